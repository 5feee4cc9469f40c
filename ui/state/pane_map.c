#include "ui/state/pane_map.h"

#include <math.h>

static const double least_zoom = 0.1, greatest_zoom = 100;
static const double end_on = 0.1; /* sine of the least angle to the line of sight at which a movement is seen */

ang_pane_map ang_pane_map_of_camera(const ang_camera *camera, int width, int height) {
    bool perspective = camera->projection == ANG_PERSPECTIVE;
    double half = perspective ? tan(camera->fov_deg * (M_PI / 360)) : camera->half_height;
    return (ang_pane_map){.eye = camera->eye,
                          .right = camera->right,
                          .down = ang_vec3_scale(camera->up, -1),
                          .forward = camera->forward,
                          .middle_x = width / 2.0,
                          .middle_y = height / 2.0,
                          .focal = height / 2.0 / half,
                          .perspective = perspective,
                          .near_mm = camera->near_mm};
}

ang_pane_map ang_pane_map_of_slice(const ang_slice_frame *frame) {
    return (ang_pane_map){.eye = frame->corner,
                          .right = frame->axes.right,
                          .down = frame->axes.down,
                          .forward = frame->axes.inward,
                          .focal = 1 / frame->mm_per_pixel};
}

static double depth_of(const ang_pane_map *map, ang_vec3 mm) {
    return map->perspective ? ang_vec3_dot(ang_vec3_sub(mm, map->eye), map->forward) : 1;
}

bool ang_pane_map_point(const ang_pane_map *map, ang_vec3 mm, double *x, double *y) {
    double depth = depth_of(map, mm);
    if (map->perspective && !(depth >= map->near_mm * (1 - 1e-9))) return false;
    ang_vec3 from = ang_vec3_sub(mm, map->eye);
    *x = map->middle_x + map->focal * ang_vec3_dot(from, map->right) / depth;
    *y = map->middle_y + map->focal * ang_vec3_dot(from, map->down) / depth;
    return true;
}

double ang_pane_map_distance(const ang_pane_map *map, ang_vec3 mm, double x, double y) {
    double at_x, at_y;
    return ang_pane_map_point(map, mm, &at_x, &at_y) ? hypot(at_x - x, at_y - y) : INFINITY;
}

bool ang_pane_map_line(const ang_pane_map *map, ang_vec3 from, ang_vec3 to, double ends[4]) {
    double near[2] = {depth_of(map, from) - map->near_mm, depth_of(map, to) - map->near_mm};
    ang_vec3 place[2] = {from, to};
    if (map->perspective && near[0] < 0 && near[1] < 0) return false;
    for (int i = 0; i < 2 && map->perspective; i++) {
        if (near[i] >= 0) continue;
        double part = near[0] / (near[0] - near[1]);
        place[i] = ang_vec3_along(from, ang_vec3_sub(to, from), part);
    }
    return ang_pane_map_point(map, place[0], &ends[0], &ends[1]) &&
           ang_pane_map_point(map, place[1], &ends[2], &ends[3]);
}

bool ang_line_within(double ends[4], double width, double height) {
    double size[2] = {width, height}, first = 0, last = 1;
    for (int i = 0; i < 2; i++) {
        double start = ends[i], way = ends[2 + i] - start;
        if (fabs(way) < 1e-9) {
            if (start < 0 || start > size[i]) return false;
            continue;
        }
        double a = -start / way, b = (size[i] - start) / way;
        first = fmax(first, fmin(a, b));
        last = fmin(last, fmax(a, b));
    }
    if (!(first <= last)) return false;
    for (int i = 0; i < 2; i++) {
        double start = ends[i], way = ends[2 + i] - start;
        ends[i] = start + first * way;
        ends[2 + i] = start + last * way;
    }
    return true;
}

double ang_line_distance(const double ends[4], double x, double y) {
    double dx = ends[2] - ends[0], dy = ends[3] - ends[1], squared = dx * dx + dy * dy;
    double part = squared > 0 ? ((x - ends[0]) * dx + (y - ends[1]) * dy) / squared : 0;
    part = fmin(fmax(part, 0), 1);
    return hypot(x - ends[0] - part * dx, y - ends[1] - part * dy);
}

