#include "core/scene/objects.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Shares of half the box's diagonal. */
static const double axis_radius = 0.004, mark_radius = 0.004, mark_ball = 0.011, axis_overhang = 0.08;

/* Light from the eye on a tube; half of it without. */
static const double tube_ambient = 0.35, tube_diffuse = 0.65;

static bool add_object(ang_objects *objects, const ang_object *object, ang_error *err) {
    ang_object *grown = realloc(objects->object, (objects->count + 1) * sizeof *grown);
    if (!grown) return ang_fail(err, ANG_LIMIT, "no memory for an object of the scene");
    objects->object = grown;
    grown[objects->count++] = *object;
    return true;
}

static bool add_label(ang_objects *objects, ang_vec3 at, bool below, const char *text, ang_error *err) {
    ang_object_label *grown = realloc(objects->label, (objects->label_count + 1) * sizeof *grown);
    if (!grown) return ang_fail(err, ANG_LIMIT, "no memory for a label of the scene");
    objects->label = grown;
    ang_object_label *label = &grown[objects->label_count++];
    *label = (ang_object_label){.at = at, .below = below};
    snprintf(label->text, sizeof label->text, "%s", text);
    return true;
}

/* Half the extent of the box along a patient axis, mm. */
static double half_extent(const ang_volume *volume, int patient_axis) {
    ang_vec3 lower, upper;
    ang_volume_box(volume, &lower, &upper);
    ang_vec3 half = ang_vec3_scale(ang_vec3_sub(upper, lower), 0.5);
    double sum = 0;
    for (int axis = 0; axis < 3; axis++) sum += fabs(volume->affine.m[patient_axis][axis]) * ang_vec3_at(half, axis);
    return sum;
}

bool ang_objects_add_axes(ang_objects *objects, const ang_volume *volume, ang_error *err) {
    static const double colours[3][3] = {{0.9, 0.25, 0.2}, {0.35, 0.8, 0.3}, {0.35, 0.5, 1}};
    static const char *const letters[3][2] = {{"R", "L"}, {"A", "P"}, {"F", "H"}};
    double radius = ang_volume_half_diagonal(volume);
    ang_vec3 centre = ang_volume_centre(volume);
    for (int axis = 0; axis < 3; axis++) {
        double reach = half_extent(volume, axis) + axis_overhang * radius;
        ang_vec3 along = {axis == 0, axis == 1, axis == 2};
        ang_object tube = {.kind = ANG_OBJECT_TUBE,
                           .from = ang_vec3_along(centre, along, -reach),
                           .to = ang_vec3_along(centre, along, reach),
                           .radius_mm = axis_radius * radius};
        memcpy(tube.colour, colours[axis], sizeof tube.colour);
        double beyond = reach + 0.25 * axis_overhang * radius;
        if (!add_object(objects, &tube, err) ||
            !add_label(objects, ang_vec3_along(centre, along, -beyond), false, letters[axis][0], err) ||
            !add_label(objects, ang_vec3_along(centre, along, beyond), false, letters[axis][1], err))
            return false;
    }
    return true;
}

bool ang_objects_add_mark(ang_objects *objects, const ang_volume *volume, ang_vec3 from, ang_vec3 to, ang_error *err) {
    double length = ang_vec3_length(ang_vec3_sub(to, from)), radius = ang_volume_half_diagonal(volume);
    if (!isfinite(length)) return ang_fail(err, ANG_USAGE, "a measuring mark needs finite coordinates");
    ang_object parts[3] = {{.from = from, .to = to, .radius_mm = mark_radius * radius},
                           {.from = from, .to = from, .radius_mm = mark_ball * radius},
                           {.from = to, .to = to, .radius_mm = mark_ball * radius}};
    for (int i = 0; i < 3; i++) {
        static const double yellow[3] = {1, 0.85, 0.2};
        memcpy(parts[i].colour, yellow, sizeof yellow);
        if (!add_object(objects, &parts[i], err)) return false;
    }
    char text[24];
    snprintf(text, sizeof text, "%.1f mm", length);
    return add_label(objects, ang_vec3_scale(ang_vec3_add(from, to), 0.5), true, text, err);
}

