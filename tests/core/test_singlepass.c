/* The single pass against closed forms, on every backend that is here. */
#include "tests/core/backends.h"

#include "core/render/method.h"

#include <string.h>

enum { width = 19, height = 16 };

static const double unit[3] = {1, 1, 1};

static double flat_value(int x, int y, int z) {
    (void)x, (void)y, (void)z;
    return 100;
}
static double ramp_y(int x, int y, int z) {
    (void)x, (void)z;
    return 10 * y;
}

static const ang_render_options exact = {.step_voxels = 0.5, .termination = 1};

static ang_renderer *open_renderer(ang_gl *gl, const ang_volume *volume) {
    ang_error err = {0};
    ang_renderer *renderer = ang_method_singlepass.create(gl, volume, &ang_render_options_default, &err);
    if (!renderer) fail_msg("%s", err.message);
    return renderer;
}

/* The picture; the caller clears it. Nothing may be NaN or infinite. */
static ang_image draw(ang_renderer *renderer, const ang_scene *scene, const ang_render_options *options,
                      ang_frame_stats *stats) {
    ang_error err = {0};
    ang_image image;
    assert_true(ang_image_create(&image, scene->width, scene->height, &err));
    if (!ang_method_singlepass.render(renderer, scene, options, &image, stats, NULL, &err)) fail_msg("%s", err.message);
    for (int i = 0; i < 4 * image.width * image.height; i++) assert_true(isfinite(image.rgba[i]));
    return image;
}

static ang_image draw_once(ang_gl *gl, const ang_volume *volume, const ang_scene *scene,
                           const ang_render_options *options) {
    ang_renderer *renderer = open_renderer(gl, volume);
    ang_image image = draw(renderer, scene, options, NULL);
    ang_method_singlepass.destroy(renderer);
    return image;
}

static ang_scene make_scene(const ang_volume *volume, const ang_transfer *transfer, const char *view_name,
                            ang_projection projection) {
    ang_scene scene = ang_scene_default(volume);
    ang_view view = ang_view_default;
    assert_true(ang_view_parse(view_name, &view, NULL));
    view.projection = projection;
    scene.camera = ang_camera_for(volume, &view);
    scene.width = width;
    scene.height = height;
    scene.transfer = transfer;
    return scene;
}

/* 1 - exp(-kappa L) in every pixel and its share of colour, for a medium of constant extinction. */
static void check_homogeneous(const ang_volume *volume, const ang_scene *scene, const ang_image *image,
                              double tolerance) {
    double colour[3], kappa = ang_transfer_extinction(scene->transfer, 100);
    ang_transfer_colour(scene->transfer, 100, colour);
    for (int i = 0; i < image->width * image->height; i++) {
        double alpha = -expm1(-kappa * ray_length(volume, scene, i));
        assert_true(image->rgba[4 * i + 3] >= 0 && image->rgba[4 * i + 3] <= 1);
        assert_close(image->rgba[4 * i + 3], alpha, tolerance);
        for (int c = 0; c < 3; c++) assert_close(image->rgba[4 * i + c], alpha * colour[c], tolerance);
    }
}

static void homogeneous_medium_at_any_step_and_extinction(void **state) {
    open_gl(state);
    ang_volume *volume = make_volume(16, 20, 12, unit, flat_value);
    ang_renderer *renderer = open_renderer(gl, volume);
    for (int power = -6; power <= 6; power++) {
        ang_transfer *transfer = constant_transfer(pow(10, power), 0.25, 0.5, 1);
        ang_scene scene = make_scene(volume, transfer, "30,20", power % 2 ? ANG_PARALLEL : ANG_PERSPECTIVE);
        static const double steps[] = {0.07, 0.5, 1, 1.3, 100};
        for (size_t i = 0; i < sizeof steps / sizeof *steps; i++) {
            ang_render_options options = exact;
            options.step_voxels = steps[i];
            ang_image image = draw(renderer, &scene, &options, NULL);
            /* Rays that cut an edge of the box are as uncertain as its float coordinates. */
            check_homogeneous(volume, &scene, &image, 1e-6 + fmin(2e-6 * pow(10, power), 1e-4));
            ang_image_clear(&image);
        }
        ang_transfer_free(transfer);
    }
    ang_method_singlepass.destroy(renderer);
    ang_volume_free(volume);
}

