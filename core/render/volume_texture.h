/* A volume, or a part of it, on the GL side. Include only within core/render/ and its tests. */
#ifndef ANG_RENDER_VOLUME_TEXTURE_H
#define ANG_RENDER_VOLUME_TEXTURE_H

#include "core/render/context.h"
#include "core/volume/volume.h"

/* Zero-initialise. `values` is a 3D texture of GL_R16: texture coordinate (index - first + 0.5) / dims gives stored /
 * 65535, trilinear, clamped to the box. */
typedef struct ang_volume_texture {
    unsigned values;
    unsigned weight; /* 0, or 1.0 where a voxel is not padding and 0.0 where it is, of the same shape */
    int first[3];    /* voxel index of the first texel; may lie before the volume, whose outermost voxels go on there */
    int dims[3];     /* texels */
    int held_first[3], held_end[3]; /* of a whole volume: the voxels that are there */
} ang_volume_texture;

/* Whether this GL takes textures of that many texels; false with ANG_LIMIT, saying how many it takes a side. */
bool ang_volume_texture_fits(ang_gl *gl, const int dims[3], ang_error *err);

/* Uploads the stored values of the whole volume. False with ANG_LIMIT where a side or the size is beyond what this GL
 * takes. */
bool ang_volume_texture_create(ang_volume_texture *texture, ang_gl *gl, const ang_volume *volume, ang_error *err);
/* The same in two parts: a texture for the whole volume without its voxels, and those from `first` up to, not with,
 * `end` (limited to the volume), or all of the least box that holds them and what is there already. Anything else is
 * undefined. */
bool ang_volume_texture_reserve(ang_volume_texture *texture, ang_gl *gl, const ang_volume *volume, ang_error *err);
bool ang_volume_texture_hold(ang_volume_texture *texture, ang_gl *gl, const ang_volume *volume, const int first[3],
                             const int end[3], ang_error *err);
/* Uploads the part of `dims` voxels from `first` on; a texture that has `dims` already is filled anew. */
bool ang_volume_texture_set_part(ang_volume_texture *texture, ang_gl *gl, const ang_volume *volume, const int first[3],
                                 const int dims[3], ang_error *err);
/* Uploads the weight too, for the mean; does nothing where it is there or the volume has no padding. The weight is
 * GL_R16 as well: software GL filters 8-bit textures in 8 bits, which would be several HU at the edge of the padding.
 */
bool ang_volume_texture_add_weight(ang_volume_texture *texture, ang_gl *gl, const ang_volume *volume, ang_error *err);
/* Deletes the textures. The context must be current. */
void ang_volume_texture_destroy(ang_volume_texture *texture);

#endif
