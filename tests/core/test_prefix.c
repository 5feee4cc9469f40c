/* Prefix-integrated classification against closed forms, numerical integration and the reference, and with skipping
 * against itself; every method, on every backend here. */
#include "tests/core/backends.h"
#include "tests/core/drawer.h"
#include "tests/core/scenes.h"

#include "core/error/metrics.h"
#include "core/render/method.h"
#include "core/transfer/prefix.h"

#include <string.h>

static const ang_render_options prefix = {
    .step_voxels = 0.5, .termination = 1, .classification = ANG_CLASSIFY_PREFIX, .gradients = ANG_GRADIENTS_LOOKUPS};

static double ramp_y(int x, int y, int z) {
    (void)x, (void)z;
    return 10 * y;
}
/* All of 65536 values, 4369 a voxel. */
static double steep_ramp(int x, int y, int z) {
    (void)x, (void)z;
    return 4369 * y - 1024;
}
static double ramp_zero(int x, int y, int z) {
    (void)x, (void)y, (void)z;
    return 0;
}

/* Adaptive Simpson of the extinction. */
static double simpson(const ang_transfer *t, double a, double b, double fa, double fm, double fb, int depth) {
    double m = 0.5 * (a + b), l = ang_transfer_extinction(t, 0.5 * (a + m)),
           r = ang_transfer_extinction(t, 0.5 * (m + b));
    double whole = (b - a) / 6 * (fa + 4 * fm + fb);
    double halves = (b - a) / 12 * (fa + 4 * l + 2 * fm + 4 * r + fb);
    if (depth == 0 || fabs(halves - whole) < 1e-13) return halves + (halves - whole) / 15;
    return simpson(t, a, m, fa, l, fm, depth - 1) + simpson(t, m, b, fm, r, fb, depth - 1);
}

static void sums_are_what_integration_gives(void **state) {
    (void)state;
    static const ang_transfer_point points[] = {{.hu = -50, .colour = {1, 0, 0}, .opacity = 0},
                                                {.hu = 20, .colour = {1, 0, 0}, .opacity = 0.3},
                                                {.hu = 64.5, .colour = {0, 1, 0}, .opacity = 0.97},
                                                {.hu = 120, .colour = {0, 0, 1}, .opacity = 0.02},
                                                {.hu = 400, .colour = {1, 1, 1}, .opacity = 0.5}};
    ang_transfer *t = ang_transfer_create(points, 5, 0.7, false, NULL, NULL);
    ang_transfer_tables *tables = ang_tables_create(t, 0.5, -60, 0, 1000, 0, NULL);
    ang_prefix *sums = ang_prefix_create(tables, t, 0.5, -60, NULL);
    assert_non_null(sums);
    double sum = 0, before = 0.5 * tables->first - 60;
    for (int i = 0; i <= sums->intervals; i++) {
        double hu = 0.5 * (tables->first + i / tables->per_value) - 60;
        if (hu > before)
            sum += simpson(t, before, hu, ang_transfer_extinction(t, before),
                           ang_transfer_extinction(t, 0.5 * (before + hu)), ang_transfer_extinction(t, hu), 30);
        before = hu;
        const float *at = &sums->sums[8 * (size_t)i];
        assert_close(((double)at[3] + at[7]) / tables->per_value * 0.5, sum, 1e-9);
    }
    assert_null(sums->plateaus);
    ang_prefix_free(sums);
    ang_tables_free(tables);
    ang_transfer_free(t);
}

/* Values at the ends of a pixel's ray through a field that is linear along y; returns the ray's length. */
static double ends_of(const ang_volume *volume, const ang_scene *scene, int pixel, double at_zero, double slope,
                      double hu[2]) {
    ang_ray_frame frame;
    assert_true(ang_ray_frame_make(volume, scene, &frame, NULL));
    ang_ray ray = ang_ray_through(&frame, pixel % scene->width + 0.5, pixel / scene->width + 0.5);
    double t[2] = {ray.enter, ray.leave};
    for (int i = 0; i < 2; i++) hu[i] = at_zero + slope * (ray.origin.y + t[i] * ray.direction.y + frame.centre.y);
    return fmax(ray.leave - ray.enter, 0);
}

