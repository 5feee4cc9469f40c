/* The oblique clip plane: rays against the half-space itself, and every method against closed forms. */
#include "tests/core/backends.h"
#include "tests/core/drawer.h"
#include "tests/core/scenes.h"

#include "core/cpu/reference.h"

#include <string.h>

static void planes_are_read(void **state) {
    (void)state;
    ang_clip_plane plane = {{0}, 0};
    ang_error err = {0};
    assert_false(ang_clip_plane_given(&plane));
    assert_true(ang_clip_plane_parse("3,0,-4,12.5", &plane, &err));
    assert_close(plane.normal.x, 0.6, 1e-15);
    assert_close(plane.normal.y, 0, 0);
    assert_close(plane.normal.z, -0.8, 1e-15);
    assert_close(plane.offset_mm, 12.5, 0);
    assert_true(ang_clip_plane_given(&plane));
    assert_true(ang_clip_plane_parse("0,1e-300,0,-1", &plane, &err));
    assert_close(plane.normal.y, 1, 1e-15);
    assert_true(ang_clip_plane_parse("1e300,1e300,0,0", &plane, &err));
    assert_close(plane.normal.x, sqrt(0.5), 1e-15);
    static const char *const refused[] = {"",          "1,0,0",   "1,0,0,0,0", "0,0,0,5",  "nan,0,0,1",
                                          "1,inf,0,1", "1,0,0,x", "1,0,0,inf", "1;0;0;0 ", "1,0,0,5mm"};
    for (size_t i = 0; i < sizeof refused / sizeof *refused; i++) {
        err = (ang_error){0};
        assert_false(ang_clip_plane_parse(refused[i], &plane, &err));
        assert_int_equal(err.code, ANG_USAGE);
        assert_non_null(strstr(err.message, "--clip-plane"));
    }
}

static ang_vec3 random_unit_vector(uint64_t *lot) {
    ang_vec3 v;
    do v = (ang_vec3){2 * random_unit(lot) - 1, 2 * random_unit(lot) - 1, 2 * random_unit(lot) - 1};
    while (ang_vec3_length(v) < 0.1);
    return ang_vec3_unit(v);
}

/* A plane through a place in the box or near it. */
static ang_clip_plane random_plane(const ang_volume *volume, uint64_t *lot) {
    ang_vec3 normal = random_unit_vector(lot), through = random_unit_vector(lot);
    through = ang_vec3_along(ang_volume_centre(volume), through, 20 * random_unit(lot));
    return (ang_clip_plane){normal, ang_vec3_dot(normal, through)};
}

/* mm beyond the plane of the place t mm along the ray. */
static double beyond(const ang_volume *volume, const ang_ray_frame *frame, const ang_clip_plane *plane,
                     const ang_ray *ray, double t) {
    ang_vec3 index = ang_vec3_add(frame->centre, ang_vec3_along(ray->origin, ray->direction, t));
    return ang_vec3_dot(plane->normal, ang_mat4_point(&volume->affine, index)) - plane->offset_mm;
}

