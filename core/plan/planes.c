#include "core/plan/planes.h"

void ang_slice_depths(const ang_slice_planes *planes, ang_vec3 lower, ang_vec3 upper, double *least, double *greatest) {
    *least = *greatest = planes->offset;
    for (int axis = 0; axis < 3; axis++) {
        double g = ang_vec3_at(planes->gradient, axis);
        double a = g * ang_vec3_at(lower, axis), b = g * ang_vec3_at(upper, axis);
        *least += fmin(a, b);
        *greatest += fmax(a, b);
    }
}

ang_slice_planes ang_slice_planes_make(const ang_ray_frame *frame, double step_mm) {
    ang_slice_planes planes = {.gradient = ang_mat4_transposed_direction(&frame->to_mm, frame->axis_mm),
                               .offset = -ang_vec3_dot(frame->axis_mm, frame->origin_mm),
                               .distance = step_mm};
    double least, greatest;
    ang_slice_depths(&planes, frame->lower, frame->upper, &least, &greatest);
    ang_vec3 diagonal = ang_mat4_direction(&frame->to_mm, ang_vec3_sub(frame->upper, frame->lower));
    planes.rounding = 4e-6 * ang_vec3_length(diagonal);
    least = fmax(least, frame->near_depth);
    double extent = greatest - least;
    if (!(extent > 0)) return planes;
    planes.distance = fmax(step_mm, extent / ANG_SLICE_MOST_PLANES);
    double whole = extent / planes.distance;
    if (whole <= 1) {
        planes.first = least + extent / 2;
        planes.count = 1;
    } else {
        planes.first = least + planes.distance / 2;
        /* The last may lie behind the box: rays that meet the box only behind the last but one are its. */
        planes.count = (int)fmin(ceil(whole), ANG_SLICE_MOST_PLANES);
    }
    return planes;
}

void ang_slice_range(const ang_slice_planes *planes, double least, double greatest, int *begin, int *end) {
    /* In steps: far above the rounding of depths in float, and elsewhere far below what costs time. */
    double open = fmax(1e-3, planes->rounding / planes->distance);
    double from = ceil((least - planes->first) / planes->distance - open);
    double to = floor((greatest - planes->first) / planes->distance + open) + 1;
    *begin = (int)fmin(fmax(from, 0), planes->count);
    *end = (int)fmin(fmax(to, *begin), planes->count);
}
