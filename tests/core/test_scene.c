/* Cameras, clip boxes and rays as DESIGN.md sets them. */
#include "tests/core/fixtures.h"

#include "core/render/method.h"
#include "core/scene/fit.h"
#include "core/scene/image.h"

static double flat_value(int x, int y, int z) {
    (void)x, (void)y, (void)z;
    return 0;
}

static ang_volume *body(void) {
    double spacing[3] = {1, 1, 2};
    ang_volume *volume = make_volume(101, 81, 61, spacing, flat_value);
    volume->affine.m[0][3] = 1e5;
    volume->affine.m[2][3] = -300;
    return volume;
}

static void check_direction(ang_vec3 actual, double x, double y, double z) {
    assert_close(actual.x, x, 1e-15);
    assert_close(actual.y, y, 1e-15);
    assert_close(actual.z, z, 1e-15);
}

static void named_views_stand_where_they_say(void **state) {
    (void)state;
    ang_volume *volume = body();
    /* LPS: left +x, posterior +y, superior +z; the direction to look, to the right of the picture, up. */
    static const struct {
        const char *name;
        double forward[3], right[3], up[3];
    } views[] = {
        {"anterior", {0, 1, 0}, {1, 0, 0}, {0, 0, 1}},    {"posterior", {0, -1, 0}, {-1, 0, 0}, {0, 0, 1}},
        {"left", {-1, 0, 0}, {0, 1, 0}, {0, 0, 1}},       {"right", {1, 0, 0}, {0, -1, 0}, {0, 0, 1}},
        {"superior", {0, 0, -1}, {-1, 0, 0}, {0, -1, 0}}, {"inferior", {0, 0, 1}, {1, 0, 0}, {0, -1, 0}},
    };
    for (size_t i = 0; i < sizeof views / sizeof *views; i++) {
        ang_view view = ang_view_default;
        assert_true(ang_view_parse(views[i].name, &view, NULL));
        ang_camera camera = ang_camera_for(volume, &view);
        check_direction(camera.forward, views[i].forward[0], views[i].forward[1], views[i].forward[2]);
        check_direction(camera.right, views[i].right[0], views[i].right[1], views[i].right[2]);
        check_direction(camera.up, views[i].up[0], views[i].up[1], views[i].up[2]);
    }
    ang_volume_free(volume);
}

static void standard_camera_is_that_of_the_design(void **state) {
    (void)state;
    ang_volume *volume = body();
    ang_view view = ang_view_default;
    view.zoom = 1.7;
    assert_true(ang_view_parse("40,20", &view, NULL));
    ang_camera camera = ang_camera_for(volume, &view);
    double radius = sqrt(100. * 100 + 80 * 80 + 120 * 120) / 2, distance = radius / sin(15 * M_PI / 180) / 1.7;
    /* bench/bench_vtk.py: (sin A cos E, -cos A cos E, sin E) */
    double a = 40 * M_PI / 180, e = 20 * M_PI / 180;
    ang_vec3 centre = {1e5 + 50, 40, -300 + 60};
    assert_close(camera.eye.x, centre.x + distance * sin(a) * cos(e), 1e-9);
    assert_close(camera.eye.y, centre.y - distance * cos(a) * cos(e), 1e-9);
    assert_close(camera.eye.z, centre.z + distance * sin(e), 1e-9);
    assert_close(camera.half_height, radius / 1.7, 1e-12);
    assert_true(camera.up.z > 0.9);
    ang_volume_free(volume);
}

/* What the viewer sees first of a unit ball, and the top of the picture, after turns: against rotations of the patient
 * in the camera's axes. */
