#include "core/render/target.h"

#include <glad/gl.h>

static GLuint attach_buffer(GLenum attachment, GLenum format, int width, int height) {
    GLuint name = 0;
    glGenRenderbuffers(1, &name);
    glBindRenderbuffer(GL_RENDERBUFFER, name);
    glRenderbufferStorage(GL_RENDERBUFFER, format, width, height);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, attachment, GL_RENDERBUFFER, name);
    glBindRenderbuffer(GL_RENDERBUFFER, 0);
    return name;
}

static GLuint attach_texture(GLenum attachment, GLenum format, int width, int height) {
    GLuint name = 0;
    glGenTextures(1, &name);
    glBindTexture(GL_TEXTURE_2D, name);
    glTexStorage2D(GL_TEXTURE_2D, 1, format, width, height);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    glBindTexture(GL_TEXTURE_2D, 0);
    glFramebufferTexture2D(GL_FRAMEBUFFER, attachment, GL_TEXTURE_2D, name, 0);
    return name;
}

static bool is_complete(void) { return glCheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE; }

static bool make_depth_only(ang_target *target) {
    glGenFramebuffers(1, &target->depth_only);
    glBindFramebuffer(GL_FRAMEBUFFER, target->depth_only);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, target->depth);
    glDrawBuffer(GL_NONE);
    return is_complete();
}

/* The most pixels a side of a picture. */
static int side_limit(void) {
    static const GLenum limits[] = {GL_MAX_RENDERBUFFER_SIZE, GL_MAX_TEXTURE_SIZE};
    GLint least[2] = {0, 0};
    glGetIntegerv(GL_MAX_VIEWPORT_DIMS, least);
    int limit = least[0] < least[1] ? least[0] : least[1];
    for (size_t i = 0; i < sizeof limits / sizeof *limits; i++) {
        GLint value = 0;
        glGetIntegerv(limits[i], &value);
        if (value < limit) limit = value;
    }
    return limit;
}

bool ang_target_fits(ang_gl *gl, int width, int height, ang_error *err) {
    int limit = side_limit();
    return (width <= limit && height <= limit) ||
           ang_fail(err, ANG_LIMIT,
                    "picture of %dx%d pixels: this OpenGL (%s) draws at most %d a side; give a smaller --size", width,
                    height, ang_gl_renderer(gl), limit);
}

bool ang_target_resize(ang_target *target, ang_gl *gl, int width, int height, unsigned parts, ang_error *err) {
    if (target->framebuffer && target->width == width && target->height == height && target->parts == parts)
        return true;
    ang_target_destroy(target);
    if (!ang_target_fits(gl, width, height, err)) return false;
    glGenFramebuffers(1, &target->framebuffer);
    glBindFramebuffer(GL_FRAMEBUFFER, target->framebuffer);
    target->colour = attach_texture(GL_COLOR_ATTACHMENT0, GL_RGBA32F, width, height);
    bool counting = parts & ANG_TARGET_COUNTS;
    if (counting) target->counts = attach_buffer(GL_COLOR_ATTACHMENT1, GL_R32F, width, height);
    if (parts & ANG_TARGET_DEPTH)
        target->depth = attach_buffer(GL_DEPTH_ATTACHMENT, GL_DEPTH_COMPONENT32F, width, height);
    static const GLenum attachments[] = {GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1};
    glDrawBuffers(counting ? 2 : 1, attachments);
    target->parts = parts;
    target->width = width;
    target->height = height;
    bool complete = is_complete() && (!target->depth || make_depth_only(target));
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    if (ang_gl_check(gl, err) && complete) return true;
    ang_target_destroy(target);
    return ang_fail(err, ANG_LIMIT,
                    "picture of %dx%d pixels in floats: this OpenGL (%s) refuses it; give a smaller --size", width,
                    height, ang_gl_renderer(gl));
}

void ang_target_destroy(ang_target *target) {
    if (target->framebuffer) glDeleteFramebuffers(1, &target->framebuffer);
    if (target->depth_only) glDeleteFramebuffers(1, &target->depth_only);
    if (target->colour) glDeleteTextures(1, &target->colour);
    if (target->counts) glDeleteRenderbuffers(1, &target->counts);
    if (target->depth) glDeleteRenderbuffers(1, &target->depth);
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