/* What a plane leaves of a ray and what its opposite does are the ray in the box, and each lies on its side. */
static void a_plane_parts_every_ray_in_two(void **state) {
    (void)state;
    uint64_t lot = 5;
    ang_volume *volume = sheared_volume(flat_value);
    volume->affine.m[0][3] = -3e4;
    int parted = 0;
    for (int n = 0; n < 200; n++) {
        ang_scene whole = make_scene(n % SCENES, volume, NULL);
        whole.clip_plane = (ang_clip_plane){{0}, 0};
        ang_clip_plane plane = random_plane(volume, &lot);
        ang_scene kept = whole, rest = whole;
        kept.clip_plane = plane;
        rest.clip_plane = (ang_clip_plane){ang_vec3_scale(plane.normal, -1), -plane.offset_mm};
        ang_ray_frame frame, near, far;
        assert_true(ang_ray_frame_make(volume, &whole, &frame, NULL) && !frame.cuts);
        assert_true(ang_ray_frame_make(volume, &kept, &near, NULL));
        assert_true(ang_ray_frame_make(volume, &rest, &far, NULL));
        for (int i = 0; i < 20; i++) {
            double x = width * random_unit(&lot), y = height * random_unit(&lot);
            ang_ray all = ang_ray_through(&frame, x, y), a = ang_ray_through(&near, x, y),
                    b = ang_ray_through(&far, x, y);
            if (!(all.enter < all.leave)) {
                assert_false(a.enter < a.leave || b.enter < b.leave);
                continue;
            }
            double left = fmax(a.leave - a.enter, 0), right = fmax(b.leave - b.enter, 0);
            assert_close(left + right, all.leave - all.enter, 1e-8);
            if (left > 0) assert_true(a.enter >= all.enter && a.leave <= all.leave);
            if (left > 0) assert_true(beyond(volume, &frame, &plane, &a, (a.enter + a.leave) / 2) <= 1e-9);
            if (right > 0) assert_true(beyond(volume, &frame, &plane, &b, (b.enter + b.leave) / 2) >= -1e-9);
            parted += left > 0.01 && right > 0.01;
        }
    }
    print_message("%d rays parted\n", parted);
    assert_true(parted > 300);
    ang_volume_free(volume);
}

/* A cube of 16 mm with its first voxel at the origin of LPS: HU linear in the place. */
static double ramp_value(int x, int y, int z) { return 12 * x + 5 * y - 7 * z + 300; }
static double ramp_at(ang_vec3 p) { return 12 * p.x + 5 * p.y - 7 * p.z + 300; }
static const double ramp_slope = 14.77; /* HU/mm, at most */
enum { EDGE = 16 };

/* A pixel's ray in what the plane leaves of the cube, from the camera alone. */
typedef struct path {
    ang_vec3 from, to; /* mm LPS */
    double length;     /* mm; 0 where it misses */
} path;

static path path_of(const ang_scene *scene, int pixel) {
    const ang_camera *c = &scene->camera;
    double x = (pixel % scene->width + 0.5) / scene->height - 0.5 * scene->width / scene->height;
    double y = 0.5 - (pixel / scene->width + 0.5) / scene->height;
    bool perspective = c->projection == ANG_PERSPECTIVE;
    double scale = 2 * (perspective ? tan(c->fov_deg * M_PI / 360) : c->half_height);
    ang_vec3 across = ang_vec3_add(ang_vec3_scale(c->right, scale * x), ang_vec3_scale(c->up, scale * y));
    ang_vec3 eye = perspective ? c->eye : ang_vec3_add(c->eye, across);
    ang_vec3 along = perspective ? ang_vec3_unit(ang_vec3_add(c->forward, across)) : c->forward;
    /* Inside: normal . p <= offset for each of the faces and the plane. */
    ang_clip_plane bound[7] = {scene->clip_plane};
    for (int axis = 0; axis < 3; axis++) {
        ang_vec3 normal = {axis == 0, axis == 1, axis == 2};
        bound[1 + 2 * axis] = (ang_clip_plane){normal, EDGE};
        bound[2 + 2 * axis] = (ang_clip_plane){ang_vec3_scale(normal, -1), 0};
    }
    double enter = 0, leave = INFINITY;
    for (int i = 0; i < 7; i++) {
        double rate = ang_vec3_dot(bound[i].normal, along),
               way = bound[i].offset_mm - ang_vec3_dot(bound[i].normal, eye);
        if (rate > 0)
            leave = fmin(leave, way / rate);
        else if (rate < 0)
            enter = fmax(enter, way / rate);
        else if (way < 0)
            leave = -INFINITY;
    }
    if (!(enter < leave)) return (path){.length = 0};
    return (path){ang_vec3_along(eye, along, enter), ang_vec3_along(eye, along, leave), leave - enter};
}

enum { PLANES = 5 };
/* Through the middle, through three corners, a corner off, nearly along a face, and a face of what it leaves edge-on.
 */
