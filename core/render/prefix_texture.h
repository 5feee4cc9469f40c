/* Prefix integrals on the GL side. Include only within core/render/ and its tests. */
#ifndef ANG_RENDER_PREFIX_TEXTURE_H
#define ANG_RENDER_PREFIX_TEXTURE_H

#include "core/render/context.h"
#include "core/render/float_buffer.h"
#include "core/transfer/prefix.h"

/* Zero-initialise; owns all. */
typedef struct ang_prefix_texture {
    ang_float_buffer sums;     /* two texels of GL_RGBA32F an interval */
    ang_float_buffer plateaus; /* a texel of GL_RG32F an interval; none where there is no plateau */
    double greatest;           /* as in ang_prefix */
} ang_prefix_texture;

/* Uploads them. False with ANG_GL. */
bool ang_prefix_texture_make(ang_prefix_texture *texture, ang_gl *gl, const ang_prefix *prefix, ang_error *err);
/* Deletes everything. The context must be current. */
void ang_prefix_texture_destroy(ang_prefix_texture *texture);
/* Sets the uniforms of step_prefix.glsl and prefix_plateaus.glsl; binds texture units `unit` and `unit` + 1. */
void ang_prefix_texture_bind(const ang_prefix_texture *texture, unsigned program, int unit);

#endif
