/* Gradients beside the values in one texture, so that a shaded sample takes one lookup instead of seven. Include only
 * within core/render/ and its tests. */
#ifndef ANG_RENDER_GRADIENT_TEXTURE_H
#define ANG_RENDER_GRADIENT_TEXTURE_H

#include "core/plan/block_grid.h"
#include "core/render/context.h"
#include "core/render/program.h"

/* Zero-initialise; owns all. GL_RGBA16: in r, g, b the difference of the neighbours along x, y, z, clamped at the box,
 * in steps of range / 32767 about 32768 / 65535; in a the stored value / 65535. Interpolated, that is what central
 * differences of the interpolated field are, to half a step. Only blocks that have been visible are filled. */
typedef struct ang_gradient_texture {
    unsigned texture;
    double range;    /* greatest difference that can be stored: that of any two voxels */
    uint8_t *filled; /* of each block of the grid */
    size_t blocks_filled;
    size_t bytes;    /* of what has been filled: what lies untouched takes software GL no memory */
    double build_ms; /* of the last update */
} ang_gradient_texture;

/* Whether this GL takes one for the volume, and the bytes of all of it, though software GL touches filled blocks alone.
 * The context must be current. */
bool ang_gradient_texture_fits(const ang_volume *volume);
size_t ang_gradient_texture_bytes(const ang_volume *volume);

/* Fills the visible blocks of the grid that are not there yet. False with ANG_LIMIT, ANG_GL. */
bool ang_gradient_texture_update(ang_gradient_texture *gradients, ang_gl *gl, const ang_volume *volume,
                                 const ang_block_grid *grid, int threads, ang_error *err);
/* field_gradient.glsl; binds it to texture unit `unit`. */
void ang_gradient_texture_bind(const ang_gradient_texture *gradients, unsigned program, int unit);
void ang_gradient_texture_destroy(ang_gradient_texture *gradients);

#endif
