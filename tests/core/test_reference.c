/* The reference against closed forms, and its parts against brute force. */
#include "tests/core/fixtures.h"

#include "core/cpu/integrate.h"
#include "core/cpu/reference.h"
#include "core/math/polynomial.h"

#include <string.h>

static const double unit[3] = {1, 1, 1};

static double flat_value(int x, int y, int z) {
    (void)x, (void)y, (void)z;
    return 100;
}
static double ramp_y(int x, int y, int z) {
    (void)x, (void)z;
    return 10 * y;
}
static double noise_value(int x, int y, int z) {
    uint64_t state = (uint64_t)(x + 1) * 73856093u ^ (uint64_t)(y + 1) * 19349663u ^ (uint64_t)(z + 1) * 83492791u;
    for (int i = 0; i < 5; i++) random_unit(&state);
    return floor(1000 * random_unit(&state));
}

static void pixel(const ang_volume *volume, const ang_scene *scene, double x, double y, double rgba[4]) {
    ang_error err = {0};
    ang_reference *reference = ang_reference_create(volume, scene, &err);
    if (!reference) fail_msg("%s", err.message);
    ang_reference_pixel(reference, x, y, rgba, NULL);
    ang_reference_free(reference);
}

static void cubic_in_a_cell_is_trilinear_interpolation(void **state) {
    (void)state;
    ang_volume *volume = make_volume(2, 2, 2, unit, noise_value);
    double corner[8];
    for (int i = 0; i < 8; i++) corner[i] = volume->data[i];
    double start[3] = {0.1, 0.9, 0.3}, step[3] = {0.8, -0.7, 0.6};
    ang_cubic f = ang_cubic_in_cell(corner, start, step);
    for (double s = 0; s <= 1; s += 0.125)
        assert_close(ang_cubic_at(&f, s),
                     ang_volume_sample(
                         volume, (ang_vec3){start[0] + s * step[0], start[1] + s * step[1], start[2] + s * step[2]}),
                     1e-9);
    ang_volume_free(volume);
}

static void crossings_of_random_cubics_are_all_found(void **state) {
    (void)state;
    uint64_t seed = 7;
    for (int trial = 0; trial < 20000; trial++) {
        ang_cubic f;
        for (int i = 0; i < 4; i++) f.c[i] = (2 * random_unit(&seed) - 1) * (i == 3 && trial % 3 == 0 ? 1e-14 : 10);
        double places[3];
        int found = ang_cubic_crossings(&f, 0.5, places);
        for (int i = 0; i < found; i++) assert_close(ang_cubic_at(&f, places[i]), 0.5, 1e-12);
        int changes = 0;
        for (int i = 0; i < 1000; i++)
            changes += (ang_cubic_at(&f, i / 1000.) < 0.5) != (ang_cubic_at(&f, (i + 1) / 1000.) < 0.5);
        assert_true(found >= changes);
        assert_int_equal((found - changes) % 2, 0);
    }
}

static void gauss_integrates_polynomials_exactly(void **state) {
    (void)state;
    ang_gauss gauss = ang_gauss_make();
    for (int power = 0; power < 2 * ANG_GAUSS_NODES; power++) {
        double sum = 0;
        for (int i = 0; i < ANG_GAUSS_NODES; i++) sum += gauss.weight[i] * pow(gauss.node[i], power);
        assert_close(sum, 1. / (power + 1), 1e-14);
    }
    for (int i = 0; i < ANG_GAUSS_NODES; i++) {
        double sum = 0;
        for (int j = 0; j < ANG_GAUSS_NODES; j++) sum += gauss.upto[i][j] * pow(gauss.node[j], 3);
        assert_close(sum, pow(gauss.node[i], 4) / 4, 1e-14);
    }
}

