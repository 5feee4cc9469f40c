#include "ui/state/clip_geometry.h"

#include <math.h>
#include <string.h>

ang_clip_plane ang_clip_plane_through(ang_vec3 mm, ang_vec3 normal) {
    normal = ang_vec3_unit(normal);
    return (ang_clip_plane){normal, ang_vec3_dot(normal, mm)};
}

ang_clip_plane ang_clip_plane_flip(const ang_clip_plane *plane) {
    return (ang_clip_plane){ang_vec3_scale(plane->normal, -1), -plane->offset_mm};
}

ang_vec3 ang_clip_plane_foot(const ang_clip_plane *plane, ang_vec3 mm) {
    return ang_vec3_along(mm, plane->normal, plane->offset_mm - ang_vec3_dot(plane->normal, mm));
}

void ang_clip_plane_angles(const ang_clip_plane *plane, double *azimuth_deg, double *elevation_deg) {
    ang_vec3 n = plane->normal;
    double level = hypot(n.x, n.y);
    *azimuth_deg = level > 1e-12 ? atan2(n.x, -n.y) * (180 / M_PI) : 0;
    *elevation_deg = atan2(n.z, level) * (180 / M_PI);
}

ang_clip_plane ang_clip_plane_turned(ang_vec3 about, double azimuth_deg, double elevation_deg) {
    double azimuth = azimuth_deg * (M_PI / 180), elevation = elevation_deg * (M_PI / 180);
    ang_vec3 normal = {sin(azimuth) * cos(elevation), -cos(azimuth) * cos(elevation), sin(elevation)};
    return ang_clip_plane_through(about, normal);
}

ang_clip_plane ang_clip_plane_moved(const ang_clip_plane *plane, const ang_volume *volume, double mm) {
    ang_vec3 lower, upper;
    ang_volume_box(volume, &lower, &upper);
    double least = INFINITY, most = -INFINITY;
    for (int i = 0; i < 8; i++) {
        ang_vec3 index = {i & 1 ? upper.x : lower.x, i & 2 ? upper.y : lower.y, i & 4 ? upper.z : lower.z};
        double at = ang_vec3_dot(plane->normal, ang_mat4_point(&volume->affine, index));
        least = fmin(least, at);
        most = fmax(most, at);
    }
    return (ang_clip_plane){plane->normal, fmin(fmax(plane->offset_mm + mm, least), most)};
}

double ang_clip_offset(const ang_clip_plane *plane, const ang_volume *volume) {
    return plane->offset_mm - ang_vec3_dot(plane->normal, ang_volume_centre(volume));
}

ang_vec3 ang_clip_normal_at(const ang_pane_map *map, ang_vec3 pivot, double length, bool towards_eye, double x,
                            double y) {
    ang_vec3 origin, direction;
    ang_pane_map_ray(map, x, y, &origin, &direction);
    ang_vec3 from = ang_vec3_sub(origin, pivot);
    ang_vec3 beside = ang_vec3_along(from, direction, -ang_vec3_dot(from, direction)); /* the ray's nearest place */
    double within = length * length - ang_vec3_dot(beside, beside);
    double deep = sqrt(fmax(within, 0));
    return ang_vec3_unit(ang_vec3_along(beside, direction, towards_eye ? -deep : deep));
}

bool ang_clip_tip_towards_eye(const ang_pane_map *map, ang_vec3 pivot, ang_vec3 tip) {
    return ang_vec3_dot(ang_vec3_sub(tip, pivot), ang_pane_map_sight(map, tip)) <= 0;
}

bool ang_clip_line(const ang_clip_plane *plane, const ang_slice_frame *frame, double ends[4]) {
    /* Over the pane the distance to the plane is at + x right + y down. */
    double right = ang_vec3_dot(plane->normal, frame->axes.right) * frame->mm_per_pixel;
    double down = ang_vec3_dot(plane->normal, frame->axes.down) * frame->mm_per_pixel;
    double at = ang_vec3_dot(plane->normal, frame->corner) - plane->offset_mm, steep = right * right + down * down;
    if (!(steep > 1e-12 * frame->mm_per_pixel * frame->mm_per_pixel)) return false;
    /* To both sides of its place nearest to the pane's middle, as far as the pane may go. */
    double middle[2] = {frame->width / 2.0, frame->height / 2.0};
    double away = (at + middle[0] * right + middle[1] * down) / steep;
    double far = hypot(frame->width, frame->height) / sqrt(steep), way[2] = {-down * far, right * far};
    double x = middle[0] - away * right, y = middle[1] - away * down;
    memcpy(ends, (double[]){x - way[0], y - way[1], x + way[0], y + way[1]}, 4 * sizeof *ends);
    return ang_line_within(ends, frame->width, frame->height);
}
