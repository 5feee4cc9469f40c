#include "ui/state/slice_geometry.h"

#include <math.h>

static const double least_zoom = 0.1, greatest_zoom = 100;
const ang_slice_view ang_slice_view_default = {.zoom = 1};

const char *ang_orientation_name(ang_orientation orientation) {
    static const char *const names[] = {"axial", "coronal", "sagittal"};
    return orientation < ANG_ORIENTATIONS ? names[orientation] : NULL;
}

ang_slice_axes ang_slice_axes_of(ang_orientation orientation) {
    static const ang_slice_axes axes[ANG_ORIENTATIONS] = {
        {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}},   /* left, posterior; from the feet towards the head */
        {{1, 0, 0}, {0, 0, -1}, {0, 1, 0}},  /* left, feet; from the front towards the back */
        {{0, 1, 0}, {0, 0, -1}, {-1, 0, 0}}, /* posterior, feet; from the left towards the right */
    };
    return axes[orientation];
}

/* The extent of the volume's box along a direction. */
static void extent(const ang_volume *volume, ang_vec3 direction, double *least, double *most) {
    ang_vec3 lower, upper;
    ang_volume_box(volume, &lower, &upper);
    *least = INFINITY;
    *most = -INFINITY;
    for (int corner = 0; corner < 8; corner++) {
        ang_vec3 index = {corner & 1 ? upper.x : lower.x, corner & 2 ? upper.y : lower.y,
                          corner & 4 ? upper.z : lower.z};
        double at = ang_vec3_dot(ang_mat4_point(&volume->affine, index), direction);
        *least = fmin(*least, at);
        *most = fmax(*most, at);
    }
}

ang_slice_range ang_slice_range_of(const ang_volume *volume, ang_orientation orientation) {
    static const ang_vec3 normals[ANG_ORIENTATIONS] = {{0, 0, 1}, {0, 1, 0}, {1, 0, 0}};
    ang_slice_range range = {.normal = normals[orientation]};
    int along = 0;
    for (int axis = 0; axis < 3; axis++) {
        double step = fabs(ang_vec3_dot(ang_mat4_column(&volume->affine, axis), range.normal));
        if (step > range.step) {
            range.step = step;
            along = axis;
        }
    }
    double most;
    extent(volume, range.normal, &range.first, &most);
    if (!(range.step > 0)) range.step = 1;
    if (volume->dims[along] == 1) range.first = (range.first + most) / 2, most = range.first;
    range.count = (int)fmin(floor((most - range.first) / range.step + 1e-6) + 1, 1e6);
    return range;
}

int ang_slice_index(const ang_slice_range *range, ang_vec3 mm) {
    double index = round((ang_vec3_dot(mm, range->normal) - range->first) / range->step);
    return (int)fmin(fmax(index, 0), range->count - 1);
}

ang_vec3 ang_slice_place(const ang_slice_range *range, ang_vec3 mm, int index) {
    index = index < 0 ? 0 : index >= range->count ? range->count - 1 : index;
    return ang_vec3_along(mm, range->normal, range->first + index * range->step - ang_vec3_dot(mm, range->normal));
}

ang_slice_frame ang_slice_frame_make(const ang_volume *volume, ang_orientation orientation, const ang_slice_view *view,
                                     ang_vec3 crosshair, int width, int height) {
    ang_slice_frame frame = {.axes = ang_slice_axes_of(orientation), .width = width, .height = height};
    double x0, x1, y0, y1;
    extent(volume, frame.axes.right, &x0, &x1);
    extent(volume, frame.axes.down, &y0, &y1);
    double fit = fmax((x1 - x0) / fmax(width, 1), (y1 - y0) / fmax(height, 1));
    frame.mm_per_pixel = (fit > 0 ? fit : 1) / view->zoom;
    ang_vec3 inward = frame.axes.inward;
    double x = (x0 + x1) / 2 + view->pan_mm[0] - frame.mm_per_pixel * width / 2;
    double y = (y0 + y1) / 2 + view->pan_mm[1] - frame.mm_per_pixel * height / 2;
    frame.corner = ang_vec3_scale(frame.axes.right, x);
    frame.corner = ang_vec3_along(frame.corner, frame.axes.down, y);
    frame.corner = ang_vec3_along(frame.corner, inward, ang_vec3_dot(crosshair, inward));
    return frame;
}

ang_vec3 ang_slice_at(const ang_slice_frame *frame, double x, double y) {
    ang_vec3 at = ang_vec3_along(frame->corner, frame->axes.right, x * frame->mm_per_pixel);
    return ang_vec3_along(at, frame->axes.down, y * frame->mm_per_pixel);
}

void ang_slice_locate(const ang_slice_frame *frame, ang_vec3 mm, double *x, double *y) {
    ang_vec3 from = ang_vec3_sub(mm, frame->corner);
    *x = ang_vec3_dot(from, frame->axes.right) / frame->mm_per_pixel;
    *y = ang_vec3_dot(from, frame->axes.down) / frame->mm_per_pixel;
}

ang_reslice_plane ang_slice_plane(const ang_slice_frame *frame, double thickness_mm, ang_slab slab) {
    return (ang_reslice_plane){.origin = ang_slice_at(frame, 0.5, 0.5),
                               .step_x = ang_vec3_scale(frame->axes.right, frame->mm_per_pixel),
                               .step_y = ang_vec3_scale(frame->axes.down, frame->mm_per_pixel),
                               .width = frame->width,
                               .height = frame->height,
                               .thickness_mm = thickness_mm,
                               .slab = slab};
}

void ang_slice_zoom(ang_slice_view *view, const ang_slice_frame *frame, double x, double y, double factor) {
    double zoom = fmin(fmax(view->zoom * factor, least_zoom), greatest_zoom);
    double kept = 1 - view->zoom / zoom; /* of the distance from the middle */
    view->pan_mm[0] += (x - frame->width / 2.0) * frame->mm_per_pixel * kept;
    view->pan_mm[1] += (y - frame->height / 2.0) * frame->mm_per_pixel * kept;
    view->zoom = zoom;
}
