#include "core/scene/scene.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

const ang_phong ang_phong_default = {.ambient = 0.3, .diffuse = 0.6, .specular = 0.3, .power = 20, .g0 = 1};
const ang_view ang_view_default = {.zoom = 1, .projection = ANG_PERSPECTIVE, .fov_deg = 30};

static const char *const mode_names[] = {"dvr", "mip", "minip", "mean", "iso", NULL};
static const char *const shading_names[] = {"none", "phong", NULL};
static const char *const projection_names[] = {"perspective", "parallel", NULL};

static const char *name_at(const char *const *names, int index) {
    for (int i = 0; names[i]; i++)
        if (i == index) return names[i];
    return NULL;
}

static int index_of(const char *const *names, const char *name) {
    for (int i = 0; names[i]; i++)
        if (strcmp(names[i], name) == 0) return i;
    return -1;
}

const char *ang_mode_name(ang_mode mode) { return name_at(mode_names, (int)mode); }
int ang_mode_from_name(const char *name) { return index_of(mode_names, name); }
const char *ang_shading_name(ang_shading shading) { return name_at(shading_names, (int)shading); }
int ang_shading_from_name(const char *name) { return index_of(shading_names, name); }
const char *ang_projection_name(ang_projection projection) { return name_at(projection_names, (int)projection); }
int ang_projection_from_name(const char *name) { return index_of(projection_names, name); }

bool ang_view_parse(const char *text, ang_view *view, ang_error *err) {
    static const struct {
        const char *name;
        double azimuth, elevation;
    } views[] = {{"anterior", 0, 0}, {"posterior", 180, 0}, {"left", 90, 0},
                 {"right", -90, 0},  {"superior", 0, 90},   {"inferior", 0, -90}};
    for (size_t i = 0; i < sizeof views / sizeof *views; i++)
        if (strcmp(views[i].name, text) == 0) {
            view->azimuth_deg = views[i].azimuth;
            view->elevation_deg = views[i].elevation;
            view->roll_deg = 0;
            return true;
        }
    double angle[3] = {0};
    int used = 0, count = 0;
    const char *rest = text;
    while (count < 3 && sscanf(rest, "%lf%n", &angle[count], &used) == 1 && isfinite(angle[count])) {
        count++;
        rest += used;
        if (*rest != ',') break;
        rest++;
    }
    if (count < 2 || *rest || fabs(angle[1]) > 90)
        return ang_fail(
            err, ANG_USAGE,
            "--view %s: give anterior, posterior, left, right, superior, inferior, or AZ,EL[,ROLL] in degrees "
            "with EL from -90 to 90",
            text);
    view->azimuth_deg = angle[0];
    view->elevation_deg = angle[1];
    view->roll_deg = angle[2];
    return true;
}

/* Exact at multiples of 90 degrees, so that the standard views look straight along the axes. */
static void cosine_sine(double degrees, double *cosine, double *sine) {
    double turn = fmod(degrees, 360);
    if (fmod(turn, 90) == 0) {
        static const double c[4] = {1, 0, -1, 0}, s[4] = {0, 1, 0, -1};
        int quarter = ((int)(turn / 90) + 4) % 4;
        *cosine = c[quarter];
        *sine = s[quarter];
        return;
    }
    double radians = turn * (M_PI / 180);
    *cosine = cos(radians);
    *sine = sin(radians);
}

/* The camera's axes; `stand` leads from the volume's centre to it. */
typedef struct axes {
    ang_vec3 stand, right, up;
} axes;