static void homogeneous_medium_has_exponential_opacity(void **state) {
    (void)state;
    double spacing[3] = {0.7, 0.7, 2.5};
    ang_volume *volume = make_volume(17, 11, 9, spacing, flat_value);
    static const double kappas[] = {1e-6, 1e-3, 0.1, 1, 30, 1e6};
    for (size_t k = 0; k < sizeof kappas / sizeof *kappas; k++) {
        ang_transfer *transfer = constant_transfer(kappas[k], 0.5, 0.25, 1);
        ang_scene scene = ang_scene_default(volume);
        scene.transfer = transfer;
        ang_view view = ang_view_default;
        view.projection = ANG_PARALLEL;
        scene.camera = ang_camera_for(volume, &view);
        double rgba[4], expected = -expm1(-kappas[k] * 10 * 0.7);
        pixel(volume, &scene, 256, 256, rgba);
        assert_close(rgba[3], expected, 1e-12);
        assert_close(rgba[0], 0.5 * expected, 1e-12);
        assert_close(rgba[2], expected, 1e-12);
        pixel(volume, &scene, 1, 1, rgba);
        assert_close(rgba[3], 0, 0);
        ang_transfer_free(transfer);
    }
    ang_volume_free(volume);
}

/* kappa = a f with f = 10 y over y in 0..n mm: depth a 10 n^2 / 2. */
static void linear_ramp_has_its_closed_form(void **state) {
    (void)state;
    ang_volume *volume = make_volume(9, 33, 9, unit, ramp_y);
    ang_transfer_point points[] = {{.hu = 0, .colour = {1, 1, 1}, .opacity = 0},
                                   {.hu = 320, .colour = {1, 1, 1}, .opacity = 0.32}};
    ang_transfer *transfer = ang_transfer_create(points, 2, 1, true, NULL, NULL);
    ang_scene scene = ang_scene_default(volume);
    scene.transfer = transfer;
    ang_view view = ang_view_default;
    view.projection = ANG_PARALLEL;
    scene.camera = ang_camera_for(volume, &view);
    double rgba[4];
    pixel(volume, &scene, 256, 256, rgba);
    assert_close(rgba[3], -expm1(-0.001 * 10 * 32 * 32 / 2.), 1e-10);
    assert_close(rgba[1], rgba[3], 1e-10);
    ang_transfer_free(transfer);
    ang_volume_free(volume);
}

/* Opacity a(f) rising to an isolated 1 at one value: the optical depth is int -log(1 - a) = finite. */
static void isolated_peak_at_opacity_one_follows_its_integral(void **state) {
    (void)state;
    ang_volume *volume = make_volume(9, 33, 9, unit, ramp_y);
    ang_transfer_point points[] = {{.hu = 100, .colour = {1, 0, 0}, .opacity = 0},
                                   {.hu = 101, .colour = {1, 0, 0}, .opacity = 1},
                                   {.hu = 102, .colour = {1, 0, 0}, .opacity = 0}};
    ang_transfer *transfer = ang_transfer_create(points, 3, 1, false, NULL, NULL);
    ang_scene scene = ang_scene_default(volume);
    scene.transfer = transfer;
    ang_view view = ang_view_default;
    view.projection = ANG_PARALLEL;
    scene.camera = ang_camera_for(volume, &view);
    double rgba[4];
    pixel(volume, &scene, 256, 256, rgba);
    /* int_0^1 -log(1 - u) du = 1 on each side; 1 HU is 0.1 mm. */
    assert_close(rgba[3], -expm1(-2 * 0.1), 1e-9);
    ang_transfer_free(transfer);

    /* A plateau is a surface however thin, in the colour of its near side. */
    ang_transfer_point plateau[] = {{.hu = 100, .colour = {0, 1, 0}, .opacity = 0},
                                    {.hu = 100, .colour = {0, 1, 0}, .opacity = 1},
                                    {.hu = 100.001, .colour = {0, 1, 0}, .opacity = 1},
                                    {.hu = 100.001, .colour = {0, 1, 0}, .opacity = 0}};
    transfer = ang_transfer_create(plateau, 4, 1, false, NULL, NULL);
    scene.transfer = transfer;
    pixel(volume, &scene, 256, 256, rgba);
    assert_close(rgba[3], 1, 0);
    assert_close(rgba[1], 1, 0);
    assert_close(rgba[0], 0, 0);
    ang_transfer_free(transfer);
    ang_volume_free(volume);
}