static void a_hundred_thousand_steps_lose_little(void **state) {
    open_gl(state);
    ang_volume *volume = make_volume(4, 4, 4, unit, flat_value);
    ang_transfer *transfer = constant_transfer(0.4, 1, 1, 1);
    ang_scene scene = make_scene(volume, transfer, "anterior", ANG_PARALLEL);
    scene.width = scene.height = 4;
    ang_render_options options = exact;
    options.step_voxels = 3e-5;
    ang_image image = draw_once(gl, volume, &scene, &options);
    check_homogeneous(volume, &scene, &image, 1e-5);
    ang_image_clear(&image);
    ang_transfer_free(transfer);
    ang_volume_free(volume);
}

static void thin_far_and_inside(void **state) {
    open_gl(state);
    static const int shapes[][3] = {{1, 1, 1}, {1, 8, 8}, {8, 1, 8}, {8, 8, 1}, {6, 6, 6}};
    static const double spacings[][3] = {{1, 1, 1}, {1, 1, 1000}, {0.3, 0.4, 5}};
    ang_transfer *transfer = constant_transfer(0.3, 0.25, 0.5, 1);
    for (size_t s = 0; s < sizeof shapes / sizeof *shapes; s++)
        for (size_t p = 0; p < sizeof spacings / sizeof *spacings; p++) {
            const int *n = shapes[s];
            ang_volume *volume = make_volume(n[0], n[1], n[2], spacings[p], flat_value);
            volume->affine.m[0][3] = -1e5;
            ang_scene scene = make_scene(volume, transfer, "40,25", ANG_PERSPECTIVE);
            scene.shading = ANG_SHADING_PHONG; /* without a gradient it changes nothing */
            ang_image image = draw_once(gl, volume, &scene, &exact);
            check_homogeneous(volume, &scene, &image, 2e-5);
            ang_image_clear(&image);
            scene.camera.eye = ang_vec3_along(ang_volume_centre(volume), scene.camera.right, 0.1);
            scene.camera.fov_deg = 120;
            image = draw_once(gl, volume, &scene, &exact);
            check_homogeneous(volume, &scene, &image, 2e-5);
            ang_image_clear(&image);
            ang_volume_free(volume);
        }
    ang_transfer_free(transfer);
}

static void transparent_is_exactly_nothing(void **state) {
    open_gl(state);
    ang_volume *volume = make_volume(8, 8, 8, unit, ramp_y);
    ang_transfer *transfer = constant_transfer(0, 1, 1, 1);
    ang_scene scene = make_scene(volume, transfer, "10,10", ANG_PERSPECTIVE);
    scene.shading = ANG_SHADING_PHONG;
    ang_image image = draw_once(gl, volume, &scene, &exact);
    for (int i = 0; i < 4 * width * height; i++) assert_true(image.rgba[i] == 0);
    ang_image_clear(&image);
    ang_transfer_free(transfer);
    ang_volume_free(volume);
}

static void a_plateau_at_one_is_a_surface(void **state) {
    open_gl(state);
    static const ang_transfer_point points[] = {{.hu = 99, .colour = {0, 0, 0}, .opacity = 0},
                                                {.hu = 100, .colour = {0, 0, 0}, .opacity = 0},
                                                {.hu = 100, .colour = {0.25, 0.5, 0.75}, .opacity = 1}};
    ang_transfer *transfer = ang_transfer_create(points, 3, 1, false, NULL, NULL);
    /* Every voxel is on the step, where the right-hand value counts. */
    ang_volume *volume = make_volume(8, 8, 8, unit, flat_value);
    ang_scene scene = make_scene(volume, transfer, "anterior", ANG_PARALLEL);
    for (int manual = 0; manual < 2; manual++) {
        ang_render_options options = exact;
        options.manual_filter = manual;
        options.step_voxels = 0.001;
        ang_image image = draw_once(gl, volume, &scene, &options);
        for (int i = 0; i < width * height; i++) {
            bool hit = ray_length(volume, &scene, i) > 0;
            for (int c = 0; c < 4; c++) assert_true(image.rgba[4 * i + c] == (hit ? 0.25 * (c + 1) : 0));
        }
        ang_image_clear(&image);
    }
    ang_transfer_free(transfer);
    ang_volume_free(volume);
}

