#include "core/render/pixel_pad.h"

#include <math.h>

ang_pixel_pad ang_pixel_pad_make(const ang_ray_frame *frame) {
    ang_vec3 diagonal = ang_mat4_direction(&frame->to_mm, ang_vec3_sub(frame->upper, frame->lower));
    ang_pixel_pad pad = {.pixel = ang_vec3_length(frame->step_x_mm) / 8, .rounding = 4e-6 * ang_vec3_length(diagonal)};
    if (frame->perspective)
        pad.growth = pad.pixel / ang_vec3_dot(ang_vec3_sub(frame->origin_mm, frame->eye_mm), frame->axis_mm);
    double index[3];
    for (int axis = 0; axis < 3; axis++) {
        const double *row = frame->to_index.m[axis];
        index[axis] = sqrt(row[0] * row[0] + row[1] * row[1] + row[2] * row[2]);
    }
    pad.index = (ang_vec3){index[0], index[1], index[2]};
    return pad;
}