static axes axes_of(double azimuth_deg, double elevation_deg, double roll_deg) {
    double ca, sa, ce, se, cr, sr;
    cosine_sine(azimuth_deg, &ca, &sa);
    cosine_sine(elevation_deg, &ce, &se);
    cosine_sine(roll_deg, &cr, &sr);
    /* In LPS the patient's left is +x and anterior is -y. */
    ang_vec3 stand = {sa * ce, -ca * ce, se};
    /* The derivative of `stand` by elevation: superior for level views, anterior seen from below. */
    ang_vec3 lifted = {-sa * se, ca * se, ce};
    /* Straight from above the derivative points to the patient's back; there anterior is up by convention. */
    ang_vec3 up = elevation_deg == 90 ? ang_vec3_scale(lifted, -1) : lifted;
    ang_vec3 right = ang_vec3_cross(ang_vec3_scale(stand, -1), up);
    return (axes){stand, ang_vec3_add(ang_vec3_scale(right, cr), ang_vec3_scale(up, -sr)),
                  ang_vec3_add(ang_vec3_scale(up, cr), ang_vec3_scale(right, sr))};
}

void ang_view_turn(ang_view *view, double right_deg, double down_deg) {
    axes a = axes_of(view->azimuth_deg, view->elevation_deg, view->roll_deg);
    /* The camera goes the other way than what it looks at: about the picture's axes, by the angle of both together. */
    double angle = hypot(right_deg, down_deg);
    if (!(angle > 0)) return;
    ang_vec3 axis = ang_vec3_add(ang_vec3_scale(a.up, -right_deg / angle), ang_vec3_scale(a.right, -down_deg / angle));
    double c, s;
    cosine_sine(angle, &c, &s);
    ang_vec3 *turned[] = {&a.stand, &a.right, &a.up};
    for (int i = 0; i < 3; i++) {
        ang_vec3 v = *turned[i], across = ang_vec3_cross(axis, v);
        ang_vec3 along = ang_vec3_scale(axis, ang_vec3_dot(axis, v) * (1 - c));
        *turned[i] = ang_vec3_add(along, ang_vec3_add(ang_vec3_scale(v, c), ang_vec3_scale(across, s)));
    }
    double level = hypot(a.stand.x, a.stand.y);
    view->azimuth_deg = level > 0 ? atan2(a.stand.x, -a.stand.y) * (180 / M_PI) : 0;
    view->elevation_deg = atan2(a.stand.z, level) * (180 / M_PI);
    /* Roll is what is left between the axes without it and these. */
    axes level_axes = axes_of(view->azimuth_deg, view->elevation_deg, 0);
    view->roll_deg = atan2(ang_vec3_dot(a.up, level_axes.right), ang_vec3_dot(a.up, level_axes.up)) * (180 / M_PI);
}

ang_camera ang_camera_for(const ang_volume *volume, const ang_view *view) {
    axes a = axes_of(view->azimuth_deg, view->elevation_deg, view->roll_deg);
    double radius = ang_volume_half_diagonal(volume);
    ang_camera camera = {.forward = ang_vec3_scale(a.stand, -1),
                         .right = a.right,
                         .up = a.up,
                         .projection = view->projection,
                         .fov_deg = view->fov_deg,
                         .half_height = radius / view->zoom,
                         .near_mm = 1e-3 * radius};
    double distance = radius / sin(15 * M_PI / 180) / view->zoom;
    /* A parallel camera stands clear of the volume whatever the zoom; the distance does not show in its picture. */
    if (view->projection == ANG_PARALLEL && distance < 2 * radius) distance = 2 * radius;
    camera.focus_mm = distance;
    camera.eye = ang_vec3_along(ang_volume_centre(volume), a.stand, distance);
    camera.eye = ang_vec3_along(camera.eye, a.right, view->pan_mm[0]);
    camera.eye = ang_vec3_along(camera.eye, a.up, view->pan_mm[1]);
    return camera;
}

ang_scene ang_scene_default(const ang_volume *volume) {
    ang_scene scene = {.width = 512,
                       .height = 512,
                       .camera = ang_camera_for(volume, &ang_view_default),
                       .phong = ang_phong_default,
                       .window_centre = 40,
                       .window_width = 400,
                       .background = {0, 0, 0, 1}};
    ang_volume_box(volume, &scene.clip_lower, &scene.clip_upper);
    return scene;
}

