/* Which blocks of a volume show something in a scene, and how far the next one is: for methods that skip along rays.
 * Include only within core/render/ and its tests. */
#ifndef ANG_RENDER_SKIP_GRID_H
#define ANG_RENDER_SKIP_GRID_H

#include "core/plan/block_box.h"
#include "core/plan/visibility.h"
#include "core/render/context.h"
#include "core/render/program.h"
#include "core/render/volume_texture.h"

/* Cells a side of a block: with 8, 1.4 times as many samples are taken, which costs more than the finer grid
 * (docs/papers.md). */
enum { ANG_SKIP_BLOCK = 4 };

/* Zero-initialise; owns all. Blocks are the leaves of an octree, ANG_SKIP_BLOCK cells a side, with an apron of one
 * voxel: every value that interpolation gives inside a block lies in its range. */
typedef struct ang_skip_grid {
    ang_octree *octree; /* NULL before the first update */
    uint8_t *visible;   /* of each block: 1 or 0 */
    uint8_t *distance;  /* ang_block_distances */
    unsigned texture;   /* 3D, GL_R8UI: `distance` */
    size_t blocks, visible_blocks;
    ang_block_box box;      /* of the visible blocks */
    uint64_t changes;       /* rises when the set of visible blocks does */
    size_t blocks_uploaded; /* by the last update: those between the first and the last plane that changed */
    double build_ms;        /* of the last update: the octree */
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
