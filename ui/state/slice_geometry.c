#include "ui/state/slice_geometry.h"

#include <math.h>

static const double least_zoom = 0.1, greatest_zoom = 100;
const ang_slice_view ang_slice_view_default = {.zoom = 1};

const char *ang_orientation_name(ang_orientation orientation) {
    static const char *const names[] = {"axial", "coronal", "sagittal"};
    return orientation < ANG_ORIENTATIONS ? names[orientation] : NULL;
}

static ang_slice_axes standard_axes(ang_orientation orientation) {
    static const ang_slice_axes axes[ANG_ORIENTATIONS] = {
        {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}},   /* left, posterior; from the feet towards the head */
        {{1, 0, 0}, {0, 0, -1}, {0, 1, 0}},  /* left, feet; from the front towards the back */
        {{0, 1, 0}, {0, 0, -1}, {-1, 0, 0}}, /* posterior, feet; from the left towards the right */
    };
    return axes[orientation];
}

/* `v` under the shortest rotation that takes the unit vector `from` to `to`, which are not opposite. */
static ang_vec3 carried(ang_vec3 v, ang_vec3 from, ang_vec3 to) {
    ang_vec3 axis = ang_vec3_cross(from, to); /* as long as the sine of the angle */
    double cosine = ang_vec3_dot(from, to);
    ang_vec3 out = ang_vec3_along(ang_vec3_scale(v, cosine), ang_vec3_cross(axis, v), 1);
    return ang_vec3_along(out, axis, ang_vec3_dot(axis, v) / (1 + cosine));
}

ang_slice_axes ang_slice_axes_of(const ang_turn *turn, ang_orientation orientation) {
    ang_slice_axes axes = standard_axes(orientation);
    ang_vec3 inward = ang_turn_direction(turn, axes.inward);
    if (ang_vec3_dot(axes.inward, inward) < -1 + 1e-9) /* seen from the other side: every way is as short */
        return (ang_slice_axes){ang_vec3_scale(axes.right, -1), axes.down, inward};
    axes.right = carried(axes.right, axes.inward, inward);
    axes.down = carried(axes.down, axes.inward, inward);
    axes.inward = inward;
    return axes;
}

double ang_slice_lean(const ang_turn *turn, ang_orientation orientation) {
    ang_vec3 inward = standard_axes(orientation).inward, turned = ang_turn_direction(turn, inward);
    double sine = ang_vec3_length(ang_vec3_cross(inward, turned));
    return atan2(sine, ang_vec3_dot(inward, turned)) * 180 / M_PI;
}

