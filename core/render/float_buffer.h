/* Floats as a buffer texture: 1D textures end at 16384 texels. Include only within core/render/ and its tests. */
#ifndef ANG_RENDER_FLOAT_BUFFER_H
#define ANG_RENDER_FLOAT_BUFFER_H

#include <stddef.h>

/* Zero-initialise; owns both. */
typedef struct ang_float_buffer {
    unsigned buffer, texture;
} ang_float_buffer;

/* Uploads `count` floats, 2 or 4 a texel. OpenGL's errors are left for ang_gl_check. */
void ang_float_buffer_make(ang_float_buffer *made, int channels, const float *values, size_t count);
/* Binds it to texture unit `unit`. */
void ang_float_buffer_bind(const ang_float_buffer *made, int unit);
/* The context must be current. */
void ang_float_buffer_destroy(ang_float_buffer *made);

#endif
