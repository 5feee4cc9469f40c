/* Pictures within an error or a time: what is planned is compared with the reference and with what was asked. */
#include "tests/core/backends.h"

#include "core/render/planner.h"
#include "core/volume/phantom.h"

#include <string.h>

enum { SIDE = 48 };

/* Made up: 0.1 us a sample, a millisecond a pixel of the reference. */
static ang_costs made_up(void) {
    static const char *const names[] = {"envelope", "raycast", "slicing", "singlepass"};
    ang_costs costs = {.count = 5};
    for (int i = 0; i < 4; i++) {
        snprintf(costs.of[i].method, sizeof costs.of[i].method, "%s", names[i]);
        costs.of[i].model = (ang_cost_model){.term = {1, 1e-4, 1e-4, 1e-4, 1e-3}};
    }
    snprintf(costs.of[4].method, sizeof costs.of[4].method, "reference");
    costs.of[4].model = (ang_cost_model){.term = {0, 1, 0, 0, 0}};
    return costs;
}

static ang_volume *make_head(void) {
    ang_phantom_params params = ang_phantom_params_default;
    for (int axis = 0; axis < 3; axis++) params.dims[axis] = axis < 2 ? 48 : 32;
    ang_volume *volume = ang_phantom_make(&params, 0, NULL, NULL, NULL);
    assert_non_null(volume);
    return volume;
}

static ang_transfer *make_bone(void) {
    static const ang_transfer_point points[] = {{.hu = 250, .colour = {0.8, 0.3, 0.2}, .opacity = 0},
                                                {.hu = 900, .colour = {1, 0.95, 0.9}, .opacity = 0.3}};
    return ang_transfer_create(points, 2, 1, false, NULL, NULL);
}

static ang_scene make_picture(const ang_volume *volume, const ang_transfer *transfer) {
    ang_scene scene = ang_scene_default(volume);
    scene.width = scene.height = SIDE;
    scene.transfer = transfer;
    return scene;
}

static ang_planned plan(ang_gl *gl, const ang_volume *volume, const ang_scene *scene, const ang_method *asked,
                        double max_error, double max_ms) {
    ang_budget budget = {max_error, max_ms};
    ang_costs costs = made_up();
    ang_planned planned;
    ang_error err = {0};
    if (!ang_planner_plan(gl, volume, scene, &ang_render_options_default, asked, &budget, &costs, &planned, NULL, &err))
        fail_msg("%s", err.message);
    return planned;
}

static ang_render_options options_of(const ang_planned *planned) {
    ang_render_options options = ang_render_options_default;
    if (planned->step_voxels > 0) options.step_voxels = planned->step_voxels;
    options.termination = planned->termination;
    return options;
}

static ang_image draw(const ang_method *method, ang_renderer *renderer, const ang_scene *scene,
                      const ang_planned *planned) {
    ang_render_options options = ang_render_options_default;
    ang_image image;
    ang_error err = {0};
    if (planned) options = options_of(planned);
    assert_true(ang_image_create(&image, scene->width, scene->height, NULL));
    int stride = planned ? planned->stride : 1;
    ang_scene sparse = ang_scene_subset(scene, stride, 0, 0);
    ang_image drawn;
    assert_true(ang_image_create(&drawn, sparse.width, sparse.height, NULL));
    if (!method->render(renderer, &sparse, &options, &drawn, NULL, NULL, &err)) fail_msg("%s", err.message);
    ang_image_enlarge(&drawn, stride, 0, &image);
    ang_image_clear(&drawn);
    return image;
}

static ang_metrics compare(ang_image a, ang_image b) {
    ang_metrics metrics;
    assert_true(ang_metrics_compute(&a, &b, false, &metrics, NULL));
    ang_image_clear(&a);
    ang_image_clear(&b);
    return metrics;
}

/* How far the planned picture is from the reference. */
static ang_metrics true_error(const ang_volume *volume, const ang_scene *scene, const ang_planned *planned) {
    ang_renderer *reference = ang_method_reference.create(NULL, volume, &ang_render_options_default, NULL);
    ang_metrics metrics = compare(draw(planned->method, planned->renderer, scene, planned),
                                  draw(&ang_method_reference, reference, scene, NULL));
    ang_method_reference.destroy(reference);
    return metrics;
}

