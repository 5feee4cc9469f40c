#include "core/render/painter.h"

#include "core/base/memory.h"
#include "core/render/program.h"
#include "shaders.h"

#include <glad/gl.h>
#include <stdlib.h>

struct ang_painter {
    ang_gl *gl;
    ang_programs programs;
    unsigned program;
    unsigned vertices, buffer, indices;
    int width, height;
};

ang_painter *ang_painter_create(ang_gl *gl, ang_error *err) {
    ang_painter *painter = ang_alloc(1, sizeof *painter, "the painter", err);
    if (!painter) return NULL;
    painter->gl = gl;
    ang_shader_source vertex = {0}, fragment = {0};
    ANG_SHADER_ADD(&vertex, version);
    ANG_SHADER_ADD(&vertex, paint_vertex);
    ANG_SHADER_ADD(&fragment, version);
    ANG_SHADER_ADD(&fragment, paint_fragment);
    painter->program = ang_programs_get(&painter->programs, "painter", &vertex, &fragment, err);
    if (!painter->program) {
        ang_painter_destroy(painter);
        return NULL;
    }
    glGenVertexArrays(1, &painter->vertices);
    glBindVertexArray(painter->vertices);
    glGenBuffers(1, &painter->buffer);
    glGenBuffers(1, &painter->indices);
    glBindBuffer(GL_ARRAY_BUFFER, painter->buffer);
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, painter->indices);
    const GLsizei stride = sizeof(ang_paint_vertex);
    glVertexAttribPointer(0, 2, GL_FLOAT, GL_FALSE, stride, (const void *)offsetof(ang_paint_vertex, x));
    glVertexAttribPointer(1, 2, GL_FLOAT, GL_FALSE, stride, (const void *)offsetof(ang_paint_vertex, u));
    glVertexAttribPointer(2, 4, GL_UNSIGNED_BYTE, GL_TRUE, stride, (const void *)offsetof(ang_paint_vertex, colour));
    for (GLuint i = 0; i < 3; i++) glEnableVertexAttribArray(i);
    glBindVertexArray(0);
    if (ang_gl_check(gl, err)) return painter;
    ang_painter_destroy(painter);
    return NULL;
}

void ang_painter_destroy(ang_painter *painter) {
    if (!painter) return;
    if (painter->vertices) glDeleteVertexArrays(1, &painter->vertices);
    if (painter->buffer) glDeleteBuffers(1, &painter->buffer);
    if (painter->indices) glDeleteBuffers(1, &painter->indices);
    ang_programs_clear(&painter->programs);
    free(painter);
}

bool ang_painter_picture(ang_painter *painter, ang_paint_texture *texture, int width, int height, const uint8_t *rgba,
                         bool smooth, ang_error *err) {
    GLint limit = 0;
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &limit);
    if (width < 1 || height < 1 || width > limit || height > limit)
        return ang_fail(err, ANG_LIMIT, "a picture of %dx%d pixels: this OpenGL (%s) shows at most %d a side", width,
                        height, ang_gl_renderer(painter->gl), limit);
    if (!texture->name) glGenTextures(1, &texture->name);
    glActiveTexture(GL_TEXTURE0);
    glBindTexture(GL_TEXTURE_2D, texture->name);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
    if (texture->width == width && texture->height == height)
        glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, width, height, GL_RGBA, GL_UNSIGNED_BYTE, rgba);
    else
        glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, width, height, 0, GL_RGBA, GL_UNSIGNED_BYTE, rgba);
    texture->width = width;
    texture->height = height;
    GLint filter = smooth ? GL_LINEAR : GL_NEAREST;
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, filter);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, filter);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    glBindTexture(GL_TEXTURE_2D, 0);
    if (ang_gl_check(painter->gl, err)) return true;
    texture->width = texture->height = 0;
    return false;
}

void ang_painter_forget(ang_painter *painter, ang_paint_texture *texture) {
    (void)painter;
    if (texture->name) glDeleteTextures(1, &texture->name);
    *texture = (ang_paint_texture){0};
}

void ang_painter_clear(ang_painter *painter, int width, int height, const float colour[3]) {
    painter->width = width;
    painter->height = height;
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    glViewport(0, 0, width, height);
    glDisable(GL_SCISSOR_TEST);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    glClearColor(colour[0], colour[1], colour[2], 1);
    glClear(GL_COLOR_BUFFER_BIT);
}

static void set_state(const ang_painter *painter) {
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    glViewport(0, 0, painter->width, painter->height);
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_CULL_FACE);
    glEnable(GL_SCISSOR_TEST);
    glEnable(GL_BLEND);
    glBlendEquation(GL_FUNC_ADD);
    /* Alpha stays 1: a compositor must not see through the window. */
    glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    glUseProgram(painter->program);
    ang_uniform_int(painter->program, "picture", 0);
    ang_uniform_vec4(painter->program, "to_clip", (ang_vec3){2.0 / painter->width, -2.0 / painter->height, -1}, 1);
    glActiveTexture(GL_TEXTURE0);
    glBindVertexArray(painter->vertices);
    glBindBuffer(GL_ARRAY_BUFFER, painter->buffer);
}

void ang_painter_draw(ang_painter *painter, const ang_paint_list *list) {
    set_state(painter);
    glBufferData(GL_ARRAY_BUFFER, (GLsizeiptr)(list->vertex_count * sizeof *list->vertices), list->vertices,
                 GL_STREAM_DRAW);
    glBufferData(GL_ELEMENT_ARRAY_BUFFER, (GLsizeiptr)(list->index_count * sizeof *list->indices), list->indices,
                 GL_STREAM_DRAW);
    for (size_t i = 0; i < list->command_count; i++) {
        const ang_paint_command *command = &list->commands[i];
        const float *clip = command->clip;
        if (!(clip[2] > clip[0] && clip[3] > clip[1])) continue;
        /* GL counts rows of a window from the bottom. */
        glScissor((GLint)clip[0], painter->height - (GLint)clip[3], (GLsizei)(clip[2] - clip[0]),
                  (GLsizei)(clip[3] - clip[1]));
        glBindTexture(GL_TEXTURE_2D, command->texture);
        glDrawElementsBaseVertex(GL_TRIANGLES, (GLsizei)command->index_count, GL_UNSIGNED_SHORT,
                                 (const void *)(command->first_index * sizeof *list->indices),
                                 (GLint)command->first_vertex);
    }
    glBindTexture(GL_TEXTURE_2D, 0);
    glBindVertexArray(0);
    glBindBuffer(GL_ARRAY_BUFFER, 0);
    glUseProgram(0);
    /* The methods expect what is usual. */
    glDisable(GL_BLEND);
    glBlendFunc(GL_ONE, GL_ZERO);
    glDisable(GL_SCISSOR_TEST);
}

void ang_painter_read(ang_painter *painter, uint8_t *rgb) {
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    size_t row = 3 * (size_t)painter->width;
    for (int y = 0; y < painter->height; y++)
        glReadPixels(0, painter->height - 1 - y, painter->width, 1, GL_RGB, GL_UNSIGNED_BYTE, rgb + row * (size_t)y);
    glPixelStorei(GL_PACK_ALIGNMENT, 4);
}

bool ang_painter_check(ang_painter *painter, ang_error *err) { return ang_gl_check(painter->gl, err); }
