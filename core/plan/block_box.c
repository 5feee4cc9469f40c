#include "core/plan/block_box.h"

#include <math.h>

double ang_block_box_voxels(const ang_block_box *box, const ang_octree *octree, const ang_volume *volume,
                            ang_vec3 margin, int first[3], int end[3]) {
    double share = 1;
    for (int axis = 0; axis < 3; axis++) {
        double around = ang_vec3_at(margin, axis), leaf = octree->leaf[axis];
        first[axis] = end[axis] = 0;
        if (box->end[axis] > box->first[axis]) {
            first[axis] = (int)fmax(floor(box->first[axis] * leaf - around), 0);
            end[axis] = (int)fmin(ceil(box->end[axis] * leaf + around) + 1, volume->dims[axis]);
        }
        share *= (double)(end[axis] - first[axis]) / volume->dims[axis];
    }
    return share;
}
