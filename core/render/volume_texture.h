/* A volume on the GL side. Include only within core/render/ and its tests. */
#ifndef ANG_RENDER_VOLUME_TEXTURE_H
#define ANG_RENDER_VOLUME_TEXTURE_H

#include "core/render/context.h"
#include "core/volume/volume.h"

/* Zero-initialise. `values` is a 3D texture of GL_R16: texture coordinate (index + 0.5) / dims gives stored / 65535,
 * trilinear, clamped to the box. */
typedef struct ang_volume_texture {
    unsigned values;
    unsigned weight; /* 0, or 1.0 where a voxel is not padding and 0.0 where it is, of the same shape */
} ang_volume_texture;

/* Uploads the stored values. False with ANG_LIMIT where a side or the size is beyond what this GL takes. */
bool ang_volume_texture_create(ang_volume_texture *texture, ang_gl *gl, const ang_volume *volume, ang_error *err);
/* Uploads the weight too, for the mean; does nothing where it is there or the volume has no padding. The weight is
 * GL_R16 as well: software GL filters 8-bit textures in 8 bits, which would be several HU at the edge of the padding.
 */
bool ang_volume_texture_add_weight(ang_volume_texture *texture, ang_gl *gl, const ang_volume *volume, ang_error *err);
/* Deletes the textures. The context must be current. */
void ang_volume_texture_destroy(ang_volume_texture *texture);

#endif