static void turning_is_a_trackball(void **state) {
    (void)state;
    ang_volume *volume = body();
    ang_view view = ang_view_default;
    ang_view_turn(&view, 90, 0);
    ang_camera camera = ang_camera_for(volume, &view);
    check_direction(camera.forward, 1, 0, 0); /* the face has moved to the right: the patient's right is in front */
    check_direction(camera.up, 0, 0, 1);
    view = ang_view_default;
    ang_view_turn(&view, 0, 90);
    camera = ang_camera_for(volume, &view);
    check_direction(camera.forward, 0, 0, -1); /* the face has moved down: the top of the head is in front */
    check_direction(camera.up, 0, 1, 0);
    check_direction(camera.right, 1, 0, 0);

    uint64_t seed = 5;
    view = ang_view_default;
    for (int i = 0; i < 200; i++) {
        double right = 60 * (random_unit(&seed) - 0.5), down = 60 * (random_unit(&seed) - 0.5);
        if (i % 20 == 0) ang_view_parse(i % 40 ? "superior" : "30,-90,10", &view, NULL);
        ang_camera before = ang_camera_for(volume, &view);
        ang_vec3 nearest = ang_vec3_scale(before.forward, -1);
        ang_view_turn(&view, right, down);
        ang_camera after = ang_camera_for(volume, &view);
        double angle = hypot(right, down) * M_PI / 180, far = sin(angle) / hypot(right, down);
        assert_close(ang_vec3_dot(nearest, after.right), far * right, 1e-9);
        assert_close(ang_vec3_dot(nearest, after.up), -far * down, 1e-9);
        assert_close(ang_vec3_dot(nearest, after.forward), -cos(angle), 1e-9);
        assert_true(fabs(view.elevation_deg) <= 90);
        ang_view back = view;
        ang_view_turn(&back, -right, -down);
        ang_camera again = ang_camera_for(volume, &back);
        check_direction(again.forward, before.forward.x, before.forward.y, before.forward.z);
        check_direction(again.up, before.up.x, before.up.y, before.up.z);
    }
    ang_volume_free(volume);
}

static void panning_moves_the_camera_in_its_plane(void **state) {
    (void)state;
    ang_volume *volume = body();
    ang_view view = ang_view_default;
    assert_true(ang_view_parse("90,0", &view, NULL)); /* from the left: posterior is to the right */
    ang_vec3 before = ang_camera_for(volume, &view).eye;
    view.pan_mm[0] = 12;
    view.pan_mm[1] = -5;
    ang_vec3 moved = ang_vec3_sub(ang_camera_for(volume, &view).eye, before);
    check_direction(moved, 0, 12, -5);
    ang_volume_free(volume);
}

/* The box's corners, taken to the picture: none is beyond its edges, and one is on them. */
static void a_fitting_zoom_touches_the_edges(void **state) {
    (void)state;
    ang_volume *volume = body();
    volume->affine.m[1][2] = 0.7; /* a gantry's tilt */
    uint64_t seed = 3;
    ang_vec3 lower, upper;
    ang_volume_body_box(volume, &lower, &upper); /* all of one value: the whole box */
    check_direction(lower, 0, 0, 0);
    check_direction(upper, 100, 80, 60);
    for (size_t i = 0; i < ang_volume_count(volume); i++) volume->data[i] = 0;
    volume->intercept = -1000;
    volume->slope = 1;
    volume->data[10 + 101 * (20 + 81 * 30)] = 501;
    volume->data[90 + 101 * (15 + 81 * 30)] = 2000;
    volume->data[3 + 101 * (4 + 81 * 5)] = 500; /* air still */
    ang_volume_body_box(volume, &lower, &upper);
    check_direction(lower, 10, 15, 30);
    check_direction(upper, 90, 20, 30);
    for (int k = 0; k < 200; k++) {
        int width = 16 + (int)(200 * random_unit(&seed)), height = 16 + (int)(200 * random_unit(&seed));
        ang_view view = {.azimuth_deg = 360 * random_unit(&seed),
                         .elevation_deg = 180 * random_unit(&seed) - 90,
                         .roll_deg = 360 * random_unit(&seed),
                         .zoom = 7,
                         .projection = k % 2 ? ANG_PARALLEL : ANG_PERSPECTIVE,
                         .fov_deg = 5 + 120 * random_unit(&seed)};
        view.zoom = ang_view_fitting_zoom(volume, lower, upper, &view, width, height);
        ang_camera camera = ang_camera_for(volume, &view);
        double farthest = 0;
        for (int i = 0; i < 8; i++) {
            ang_vec3 corner = {i & 1 ? upper.x : lower.x, i & 2 ? upper.y : lower.y, i & 4 ? upper.z : lower.z};
            ang_vec3 from = ang_vec3_sub(ang_mat4_point(&volume->affine, corner), camera.eye);
            double half = camera.half_height, depth = ang_vec3_dot(from, camera.forward);
            assert_true(depth > 0);
            if (view.projection == ANG_PERSPECTIVE) half = depth * tan(view.fov_deg * (M_PI / 360));
            farthest = fmax(farthest, fabs(ang_vec3_dot(from, camera.up)) / half);
            farthest = fmax(farthest, fabs(ang_vec3_dot(from, camera.right)) / (half * width / height));
        }
        assert_close(farthest, 1, 1e-9);
    }
    ang_volume_free(volume);
}