/* Optical depth of that ray: the mean extinction between the two values, exact, times the length. */
static double depth_of(const ang_transfer *transfer, double length, const double hu[2]) {
    if (fabs(hu[1] - hu[0]) < 1e-9) return length * ang_transfer_extinction(transfer, hu[0]);
    return length * ang_transfer_integrate_between(transfer, hu[0], hu[1]).extinction / (hu[1] - hu[0]);
}

static void check_opacity(ang_gl *gl, const ang_volume *volume, const ang_transfer *transfer, double at_zero,
                          double slope, double tolerance) {
    static const double steps[] = {0.21, 0.5, 1.7, 6};
    for (const ang_method *const *method = ang_methods(); *method; method++) {
        if (!((*method)->takes & ANG_TAKES_CLASSIFICATION)) continue;
        drawer d = open_drawer(gl, *method, volume);
        for (int which = 0; which < 3; which++)
            for (size_t k = 0; k < sizeof steps / sizeof *steps; k++) {
                ang_scene scene = make_scene(which, volume, transfer);
                scene.width = 19;
                scene.height = 16;
                ang_render_options options = prefix;
                options.step_voxels = steps[k];
                ang_image image = draw(&d, &scene, &options, NULL);
                for (int p = 0; p < scene.width * scene.height; p++) {
                    double hu[2], length = ends_of(volume, &scene, p, at_zero, slope, hu);
                    if (length > 0 && length < 0.05) continue; /* the float ends of a ray are not as certain as that */
                    double alpha = length > 0 ? -expm1(-depth_of(transfer, length, hu)) : 0;
                    if (fabs(image.rgba[4 * p + 3] - alpha) > tolerance)
                        fail_msg("%s, scene %d, step %g, pixel %d: %.9g, not %.9g", d.method->name, which, steps[k], p,
                                 (double)image.rgba[4 * p + 3], alpha);
                    assert_close(image.rgba[4 * p + 1], 0.5 * alpha, tolerance);
                }
                ang_image_clear(&image);
            }
        d.method->destroy(d.renderer);
    }
}

static const double unit[3] = {1, 1, 1};

/* Case 4 of numerics.md's battery: two slabs, whatever the step. */
static void a_step_on_a_ramp(void **state) {
    open_gl(state);
    ang_volume *volume = make_volume(20, 21, 18, unit, ramp_y);
    static const ang_transfer_point points[] = {{.hu = 0, .colour = {1, 0.5, 0}, .opacity = 0.02},
                                                {.hu = 83.7, .colour = {1, 0.5, 0}, .opacity = 0.02},
                                                {.hu = 83.7, .colour = {1, 0.5, 0}, .opacity = 0.2},
                                                {.hu = 200, .colour = {1, 0.5, 0}, .opacity = 0.2}};
    ang_transfer *transfer = ang_transfer_create(points, 4, 1, true, NULL, NULL);
    check_opacity(gl, volume, transfer, 0, 10, 1e-5);
    ang_transfer_free(transfer);
    ang_volume_free(volume);
}

/* Case 5: a spike of 1 in 65536 values has its exact integral, and mid-point samples, which see nothing of it, say so.
 */
static void a_spike_on_a_ramp(void **state) {
    open_gl(state);
    ang_volume *volume = make_volume(14, 16, 12, unit, steep_ramp);
    static const ang_transfer_point points[] = {{.hu = 0, .colour = {1, 0.5, 0}, .opacity = 0},
                                                {.hu = 29999, .colour = {1, 0.5, 0}, .opacity = 0},
                                                {.hu = 30000, .colour = {1, 0.5, 0}, .opacity = 5000},
                                                {.hu = 30001, .colour = {1, 0.5, 0}, .opacity = 0},
                                                {.hu = 60000, .colour = {1, 0.5, 0}, .opacity = 0}};
    ang_transfer *transfer = ang_transfer_create(points, 5, 1, true, NULL, NULL);
    check_opacity(gl, volume, transfer, -1024, 4369, 1e-4);
    for (const ang_method *const *method = ang_methods(); *method; method++) {
        if (!((*method)->takes & ANG_TAKES_CLASSIFICATION)) continue;
        drawer d = open_drawer(gl, *method, volume);
        ang_scene scene = make_scene(1, volume, transfer);
        ang_view view = ang_view_default;
        view.projection = ANG_PARALLEL;
        scene.camera = ang_camera_for(volume, &view); /* along the ramp */
        for (int wanted = ANG_CLASSIFY_AUTO; wanted <= ANG_CLASSIFY_PREFIX; wanted++) {
            ang_render_options options = prefix;
            options.classification = (ang_classify)wanted;
            options.step_voxels = 0.25;
            ang_frame_stats stats = {0};
            ang_image image = draw(&d, &scene, &options, &stats);
            int middle = 4 * (scene.width * (scene.height / 2) + scene.width / 2);
            double alpha = -expm1(-5000.0 / 4369);
            bool midpoint = wanted == ANG_CLASSIFY_MIDPOINT;
            assert_close(image.rgba[middle + 3], midpoint ? 0 : alpha, midpoint ? 0 : 1e-4);
            assert_true(midpoint == (stats.note != NULL));
            if (midpoint) assert_non_null(strstr(stats.note, "may be missed"));
            ang_image_clear(&image);
        }
        d.method->destroy(d.renderer);
    }
    ang_transfer_free(transfer);
    ang_volume_free(volume);
}

