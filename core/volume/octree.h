/* Min-max octree over the volume: what interpolation can give in any block of 8^3 cells, and in their unions. */
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
 * node. Leaf (i,j,k) covers the cells [8i, 8i+8) x ..., that is the voxels 8i .. 8i+8 (apron 1: every voxel that
 * interpolation inside touches) or 8i-1 .. 8i+9 (apron 2: central differences of it too), clamped to the volume. */
typedef struct ang_octree {
    int apron;
    int levels;
    ang_octree_level level[ANG_OCTREE_MAX_LEVELS];
} ang_octree;

/* Builds the tree in parallel; any dims >= 1; apron 1 or 2. NULL with ANG_LIMIT. Free with ang_octree_free. */
ang_octree *ang_octree_build(const ang_volume *volume, int apron, int threads, ang_error *err);
void ang_octree_free(ang_octree *octree);

#endif
