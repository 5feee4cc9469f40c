#include "core/scene/clip_space.h"

static ang_linear_form combine(const ang_linear_form *a, double s, const ang_linear_form *b, double t) {
    return (ang_linear_form){ang_vec3_along(ang_vec3_scale(a->gradient, s), b->gradient, t),
                             s * a->constant + t * b->constant};
}

/* The clip coordinate along `step`, the way in mm from one pixel to the next of `pixels`. */
static ang_linear_form across(const ang_ray_frame *frame, const ang_linear_form *w, ang_vec3 step, int pixels) {
    double squared = ang_vec3_dot(step, step), scale = 2 / (squared * pixels);
    ang_vec3 start = frame->perspective ? frame->eye_mm : frame->origin_mm;
    double shift = 2 * ang_vec3_dot(ang_vec3_sub(start, frame->origin_mm), step) / (squared * pixels) - 1;
    /* In perspective a point appears where its ray meets the plane of p. */
    if (frame->perspective) scale *= ang_vec3_dot(ang_vec3_sub(frame->origin_mm, frame->eye_mm), frame->axis_mm);
    ang_linear_form offset = {ang_vec3_scale(ang_mat4_transposed_direction(&frame->to_mm, step), scale),
                              -scale * ang_vec3_dot(start, step)};
    return combine(&offset, 1, w, shift);
}

ang_clip_space ang_clip_space_make(const ang_ray_frame *frame, int width, int height) {
    ang_clip_space space = {.w = {.constant = 1}};
    if (frame->perspective)
        space.w = (ang_linear_form){ang_mat4_transposed_direction(&frame->to_mm, frame->axis_mm),
                                    -ang_vec3_dot(frame->eye_mm, frame->axis_mm)};
    space.x = across(frame, &space.w, frame->step_x_mm, width);
    space.y = across(frame, &space.w, frame->step_y_mm, height);
    return space;
}

bool ang_clip_space_ahead(const ang_clip_space *space, ang_vec3 lower, ang_vec3 upper) {
    double farthest = ang_linear_form_greatest(&space->w, lower, upper);
    return ang_linear_form_least(&space->w, lower, upper) > 1e-3 * farthest;
}

bool ang_clip_space_outside(const ang_clip_space *space, ang_vec3 lower, ang_vec3 upper) {
    const ang_linear_form *across[] = {&space->x, &space->y};
    for (int i = 0; i < 2; i++)
        for (int sign = -1; sign <= 1; sign += 2) {
            ang_linear_form inside = combine(&space->w, 1, across[i], sign);
            if (ang_linear_form_greatest(&inside, lower, upper) < 0) return true;
        }
    return ang_linear_form_greatest(&space->w, lower, upper) < 0;
}