/* Along a ramp of 10 HU/mm the greatest and least samples lie half a step from the ends, the mean in the middle. */
static void extremes_and_mean_of_a_ramp(void **state) {
    open_gl(state);
    ang_volume *volume = make_volume(8, 21, 8, unit, ramp_y);
    ang_scene scene = make_scene(volume, NULL, "anterior", ANG_PARALLEL);
    scene.window_centre = 100;
    scene.window_width = 200;
    ang_renderer *renderer = open_renderer(gl, volume);
    static const struct {
        ang_mode mode;
        double hu;
    } cases[] = {{ANG_MODE_MIP, 200 - 2.5}, {ANG_MODE_MINIP, 2.5}, {ANG_MODE_MEAN, 100}};
    for (size_t m = 0; m < sizeof cases / sizeof *cases; m++)
        for (int manual = 0; manual < 2; manual++) {
            scene.mode = cases[m].mode;
            ang_render_options options = exact;
            options.manual_filter = manual;
            ang_image image = draw(renderer, &scene, &options, NULL);
            for (int i = 0; i < width * height; i++) {
                bool hit = ray_length(volume, &scene, i) > 0;
                double grey = ang_scene_grey(&scene, cases[m].hu);
                for (int c = 0; c < 3; c++) assert_close(image.rgba[4 * i + c], hit ? grey : 0, 2e-5);
                assert_true(image.rgba[4 * i + 3] == hit);
            }
            ang_image_clear(&image);
        }
    ang_method_singlepass.destroy(renderer);
    ang_volume_free(volume);
}

/* Signed data lie near 33000 stored; sums over thousands of steps must not lose what the window shows. */
static void mean_does_not_drift_with_the_step(void **state) {
    open_gl(state);
    ang_volume *volume = make_volume(64, 96, 64, unit, flat_value);
    volume->intercept = -32768;
    for (size_t i = 0; i < ang_volume_count(volume); i++) volume->data[i] = 32768 + 41;
    volume->data[0] = 32768 - 1024;
    ang_volume_update_range(volume, 1);
    ang_scene scene = make_scene(volume, NULL, "anterior", ANG_PARALLEL);
    scene.mode = ANG_MODE_MEAN;
    scene.window_centre = 40;
    scene.window_width = 80;
    for (double step = 1; step > 0.01; step /= 4) {
        ang_render_options options = exact;
        options.step_voxels = step;
        ang_image image = draw_once(gl, volume, &scene, &options);
        double hu = 80 * (image.rgba[4 * (width * height / 2 + width / 2)] - 0.5) + 40;
        assert_close(hu, 41, 1e-3);
        ang_image_clear(&image);
    }
    ang_volume_free(volume);
}

static void mean_leaves_padding_out(void **state) {
    open_gl(state);
    ang_volume *volume = make_volume(8, 16, 8, unit, flat_value);
    for (int z = 0; z < 8; z++)
        for (int y = 0; y < 16; y++)
            for (int x = 0; x < 8; x++)
                if (y < 5 || x < 4) volume->data[x + 8 * (y + 16 * z)] = 7;
    assert_true(ang_volume_mark_padding(volume, 7, NULL));
    ang_volume_update_range(volume, 1);
    ang_scene scene = make_scene(volume, NULL, "anterior", ANG_PARALLEL);
    scene.mode = ANG_MODE_MEAN;
    scene.window_centre = -500;
    scene.window_width = 1500;
    ang_ray_frame frame;
    assert_true(ang_ray_frame_make(volume, &scene, &frame, NULL));
    int tissue = 0, empty = 0;
    for (int manual = 0; manual < 2; manual++) {
        ang_render_options options = exact;
        options.manual_filter = manual;
        ang_image image = draw_once(gl, volume, &scene, &options);
        for (int i = 0; i < width * height; i++) {
            if (ray_length(volume, &scene, i) <= 0) continue;
            double x = ang_ray_through(&frame, i % width + 0.5, i / width + 0.5).origin.x + frame.centre.x;
            if (x < 3) {
                assert_close(image.rgba[4 * i], ang_scene_grey(&scene, -1000), 1e-6);
                empty++;
            } else if (x > 3.05) {
                assert_close(image.rgba[4 * i], ang_scene_grey(&scene, 100), 1e-4);
                tissue++;
            }
        }
        ang_image_clear(&image);
    }
    assert_true(tissue > 10 && empty > 10);
    ang_volume_free(volume);
}