/* The index axis that runs most along a patient axis. */
static int nearest_axis(const ang_volume *volume, int patient_axis) {
    int nearest = 0;
    double most = -1;
    for (int axis = 0; axis < 3; axis++) {
        double share = fabs(volume->affine.m[patient_axis][axis]) / ang_volume_spacing(volume, axis);
        if (share > most) {
            most = share;
            nearest = axis;
        }
    }
    return nearest;
}

static bool parse_cut_plane(const char *text, size_t length, const ang_volume *volume, ang_object *plane) {
    static const char *const names[3] = {"sagittal", "coronal", "axial"};
    for (int patient = 0; patient < 3; patient++) {
        size_t name = strlen(names[patient]);
        if (length < name || strncmp(text, names[patient], name) != 0) continue;
        *plane = (ang_object){.kind = ANG_OBJECT_PLANE, .axis = nearest_axis(volume, patient)};
        ang_vec3 lower, upper;
        ang_volume_box(volume, &lower, &upper);
        double low = ang_vec3_at(lower, plane->axis), high = ang_vec3_at(upper, plane->axis);
        plane->index = 0.5 * (low + high);
        if (length == name) return true;
        if (text[name] != ':') return false;
        char *end;
        double value = strtod(text + name + 1, &end);
        if (end == text + name + 1 || !isfinite(value)) return false;
        bool share = *end == '%';
        plane->index = share ? low + value / 100 * (high - low) : value / ang_volume_spacing(volume, plane->axis);
        return end + share == text + length && plane->index >= low && plane->index <= high;
    }
    return false;
}

bool ang_objects_add_cut_planes(ang_objects *objects, const ang_volume *volume, const char *text, ang_error *err) {
    for (const char *at = text;;) {
        size_t length = strcspn(at, ",");
        ang_object plane;
        if (!parse_cut_plane(at, length, volume, &plane))
            return ang_fail(err, ANG_USAGE,
                            "--cut-plane %s: give axial, coronal or sagittal, each with :MM from the first voxel or "
                            ":NN%% within the box, separated by commas",
                            text);
        if (!add_object(objects, &plane, err)) return false;
        if (!at[length]) return true;
        at += length + 1;
    }
}

void ang_objects_clear(ang_objects *objects) {
    free(objects->object);
    free(objects->label);
    *objects = (ang_objects){0};
}

bool ang_scene_limits_rays(const ang_scene *scene) {
    return scene->objects && scene->objects->count > 0 && (scene->mode == ANG_MODE_DVR || scene->mode == ANG_MODE_ISO);
}

/* The nearest t in (least, *t) where a ray from `origin` (mm, unit direction) meets the ball; the surface's normal. */
static bool hit_ball(ang_vec3 origin, ang_vec3 direction, ang_vec3 centre, double radius, double least, double *t,
                     ang_vec3 *normal) {
    /* From the foot of the perpendicular, so that a far eye costs no digits. */
    double middle = ang_vec3_dot(ang_vec3_sub(centre, origin), direction);
    ang_vec3 off = ang_vec3_sub(ang_vec3_along(origin, direction, middle), centre);
    double inside = radius * radius - ang_vec3_dot(off, off);
    if (!(inside >= 0)) return false;
    double half = sqrt(inside), at = middle - half > least ? middle - half : middle + half;
    if (!(at > least && at < *t)) return false;
    *t = at;
    *normal = ang_vec3_scale(ang_vec3_sub(ang_vec3_along(origin, direction, at), centre), 1 / radius);
    return true;
}