/* Case 6: opacity 1 at one value is a surface that no step jumps over, of the colour in front of which lies what comes
 * before it, from both sides; an isolated peak at 1 has its finite depth. */
static void opacity_one_at_one_value(void **state) {
    open_gl(state);
    ang_volume *volume = make_volume(20, 21, 18, unit, ramp_y);
    /* Clear, or red before and blue behind. */
    for (int coloured = 0; coloured < 2; coloured++) {
        double veil = coloured ? 0.08 : 0;
        const ang_transfer_point points[] = {{.hu = 0, .colour = {1, 0, 0}, .opacity = veil},
                                             {.hu = 91, .colour = {1, 0, 0}, .opacity = veil},
                                             {.hu = 91, .colour = {0.25, 0.5, 0.75}, .opacity = 1},
                                             {.hu = 92, .colour = {0.25, 0.5, 0.75}, .opacity = 1},
                                             {.hu = 92, .colour = {0, 0, 1}, .opacity = veil},
                                             {.hu = 200, .colour = {0, 0, 1}, .opacity = veil}};
        ang_transfer *transfer = ang_transfer_create(points, 6, 1, false, NULL, NULL);
        for (const ang_method *const *method = ang_methods(); *method; method++) {
            if (!((*method)->takes & ANG_TAKES_CLASSIFICATION)) continue;
            drawer d = open_drawer(gl, *method, volume);
            static const char *const views[] = {"anterior", "posterior", "30,10", "190,-15"};
            for (size_t v = 0; v < sizeof views / sizeof *views; v++) {
                ang_scene scene = make_scene(0, volume, transfer);
                ang_view view = ang_view_default;
                assert_true(ang_view_parse(views[v], &view, NULL));
                scene.camera = ang_camera_for(volume, &view);
                scene.width = 19;
                scene.height = 16;
                ang_render_options options = prefix;
                options.step_voxels = v % 2 ? 2.3 : 7;
                ang_image image = draw(&d, &scene, &options, NULL);
                int hits = 0;
                for (int p = 0; p < scene.width * scene.height; p++) {
                    double hu[2], length = ends_of(volume, &scene, p, 0, 10, hu);
                    double edge = hu[0] < hu[1] ? 91 : 92;
                    bool crosses = length > 0 && (hu[0] - edge) * (hu[1] - edge) < 0;
                    if (!crosses || fabs(hu[0] - edge) < 1 || fabs(hu[1] - edge) < 1) continue;
                    hits++;
                    const float *pixel = &image.rgba[4 * p];
                    if (!coloured) {
                        for (int c = 0; c < 4; c++) assert_true(pixel[c] == (float)(0.25 * (c + 1)));
                        continue;
                    }
                    double before = length * (edge - hu[0]) / (hu[1] - hu[0]);
                    double clear = exp(log1p(-veil) * before), red = hu[0] < hu[1] ? 1 : 0;
                    const double expected[4] = {(1 - clear) * red + 0.25 * clear, 0.5 * clear,
                                                (1 - clear) * (1 - red) + 0.75 * clear, 1};
                    for (int c = 0; c < 4; c++) assert_close(pixel[c], expected[c], 2e-5);
                }
                assert_true(hits > 20);
                ang_image_clear(&image);
            }
            d.method->destroy(d.renderer);
        }
        ang_transfer_free(transfer);
    }
    static const ang_transfer_point peak[] = {{.hu = 86, .colour = {1, 0.5, 0}, .opacity = 0},
                                              {.hu = 91, .colour = {1, 0.5, 0}, .opacity = 1},
                                              {.hu = 96, .colour = {1, 0.5, 0}, .opacity = 0}};
    ang_transfer *transfer = ang_transfer_create(peak, 3, 1, false, NULL, NULL);
    check_opacity(gl, volume, transfer, 0, 10, 1e-4);
    ang_transfer_free(transfer);
    ang_volume_free(volume);
}