static void errors_are_kept(void **state) {
    open_gl(state);
    ang_volume *volume = make_head();
    ang_transfer *transfer = make_bone();
    ang_scene scene = make_picture(volume, transfer);
    static const double limits[] = {8, 2, 0.5};
    double step = INFINITY;
    const ang_method *before = NULL;
    for (size_t i = 0; i < 3; i++) {
        ang_planned planned = plan(gl, volume, &scene, NULL, limits[i], NAN);
        assert_true(planned.keeps_error);
        assert_string_equal(planned.missed, "");
        assert_int_equal(planned.stride, 1);
        double off = true_error(volume, &scene, &planned).max;
        print_message("at most %g: %s, step %.3g, estimated %.3g, %.3g off\n", limits[i], planned.method->name,
                      planned.step_voxels, planned.error, off);
        assert_true(off <= limits[i]);
        assert_true(planned.method != before || planned.step_voxels <= step);
        step = planned.step_voxels;
        before = planned.method;
        planned.method->destroy(planned.renderer);
    }
    /* Beyond what floats can do: only the reference is left, or where that was not asked for a sentence. */
    ang_planned exact = plan(gl, volume, &scene, NULL, 1e-5, NAN);
    assert_ptr_equal(exact.method, &ang_method_reference);
    assert_true(exact.keeps_error);
    exact.method->destroy(exact.renderer);
    ang_planned missed = plan(gl, volume, &scene, &ang_method_singlepass, 1e-5, NAN);
    assert_ptr_equal(missed.method, &ang_method_singlepass);
    assert_false(missed.keeps_error);
    assert_non_null(strstr(missed.missed, "--max-error"));
    assert_non_null(strstr(missed.missed, "best within reach"));
    assert_true(missed.error > 0.01 && missed.error < 0.5);
    missed.method->destroy(missed.renderer);
    ang_transfer_free(transfer);
    ang_volume_free(volume);
}

static void times_are_generous_or_impossible(void **state) {
    open_gl(state);
    ang_volume *volume = make_head();
    ang_transfer *transfer = make_bone();
    ang_scene scene = make_picture(volume, transfer);
    ang_planned generous = plan(gl, volume, &scene, NULL, NAN, 1e9);
    assert_true(generous.keeps_time);
    assert_string_equal(generous.missed, "");
    assert_int_equal(generous.stride, 1);
    assert_true(generous.error < 0.1);
    generous.method->destroy(generous.renderer);
    ang_planned impossible = plan(gl, volume, &scene, NULL, NAN, 1e-6);
    assert_false(impossible.keeps_time);
    assert_non_null(strstr(impossible.missed, "--max-time"));
    assert_int_equal(impossible.stride, 4);
    assert_close(impossible.step_voxels, 4, 1e-9);
    impossible.method->destroy(impossible.renderer);
    ang_transfer_free(transfer);
    ang_volume_free(volume);
}

/* What pixels between those drawn are off is measured where they are farthest from these, and counts. */
static void interpolated_pixels_are_judged(void **state) {
    open_gl(state);
    ang_volume *volume = make_head();
    ang_transfer *transfer = make_bone();
    ang_scene scene = make_picture(volume, transfer);
    ang_planned coarse = plan(gl, volume, &scene, NULL, NAN, 1e-6), whole = coarse;
    whole.stride = 1;
    ang_metrics between = compare(draw(coarse.method, coarse.renderer, &scene, &coarse),
                                  draw(coarse.method, coarse.renderer, &scene, &whole));
    assert_true(between.max > 10);
    assert_true(coarse.between.max <= between.max && coarse.between.max > 0.5 * between.max);
    assert_true(coarse.between.rms >= between.rms && coarse.between.rms < 3 * between.rms);

    ang_error_estimate estimate;
    ang_render_options options = options_of(&coarse);
    assert_true(ang_error_estimate_make(coarse.method, coarse.renderer, &scene, &options, &estimate, NULL, NULL));
    double rms_without = estimate.rms;
    ang_error_estimate_add(&estimate, &coarse.between);
    ang_metrics truth = true_error(volume, &scene, &coarse);
    print_message("stride 4, step 4: RMS %.3g estimated, %.3g without what is interpolated, truly %.3g\n", estimate.rms,
                  rms_without, truth.rms);
    assert_true(estimate.rms >= truth.rms && estimate.rms < 4 * truth.rms);
    assert_true(estimate.levels >= truth.max && estimate.p999 >= truth.p999);
    coarse.method->destroy(coarse.renderer);
    ang_transfer_free(transfer);
    ang_volume_free(volume);
}

/* Of wide or high, flat pictures a few strides are more than their height or width. */
static void flat_pictures_are_planned(void **state) {
    open_gl(state);
    ang_volume *volume = make_head();
    ang_transfer *transfer = make_bone();
    static const int sizes[][2] = {{2000, 10}, {400, 3}, {4096, 2}, {1, 700}};
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) {
        ang_scene scene = make_picture(volume, transfer);
        scene.width = sizes[i][0];
        scene.height = sizes[i][1];
        ang_planned exact = plan(gl, volume, &scene, &ang_method_envelope, 5, NAN);
        assert_true(exact.keeps_error);
        exact.method->destroy(exact.renderer);
        ang_planned fast = plan(gl, volume, &scene, &ang_method_envelope, NAN, 1e-6);
        assert_true(fast.between.max >= 0 && fast.between.max <= 255);
        ang_image image = draw(fast.method, fast.renderer, &scene, &fast);
        ang_image_clear(&image);
        fast.method->destroy(fast.renderer);
    }
    ang_scene scene = make_picture(volume, transfer);
    scene.width = 512;
    scene.height = 5;
    ang_planned exact = plan(gl, volume, &scene, NULL, 1e-5, NAN);
    assert_ptr_equal(exact.method, &ang_method_reference);
    exact.method->destroy(exact.renderer);
    ang_transfer_free(transfer);
    ang_volume_free(volume);
}