static ang_clip_plane plane_of(int which) {
    static const ang_clip_plane planes[PLANES] = {
        {{1, 1, 1}, 24}, {{1, -1, 1}, 16}, {{-2, 3, 1}, 44}, {{0, 1, 0.001}, 9}, {{1, 0, 0}, 7.5}};
    double length = ang_vec3_length(planes[which].normal);
    return (ang_clip_plane){ang_vec3_scale(planes[which].normal, 1 / length), planes[which].offset_mm / length};
}

enum { LOOKS = 3 };
static ang_scene cube_scene(const ang_volume *volume, int look, int plane) {
    static const char *const views[LOOKS] = {"33,21,10", "-50,-35", "anterior"};
    ang_scene scene = ang_scene_default(volume);
    ang_view view = ang_view_default;
    assert_true(ang_view_parse(views[look], &view, NULL));
    view.projection = look == 0 ? ANG_PERSPECTIVE : ANG_PARALLEL;
    scene.camera = ang_camera_for(volume, &view);
    scene.width = 29;
    scene.height = 24;
    scene.clip_plane = plane_of(plane);
    scene.window_centre = 300;
    scene.window_width = 700;
    scene.phong = (ang_phong){.ambient = 1, .power = 1, .g0 = 1}; /* colours as they are */
    return scene;
}

static const double steps[] = {0.3, 1.3};
enum { STEPS = 2 };

/* Calls `check` with the picture by every method of every scene. */
static void draw_all(ang_gl *gl, const ang_volume *volume, const ang_transfer *transfer, ang_mode mode,
                     void (*check)(const drawer *d, const ang_scene *scene, double step, const ang_image *image)) {
    for (const ang_method *const *method = ang_methods(); *method; method++) {
        drawer d = open_drawer((*method)->needs_gl ? gl : NULL, *method, volume);
        for (int i = 0; i < LOOKS * PLANES * STEPS; i++) {
            ang_scene scene = cube_scene(volume, i / STEPS % LOOKS, i / STEPS / LOOKS);
            scene.transfer = transfer;
            scene.mode = mode;
            scene.iso_hu = 320;
            ang_render_options options = ang_render_options_default;
            options.step_voxels = steps[i % STEPS];
            options.termination = 1;
            ang_image image = draw(&d, &scene, &options, NULL);
            check(&d, &scene, options.step_voxels, &image);
            ang_image_clear(&image);
        }
        d.method->destroy(d.renderer);
    }
}

static bool is_slicing(const drawer *d) { return d->method == &ang_method_slicing; }

static const double extinction = 0.07;

static void check_medium(const drawer *d, const ang_scene *scene, double step, const ang_image *image) {
    double worst = 0;
    int seen = 0;
    for (int i = 0; i < image->width * image->height; i++) {
        path p = path_of(scene, i);
        double alpha = -expm1(-extinction * p.length);
        worst = fmax(worst, fabs((double)image->rgba[4 * i + 3] - alpha));
        worst = fmax(worst, fabs((double)image->rgba[4 * i] - 0.25 * alpha));
        seen += alpha > 0.05;
    }
    assert_true(seen > 10);
    if (!(worst < 2e-6)) fail_msg("%s, step %g: %g", d->method->name, step, worst);
}

static void check_greatest(const drawer *d, const ang_scene *scene, double step, const ang_image *image) {
    double room = d->method->exact ? 1e-6 : 0.5 * ramp_slope * step / scene->window_width + 1e-4;
    if (is_slicing(d)) room *= 2; /* planes lie a step apart in depth, and the first half a step behind the box's */
    for (int i = 0; i < image->width * image->height; i++) {
        path p = path_of(scene, i);
        double grey = p.length > 0 ? ang_scene_grey(scene, fmax(ramp_at(p.from), ramp_at(p.to))) : 0;
        if (p.length > 0 && p.length < 1e-4) continue;
        double far = fabs((double)image->rgba[4 * i] - grey);
        if (!(far <= room)) fail_msg("%s, step %g, pixel %d: %g", d->method->name, step, i, far);
        if ((image->rgba[4 * i + 3] > 0) != (p.length > 0))
            fail_msg("%s, step %g, pixel %d of %g mm shows %g", d->method->name, step, i, p.length,
                     (double)image->rgba[4 * i + 3]);
    }
}