double ang_slice_turned(const ang_turn *turn, ang_orientation orientation) {
    ang_slice_axes axes = ang_slice_axes_of(turn, orientation);
    ang_vec3 right = ang_turn_direction(turn, standard_axes(orientation).right);
    return atan2(ang_vec3_dot(right, axes.down), ang_vec3_dot(right, axes.right)) * 180 / M_PI;
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

ang_slice_range ang_slice_range_of(const ang_volume *volume, const ang_turn *turn, ang_orientation orientation) {
    static const ang_vec3 normals[ANG_ORIENTATIONS] = {{0, 0, 1}, {0, 1, 0}, {1, 0, 0}};
    ang_slice_range range = {.normal = ang_turn_direction(turn, normals[orientation])};
    ang_mat4 to_index;
    int along = 0;
    double most = 0; /* voxels for each mm along the normal */
    if (ang_mat4_inverse(&volume->affine, &to_index)) {
        ang_vec3 voxels = ang_mat4_direction(&to_index, range.normal);
        for (int axis = 0; axis < 3; axis++) {
            if (!(fabs(ang_vec3_at(voxels, axis)) > most)) continue;
            most = fabs(ang_vec3_at(voxels, axis));
            along = axis;
        }
    }
    range.step = most > 0 ? 1 / most : 1;
    extent(volume, range.normal, &range.first, &range.last);
    range.whole = fmax(fmax(fabs(range.normal.x), fabs(range.normal.y)), fabs(range.normal.z)) >= 1;
    if (volume->dims[along] == 1 && range.whole) range.first = range.last = (range.first + range.last) / 2;
    range.count = (int)fmin(floor((range.last - range.first) / range.step + 1e-6) + 1, 1e6);
    return range;
}

/* Where a point lies between the slices, and the point moved there along the normal. */
static double position(const ang_slice_range *range, ang_vec3 mm) {
    return (ang_vec3_dot(mm, range->normal) - range->first) / range->step;
}
static ang_vec3 moved(const ang_slice_range *range, ang_vec3 mm, double to) {
    double last = range->whole ? range->count - 1 : (range->last - range->first) / range->step;
    double along = range->first + fmin(fmax(to, 0), last) * range->step;
    return ang_vec3_along(mm, range->normal, along - ang_vec3_dot(mm, range->normal));
}

/* Of two slices as near the further one, whatever the rounding. */
static double nearest(double position) { return floor(position + 0.5 + 1e-6); }

int ang_slice_index(const ang_slice_range *range, ang_vec3 mm) {
    return (int)fmin(fmax(nearest(position(range, mm)), 0), range->count - 1);
}

ang_vec3 ang_slice_place(const ang_slice_range *range, ang_vec3 mm, int index) {
    return moved(range, mm, fmin(index, range->count - 1));
}

ang_vec3 ang_slice_move(const ang_slice_range *range, ang_vec3 mm, int slices) {
    double at = position(range, mm);
    if (range->whole) at = nearest(at);
    return moved(range, mm, at + slices);
}

ang_slice_frame ang_slice_frame_make(const ang_volume *volume, const ang_turn *turn, ang_orientation orientation,
                                     const ang_slice_view *view, ang_vec3 crosshair, int width, int height) {
    ang_slice_frame frame = {.axes = ang_slice_axes_of(turn, orientation), .width = width, .height = height};
    /* Turning does not change the scale. */
    ang_slice_axes standard = standard_axes(orientation);
    double x0, x1, y0, y1;
    extent(volume, standard.right, &x0, &x1);
    extent(volume, standard.down, &y0, &y1);
    double fit = fmax((x1 - x0) / fmax(width, 1), (y1 - y0) / fmax(height, 1));
    frame.mm_per_pixel = (fit > 0 ? fit : 1) / view->zoom;
    ang_vec3 inward = frame.axes.inward, centre = ang_volume_centre(volume);
    double x = ang_vec3_dot(centre, frame.axes.right) + view->pan_mm[0] - frame.mm_per_pixel * width / 2;
    double y = ang_vec3_dot(centre, frame.axes.down) + view->pan_mm[1] - frame.mm_per_pixel * height / 2;
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

void ang_slice_cut(const ang_slice_frame *frame, const ang_turn *turn, ang_orientation other, double direction[2]) {
    ang_vec3 normal = ang_turn_direction(turn, standard_axes(other).inward);
    ang_vec3 along = ang_vec3_cross(frame->axes.inward, normal);
    direction[0] = ang_vec3_dot(along, frame->axes.right);
    direction[1] = ang_vec3_dot(along, frame->axes.down);
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

/* `value` within half the volume's extent along a direction. */
static double inside(const ang_volume *volume, ang_vec3 direction, double value) {
    double least, most;
    extent(volume, direction, &least, &most);
    double half = (most - least) / 2;
    return fmin(fmax(value, -half), half);
}

void ang_slice_keep_inside(ang_slice_view *view, const ang_volume *volume, const ang_slice_axes *axes) {
    view->pan_mm[0] = inside(volume, axes->right, view->pan_mm[0]);
    view->pan_mm[1] = inside(volume, axes->down, view->pan_mm[1]);
}

void ang_slice_keep_place(ang_slice_view *view, const ang_volume *volume, ang_vec3 mm, const ang_slice_axes *before,
                          const ang_slice_axes *after) {
    ang_vec3 from = ang_vec3_sub(mm, ang_volume_centre(volume));
    view->pan_mm[0] += ang_vec3_dot(from, ang_vec3_sub(after->right, before->right));
    view->pan_mm[1] += ang_vec3_dot(from, ang_vec3_sub(after->down, before->down));
}
