#include "core/proxy/slicer.h"

void ang_slicer_make(ang_slicer *slicer, ang_vec3 lower, ang_vec3 upper, ang_vec3 gradient) {
    slicer->lower = lower;
    slicer->size = ang_vec3_sub(upper, lower);
    slicer->front = (gradient.x < 0) | (gradient.y < 0) << 1 | (gradient.z < 0) << 2;
    for (int axis = 0; axis < 3; axis++)
        slicer->rise[axis] = fabs(ang_vec3_at(gradient, axis)) * ang_vec3_at(slicer->size, axis);
    for (int c = 0; c < 8; c++)
        slicer->corner[c] = (ang_vec3){c & 1 ? upper.x : lower.x, c & 2 ? upper.y : lower.y, c & 4 ? upper.z : lower.z};
    double least = ang_vec3_dot(gradient, slicer->corner[slicer->front]);
    for (int steps = 0; steps < 8; steps++) {
        double depth = least;
        for (int axis = 0; axis < 3; axis++)
            if (steps >> axis & 1) depth += slicer->rise[axis];
        slicer->depth[slicer->front ^ steps] = depth;
    }
}