static void check_mean(const drawer *d, const ang_scene *scene, double step, const ang_image *image) {
    for (int i = 0; i < image->width * image->height; i++) {
        path p = path_of(scene, i);
        if (p.length < 1e-2) continue;
        double grey = ang_scene_grey(scene, 0.5 * (ramp_at(p.from) + ramp_at(p.to)));
        /* Of a slab that the plane cuts the value is not that of its middle. */
        double room = is_slicing(d) ? 2 * ramp_slope * step * fmin(step / p.length, 1) / scene->window_width : 0;
        double far = fabs((double)image->rgba[4 * i] - grey);
        if (!(far <= room + 2e-5)) fail_msg("%s, step %g, pixel %d: %g", d->method->name, step, i, far);
    }
}

/* The cut face shows its own value where that is at or above the iso value, as the clip box's faces do; below it the
 * surface is seen from inside. */
static void check_surface(const drawer *d, const ang_scene *scene, double step, const ang_image *image) {
    int cut = 0, inside = 0, none = 0;
    for (int i = 0; i < image->width * image->height; i++) {
        path p = path_of(scene, i);
        double first = ramp_at(p.from), last = ramp_at(p.to), iso = scene->iso_hu;
        if (p.length > 0 && (p.length < 1e-3 || fabs(first - iso) < 0.05 || fabs(last - iso) < 0.05)) continue;
        bool hit = p.length > 0 && fmax(first, last) >= iso;
        double colour[3];
        ang_transfer_colour(scene->transfer, first >= iso ? first : iso, colour);
        assert_close((double)image->rgba[4 * i + 3], hit, 0);
        for (int c = 0; c < 3; c++) {
            double far = fabs((double)image->rgba[4 * i + c] - (hit ? colour[c] : 0));
            if (!(far < 2e-4)) fail_msg("%s, step %g, pixel %d: %g", d->method->name, step, i, far);
        }
        cut += hit && first >= iso;
        inside += hit && first < iso;
        none += !hit;
    }
    assert_true(cut + inside > 10 && none > 10);
}

static void a_medium_is_as_long_as_its_rays(void **state) {
    open_gl(state);
    static const double spacing[3] = {1, 1, 1};
    ang_volume *volume = make_volume(EDGE + 1, EDGE + 1, EDGE + 1, spacing, flat_value);
    ang_transfer *transfer = constant_transfer(extinction, 0.25, 0.5, 1);
    draw_all(gl, volume, transfer, ANG_MODE_DVR, check_medium);
    ang_transfer_free(transfer);
    ang_volume_free(volume);
}

static void values_and_surfaces_end_at_the_plane(void **state) {
    open_gl(state);
    static const double spacing[3] = {1, 1, 1};
    static const ang_transfer_point points[] = {{.hu = 0, .colour = {0, 1, 0.3}, .opacity = 0.1},
                                                {.hu = 700, .colour = {1, 0, 0.3}, .opacity = 0.1}};
    ang_volume *volume = make_volume(EDGE + 1, EDGE + 1, EDGE + 1, spacing, ramp_value);
    ang_transfer *transfer = ang_transfer_create(points, 2, 1, false, NULL, NULL);
    draw_all(gl, volume, transfer, ANG_MODE_MIP, check_greatest);
    draw_all(gl, volume, transfer, ANG_MODE_MEAN, check_mean);
    draw_all(gl, volume, transfer, ANG_MODE_ISO, check_surface);
    ang_transfer_free(transfer);
    ang_volume_free(volume);
}