/* Both ends of a step at one value, or almost: the extinction of that value, from 1e-6 to 1e6 per mm. */
static void flat_values(void **state) {
    open_gl(state);
    ang_volume *volume = make_volume(20, 21, 18, unit, ramp_zero);
    volume->data[5 + 20 * (7 + 21 * 9)] += 1; /* so that values lie around a whole one */
    ang_volume_update_range(volume, 1);
    for (int power = -6; power <= 6; power += 3) {
        double kappa = pow(10, power);
        const ang_transfer_point points[] = {{.hu = -5, .colour = {1, 0.5, 0}, .opacity = 0.5 * kappa},
                                             {.hu = 0, .colour = {1, 0.5, 0}, .opacity = kappa},
                                             {.hu = 1, .colour = {1, 0.5, 0}, .opacity = kappa},
                                             {.hu = 7, .colour = {1, 0.5, 0}, .opacity = 2 * kappa}};
        ang_transfer *transfer = ang_transfer_create(points, 4, 1, true, NULL, NULL);
        check_opacity(gl, volume, transfer, 0, 0, 4e-6 + fmin(4e-5 * kappa, 4e-3));
        ang_transfer_free(transfer);
    }
    ang_volume_free(volume);
}

/* Transfer functions of four kinds, over the values of scenes.h. */
enum { KINDS = 5 };
static ang_transfer *of_kind(int kind) {
    static const ang_transfer_point step[] = {{.hu = 250, .colour = {1, 0.3, 0.2}, .opacity = 0},
                                              {.hu = 250, .colour = {1, 0.3, 0.2}, .opacity = 0.12},
                                              {.hu = 600, .colour = {1, 0.9, 0.8}, .opacity = 0.12}};
    static const ang_transfer_point spike[] = {{.hu = 300, .colour = {1, 0.3, 0.2}, .opacity = 0},
                                               {.hu = 301, .colour = {1, 0.3, 0.2}, .opacity = 0.9},
                                               {.hu = 302, .colour = {1, 0.3, 0.2}, .opacity = 0}};
    static const ang_transfer_point surface[] = {
        {.hu = 200, .colour = {0.2, 0.3, 1}, .opacity = 0},   {.hu = 320, .colour = {0.2, 0.3, 1}, .opacity = 0.1},
        {.hu = 320, .colour = {1, 0.6, 0.4}, .opacity = 1},   {.hu = 340, .colour = {1, 0.9, 0.4}, .opacity = 1},
        {.hu = 340, .colour = {1, 0.6, 0.4}, .opacity = 0.1}, {.hu = 600, .colour = {1, 1, 1}, .opacity = 0.2}};
    static const ang_transfer_point kinked[] = {{.hu = 250, .colour = {1, 0.3, 0.2}, .opacity = 0},
                                                {.hu = 290, .colour = {1, 0.5, 0.2}, .opacity = 0.3},
                                                {.hu = 330, .colour = {1, 0.9, 0.3}, .opacity = 0.02},
                                                {.hu = 600, .colour = {1, 1, 1}, .opacity = 0.1}};
    if (kind == 1) return ang_transfer_create(step, 3, 1, false, NULL, NULL);
    if (kind == 2) return ang_transfer_create(spike, 3, 1, false, NULL, NULL);
    if (kind == 3) return ang_transfer_create(surface, 6, 1, false, NULL, NULL);
    if (kind == 4) return ang_transfer_create(kinked, 4, 1, false, NULL, NULL);
    return vessels();
}