/* The same for the tube's side. */
static bool hit_side(ang_vec3 origin, ang_vec3 direction, ang_vec3 from, ang_vec3 to, double radius, double least,
                     double *t, ang_vec3 *normal) {
    ang_vec3 along = ang_vec3_sub(to, from);
    double length = ang_vec3_length(along);
    if (!(length > 0)) return false;
    along = ang_vec3_scale(along, 1 / length);
    /* Across the tube. */
    ang_vec3 d = ang_vec3_along(direction, along, -ang_vec3_dot(direction, along));
    double d2 = ang_vec3_dot(d, d);
    if (!(d2 > 1e-18)) return false; /* along the tube: its ends are met */
    ang_vec3 o = ang_vec3_sub(origin, from);
    o = ang_vec3_along(o, along, -ang_vec3_dot(o, along));
    double middle = -ang_vec3_dot(o, d) / d2;
    ang_vec3 off = ang_vec3_along(o, d, middle);
    double inside = radius * radius - ang_vec3_dot(off, off);
    if (!(inside >= 0)) return false;
    double half = sqrt(inside / d2);
    for (int side = -1; side <= 1; side += 2) {
        double at = middle + side * half;
        if (!(at > least && at < *t)) continue;
        ang_vec3 place = ang_vec3_sub(ang_vec3_along(origin, direction, at), from);
        double share = ang_vec3_dot(place, along);
        if (share < 0 || share > length) continue;
        *t = at;
        *normal = ang_vec3_scale(ang_vec3_along(place, along, -share), 1 / radius);
        return true;
    }
    return false;
}

static bool hit_tube(const ang_object *tube, const ang_volume *volume, ang_vec3 origin, ang_vec3 direction,
                     double least, double *t, double colour[3]) {
    ang_vec3 centre = ang_volume_centre(volume), normal = {0};
    ang_vec3 from = ang_vec3_sub(tube->from, centre), to = ang_vec3_sub(tube->to, centre);
    bool hit = hit_side(origin, direction, from, to, tube->radius_mm, least, t, &normal);
    hit |= hit_ball(origin, direction, from, tube->radius_mm, least, t, &normal);
    hit |= hit_ball(origin, direction, to, tube->radius_mm, least, t, &normal);
    if (!hit) return false;
    double light = tube_ambient + tube_diffuse * fabs(ang_vec3_dot(normal, direction));
    for (int c = 0; c < 3; c++) colour[c] = light * tube->colour[c];
    return true;
}

static bool hit_plane(const ang_object *plane, const ang_volume *volume, const ang_scene *scene,
                      const ang_ray_frame *frame, const ang_ray *ray, double least, double *t, double colour[3]) {
    double across = ang_vec3_at(ray->direction, plane->axis);
    double way = plane->index - ang_vec3_at(frame->centre, plane->axis) - ang_vec3_at(ray->origin, plane->axis);
    double at = way / across; /* not finite along the plane: not met */
    if (!(at > least && at < *t)) return false;
    ang_vec3 place = ang_vec3_add(frame->centre, ang_vec3_along(ray->origin, ray->direction, at)), lower, upper;
    ang_volume_box(volume, &lower, &upper);
    for (int axis = 0; axis < 3; axis++) {
        double p = ang_vec3_at(place, axis);
        if (axis != plane->axis && !(p >= ang_vec3_at(lower, axis) && p <= ang_vec3_at(upper, axis))) return false;
    }
    *t = at;
    colour[0] = colour[1] = colour[2] = ang_scene_grey(scene, ang_volume_hu(volume, ang_volume_sample(volume, place)));
    return true;
}

bool ang_object_hit(const ang_object *object, const ang_volume *volume, const ang_scene *scene,
                    const ang_ray_frame *frame, double x, double y, double *t, double colour[3]) {
    ang_ray ray = ang_ray_through(frame, x, y);
    double least = frame->near_depth / ang_vec3_dot(ray.direction_mm, frame->axis_mm);
    if (object->kind == ANG_OBJECT_PLANE) return hit_plane(object, volume, scene, frame, &ray, least, t, colour);
    ang_vec3 origin = ang_vec3_along(ang_vec3_along(frame->origin_mm, frame->step_x_mm, x), frame->step_y_mm, y);
    return hit_tube(object, volume, origin, ray.direction_mm, least, t, colour);
}

bool ang_objects_hit(const ang_objects *objects, const ang_volume *volume, const ang_scene *scene,
                     const ang_ray_frame *frame, double x, double y, double *t, double colour[3]) {
    bool hit = false;
    *t = INFINITY;
    for (size_t i = 0; i < objects->count; i++)
        hit |= ang_object_hit(&objects->object[i], volume, scene, frame, x, y, t, colour);
    return hit;
}
