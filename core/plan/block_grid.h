/* Which blocks of a volume show something in a scene, and how far the next one is: for methods that skip along rays. */
#ifndef ANG_PLAN_BLOCK_GRID_H
#define ANG_PLAN_BLOCK_GRID_H

#include "core/plan/block_box.h"
#include "core/plan/visibility.h"

/* Cells a side of a block: with 8, 1.4 times as many samples are taken, which costs more than the finer grid
 * (docs/papers.md). */
enum { ANG_SKIP_BLOCK = 4 };

/* Zero-initialise; owns all. Blocks are the leaves of an octree, ANG_SKIP_BLOCK cells a side, with an apron of one
 * voxel: every value that interpolation gives inside a block lies in its range. */
typedef struct ang_block_grid {
    ang_octree *octree; /* NULL before the first update */
    uint8_t *visible;   /* of each block: 1 or 0 */
    uint8_t *distance;  /* ang_block_distances */
    size_t blocks, visible_blocks;
    ang_block_box box; /* of the visible blocks */
    uint64_t changes;  /* rises when the set of visible blocks does */
    double build_ms;   /* of the last update: the octree */
} ang_block_grid;

/* Gives an empty grid its octree, which becomes the grid's own even where this fails: of the volume's ranges, or, where
 * `octree` is not NULL, one whose ranges are already known. False with ANG_LIMIT. */
bool ang_block_grid_start(ang_block_grid *grid, const ang_volume *volume, ang_octree *octree, int threads,
                          ang_error *err);
/* An octree for a grid without ranges; NULL with ANG_LIMIT. */
ang_octree *ang_block_grid_octree(const ang_volume *volume, ang_error *err);
/* Brings a started grid up to date; true in *changed where other blocks show than before, and only then the distances
 * are made anew. `rounding`: whether values may lie beyond their voxels' by a unit in the last place, as interpolation
 * in float gives them, and count as shown where the next whole value does. False with ANG_LIMIT, nothing changed. */
bool ang_block_grid_update(ang_block_grid *grid, const ang_visibility *visibility, bool rounding, int threads,
                           bool *changed, ang_error *err);
/* Frees what it holds and makes it empty. */
void ang_block_grid_clear(ang_block_grid *grid);

#endif
