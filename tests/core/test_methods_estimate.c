/* How wrong a picture says it may be, beside how wrong it is. */
#include "tests/core/backends.h"
#include "tests/core/judged.h"

enum { LOTS = 6, SIZE = 24 };

static ang_scene scene_of(const ang_volume *volume, const ang_transfer *transfer) {
    ang_scene scene = ang_scene_default(volume);
    ang_view view = ang_view_default;
    assert_true(ang_view_parse("33,21,10", &view, NULL));
    scene.camera = ang_camera_for(volume, &view);
    scene.width = scene.height = SIZE;
    scene.transfer = transfer;
    return scene;
}

/* measure_estimate does the same with more scenes, real volumes among them. */
static void judge_volume(ang_gl *gl, const ang_volume *volume, bool cut, uint64_t *lot, judged *out) {
    static const char *const kinds[] = {"smooth", "step", "spike", "plateau"};
    ang_renderer *truth = ang_method_reference.create(NULL, volume, &ang_render_options_default, NULL);
    for (int i = 0; i < LOTS; i++) {
        ang_error err = {0};
        drawn d = draw_lot(volume, SIZE, cut, lot);
        if (cut) d.scene.objects = &d.objects;
        ang_transfer *transfer = judged_transfer(kinds[i % 4], volume);
        d.scene.transfer = transfer;
        const ang_method *method = judged_methods[d.method];
        ang_renderer *renderer = method->create(gl, volume, &d.options, &err);
        if (!renderer || !judge(method, renderer, truth, &d.scene, &d.options, &out[i], &err))
            fail_msg("%s: %s", method->name, err.message);
        print_message("%-10s %-7s step %-5g estimate %.3f, truth %.3f levels\n", method->name, kinds[i % 4],
                      d.options.step_voxels, out[i].estimate.levels, out[i].truth.max);
        method->destroy(renderer);
        ang_transfer_free(transfer);
        ang_objects_clear(&d.objects);
    }
    ang_method_reference.destroy(truth);
}

static void judge_volumes(ang_gl *gl, bool cut) {
    judged rows[2 * LOTS];
    uint64_t lot = 20;
    for (int i = 0; i < 20; i++) random_unit(&lot);
    ang_volume *waves = judged_volume(waves_value), *ball = judged_volume(ball_value);
    judge_volume(gl, waves, cut, &lot, rows);
    judge_volume(gl, ball, cut, &lot, rows + LOTS);
    ang_volume_free(waves);
    ang_volume_free(ball);
    verdict v = judge_all(rows, 2 * LOTS, 0, 1);
    print_message("not below in %.0f %%, median %.2f\n", 100 * v.not_below, v.median);
    assert_true(v.not_below >= 0.95);
    assert_true(v.median <= 10);
}

static void estimates_are_seldom_below_the_truth_and_not_far_above(void **state) {
    open_gl(state);
    judge_volumes(gl, false);
}

static void nor_are_they_where_opaque_objects_lie_behind(void **state) {
    open_gl(state);
    judge_volumes(gl, true);
}

static ang_error_estimate estimate_of(const ang_method *method, ang_gl *gl, const ang_volume *volume,
                                      const ang_scene *scene, const ang_render_options *options) {
    ang_error err = {0};
    ang_error_estimate estimate;
    ang_renderer *renderer = method->create(gl, volume, options, &err);
    if (!renderer || !ang_error_estimate_make(method, renderer, scene, options, &estimate, NULL, &err))
        fail_msg("%s: %s", method->name, err.message);
    method->destroy(renderer);
    return estimate;
}

static void the_reference_errs_by_nothing(void **state) {
    (void)state;
    ang_volume *volume = judged_volume(ball_value);
    ang_transfer *transfer = judged_transfer("smooth", volume);
    ang_scene scene = scene_of(volume, transfer);
    ang_error_estimate e = estimate_of(&ang_method_reference, NULL, volume, &scene, &ang_render_options_default);
    assert_true(e.levels == 0 && e.step == 0 && e.termination == 0 && e.filtering == 0 && e.ms == 0);
    assert_int_equal(e.pixels, SIZE * SIZE);
    assert_null(e.why);
    assert_close(ang_error_termination_bound(&ang_method_reference, &scene, 0.9), 0, 0);
    ang_transfer_free(transfer);
    ang_volume_free(volume);
}

/* A homogeneous medium has no error of the step; a ray that ends at opacity a leaves what comes behind, here known. */
static void termination_is_bounded_by_what_is_left(void **state) {
    open_gl(state);
    ang_volume *volume = judged_volume(waves_value);
    ang_transfer *transfer = constant_transfer(0.4, 1, 0.5, 0.25);
    ang_scene scene = scene_of(volume, transfer);
    ang_render_options options = ang_render_options_default;
    options.termination = 0.9;
    ang_error_estimate e = estimate_of(&ang_method_singlepass, gl, volume, &scene, &options);
    ang_renderer *truth = ang_method_reference.create(NULL, volume, &options, NULL);
    ang_renderer *renderer = ang_method_singlepass.create(gl, volume, &options, NULL);
    judged j;
    assert_true(judge(&ang_method_singlepass, renderer, truth, &scene, &options, &j, NULL));
    double bound = ang_error_termination_bound(&ang_method_singlepass, &scene, 0.9);
    assert_close(bound, 25.5, 1e-12);
    assert_true(j.truth.max > 10); /* 1 - a = 0.1 and a sample of at most 0.15 */
    assert_true(e.termination >= j.truth.max && e.termination <= bound);
    ang_method_reference.destroy(truth);
    ang_method_singlepass.destroy(renderer);
    ang_transfer_free(transfer);
    ang_volume_free(volume);
}