bool ang_scene_check(const ang_scene *scene, ang_error *err) {
    bool coloured = scene->mode == ANG_MODE_DVR || scene->mode == ANG_MODE_ISO;
    if (coloured && !scene->transfer)
        return ang_fail(err, ANG_USAGE, "--mode %s needs a transfer function: give a --preset",
                        ang_mode_name(scene->mode));
    if (scene->mode == ANG_MODE_ISO && !isfinite(scene->iso_hu))
        return ang_fail(err, ANG_USAGE, "--mode iso needs a value: give --iso HU");
    if (scene->width < 1 || scene->height < 1)
        return ang_fail(err, ANG_USAGE, "a picture of %d x %d pixels does not exist", scene->width, scene->height);
    return true;
}

static int pixels_left(int size, int stride, int first) {
    return first < 0 || first >= size ? 0 : (size - first - 1) / stride + 1;
}

ang_scene ang_scene_subset(const ang_scene *scene, int stride, int first_x, int first_y) {
    ang_scene subset = *scene;
    const ang_sampling whole = {1, 0, 0, scene->width, scene->height};
    const ang_sampling *from = scene->sampling.stride > 0 ? &scene->sampling : &whole;
    if (stride < 1) stride = 1;
    subset.sampling = (ang_sampling){from->stride * stride, from->first_x + from->stride * first_x,
                                     from->first_y + from->stride * first_y, from->width, from->height};
    subset.width = pixels_left(scene->width, stride, first_x);
    subset.height = pixels_left(scene->height, stride, first_y);
    return subset;
}

bool ang_scene_clip_parse(const char *text, const ang_volume *volume, ang_scene *scene, ang_error *err) {
    double bound[6];
    ang_vec3 lower, upper;
    ang_volume_box(volume, &lower, &upper);
    const char *rest = text;
    for (int i = 0; i < 6; i++) {
        char *end;
        double value = strtod(rest, &end);
        if (end == rest || !isfinite(value)) goto refused;
        int axis = i / 2;
        double low = ang_vec3_at(lower, axis), high = ang_vec3_at(upper, axis);
        if (*end == '%') {
            bound[i] = low + value / 100 * (high - low);
            end++;
        } else {
            bound[i] = value / ang_volume_spacing(volume, axis);
        }
        bound[i] = fmin(fmax(bound[i], low), high);
        if (*end != (i < 5 ? ',' : '\0')) goto refused;
        rest = end + 1;
    }
    for (int axis = 0; axis < 3; axis++)
        if (!(bound[2 * axis] < bound[2 * axis + 1]))
            return ang_fail(err, ANG_USAGE, "--clip %s: nothing of the volume is left along its %c axis", text,
                            "xyz"[axis]);
    scene->clip_lower = (ang_vec3){bound[0], bound[2], bound[4]};
    scene->clip_upper = (ang_vec3){bound[1], bound[3], bound[5]};
    return true;
refused:
    return ang_fail(err, ANG_USAGE,
                    "--clip %s: give x0,x1,y0,y1,z0,z1 in mm from the first voxel, or with %% of the box", text);
}

bool ang_clip_plane_parse(const char *text, ang_clip_plane *plane, ang_error *err) {
    double number[4];
    const char *rest = text;
    for (int i = 0; i < 4; i++) {
        char *end;
        number[i] = strtod(rest, &end);
        if (end == rest || !isfinite(number[i]) || *end != (i < 3 ? ',' : '\0')) goto refused;
        rest = end + 1;
    }
    /* Scaled first, so that no square overflows or vanishes. */
    double largest = fmax(fabs(number[0]), fmax(fabs(number[1]), fabs(number[2])));
    if (!(largest > 0)) goto refused;
    ang_vec3 normal = {number[0] / largest, number[1] / largest, number[2] / largest};
    *plane = (ang_clip_plane){ang_vec3_unit(normal), number[3]};
    return true;
refused:
    return ang_fail(err, ANG_USAGE,
                    "--clip-plane %s: give NX,NY,NZ,OFFSET_MM: a normal that is not zero and its offset in mm, in LPS",
                    text);
}