static void the_reference_is_exact(void **state) {
    (void)state;
    static const double spacing[3] = {1, 1, 1};
    ang_volume *flat = make_volume(EDGE + 1, EDGE + 1, EDGE + 1, spacing, flat_value);
    ang_volume *ramp = make_volume(EDGE + 1, EDGE + 1, EDGE + 1, spacing, ramp_value);
    ang_transfer *transfer = constant_transfer(extinction, 0.25, 0.5, 1);
    for (int i = 0; i < LOOKS * PLANES; i++) {
        ang_scene medium = cube_scene(flat, i % LOOKS, i / LOOKS), greatest = cube_scene(ramp, i % LOOKS, i / LOOKS);
        medium.transfer = transfer;
        greatest.mode = ANG_MODE_MIP;
        ang_reference *a = ang_reference_create(flat, &medium, NULL), *b = ang_reference_create(ramp, &greatest, NULL);
        for (int pixel = 0; pixel < medium.width * medium.height; pixel++) {
            path p = path_of(&medium, pixel);
            double x = pixel % medium.width + 0.5, y = pixel / medium.width + 0.5, rgba[4];
            ang_reference_pixel(a, x, y, rgba, NULL);
            assert_close(rgba[3], -expm1(-extinction * p.length), 1e-12);
            ang_reference_pixel(b, x, y, rgba, NULL);
            double grey = ang_scene_grey(&greatest, fmax(ramp_at(p.from), ramp_at(p.to)));
            if (p.length > 1e-9) assert_close(rgba[0], grey, 1e-12);
        }
        ang_reference_free(a);
        ang_reference_free(b);
    }
    ang_transfer_free(transfer);
    ang_volume_free(flat);
    ang_volume_free(ramp);
}

/* Whether the plan of a picture has the clip plane's part, and says that it is left out. */
static void find_part(const drawer *d, const ang_scene *scene, bool *has, bool *left_out) {
    ang_plan plan = {0};
    *has = *left_out = false;
    assert_true(d->method->explain(d->renderer, scene, &ang_render_options_default, &plan, NULL));
    for (size_t i = 0; i < plan.pass_count; i++) {
        char parts[2048];
        snprintf(parts, sizeof parts, " %s ", plan.pass[i].parts);
        *has = *has || strstr(parts, " half_space ");
    }
    for (size_t i = 0; i < plan.left_out.count; i++)
        *left_out = *left_out || strcmp(plan.left_out.item[i].what, "clip plane") == 0;
    ang_plan_clear(&plan);
}

/* The bounds of the volume along a normal: mm. */
static void bounds_along(const ang_volume *volume, ang_vec3 normal, double *least, double *greatest) {
    ang_vec3 lower, upper;
    ang_volume_box(volume, &lower, &upper);
    *least = INFINITY;
    *greatest = -INFINITY;
    for (int i = 0; i < 8; i++) {
        ang_vec3 at = {i & 1 ? upper.x : lower.x, i & 2 ? upper.y : lower.y, i & 4 ? upper.z : lower.z};
        double along = ang_vec3_dot(normal, ang_mat4_point(&volume->affine, at));
        *least = fmin(*least, along);
        *greatest = fmax(*greatest, along);
    }
}