/* A fine midpoint march over the same trilinear field must approach the reference with order 1.8 to 2. */
static void random_field_agrees_with_a_fine_march(void **state) {
    (void)state;
    double spacing[3] = {1, 0.8, 1.7};
    ang_volume *volume = make_volume(7, 9, 6, spacing, noise_value);
    ang_transfer_point points[] = {{.hu = 200, .colour = {1, 0, 0.2}, .opacity = 0},
                                   {.hu = 500, .colour = {0, 1, 0.4}, .opacity = 0.5},
                                   {.hu = 900, .colour = {0, 0, 1}, .opacity = 0.9}};
    ang_transfer *transfer = ang_transfer_create(points, 3, 1, false, NULL, NULL);
    ang_scene scene = ang_scene_default(volume);
    scene.transfer = transfer;
    ang_view view = ang_view_default;
    assert_true(ang_view_parse("37,-21,13", &view, NULL));
    scene.camera = ang_camera_for(volume, &view);
    ang_ray_frame frame;
    assert_true(ang_ray_frame_make(volume, &scene, &frame, NULL));
    for (int shading = 0; shading < 2; shading++) {
        scene.shading = (ang_shading)shading;
        double rgba[4];
        pixel(volume, &scene, 250, 270, rgba);
        ang_ray ray = ang_ray_through(&frame, 250, 270);
        double error[2];
        for (int refinement = 0; refinement < 2; refinement++) {
            int steps = 400 << (4 * refinement);
            double h = (ray.leave - ray.enter) / steps, light[4] = {0};
            for (int i = 0; i < steps; i++) {
                ang_vec3 at =
                    ang_vec3_add(frame.centre, ang_vec3_along(ray.origin, ray.direction, ray.enter + (i + 0.5) * h));
                double hu = ang_volume_hu(volume, ang_volume_sample(volume, at)), colour[3];
                double opacity = -expm1(-h * ang_transfer_extinction(transfer, hu));
                ang_transfer_colour(transfer, hu, colour);
                if (shading) {
                    ang_vec3 g = ang_volume_gradient(volume, &frame.to_index, at);
                    double g2 = ang_vec3_dot(g, g), facing = fabs(ang_vec3_dot(g, ray.direction_mm)) / sqrt(g2);
                    double weight = g2 / (g2 + 1);
                    for (int c = 0; c < 3; c++)
                        colour[c] = (1 - weight) * colour[c] +
                                    weight * (colour[c] * (0.3 + 0.6 * facing) + 0.3 * pow(facing, 20));
                }
                for (int c = 0; c < 3; c++) light[c] += (1 - light[3]) * opacity * colour[c];
                light[3] += (1 - light[3]) * opacity;
            }
            error[refinement] = 0;
            for (int c = 0; c < 4; c++) error[refinement] = fmax(error[refinement], fabs(light[c] - rgba[c]));
        }
        assert_true(error[0] < 1e-4);
        /* Kinks lower the order from 2 to about 1.8: sixteen times the steps, at least a hundredth of the error. */
        assert_true(error[1] < error[0] / 100);
    }
    ang_transfer_free(transfer);
    ang_volume_free(volume);
}