/* A plane behind a medium makes every pixel opaque: that rays ended before it shows all the same. */
static void termination_is_seen_before_opaque_objects(void **state) {
    open_gl(state);
    ang_volume *volume = judged_volume(waves_value);
    ang_transfer *transfer = constant_transfer(0.4, 1, 0.5, 0.25);
    ang_scene scene = scene_of(volume, transfer);
    ang_objects objects = {0};
    assert_true(ang_objects_add_cut_planes(&objects, volume, "coronal:90%", NULL));
    scene.objects = &objects;
    ang_render_options options = ang_render_options_default;
    options.termination = 0.7;
    ang_renderer *truth = ang_method_reference.create(NULL, volume, &options, NULL);
    ang_renderer *renderer = ang_method_singlepass.create(gl, volume, &options, NULL);
    judged j;
    assert_true(judge(&ang_method_singlepass, renderer, truth, &scene, &options, &j, NULL));
    assert_true(j.truth.max > 20);
    assert_true(j.estimate.termination > 20 && j.estimate.levels >= j.truth.max);
    assert_true(j.estimate.rms >= j.truth.rms);
    ang_method_reference.destroy(truth);
    ang_method_singlepass.destroy(renderer);
    ang_objects_clear(&objects);
    ang_transfer_free(transfer);
    ang_volume_free(volume);
}

static void what_cannot_be_estimated_is_not(void **state) {
    open_gl(state);
    ang_volume *volume = judged_volume(ball_value);
    ang_transfer *transfer = judged_transfer("smooth", volume);
    ang_scene scene = scene_of(volume, transfer);
    scene.mode = ANG_MODE_ISO;
    scene.iso_hu = 100;
    ang_error_estimate e = estimate_of(&ang_method_envelope, gl, volume, &scene, &ang_render_options_default);
    assert_true(isnan(e.levels) && e.why);
    assert_true(isfinite(e.rms) && isfinite(e.p999) && e.flipped < 0.01);

    scene.mode = ANG_MODE_MIP;
    scene.width = scene.height = 4;
    ang_render_options finest = ang_render_options_default;
    finest.step_voxels = 1e-4;
    e = estimate_of(&ang_method_singlepass, gl, volume, &scene, &finest);
    assert_true(isnan(e.levels) && e.why);
    ang_transfer_free(transfer);
    ang_volume_free(volume);
}

static void the_pixels_looked_at_are_a_grid(void **state) {
    (void)state;
    static const int sizes[][2] = {{512, 512}, {1920, 1080}, {40, 30}, {1, 1}, {4096, 2}, {100, 100}};
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) {
        ang_scene scene = {.width = sizes[i][0], .height = sizes[i][1]}, subset = ang_error_subset(&scene);
        int pixels = subset.width * subset.height, all = scene.width * scene.height;
        assert_true(pixels >= 1 && pixels <= 10000);
        assert_true(pixels >= (all < 1000 ? all : 1000));
    }
}

static void what_is_not_known_stays_so(void **state) {
    (void)state;
    assert_true(isnan(ang_error_capped((double)NAN)));
    assert_close(ang_error_capped(300), 255, 0);
    assert_close(ang_error_capped(3), 3, 0);
    ang_error_estimate e = {.levels = (double)NAN, .rms = 3, .p999 = 200, .flipped = 0.5};
    ang_metrics more = {.max = 10, .rms = 4, .p999 = 100, .flipped = 0.25};
    ang_error_estimate_add(&e, &more);
    assert_true(isnan(e.levels));
    assert_close(e.rms, 7, 0);
    assert_close(e.p999, 255, 0);
    assert_close(e.flipped, 0.75, 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(estimates_are_seldom_below_the_truth_and_not_far_above),
        cmocka_unit_test(nor_are_they_where_opaque_objects_lie_behind),
        cmocka_unit_test(termination_is_bounded_by_what_is_left),
        cmocka_unit_test(termination_is_seen_before_opaque_objects),
        cmocka_unit_test(what_cannot_be_estimated_is_not),
    };
    const struct CMUnitTest plain[] = {
        cmocka_unit_test(the_reference_errs_by_nothing),
        cmocka_unit_test(the_pixels_looked_at_are_a_grid),
        cmocka_unit_test(what_is_not_known_stays_so),
    };
    return run_on_backends(tests) + cmocka_run_group_tests(plain, NULL, NULL);
}