static double long_value(int x, int y, int z) { return 400 * sin(0.9 * z) + 100 * x - 80 * y; }

/* No step is taken whose error cannot be told, and what is within reach is named. */
static void steps_stay_within_what_can_be_told(void **state) {
    open_gl(state);
    static const double spacing[3] = {1, 1, 1};
    ang_volume *volume = make_volume(8, 8, 400, spacing, long_value);
    ang_transfer *transfer = make_bone();
    ang_scene scene = make_picture(volume, transfer);
    ang_view view = ang_view_default;
    view.zoom = 30;
    scene.camera = ang_camera_for(volume, &view);
    scene.width = scene.height = 12;
    ang_planned planned = plan(gl, volume, &scene, &ang_method_envelope, 0.005, NAN);
    print_message("%s\n", planned.missed);
    assert_false(planned.keeps_error);
    assert_true(isfinite(planned.error) && planned.error > 0.011);
    assert_non_null(strstr(planned.missed, "best within reach"));
    assert_true(planned.step_voxels / 4 * 32000 >= 2 * ang_volume_half_diagonal(volume) * (1 - 1e-9));
    planned.method->destroy(planned.renderer);
    ang_transfer_free(transfer);
    ang_volume_free(volume);
}

/* The largest error of an iso-surface is not known, which keeps no limit; nor is it 255. */
static void what_is_not_known_keeps_no_limit(void **state) {
    open_gl(state);
    ang_volume *volume = make_head();
    ang_transfer *transfer = make_bone();
    ang_scene scene = make_picture(volume, transfer);
    scene.mode = ANG_MODE_ISO;
    scene.iso_hu = 400;
    ang_planned asked = plan(gl, volume, &scene, &ang_method_envelope, 254, NAN);
    assert_false(asked.keeps_error);
    assert_true(isnan(asked.error));
    assert_non_null(strstr(asked.missed, "cannot be told"));
    assert_close(asked.step_voxels, ang_render_options_default.step_voxels, 1e-9);
    asked.method->destroy(asked.renderer);
    ang_planned any = plan(gl, volume, &scene, NULL, 255, NAN);
    assert_ptr_equal(any.method, &ang_method_reference);
    any.method->destroy(any.renderer);
    ang_transfer_free(transfer);
    ang_volume_free(volume);
}

/* Without OpenGL the rays on the processor have a step and an error as any others. */
static void the_processor_has_an_error_too(void **state) {
    (void)state;
    ang_volume *volume = make_head();
    ang_transfer *transfer = make_bone();
    ang_scene scene = make_picture(volume, transfer);
    ang_planned planned = plan(NULL, volume, &scene, &ang_method_cpu, 2, NAN);
    assert_true(planned.keeps_error && planned.error > 0 && planned.step_voxels > 0);
    assert_true(true_error(volume, &scene, &planned).max <= 2);
    planned.method->destroy(planned.renderer);
    ang_planned exact = plan(NULL, volume, &scene, NULL, 1e-5, NAN);
    assert_ptr_equal(exact.method, &ang_method_reference);
    exact.method->destroy(exact.renderer);
    ang_transfer_free(transfer);
    ang_volume_free(volume);
}

/* A plane in x and y is what lies between its pixels, and pixels that are drawn stay as they are. */
static void interpolation_is_bilinear(void **state) {
    (void)state;
    for (int stride = 1; stride <= 4; stride++) {
        ang_image whole, drawn;
        int side = (SIDE - 1) / stride + 1;
        assert_true(ang_image_create(&whole, SIDE, SIDE, NULL) && ang_image_create(&drawn, side, side, NULL));
        for (int i = 0; i < 4 * side * side; i++)
            drawn.rgba[i] = (float)(0.01 * stride * (i / 4 % side) + 0.003 * stride * (i / 4 / side) + 0.1 * (i % 4));
        ang_image_enlarge(&drawn, stride, 0, &whole);
        for (int i = 0; i < 4 * SIDE * SIDE; i++) {
            double x = i / 4 % SIDE, y = i / 4 / SIDE, last = stride * (side - 1);
            assert_close((double)whole.rgba[i], 0.01 * fmin(x, last) + 0.003 * fmin(y, last) + 0.1 * (i % 4), 1e-6);
        }
        ang_image_clear(&whole);
        ang_image_clear(&drawn);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(errors_are_kept),
        cmocka_unit_test(times_are_generous_or_impossible),
        cmocka_unit_test(interpolated_pixels_are_judged),
        cmocka_unit_test(flat_pictures_are_planned),
        cmocka_unit_test(steps_stay_within_what_can_be_told),
        cmocka_unit_test(what_is_not_known_keeps_no_limit),
        cmocka_unit_test(the_processor_has_an_error_too),
        cmocka_unit_test(interpolation_is_bilinear),
    };
    return cmocka_run_group_tests_name("any backend", tests, open_osmesa, close_backend);
}
