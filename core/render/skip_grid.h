/* ang_block_grid as a texture, for methods that skip along rays. Include only within core/render/ and its tests. */
#ifndef ANG_RENDER_SKIP_GRID_H
#define ANG_RENDER_SKIP_GRID_H

#include "core/plan/block_grid.h"
#include "core/render/context.h"
#include "core/render/program.h"
#include "core/render/volume_texture.h"

/* Zero-initialise; owns all. */
typedef struct ang_skip_grid {
    ang_block_grid shown;
    unsigned texture;       /* 3D, GL_R8UI: the distances */
    size_t blocks_uploaded; /* by the last update: those between the first and the last plane that changed */
} ang_skip_grid;

/* Brings the grid up to date; does nothing where the same blocks show. Where `field` is not NULL the ranges of blocks
 * come from that texture of the whole volume by compute shader, else from the volume. False with ANG_LIMIT or ANG_GL.
 */
bool ang_skip_grid_update(ang_skip_grid *grid, ang_gl *gl, const ang_volume *volume, const ang_volume_texture *field,
                          const ang_visibility *visibility, int threads, ang_error *err);
/* The context must be current. */
void ang_skip_grid_destroy(ang_skip_grid *grid);

/* skip_distance.glsl; binds the grid to texture unit `unit`. `centre`: the box's, voxel index. */
void ang_skip_grid_bind(const ang_skip_grid *grid, unsigned program, int unit, ang_vec3 centre);

#endif