static void extremes_mean_and_surface_of_a_ramp_are_exact(void **state) {
    (void)state;
    ang_volume *volume = make_volume(11, 21, 11, unit, ramp_y);
    ang_transfer *transfer = constant_transfer(1, 0.2, 0.4, 0.8);
    ang_scene scene = ang_scene_default(volume);
    scene.transfer = transfer;
    scene.window_centre = 100;
    scene.window_width = 400;
    ang_view view = ang_view_default;
    view.projection = ANG_PARALLEL;
    scene.camera = ang_camera_for(volume, &view);
    double rgba[4];
    scene.mode = ANG_MODE_MIP;
    pixel(volume, &scene, 256, 256, rgba);
    assert_close(rgba[0], (200 - 100) / 400. + 0.5, 1e-12);
    scene.mode = ANG_MODE_MINIP;
    pixel(volume, &scene, 256, 256, rgba);
    assert_close(rgba[0], (0 - 100) / 400. + 0.5, 1e-12);
    scene.mode = ANG_MODE_MEAN;
    pixel(volume, &scene, 256, 256, rgba);
    assert_close(rgba[0], (100 - 100) / 400. + 0.5, 1e-12);
    /* The normal faces the eye: ambient + diffuse and the full highlight, weighted by 10^2 / (10^2 + 1). */
    scene.mode = ANG_MODE_ISO;
    scene.iso_hu = 77;
    pixel(volume, &scene, 256, 256, rgba);
    double weight = 100 / 101.;
    assert_close(rgba[1], 0.4 + weight * (0.4 * 0.9 + 0.3 - 0.4), 1e-9);
    assert_close(rgba[3], 1, 0);
    scene.iso_hu = 201;
    pixel(volume, &scene, 256, 256, rgba);
    assert_close(rgba[3], 0, 0);
    ang_transfer_free(transfer);
    ang_volume_free(volume);
}

static void maximum_inside_a_cell_is_found(void **state) {
    (void)state;
    ang_volume *volume = make_volume(2, 2, 2, unit, flat_value);
    /* f = xy on a diagonal is x^2 - ...: corners 0, 0, 0, 100 in z = 0 and 100, 0, 0, 0 in z = 1 */
    uint16_t corner[8] = {1024, 1124, 1124, 1024, 1024, 1124, 1124, 1024};
    memcpy(volume->data, corner, sizeof corner);
    ang_volume_update_range(volume, 1);
    ang_scene scene = ang_scene_default(volume);
    ang_view view = ang_view_default;
    view.projection = ANG_PARALLEL;
    assert_true(ang_view_parse("45,0", &view, NULL));
    scene.camera = ang_camera_for(volume, &view);
    scene.mode = ANG_MODE_MIP;
    scene.window_centre = 0;
    scene.window_width = 200;
    /* Along the diagonal of the face f runs 0 .. 50 .. 0 or 100 .. 50 .. 100, by the side. */
    double front[4], side[4];
    pixel(volume, &scene, 256, 256, front);
    assert_true(ang_view_parse("-45,0", &view, NULL));
    scene.camera = ang_camera_for(volume, &view);
    pixel(volume, &scene, 256, 256, side);
    assert_close(fmin(front[0], side[0]), 50 / 200. + 0.5, 1e-12);
    assert_close(fmax(front[0], side[0]), 100 / 200. + 0.5, 1e-12);
    ang_volume_free(volume);
}

static void padding_stays_out_of_the_mean(void **state) {
    (void)state;
    ang_volume *volume = make_volume(5, 11, 5, unit, flat_value);
    volume->intercept = -2024;
    for (size_t i = 0; i < 275; i++) volume->data[i] = i / 5 % 11 < 5 ? 7 : 2324; /* 300 HU behind padding */
    assert_true(ang_volume_mark_padding(volume, 7, NULL));
    ang_scene scene = ang_scene_default(volume);
    scene.mode = ANG_MODE_MEAN;
    scene.window_centre = 0;
    scene.window_width = 1000;
    double rgba[4];
    pixel(volume, &scene, 256, 256, rgba);
    assert_close(rgba[0], 300 / 1000. + 0.5, 1e-12);
    ang_volume_free(volume);
}