static void bad_views_are_refused(void **state) {
    (void)state;
    static const char *const bad[] = {"front", "", "10", "10,", "10,95", "1,2,3,4", "1,2,x", "nan,0"};
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        ang_view view = ang_view_default;
        ang_error err = {0};
        assert_false(ang_view_parse(bad[i], &view, &err));
        assert_int_equal(err.code, ANG_USAGE);
    }
}

static void clip_boxes_are_read_in_mm_and_percent(void **state) {
    (void)state;
    ang_volume *volume = body();
    ang_scene scene = ang_scene_default(volume);
    assert_true(ang_scene_clip_parse("10,50%,0,200,20,40", volume, &scene, NULL));
    check_direction(scene.clip_lower, 10, 0, 10);
    check_direction(scene.clip_upper, 50, 80, 20);
    assert_false(ang_scene_clip_parse("10,10,0,1,0,1", volume, &scene, NULL));
    assert_false(ang_scene_clip_parse("0,1,0,1,0", volume, &scene, NULL));
    assert_false(ang_scene_clip_parse("0,1,0,1,0,x", volume, &scene, NULL));
    ang_volume_free(volume);
}

/* Rays must meet the box where a plain computation in mm says, for tilted affines too. */
static void rays_enter_and_leave_where_a_plain_computation_says(void **state) {
    (void)state;
    ang_volume *volume = body();
    volume->affine.m[1][2] = 0.7;
    volume->affine.m[0][1] = -0.2;
    uint64_t seed = 99;
    for (int projection = 0; projection < 2; projection++)
        for (int trial = 0; trial < 500; trial++) {
            ang_scene scene = ang_scene_default(volume);
            ang_view view = {.azimuth_deg = 360 * random_unit(&seed),
                             .elevation_deg = 180 * random_unit(&seed) - 90,
                             .zoom = 0.5 + 3 * random_unit(&seed),
                             .projection = (ang_projection)projection,
                             .fov_deg = 5 + 100 * random_unit(&seed)};
            scene.camera = ang_camera_for(volume, &view);
            ang_ray_frame frame;
            assert_true(ang_ray_frame_make(volume, &scene, &frame, NULL));
            double px = 512 * random_unit(&seed), py = 512 * random_unit(&seed);
            ang_ray ray = ang_ray_through(&frame, px, py);

            const ang_camera *camera = &scene.camera;
            double half = projection == ANG_PERSPECTIVE ? tan(camera->fov_deg * M_PI / 360) : camera->half_height;
            double right = (px - 256) / 256 * half, up = (256 - py) / 256 * half;
            ang_vec3 offset = ang_vec3_add(ang_vec3_scale(camera->right, right), ang_vec3_scale(camera->up, up));
            bool perspective = projection == ANG_PERSPECTIVE;
            ang_vec3 start = perspective ? camera->eye : ang_vec3_add(camera->eye, offset);
            ang_vec3 direction = perspective ? ang_vec3_unit(ang_vec3_add(camera->forward, offset)) : camera->forward;
            /* Steps of pixels are whole multiples of some 1e-14 of the scene's size (scene.c, lay_pixels). */
            assert_close(ang_vec3_length(ang_vec3_sub(ray.direction_mm, direction)), 0, 1e-11);
            ang_mat4 to_index;
            assert_true(ang_mat4_inverse(&volume->affine, &to_index));
            ang_vec3 o = ang_mat4_point(&to_index, start), d = ang_mat4_direction(&to_index, direction);
            double enter = camera->near_mm / ang_vec3_dot(direction, camera->forward), leave = INFINITY;
            static const double top[3] = {100, 80, 60};
            for (int axis = 0; axis < 3; axis++) {
                double t0 = -ang_vec3_at(o, axis) / ang_vec3_at(d, axis);
                double t1 = (top[axis] - ang_vec3_at(o, axis)) / ang_vec3_at(d, axis);
                enter = fmax(enter, fmin(t0, t1));
                leave = fmin(leave, fmax(t0, t1));
            }
            if (enter < leave - 1e-6) {
                assert_close(ray.leave - ray.enter, leave - enter, 1e-6);
                ang_vec3 a = ang_vec3_add(frame.centre, ang_vec3_along(ray.origin, ray.direction, ray.enter));
                ang_vec3 b = ang_vec3_along(o, d, enter);
                assert_close(ang_vec3_length(ang_vec3_sub(a, b)), 0, 1e-6);
            } else if (enter > leave + 1e-6) {
                assert_true(ray.enter >= ray.leave);
            }
        }
    ang_volume_free(volume);
}

