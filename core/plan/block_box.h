/* The box of an octree's leaves that show something. */
#ifndef ANG_PLAN_BLOCK_BOX_H
#define ANG_PLAN_BLOCK_BOX_H

#include "core/volume/octree.h"

/* Leaves [first, end) along each axis. */
typedef struct ang_block_box {
    int first[3], end[3];
} ang_block_box;

/* One that holds no leaf, and the least one with leaf `index` (x fastest) of the octree as well. */
static inline ang_block_box ang_block_box_none(void) {
    return (ang_block_box){{INT32_MAX, INT32_MAX, INT32_MAX}, {0, 0, 0}};
}
static inline void ang_block_box_add(ang_block_box *box, const ang_octree *octree, size_t index) {
    const int *dims = octree->level[0].dims;
    size_t width = (size_t)dims[0], height = (size_t)dims[1];
    const int at[3] = {(int)(index % width), (int)(index / width % height), (int)(index / width / height)};
    for (int axis = 0; axis < 3; axis++) {
        if (at[axis] < box->first[axis]) box->first[axis] = at[axis];
        if (at[axis] >= box->end[axis]) box->end[axis] = at[axis] + 1;
    }
}

/* The voxels [first, end), limited to the volume, that interpolation up to `margin` cells around the box touches; none
 * for an empty box. Returns their share of the volume. */
double ang_block_box_voxels(const ang_block_box *box, const ang_octree *octree, const ang_volume *volume,
                            ang_vec3 margin, int first[3], int end[3]);

#endif