/* What touches nothing changes no bit and is left out; what cuts all away leaves the background. */
static void planes_beside_the_box_are_left_out(void **state) {
    open_gl(state);
    ang_volume *volume = sheared_volume(sparse_value);
    ang_transfer *transfer = vessels();
    /* Normals of faces: the plane then lies along one; and any. */
    ang_vec3 normals[4] = {{1, 0, 0}};
    for (int axis = 0; axis < 3; axis++) {
        ang_mat4 inverse;
        assert_true(ang_mat4_inverse(&volume->affine, &inverse));
        normals[axis] =
            ang_vec3_unit(ang_mat4_transposed_direction(&inverse, (ang_vec3){axis == 0, axis == 1, axis == 2}));
    }
    normals[3] = ang_vec3_unit((ang_vec3){1, -2, 0.7});
    for (const ang_method *const *method = ang_methods(); *method; method++) {
        drawer d = open_drawer((*method)->needs_gl ? gl : NULL, *method, volume);
        for (int mode = 0; mode < 3; mode++) {
            ang_scene scene = make_scene(0, volume, transfer);
            scene.mode = mode == 0 ? ANG_MODE_DVR : mode == 1 ? ANG_MODE_MIP : ANG_MODE_ISO;
            if (d.method->exact) scene.width = scene.height = 9;
            ang_image plain = draw(&d, &scene, &ang_render_options_default, NULL);
            for (int n = 0; n < 8; n++) {
                double least, greatest;
                bool has, left_out;
                scene.clip_plane.normal = ang_vec3_scale(normals[n % 4], n < 4 ? 1 : -1);
                bounds_along(volume, scene.clip_plane.normal, &least, &greatest);
                scene.clip_plane.offset_mm = greatest;
                ang_image image = draw(&d, &scene, &ang_render_options_default, NULL);
                assert_memory_equal(image.rgba, plain.rgba,
                                    4 * sizeof *image.rgba * (size_t)(scene.width * scene.height));
                ang_image_clear(&image);
                find_part(&d, &scene, &has, &left_out);
                assert_true(!has && left_out);
                scene.clip_plane.offset_mm = least;
                image = draw(&d, &scene, &ang_render_options_default, NULL);
                for (int i = 0; i < 4 * scene.width * scene.height; i++)
                    if (image.rgba[i] != 0)
                        fail_msg("%s, mode %d, plane %d cuts all: %g", d.method->name, mode, n, (double)image.rgba[i]);
                ang_image_clear(&image);
                scene.clip_plane.offset_mm = 0.5 * (least + greatest);
                find_part(&d, &scene, &has, &left_out);
                assert_true(has == d.method->needs_gl && !left_out);
            }
            ang_image_clear(&plain);
        }
        d.method->destroy(d.renderer);
    }
    ang_transfer_free(transfer);
    ang_volume_free(volume);
}

/* A plane along a face of a smaller clip box is that box. */
static void a_plane_may_be_a_face_of_the_box(void **state) {
    open_gl(state);
    ang_volume *volume = sheared_volume(sparse_value);
    ang_transfer *transfer = vessels();
    ang_mat4 inverse;
    assert_true(ang_mat4_inverse(&volume->affine, &inverse));
    ang_vec3 normal = ang_vec3_unit(ang_mat4_transposed_direction(&inverse, (ang_vec3){1, 0, 0}));
    ang_scene boxed = make_scene(0, volume, transfer);
    boxed.shading = ANG_SHADING_PHONG;
    ang_scene cut = boxed;
    boxed.clip_upper.x = 20.3;
    cut.clip_plane = (ang_clip_plane){normal, ang_vec3_dot(normal, ang_mat4_point(&volume->affine, boxed.clip_upper))};
    for (const ang_method *const *method = ang_methods(); *method; method++) {
        /* Its planes begin at the nearest corner of the box. */
        if (*method == &ang_method_slicing || (*method)->exact) continue;
        drawer d = open_drawer((*method)->needs_gl ? gl : NULL, *method, volume);
        ang_image image = draw(&d, &boxed, &ang_render_options_default, NULL);
        ang_image same = draw(&d, &cut, &ang_render_options_default, NULL);
        double far = difference(&image, &same);
        print_message("%s: %g\n", d.method->name, far);
        assert_true(far < 1e-4);
        ang_image_clear(&image);
        d.method->destroy(d.renderer);
    }
    ang_transfer_free(transfer);
    ang_volume_free(volume);
}

int main(void) {
    const struct CMUnitTest pure[] = {
        cmocka_unit_test(planes_are_read),
        cmocka_unit_test(a_plane_parts_every_ray_in_two),
        cmocka_unit_test(the_reference_is_exact),
    };
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_medium_is_as_long_as_its_rays),
        cmocka_unit_test(values_and_surfaces_end_at_the_plane),
        cmocka_unit_test(planes_beside_the_box_are_left_out),
        cmocka_unit_test(a_plane_may_be_a_face_of_the_box),
    };
    return cmocka_run_group_tests(pure, NULL, NULL) + run_on_backends(tests);
}