double ang_scene_grey(const ang_scene *scene, double hu) {
    return fmin(fmax((hu - scene->window_centre) / scene->window_width + 0.5, 0), 1);
}

static double greatest(ang_vec3 v) { return fmax(fabs(v.x), fmax(fabs(v.y), fabs(v.z))); }

static ang_vec3 on_grid(ang_vec3 v, double grid) {
    return (ang_vec3){rint(v.x / grid) * grid, rint(v.y / grid) * grid, rint(v.z / grid) * grid};
}

/* The plane of p about `middle`, that of the whole picture, in one of the two spaces. All lies on a grid, a power of
 * two some 1e-14 of the largest number, so that no sum of an origin, steps for pixels, and the eye is rounded: a
 * pixel's ray is the same bits in the picture and in each of its subsets. */
static void lay_pixels(ang_vec3 middle, const ang_sampling *sampling, ang_vec3 *origin, ang_vec3 *step_x,
                       ang_vec3 *step_y, ang_vec3 *eye) {
    double across = sampling->width * greatest(*step_x), down = sampling->height * greatest(*step_y);
    double largest = fmax(fmax(greatest(middle), greatest(*eye)), fmax(across, down));
    double grid = ldexp(1, ilogb(largest) - 47);
    double left = sampling->first_x + 0.5 - 0.5 * sampling->stride - 0.5 * sampling->width;
    double top = sampling->first_y + 0.5 - 0.5 * sampling->stride - 0.5 * sampling->height;
    *eye = on_grid(*eye, grid);
    *step_x = on_grid(*step_x, grid);
    *step_y = on_grid(*step_y, grid);
    *origin = ang_vec3_along(ang_vec3_along(on_grid(middle, grid), *step_x, left), *step_y, top);
    *step_x = ang_vec3_scale(*step_x, sampling->stride);
    *step_y = ang_vec3_scale(*step_y, sampling->stride);
}

/* A plane that touches the clip box, or leaves all of it away but a face, must not leave slivers to rounding. */
static void place_clip_plane(ang_ray_frame *frame, const ang_clip_plane *plane, ang_vec3 centre_mm) {
    if (!ang_clip_plane_given(plane)) return;
    ang_vec3 diagonal = ang_mat4_direction(&frame->to_mm, ang_vec3_sub(frame->upper, frame->lower));
    double rounding = 1e-9 * ang_vec3_length(diagonal);
    ang_linear_form beyond = {ang_mat4_transposed_direction(&frame->to_mm, plane->normal),
                              ang_vec3_dot(plane->normal, centre_mm) - plane->offset_mm};
    frame->cuts = ang_linear_form_greatest(&beyond, frame->lower, frame->upper) > rounding;
    if (!frame->cuts) return;
    bool all = ang_linear_form_least(&beyond, frame->lower, frame->upper) > -rounding;
    frame->beyond = all ? (ang_linear_form){.constant = 1} : beyond;
}