static void sphere_seen_from_inside_and_single_voxels_are_finite(void **state) {
    (void)state;
    static const int sizes[][3] = {{1, 1, 1}, {1, 5, 5}, {5, 1, 5}, {5, 5, 1}, {2, 1, 1}};
    for (size_t s = 0; s < sizeof sizes / sizeof *sizes; s++) {
        ang_volume *volume = make_volume(sizes[s][0], sizes[s][1], sizes[s][2], unit, flat_value);
        ang_transfer *transfer = constant_transfer(0.3, 1, 1, 1);
        ang_scene scene = ang_scene_default(volume);
        scene.transfer = transfer;
        ang_view view = ang_view_default;
        view.projection = ANG_PARALLEL;
        scene.camera = ang_camera_for(volume, &view);
        double depth = sizes[s][1] == 1 ? 1 : sizes[s][1] - 1, rgba[4];
        pixel(volume, &scene, 256, 256, rgba);
        assert_close(rgba[3], -expm1(-0.3 * depth), 1e-12);
        scene.shading = ANG_SHADING_PHONG;
        pixel(volume, &scene, 256, 256, rgba);
        assert_close(rgba[3], -expm1(-0.3 * depth), 1e-6);
        assert_close(rgba[0], rgba[3], 1e-6); /* no gradient, no shading */
        ang_transfer_free(transfer);
        ang_volume_free(volume);
    }
}

/* A picture in parts is the picture, and what is filled is left as it is. */
static void only_blank_pixels_are_filled(void **state) {
    (void)state;
    ang_volume *volume = make_volume(6, 6, 6, unit, noise_value);
    ang_transfer *transfer = constant_transfer(0.3, 1, 0.5, 0.25);
    ang_scene scene = ang_scene_default(volume);
    scene.transfer = transfer;
    scene.width = scene.height = 16;
    ang_error err = {0};
    ang_reference *reference = ang_reference_create(volume, &scene, &err);
    ang_image whole, parts;
    assert_true(reference && ang_image_create(&whole, 16, 16, &err) && ang_image_create(&parts, 16, 16, &err));
    ang_reference_blank(&whole);
    assert_true(ang_reference_fill(reference, &whole, 2, NULL, NULL, &err));
    for (int i = 0; i < 256; i++) {
        double rgba[4];
        ang_reference_pixel(reference, i % 16 + 0.5, i / 16 + 0.5, rgba, NULL);
        for (int c = 0; c < 4; c++) assert_true(whole.rgba[4 * i + c] == (float)rgba[c]);
    }
    ang_reference_blank(&parts);
    for (int i = 0; i < 100; i++)
        for (int c = 0; c < 4; c++) parts.rgba[4 * i + c] = 7;
    uint64_t samples = 0;
    assert_true(ang_reference_fill(reference, &parts, 2, NULL, &samples, &err));
    assert_true(samples > 0);
    for (int i = 0; i < 1024; i++) assert_true(parts.rgba[i] == (i < 400 ? 7 : whole.rgba[i]));
    samples = 0;
    assert_true(ang_reference_fill(reference, &parts, 2, NULL, &samples, &err));
    assert_int_equal(samples, 0);
    ang_image_clear(&whole);
    ang_image_clear(&parts);
    ang_reference_free(reference);
    ang_transfer_free(transfer);
    ang_volume_free(volume);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(cubic_in_a_cell_is_trilinear_interpolation),
        cmocka_unit_test(crossings_of_random_cubics_are_all_found),
        cmocka_unit_test(gauss_integrates_polynomials_exactly),
        cmocka_unit_test(homogeneous_medium_has_exponential_opacity),
        cmocka_unit_test(linear_ramp_has_its_closed_form),
        cmocka_unit_test(isolated_peak_at_opacity_one_follows_its_integral),
        cmocka_unit_test(random_field_agrees_with_a_fine_march),
        cmocka_unit_test(extremes_mean_and_surface_of_a_ramp_are_exact),
        cmocka_unit_test(maximum_inside_a_cell_is_found),
        cmocka_unit_test(padding_stays_out_of_the_mean),
        cmocka_unit_test(sphere_seen_from_inside_and_single_voxels_are_finite),
        cmocka_unit_test(only_blank_pixels_are_filled),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