static void check_same(const char *what, const drawer *d, const ang_scene *scene, const ang_render_options *options,
                       const ang_image *truth, bool fewer) {
    ang_frame_stats stats = {0};
    ang_image image = draw(d, scene, options, &stats);
    double far = difference(truth, &image);
    if (!(far <= 1e-6)) fail_msg("%s, %s, step %g: %g", d->method->name, what, options->step_voxels, far);
    if (fewer) assert_true(stats.bricks_drawn < stats.bricks_total);
}

/* Half of the volume is air. */
static double half_value(int x, int y, int z) { return x > 20 ? sparse_value(x, y, z) : -50; }

/* A step is skipped only where every block that it touches is invisible: with and without, the same picture. */
static void skipping_changes_nothing(void **state) {
    open_gl(state);
    ang_volume *volume = sheared_volume(half_value);
    drawer singlepass = open_drawer(gl, &ang_method_singlepass, volume);
    drawer envelope = open_drawer(gl, &ang_method_envelope, volume);
    drawer raycast = open_drawer(gl, &ang_method_raycast, volume);
    drawer slicing = open_drawer(gl, &ang_method_slicing, volume);
    drawer cpu = open_drawer(gl, &ang_method_cpu, volume);
    static const double steps[] = {0.11, 0.5, 3.3, 12};
    for (int which = 0; which < SCENES; which++)
        for (int kind = 0; kind < KINDS; kind++)
            for (int k = 0; k < 4; k++) {
                if (k == 0 ? kind != which : (which + kind + k) % 2) continue;
                ang_transfer *transfer = of_kind(kind);
                ang_scene scene = make_scene(which, volume, transfer);
                scene.width /= 2;
                scene.height /= 2;
                scene.shading = kind % 2 ? ANG_SHADING_PHONG : ANG_SHADING_NONE;
                char what[80];
                snprintf(what, sizeof what, "scene %d, kind %d, shading %d", which, kind, scene.shading);
                ang_render_options options = prefix;
                options.step_voxels = steps[k];
                ang_render_options whole = options;
                whole.no_skip = true;
                ang_image truth = draw(&singlepass, &scene, &options, NULL);
                check_same(what, &envelope, &scene, &whole, &truth, false);
                for (int skipping = 0; skipping < 3; skipping++) {
                    options.skipping = (ang_skipping)skipping;
                    options.quads = k == 1 ? 40 : 0;
                    check_same(what, &envelope, &scene, &options, &truth, skipping != ANG_SKIP_OUTSIDE);
                }
                options = prefix;
                options.step_voxels = steps[k];
                ang_image_clear(&truth);
                options.pass_steps = whole.pass_steps = 3 + which;
                truth = draw(&raycast, &scene, &whole, NULL);
                check_same(what, &raycast, &scene, &options, &truth, true);
                options.separate_passes = true;
                check_same(what, &raycast, &scene, &options, &truth, true);
                ang_image_clear(&truth);

                options = prefix;
                options.step_voxels = steps[k];
                whole.pass_steps = 0;
                truth = draw(&cpu, &scene, &whole, NULL);
                check_same(what, &cpu, &scene, &options, &truth, true);
                ang_image_clear(&truth);
                whole.bricks[0] = whole.bricks[1] = whole.bricks[2] = 1;
                truth = draw(&slicing, &scene, &whole, NULL);
                check_same(what, &slicing, &scene, &options, &truth, steps[k] < 1);
                memcpy(options.bricks, (const int[3]){5, 4, 3}, sizeof options.bricks);
                check_same(what, &slicing, &scene, &options, &truth, false);
                ang_image_clear(&truth);
                ang_transfer_free(transfer);
            }
    drawer *all[] = {&singlepass, &envelope, &raycast, &slicing, &cpu};
    for (int i = 0; i < 5; i++) all[i]->method->destroy(all[i]->renderer);
    ang_volume_free(volume);
}