bool ang_ray_frame_make(const ang_volume *volume, const ang_scene *scene, ang_ray_frame *frame, ang_error *err) {
    *frame = (ang_ray_frame){.to_mm = volume->affine};
    if (!ang_mat4_inverse(&volume->affine, &frame->to_index))
        return ang_fail(err, ANG_GEOMETRY, "the volume's axes lie in one plane or its spacing is zero");
    ang_vec3 lower, upper;
    ang_volume_box(volume, &lower, &upper);
    frame->centre = ang_vec3_scale(ang_vec3_add(lower, upper), 0.5);
    frame->lower = ang_vec3_sub(scene->clip_lower, frame->centre);
    frame->upper = ang_vec3_sub(scene->clip_upper, frame->centre);

    const ang_camera *camera = &scene->camera;
    ang_vec3 centre_mm = ang_mat4_point(&volume->affine, frame->centre);
    place_clip_plane(frame, &scene->clip_plane, centre_mm);
    ang_vec3 eye = ang_vec3_sub(camera->eye, centre_mm);
    frame->perspective = camera->projection == ANG_PERSPECTIVE;
    /* The plane of p: through the box's centre, where p is exact; in perspective never nearer than the near plane. */
    double depth = -ang_vec3_dot(eye, camera->forward);
    if (frame->perspective) depth = fmax(depth, fmax(camera->near_mm, 1e-3 * ang_volume_half_diagonal(volume)));
    double half = frame->perspective ? depth * tan(camera->fov_deg * (M_PI / 360)) : camera->half_height;
    ang_sampling sampling = {1, 0, 0, scene->width, scene->height};
    if (scene->sampling.stride > 0) sampling = scene->sampling;
    double pixel = 2 * half / sampling.height;
    ang_vec3 middle = ang_vec3_along(eye, camera->forward, depth);
    frame->axis_mm = camera->forward;
    frame->near_depth = camera->near_mm - depth;
    frame->eye_mm = eye;
    frame->step_x_mm = ang_vec3_scale(camera->right, pixel);
    frame->step_y_mm = ang_vec3_scale(camera->up, -pixel);

    frame->axis = ang_mat4_direction(&frame->to_index, frame->axis_mm);
    frame->eye = ang_mat4_direction(&frame->to_index, frame->eye_mm);
    frame->step_x = ang_mat4_direction(&frame->to_index, frame->step_x_mm);
    frame->step_y = ang_mat4_direction(&frame->to_index, frame->step_y_mm);
    lay_pixels(ang_mat4_direction(&frame->to_index, middle), &sampling, &frame->origin, &frame->step_x, &frame->step_y,
               &frame->eye);
    lay_pixels(middle, &sampling, &frame->origin_mm, &frame->step_x_mm, &frame->step_y_mm, &frame->eye_mm);
    return true;
}

/* Cuts the ray's stretch at the clip plane. */
static void cut_ray(const ang_ray_frame *frame, ang_ray *ray) {
    double beyond = ang_linear_form_at(&frame->beyond, ray->origin);
    double rate = ang_vec3_dot(frame->beyond.gradient, ray->direction);
    if (rate < 0)
        ray->enter = fmax(ray->enter, -beyond / rate);
    else if (rate > 0)
        ray->leave = fmin(ray->leave, -beyond / rate);
    else if (beyond > 0)
        ray->leave = -INFINITY;
}

ang_ray ang_ray_through(const ang_ray_frame *frame, double x, double y) {
    ang_ray ray;
    ray.origin = ang_vec3_along(ang_vec3_along(frame->origin, frame->step_x, x), frame->step_y, y);
    ang_vec3 point = ang_vec3_along(ang_vec3_along(frame->origin_mm, frame->step_x_mm, x), frame->step_y_mm, y);
    ray.direction_mm = frame->perspective ? ang_vec3_unit(ang_vec3_sub(point, frame->eye_mm)) : frame->axis_mm;
    ray.direction = ang_mat4_direction(&frame->to_index, ray.direction_mm);

    double cosine = ang_vec3_dot(ray.direction_mm, frame->axis_mm);
    double enter = frame->near_depth / cosine, leave = INFINITY;
    for (int axis = 0; axis < 3; axis++) {
        double o = ang_vec3_at(ray.origin, axis), d = ang_vec3_at(ray.direction, axis);
        double low = ang_vec3_at(frame->lower, axis) - o, high = ang_vec3_at(frame->upper, axis) - o;
        if (d == 0) {
            if (low > 0 || high < 0) leave = -INFINITY;
            continue;
        }
        double t0 = low / d, t1 = high / d;
        enter = fmax(enter, fmin(t0, t1));
        leave = fmin(leave, fmax(t0, t1));
    }
    ray.enter = enter;
    ray.leave = leave;
    if (frame->cuts) cut_ray(frame, &ray);
    return ray;
}