static void pictures_are_composited_over_their_background(void **state) {
    (void)state;
    ang_image image;
    assert_true(ang_image_create(&image, 3, 1, NULL));
    static const float in[12] = {0.25f, 0.5f, 0, 0.5f, 0, 0, 0, 0, 2, -1, 0.5f, 1};
    for (int i = 0; i < 12; i++) image.rgba[i] = in[i];
    static const double white[4] = {1, 1, 1, 1}, clear[4] = {1, 1, 1, 0}, half[4] = {0, 0, 1, 0.5};
    float out[12];
    ang_image_over(&image, white, out);
    assert_close(out[0], 0.75, 1e-7);
    assert_close(out[1], 1, 1e-7);
    assert_close(out[4], 1, 0);
    assert_close(out[8], 1, 0);
    assert_close(out[9], 0, 0);
    ang_image_over(&image, clear, out);
    assert_close(out[0], 0.5, 1e-7);
    assert_close(out[3], 0.5, 1e-7);
    assert_close(out[7], 0, 0);
    ang_image_over(&image, half, out);
    assert_close(out[3], 0.75, 1e-7);
    assert_close(out[2], 0.25 / 0.75, 1e-6);
    ang_image_clear(&image);
    ang_error err;
    assert_false(ang_image_create(&image, 0, 5, &err));
}

static void scenes_that_cannot_be_drawn_are_refused(void **state) {
    (void)state;
    ang_volume *volume = body();
    ang_scene scene = ang_scene_default(volume);
    ang_error err = {0};
    assert_false(ang_scene_check(&scene, &err));
    assert_int_equal(err.code, ANG_USAGE);
    scene.mode = ANG_MODE_MIP;
    assert_true(ang_scene_check(&scene, &err));
    ang_transfer *transfer = constant_transfer(1, 1, 1, 1);
    scene.transfer = transfer;
    scene.mode = ANG_MODE_ISO;
    scene.iso_hu = NAN;
    assert_false(ang_scene_check(&scene, &err));
    scene.iso_hu = 100;
    assert_true(ang_scene_check(&scene, &err));
    scene.width = 0;
    assert_false(ang_scene_check(&scene, &err));
    ang_transfer_free(transfer);
    ang_volume_free(volume);
}