double ang_pane_map_scale(const ang_pane_map *map, ang_vec3 mm) {
    double depth = depth_of(map, mm);
    return map->perspective && depth < map->near_mm ? 0 : map->focal / depth;
}

ang_vec3 ang_pane_map_sight(const ang_pane_map *map, ang_vec3 mm) {
    return map->perspective ? ang_vec3_unit(ang_vec3_sub(mm, map->eye)) : map->forward;
}

void ang_pane_map_ray(const ang_pane_map *map, double x, double y, ang_vec3 *origin, ang_vec3 *direction) {
    double right = (x - map->middle_x) / map->focal, down = (y - map->middle_y) / map->focal;
    ang_vec3 across = ang_vec3_along(ang_vec3_scale(map->right, right), map->down, down);
    *origin = map->perspective ? map->eye : ang_vec3_add(map->eye, across);
    *direction = map->perspective ? ang_vec3_unit(ang_vec3_add(map->forward, across)) : map->forward;
}

/* Up away from the eye, a pixel as far as a pixel across. */
static double drag_end_on(const ang_pane_map *map, ang_vec3 from, ang_vec3 along, double pixels_up) {
    double away = ang_vec3_dot(along, ang_pane_map_sight(map, from)) < 0 ? -1 : 1;
    return away * pixels_up / (ang_pane_map_scale(map, from) * ang_vec3_length(along));
}

double ang_pane_map_drag(const ang_pane_map *map, ang_vec3 from, ang_vec3 along, double x, double y) {
    double x0, y0, depth = depth_of(map, from), length = ang_vec3_length(along);
    if (!(length > 0) || !ang_pane_map_point(map, from, &x0, &y0)) return 0;
    ang_vec3 sight = ang_pane_map_sight(map, from);
    if (ang_vec3_length(ang_vec3_cross(sight, along)) < end_on * length) return drag_end_on(map, from, along, y0 - y);
    /* from + t along appears at (x0, y0) + t (fast_x, fast_y) / (depth + t deeper). */
    double deeper = map->perspective ? ang_vec3_dot(along, map->forward) : 0;
    double fast_x = map->focal * ang_vec3_dot(along, map->right) - deeper * (x0 - map->middle_x);
    double fast_y = map->focal * ang_vec3_dot(along, map->down) - deeper * (y0 - map->middle_y);
    double fast = hypot(fast_x, fast_y), wanted = ((x - x0) * fast_x + (y - y0) * fast_y) / fast;
    double left = fast - wanted * deeper;
    return left > 0 ? wanted * depth / left : copysign(INFINITY, wanted);
}

void ang_view_zoom(ang_view *view, const ang_volume *volume, int width, int height, double x, double y, double factor) {
    ang_camera camera = ang_camera_for(volume, view);
    ang_pane_map map = ang_pane_map_of_camera(&camera, width, height);
    double scale = ang_pane_map_scale(&map, ang_vec3_along(camera.eye, camera.forward, camera.focus_mm));
    double wanted = fmin(fmax(view->zoom * factor, least_zoom), greatest_zoom);
    /* The eye goes along the pointer's ray, so that what is on it stays there whatever its depth. */
    double kept = (1 - view->zoom / wanted) / scale;
    view->pan_mm[0] += (x - width / 2.0) * kept;
    view->pan_mm[1] -= (y - height / 2.0) * kept;
    view->zoom = wanted;
}

void ang_view_turn_about(ang_view *view, const ang_volume *volume, ang_vec3 mm, double right_deg, double down_deg) {
    ang_camera before = ang_camera_for(volume, view);
    ang_view_turn(view, right_deg, down_deg);
    ang_camera after = ang_camera_for(volume, view);
    ang_vec3 was = ang_vec3_sub(mm, before.eye), is = ang_vec3_sub(mm, after.eye);
    double nearer = 1;
    if (view->projection == ANG_PERSPECTIVE) {
        double depth = ang_vec3_dot(was, before.forward), now = ang_vec3_dot(is, after.forward);
        if (depth <= before.near_mm || now <= after.near_mm) return;
        nearer = now / depth;
    }
    view->pan_mm[0] += ang_vec3_dot(is, after.right) - nearer * ang_vec3_dot(was, before.right);
    view->pan_mm[1] += ang_vec3_dot(is, after.up) - nearer * ang_vec3_dot(was, before.up);
}