/* The surface of a ramp is a plane whose gradient is constant; a ray that starts beyond it meets a cut face. */
static void iso_surfaces_and_cut_faces(void **state) {
    open_gl(state);
    static const ang_transfer_point points[] = {{.hu = 0, .colour = {0, 0.25, 0.5}, .opacity = 0},
                                                {.hu = 200, .colour = {1, 0.25, 0.5}, .opacity = 0}};
    ang_transfer *transfer = ang_transfer_create(points, 2, 1, false, NULL, NULL);
    ang_volume *volume = make_volume(8, 21, 8, unit, ramp_y);
    ang_renderer *renderer = open_renderer(gl, volume);
    static const struct {
        const char *view;
        double hu, shown; /* iso value, and the value whose colour is seen; < 0: nothing */
    } cases[] = {{"anterior", 123.4, 123.4}, {"posterior", 123.4, 200}, {"anterior", -5, 0}, {"anterior", 201, -1}};
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        ang_scene scene = make_scene(volume, transfer, cases[k].view, ANG_PARALLEL);
        scene.mode = ANG_MODE_ISO;
        scene.iso_hu = cases[k].hu;
        ang_image image = draw(renderer, &scene, &exact, NULL);
        /* At the box's face the clamped differences are one-sided, halved all the same. */
        double g = cases[k].shown == 200 || cases[k].shown == 0 ? 5 : 10, w = g * g / (g * g + 1);
        for (int i = 0; i < width * height; i++) {
            bool hit = ray_length(volume, &scene, i) > 0 && cases[k].shown >= 0;
            const double colour[3] = {cases[k].shown / 200, 0.25, 0.5};
            for (int c = 0; c < 3; c++) {
                double shaded = colour[c] * 0.9 + 0.3;
                assert_close(image.rgba[4 * i + c], hit ? colour[c] + w * (shaded - colour[c]) : 0, 2e-5);
            }
            assert_true(image.rgba[4 * i + 3] == hit);
        }
        ang_image_clear(&image);
    }
    ang_method_singlepass.destroy(renderer);
    ang_transfer_free(transfer);
    ang_volume_free(volume);
}

/* A constant gradient across a sheared grid: Phong's closed form, the same in every sample. */
static void phong_of_a_constant_gradient(void **state) {
    open_gl(state);
    static const double spacing[3] = {0.5, 0.8, 2};
    ang_volume *volume = make_volume(24, 24, 24, spacing, ramp_y);
    volume->affine.m[1][2] = 0.9;
    ang_transfer *transfer = constant_transfer(0.2, 0.25, 0.5, 0.75);
    ang_scene scene = make_scene(volume, transfer, "30,20", ANG_PARALLEL);
    scene.shading = ANG_SHADING_PHONG;
    /* Away from the faces, where differences are clamped. */
    assert_true(ang_scene_clip_parse("20%,80%,20%,80%,20%,80%", volume, &scene, NULL));
    ang_mat4 to_index;
    assert_true(ang_mat4_inverse(&volume->affine, &to_index));
    ang_vec3 gradient = ang_mat4_transposed_direction(&to_index, (ang_vec3){0, 10, 0});
    double g = ang_vec3_length(gradient), facing = fabs(ang_vec3_dot(gradient, scene.camera.forward)) / g;
    double w = g * g / (g * g + 1);
    ang_image image = draw_once(gl, volume, &scene, &exact);
    for (int i = 0; i < width * height; i++) {
        double alpha = -expm1(-0.2 * ray_length(volume, &scene, i));
        for (int c = 0; c < 3; c++) {
            double colour = 0.25 * (c + 1), shaded = colour * (0.3 + 0.6 * facing) + 0.3 * pow(facing, 20);
            assert_close(image.rgba[4 * i + c], alpha * (colour + w * (shaded - colour)), 2e-5);
        }
    }
    ang_image_clear(&image);
    ang_transfer_free(transfer);
    ang_volume_free(volume);
}

