/* Min-max octree over the volume: what interpolation can give in any leaf of cells, 8^3 by default, and in their
 * unions.
 */
#ifndef ANG_VOLUME_OCTREE_H
#define ANG_VOLUME_OCTREE_H

#include "core/volume/volume.h"

enum { ANG_OCTREE_LEAF = 8, ANG_OCTREE_MAX_LEVELS = 32 };

typedef struct ang_minmax {
    uint16_t min, max;
} ang_minmax;

typedef struct ang_octree_level {
    int dims[3];       /* nodes along x, y, z */
    ang_minmax *nodes; /* x fastest */
} ang_octree_level;

/* Level 0 has the leaves; node (i,j,k) of level L covers the nodes 2i..2i+1, ... of level L-1; the last level is one
 * node. With leaves of n cells along x, leaf i covers the cells [n i, n i + n), that is the voxels n i .. n i + n
 * (apron 1: every voxel that interpolation inside touches) or, with apron a, a-1 voxels more on each side, clamped to
 * the volume. */
typedef struct ang_octree {
    int leaf[3];  /* cells of a leaf along x, y, z */
    int cells[3]; /* of the volume: voxels less one; an axis of one voxel has one cell */
    int apron;
    int levels;
    ang_octree_level level[ANG_OCTREE_MAX_LEVELS];
} ang_octree;

/* Builds the tree in parallel; any dims >= 1; `leaf` NULL: ANG_OCTREE_LEAF along each axis, else each >= 1; apron >= 1
 * (2: central differences too). NULL with ANG_LIMIT. Free with ang_octree_free. */
ang_octree *ang_octree_build(const ang_volume *volume, const int leaf[3], int apron, int threads, ang_error *err);
/* The same in two halves, for leaves whose ranges come from elsewhere: without any range yet, and the levels above
 * filled leaves. */
ang_octree *ang_octree_allocate(const ang_volume *volume, const int leaf[3], int apron, ang_error *err);
void ang_octree_finish(ang_octree *octree, int threads);
void ang_octree_free(ang_octree *octree);

/* The cells [first, end) along each axis of node (x,y,z) of `level`. */
void ang_octree_cells(const ang_octree *octree, int level, const int node[3], int first[3], int end[3]);

#endif
