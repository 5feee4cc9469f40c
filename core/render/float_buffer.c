#include "core/render/float_buffer.h"

#include <glad/gl.h>

void ang_float_buffer_make(ang_float_buffer *made, int channels, const float *values, size_t count) {
    ang_float_buffer_destroy(made);
    glGenBuffers(1, &made->buffer);
    glBindBuffer(GL_TEXTURE_BUFFER, made->buffer);
    glBufferData(GL_TEXTURE_BUFFER, (GLsizeiptr)(count * sizeof *values), values, GL_STATIC_DRAW);
    glGenTextures(1, &made->texture);
    glBindTexture(GL_TEXTURE_BUFFER, made->texture);
    glTexBuffer(GL_TEXTURE_BUFFER, channels == 2 ? GL_RG32F : GL_RGBA32F, made->buffer);
    glBindTexture(GL_TEXTURE_BUFFER, 0);
    glBindBuffer(GL_TEXTURE_BUFFER, 0);
}

void ang_float_buffer_bind(const ang_float_buffer *made, int unit) {
    glActiveTexture(GL_TEXTURE0 + (GLenum)unit);
    glBindTexture(GL_TEXTURE_BUFFER, made->texture);
}

void ang_float_buffer_destroy(ang_float_buffer *made) {
    if (made->texture) glDeleteTextures(1, &made->texture);
    if (made->buffer) glDeleteBuffers(1, &made->buffer);
    *made = (ang_float_buffer){0};
}