static void samples_rays_and_termination_are_counted(void **state) {
    open_gl(state);
    ang_volume *volume = make_volume(16, 20, 12, unit, flat_value);
    ang_transfer *thin = constant_transfer(0.01, 1, 1, 1), *dense = constant_transfer(2, 1, 1, 1);
    ang_renderer *renderer = open_renderer(gl, volume);
    ang_scene scene = make_scene(volume, thin, "anterior", ANG_PARALLEL);
    double samples = 0, rays = 0;
    for (int i = 0; i < width * height; i++) {
        double length = ray_length(volume, &scene, i);
        samples += ceil(length / 0.5);
        rays += length > 0;
    }
    ang_frame_stats stats = {0};
    ang_image image = draw(renderer, &scene, &exact, &stats);
    ang_image_clear(&image);
    assert_true(stats.fragments == rays);
    assert_true(stats.samples == samples);

    /* 1 - exp(-1 * n) passes 0.9 at n = 3. */
    scene.transfer = dense;
    ang_render_options options = exact;
    options.termination = 0.9;
    image = draw(renderer, &scene, &options, &stats);
    assert_true(stats.samples == 3 * rays);
    for (int i = 0; i < width * height; i++) {
        double length = ray_length(volume, &scene, i);
        assert_close(image.rgba[4 * i + 3], length > 0 ? -expm1(-3) : 0, 1e-6);
    }
    ang_image_clear(&image);

    /* Another size in the same renderer. */
    scene.width = 33;
    scene.height = 140;
    image = draw(renderer, &scene, &exact, NULL);
    check_homogeneous(volume, &scene, &image, 1e-5);
    ang_image_clear(&image);
    ang_method_singlepass.destroy(renderer);
    ang_transfer_free(thin);
    ang_transfer_free(dense);
    ang_volume_free(volume);
}

static bool stop_at_once(void *context, const char *what, double fraction) {
    (void)what, (void)fraction;
    ++*(int *)context;
    return false;
}

static void refusals_and_interruption(void **state) {
    open_gl(state);
    ang_volume *volume = make_volume(8, 8, 8, unit, flat_value);
    ang_renderer *renderer = open_renderer(gl, volume);
    ang_scene scene = make_scene(volume, NULL, "anterior", ANG_PARALLEL);
    scene.height = 200;
    ang_image image;
    ang_error err = {0};
    assert_true(ang_image_create(&image, scene.width, scene.height, &err));
    assert_false(ang_method_singlepass.render(renderer, &scene, &exact, &image, NULL, NULL, &err));
    assert_int_equal(err.code, ANG_USAGE);
    scene.mode = ANG_MODE_MIP;
    int calls = 0;
    ang_progress progress = {stop_at_once, &calls};
    assert_false(ang_method_singlepass.render(renderer, &scene, &exact, &image, NULL, &progress, &err));
    assert_int_equal(err.code, ANG_INTERRUPTED);
    assert_int_equal(calls, 1);
    ang_render_options options = exact;
    options.step_voxels = 0;
    assert_false(ang_method_singlepass.render(renderer, &scene, &options, &image, NULL, NULL, &err));
    assert_int_equal(err.code, ANG_USAGE);
    assert_null(ang_method_singlepass.create(NULL, volume, &ang_render_options_default, &err));
    assert_int_equal(err.code, ANG_GL);
    assert_true(ang_method_find("singlepass") == &ang_method_singlepass);
    assert_null(ang_method_find("telepathy"));
    ang_image_clear(&image);
    ang_method_singlepass.destroy(renderer);
    ang_volume_free(volume);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(homogeneous_medium_at_any_step_and_extinction),
        cmocka_unit_test(a_hundred_thousand_steps_lose_little),
        cmocka_unit_test(thin_far_and_inside),
        cmocka_unit_test(transparent_is_exactly_nothing),
        cmocka_unit_test(a_plateau_at_one_is_a_surface),
        cmocka_unit_test(extremes_and_mean_of_a_ramp),
        cmocka_unit_test(mean_does_not_drift_with_the_step),
        cmocka_unit_test(mean_leaves_padding_out),
        cmocka_unit_test(iso_surfaces_and_cut_faces),
        cmocka_unit_test(phong_of_a_constant_gradient),
        cmocka_unit_test(samples_rays_and_termination_are_counted),
        cmocka_unit_test(refusals_and_interruption),
    };
    return run_on_backends(tests);
}