/* Bricks in textures of their own reach as far as the ends of their steps. */
static void bricks_hold_the_ends_of_steps(void **state) {
    open_gl(state);
    ang_volume *volume = sheared_volume(sparse_value);
    ang_transfer *transfer = of_kind(1);
    ang_scene scene = make_scene(0, volume, transfer);
    ang_render_options options = prefix;
    options.step_voxels = 2.5;
    options.manual_filter = true; /* the same bits whichever texture holds the voxels */
    drawer whole = open_drawer(gl, &ang_method_slicing, volume);
    ang_image truth = draw(&whole, &scene, &options, NULL);
    options.gpu_memory = 60000;
    ang_error err = {0};
    drawer bricked = {&ang_method_slicing, ang_method_slicing.create(gl, volume, &options, &err)};
    if (!bricked.renderer) fail_msg("%s", err.message);
    ang_frame_stats stats = {0};
    ang_image image = draw(&bricked, &scene, &options, &stats);
    assert_true(stats.bricks_uploaded > 1);
    assert_true(difference(&truth, &image) <= 1e-6);
    ang_image_clear(&truth);
    ang_method_slicing.destroy(whole.renderer);
    ang_method_slicing.destroy(bricked.renderer);
    ang_transfer_free(transfer);
    ang_volume_free(volume);
}

static double smooth_value(int x, int y, int z) {
    return 300 + 250 * sin(0.31 * x + 0.2) * cos(0.27 * y) + 150 * sin(0.4 * z + 0.13 * x);
}

/* Against the reference: prefix is of order 2 where the transfer function is smooth, and where it has steps or peaks
 * its error is below the mid-point's at the same step. */
static void errors_beside_the_mid_point(void **state) {
    open_gl(state);
    static const double spacing[3] = {0.8, 0.9, 1.4};
    ang_volume *volume = make_volume(24, 28, 18, spacing, smooth_value);
    ang_error err = {0};
    drawer truth = {&ang_method_reference, ang_method_reference.create(NULL, volume, &prefix, &err)};
    for (int kind = 0; kind < KINDS; kind++) {
        ang_transfer *transfer = of_kind(kind);
        ang_scene scene = make_scene(0, volume, transfer);
        scene.width = 40;
        scene.height = 32;
        ang_image exact = draw(&truth, &scene, &prefix, NULL);
        for (const ang_method *const *method = ang_methods(); *method; method++) {
            if (!((*method)->takes & ANG_TAKES_CLASSIFICATION)) continue;
            drawer d = open_drawer(gl, *method, volume);
            double rms[2][2];
            for (int wanted = ANG_CLASSIFY_MIDPOINT; wanted <= ANG_CLASSIFY_PREFIX; wanted++)
                for (int fine = 0; fine < 2; fine++) {
                    ang_render_options options = prefix;
                    options.classification = (ang_classify)wanted;
                    options.step_voxels = fine ? 0.125 : 0.5;
                    ang_image image = draw(&d, &scene, &options, NULL);
                    ang_metrics metrics;
                    assert_true(ang_metrics_compute(&image, &exact, false, &metrics, NULL));
                    rms[wanted == ANG_CLASSIFY_PREFIX][fine] = metrics.rms;
                    ang_image_clear(&image);
                }
            double order = log2(rms[1][0] / rms[1][1]) / 2;
            print_message("%-10s kind %d: mid-point rms %.3g -> %.3g, prefix %.3g -> %.3g, order %.2f\n",
                          d.method->name, kind, rms[0][0], rms[0][1], rms[1][0], rms[1][1], order);
            if (kind == 0) assert_true(order > 1.5);
            if (kind > 0 && kind < 4) assert_true(rms[1][0] < rms[0][0] && rms[1][1] < rms[0][1]);
            d.method->destroy(d.renderer);
        }
        ang_image_clear(&exact);
        ang_transfer_free(transfer);
    }
    truth.method->destroy(truth.renderer);
    ang_volume_free(volume);
}

int main(void) {
    const struct CMUnitTest sums[] = {cmocka_unit_test(sums_are_what_integration_gives)};
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_step_on_a_ramp),
        cmocka_unit_test(a_spike_on_a_ramp),
        cmocka_unit_test(opacity_one_at_one_value),
        cmocka_unit_test(flat_values),
        cmocka_unit_test(skipping_changes_nothing),
        cmocka_unit_test(bricks_hold_the_ends_of_steps),
        cmocka_unit_test(errors_beside_the_mid_point),
    };
    return cmocka_run_group_tests(sums, NULL, NULL) + run_on_backends(tests);
}
