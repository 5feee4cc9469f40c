#include "core/render/target.h"

#include <glad/gl.h>

static GLuint attach(GLenum attachment, GLenum format, int width, int height) {
    GLuint name = 0;
    glGenRenderbuffers(1, &name);
    glBindRenderbuffer(GL_RENDERBUFFER, name);
    glRenderbufferStorage(GL_RENDERBUFFER, format, width, height);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, attachment, GL_RENDERBUFFER, name);
    glBindRenderbuffer(GL_RENDERBUFFER, 0);
    return name;
}

bool ang_target_resize(ang_target *target, ang_gl *gl, int width, int height, bool counting, ang_error *err) {
    if (target->framebuffer && target->width == width && target->height == height && (target->counts != 0) == counting)
        return true;
    ang_target_destroy(target);
    GLint limit = 0;
    GLint viewport[2] = {0, 0};
    glGetIntegerv(GL_MAX_RENDERBUFFER_SIZE, &limit);
    glGetIntegerv(GL_MAX_VIEWPORT_DIMS, viewport);
    if (viewport[0] < limit) limit = viewport[0];
    if (viewport[1] < limit) limit = viewport[1];
    if (width > limit || height > limit)
        return ang_fail(err, ANG_LIMIT,
                        "picture of %dx%d pixels: this OpenGL (%s) draws at most %d a side; give a smaller --size",
                        width, height, ang_gl_renderer(gl), (int)limit);
    glGenFramebuffers(1, &target->framebuffer);
    glBindFramebuffer(GL_FRAMEBUFFER, target->framebuffer);
    target->colour = attach(GL_COLOR_ATTACHMENT0, GL_RGBA32F, width, height);
    if (counting) target->counts = attach(GL_COLOR_ATTACHMENT1, GL_R32F, width, height);
    static const GLenum attachments[] = {GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1};
    glDrawBuffers(counting ? 2 : 1, attachments);
    target->width = width;
    target->height = height;
    bool complete = glCheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE;
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    if (ang_gl_check(gl, err) && complete) return true;
    ang_target_destroy(target);
    return ang_fail(err, ANG_LIMIT,
                    "picture of %dx%d pixels in floats: this OpenGL (%s) refuses it; give a smaller --size", width,
                    height, ang_gl_renderer(gl));
}

void ang_target_destroy(ang_target *target) {
    if (target->framebuffer) glDeleteFramebuffers(1, &target->framebuffer);
    if (target->colour) glDeleteRenderbuffers(1, &target->colour);
    if (target->counts) glDeleteRenderbuffers(1, &target->counts);
    *target = (ang_target){0};
}

void ang_target_read(const ang_target *target, int first, int rows, ang_image *image) {
    glBindFramebuffer(GL_READ_FRAMEBUFFER, target->framebuffer);
    glReadBuffer(GL_COLOR_ATTACHMENT0);
    glReadPixels(0, first, target->width, rows, GL_RGBA, GL_FLOAT,
                 image->rgba + (size_t)first * (size_t)target->width * 4);
}

void ang_target_read_counts(const ang_target *target, int first, int rows, float *counts, uint64_t *sum,
                            uint64_t *pixels) {
    glBindFramebuffer(GL_READ_FRAMEBUFFER, target->framebuffer);
    glReadBuffer(GL_COLOR_ATTACHMENT1);
    glReadPixels(0, first, target->width, rows, GL_RED, GL_FLOAT, counts);
    for (size_t i = 0; i < (size_t)rows * (size_t)target->width; i++) {
        *sum += (uint64_t)counts[i];
        *pixels += counts[i] > 0;
    }
}