static void check_same_ray(const ang_ray *a, const ang_ray *b) {
    assert_memory_equal(&a->origin, &b->origin, sizeof a->origin);
    assert_memory_equal(&a->direction, &b->direction, sizeof a->direction);
    assert_memory_equal(&a->direction_mm, &b->direction_mm, sizeof a->direction_mm);
    assert_memory_equal(&a->enter, &b->enter, sizeof a->enter);
    assert_memory_equal(&a->leave, &b->leave, sizeof a->leave);
}

/* To the bit: pictures are drawn in parts. */
static void a_subset_has_the_rays_of_the_picture(void **state) {
    (void)state;
    ang_volume *volume = body();
    static const int subsets[][3] = {{1, 0, 0}, {1, 7, 3}, {4, 0, 0}, {5, 4, 2}, {50, 13, 1}};
    for (int parallel = 0; parallel < 2; parallel++) {
        ang_view view = {.azimuth_deg = 33, .elevation_deg = 21, .roll_deg = 10, .zoom = 1.7, .fov_deg = 30};
        view.projection = parallel ? ANG_PARALLEL : ANG_PERSPECTIVE;
        ang_scene scene = ang_scene_default(volume);
        scene.camera = ang_camera_for(volume, &view);
        scene.width = 61;
        scene.height = 48;
        ang_ray_frame whole, part;
        assert_true(ang_ray_frame_make(volume, &scene, &whole, NULL));
        for (size_t s = 0; s < sizeof subsets / sizeof *subsets; s++) {
            int stride = subsets[s][0], x0 = subsets[s][1], y0 = subsets[s][2], count = 0;
            ang_scene subset = ang_scene_subset(&scene, stride, x0, y0);
            /* Every pixel of that grid which the picture has, and no other. */
            assert_true(x0 + (subset.width - 1) * stride < 61 && x0 + subset.width * stride >= 61);
            assert_true(y0 + (subset.height - 1) * stride < 48 && y0 + subset.height * stride >= 48);
            assert_true(ang_ray_frame_make(volume, &subset, &part, NULL));
            for (int j = 0; j < subset.height; j++)
                for (int i = 0; i < subset.width; i++, count++) {
                    ang_ray a = ang_ray_through(&part, i + 0.5, j + 0.5);
                    ang_ray b = ang_ray_through(&whole, x0 + i * stride + 0.5, y0 + j * stride + 0.5);
                    check_same_ray(&a, &b);
                }
            assert_true(count > 0);
        }
    }
    ang_volume_free(volume);
}

static void a_subset_of_a_subset_is_a_subset(void **state) {
    (void)state;
    ang_volume *volume = body();
    ang_scene scene = ang_scene_default(volume);
    ang_scene once = ang_scene_subset(&scene, 3, 2, 1), twice = ang_scene_subset(&once, 4, 1, 5);
    ang_scene same = ang_scene_subset(&scene, 12, 5, 16);
    assert_int_equal(twice.width, same.width);
    assert_int_equal(twice.height, same.height);
    assert_memory_equal(&twice.sampling, &same.sampling, sizeof same.sampling);
    scene.mode = once.mode = ANG_MODE_MIP;
    assert_true(ang_scene_check(&once, NULL));
    ang_scene none = ang_scene_subset(&scene, 3, scene.width, 0);
    assert_false(ang_scene_check(&none, NULL));
    ang_volume_free(volume);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(named_views_stand_where_they_say),
        cmocka_unit_test(standard_camera_is_that_of_the_design),
        cmocka_unit_test(turning_is_a_trackball),
        cmocka_unit_test(panning_moves_the_camera_in_its_plane),
        cmocka_unit_test(a_fitting_zoom_touches_the_edges),
        cmocka_unit_test(bad_views_are_refused),
        cmocka_unit_test(scenes_that_cannot_be_drawn_are_refused),
        cmocka_unit_test(a_subset_has_the_rays_of_the_picture),
        cmocka_unit_test(a_subset_of_a_subset_is_a_subset),
        cmocka_unit_test(clip_boxes_are_read_in_mm_and_percent),
        cmocka_unit_test(rays_enter_and_leave_where_a_plain_computation_says),
        cmocka_unit_test(pictures_are_composited_over_their_background),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
