/* The battery can go red, in the cases that should and in no others, and is green here. */
#include "tests/core/fixtures.h"

#include "core/selfcheck/selfcheck.h"

#include <string.h>

/* Broken methods: the reference's picture, spoiled. */
static ang_renderer *create(ang_gl *gl, const ang_volume *volume, const ang_render_options *options, ang_error *err) {
    return ang_method_reference.create(gl, volume, options, err);
}
static void destroy(ang_renderer *renderer) { ang_method_reference.destroy(renderer); }

typedef void spoil_picture(const ang_render_options *options, ang_image *image);

static bool draw(ang_renderer *renderer, const ang_scene *scene, const ang_render_options *options, ang_image *image,
                 ang_frame_stats *stats, const ang_progress *progress, ang_error *err, spoil_picture *spoil) {
    if (!ang_method_reference.render(renderer, scene, options, image, stats, progress, err)) return false;
    spoil(options, image);
    if (stats) stats->samples = stats->fragments = 0;
    return true;
}

static void leave(const ang_render_options *options, ang_image *image) { (void)options, (void)image; }

static void halve(const ang_render_options *options, ang_image *image) {
    (void)options;
    for (int i = 0; i < 4 * image->width * image->height; i++) image->rgba[i] *= 0.5F;
}

static void punch_hole(const ang_render_options *options, ang_image *image) {
    (void)options;
    int w = image->width, h = image->height;
    for (int y = 2 * h / 5; y < 3 * h / 5; y++)
        for (int x = 2 * w / 5; x < 3 * w / 5; x++) memset(image->rgba + 4 * (x + w * y), 0, 4 * sizeof(float));
}

static void spoil_one(const ang_render_options *options, ang_image *image) {
    (void)options;
    image->rgba[4 * (image->width / 2) + 1] = NAN;
}

static void shift_a_pixel(const ang_render_options *options, ang_image *image) {
    (void)options;
    size_t pixel = 4 * sizeof(float), count = (size_t)image->width * (size_t)image->height;
    memmove(image->rgba + 4, image->rgba, pixel * (count - 1));
}

/* Seams between bricks, losses by skipping and by ending rays. */
static void obey_badly(const ang_render_options *options, ang_image *image) {
    float *pixel = image->rgba + 4 * (image->width / 2 + image->width * (image->height / 2));
    if (options->bricks[0] > 1) pixel[3] += 1e-3F;
    if (options->no_skip && !options->bricks[0]) pixel[3] += 1e-3F;
    if (options->termination > 0.99 && options->termination < 1) pixel[3] *= 0.99F;
}

/* Wrong in the last digits where it should integrate over steps. */
static void integrate_badly(const ang_render_options *options, ang_image *image) {
    if (options->classification != ANG_CLASSIFY_PREFIX) return;
    for (int i = 0; i < 4 * image->width * image->height; i++) image->rgba[i] *= 0.999F;
}

static void show_nothing(const ang_render_options *options, ang_image *image) {
    (void)options;
    memset(image->rgba, 0, 4 * sizeof(float) * (size_t)image->width * (size_t)image->height);
}

#define BROKEN(name_, spoil, takes_)                                                                                   \
    static bool render_##spoil(ang_renderer *renderer, const ang_scene *scene, const ang_render_options *options,      \
                               ang_image *image, ang_frame_stats *stats, const ang_progress *progress,                 \
                               ang_error *err) {                                                                       \
        return draw(renderer, scene, options, image, stats, progress, err, spoil);                                     \
    }                                                                                                                  \
    static const ang_method method_##spoil = {                                                                         \
        .name = name_, .takes = takes_, .create = create, .render = render_##spoil, .destroy = destroy}

BROKEN("right", leave, ANG_TAKES_BRICKS | ANG_TAKES_NO_SKIP | ANG_TAKES_TERMINATION);
BROKEN("half", halve, 0);
BROKEN("hole", punch_hole, 0);
BROKEN("nan", spoil_one, 0);
BROKEN("shifted", shift_a_pixel, 0);
BROKEN("careless", obey_badly, ANG_TAKES_BRICKS | ANG_TAKES_NO_SKIP | ANG_TAKES_TERMINATION);

BROKEN("inexact", integrate_badly, ANG_TAKES_CLASSIFICATION);
BROKEN("blind", show_nothing, 0);

static bool miss_and_say_so(ang_renderer *renderer, const ang_scene *scene, const ang_render_options *options,
                            ang_image *image, ang_frame_stats *stats, const ang_progress *progress, ang_error *err) {
    bool done = draw(renderer, scene, options, image, stats, progress, err, show_nothing);
    stats->note = "a peak may be missed";
    return done;
}
static const ang_method method_honest = {
    .name = "honest", .create = create, .render = miss_and_say_so, .destroy = destroy};

static bool fail_to_draw(ang_renderer *renderer, const ang_scene *scene, const ang_render_options *options,
                         ang_image *image, ang_frame_stats *stats, const ang_progress *progress, ang_error *err) {
    (void)renderer, (void)scene, (void)options, (void)image, (void)stats, (void)progress;
    return ang_fail(err, ANG_GL, "the driver is on holiday");
}
static const ang_method method_failing = {
    .name = "failing", .create = create, .render = fail_to_draw, .destroy = destroy};

enum { cases = 28 };

/* The red cases of one method, in the order of their numbers; what does not apply goes to `unless`. */
static void check(const ang_method *method, const int *red, int count, const int *unless, int unless_count) {
    const ang_method *const methods[] = {method, NULL};
    ang_selfcheck_options options = {.methods = methods, .backend = ANG_BACKEND_NONE};
    ang_selfcheck_report report;
    ang_error err = {0};
    if (!ang_selfcheck_run(&options, &report, NULL, &err)) fail_msg("%s", err.message);
    assert_int_equal(report.count, cases);
    bool wrong = false;
    for (int r = 0; r < report.count; r++) {
        const ang_selfcheck_result *result = &report.results[r];
        ang_verdict expected = ANG_VERDICT_OK;
        for (int i = 0; i < count; i++)
            if (red[i] == result->which->number) expected = ANG_VERDICT_RED;
        for (int i = 0; i < unless_count; i++)
            if (unless[i] == result->which->number) expected = ANG_VERDICT_NOT_APPLICABLE;
        if (result->verdict == expected) continue;
        print_message("%s, case %d is %s: %s = %g (%g to %g) %s\n", method->name, result->which->number,
                      ang_verdict_name(result->verdict), result->worst.what, result->worst.value, result->worst.low,
                      result->worst.high, result->note);
        wrong = true;
    }
    assert_false(wrong);
    assert_int_equal(report.red, count);
    ang_selfcheck_report_clear(&report);
}
#define LENGTH(array) ((int)(sizeof(array) / sizeof *(array)))
static const int options_alone[] = {17, 18, 19};

static void a_right_method_is_green(void **state) {
    (void)state;
    check(&method_leave, NULL, 0, NULL, 0);
}

/* Comparisons of a method with itself stay green; so do silhouettes and directions of normals. */
static void half_the_opacity_is_red(void **state) {
    (void)state;
    static const int red[] = {1, 2, 3, 4, 5, 6, 8, 10, 11, 13, 15, 16, 20, 22, 24, 25, 27, 28};
    check(&method_halve, red, LENGTH(red), options_alone, LENGTH(options_alone));
}

static void a_hole_is_red(void **state) {
    (void)state;
    static const int red[] = {1, 2, 3, 4, 5, 6, 8, 9, 10, 11, 13, 15, 16, 20, 22, 24, 25, 27, 28};
    check(&method_punch_hole, red, LENGTH(red), options_alone, LENGTH(options_alone));
}

static void one_value_that_is_no_number_is_red_wherever_something_is_drawn(void **state) {
    (void)state;
    static const int red[] = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 13, 14, 15, 16, 20, 21, 22, 24, 25, 26, 27, 28};
    check(&method_spoil_one, red, LENGTH(red), options_alone, LENGTH(options_alone));
}

static void a_careless_method_is_red_where_options_are_compared(void **state) {
    (void)state;
    check(&method_obey_badly, options_alone, LENGTH(options_alone), NULL, 0);
}

static void each_classification_is_checked(void **state) {
    (void)state;
    static const int red[] = {3, 4, 5, 6};
    check(&method_integrate_badly, red, LENGTH(red), options_alone, LENGTH(options_alone));
}

static ang_verdict verdict_of(const ang_method *method, int number, ang_selfcheck_result *out) {
    const ang_method *const methods[] = {method, NULL};
    ang_selfcheck_options options = {
        .methods = methods, .backend = ANG_BACKEND_NONE, .cases = &number, .case_count = 1};
    ang_selfcheck_report report;
    assert_true(ang_selfcheck_run(&options, &report, NULL, NULL));
    assert_int_equal(report.count, 1);
    ang_verdict verdict = report.results[0].verdict;
    *out = report.results[0];
    ang_selfcheck_report_clear(&report);
    return verdict;
}

/* A picture moved by one pixel still looks right. */
static void a_shift_by_a_pixel_is_red(void **state) {
    (void)state;
    ang_selfcheck_result result;
    static const int red[] = {8, 11, 13, 15, 25};
    for (int i = 0; i < LENGTH(red); i++)
        if (verdict_of(&method_shift_a_pixel, red[i], &result) != ANG_VERDICT_RED) fail_msg("case %d", red[i]);
    assert_int_equal(verdict_of(&method_shift_a_pixel, 26, &result), ANG_VERDICT_OK);
}

static void a_missed_spike_is_red_unless_it_is_said(void **state) {
    (void)state;
    ang_selfcheck_result result;
    assert_int_equal(verdict_of(&method_show_nothing, 5, &result), ANG_VERDICT_RED);
    assert_int_equal(verdict_of(&method_honest, 5, &result), ANG_VERDICT_OK);
    assert_int_equal(verdict_of(&method_honest, 4, &result), ANG_VERDICT_RED);
}

static void a_method_that_fails_is_red_and_says_why(void **state) {
    (void)state;
    ang_selfcheck_result result;
    assert_int_equal(verdict_of(&method_failing, 1, &result), ANG_VERDICT_RED);
    assert_string_equal(result.note, "the driver is on holiday");
    assert_int_equal(result.worst.what[0], 0);
}

static void what_does_not_apply_is_asked_of_the_method(void **state) {
    (void)state;
    int count;
    const ang_selfcheck_case *all = ang_selfcheck_cases(&count);
    assert_int_equal(count, cases);
    for (int c = 0; c < count; c++) {
        assert_int_equal(all[c].number, c + 1);
        assert_non_null(strstr(all[c].means, "."));
        assert_null(ang_selfcheck_unless(&all[c], &method_leave));
        if (all[c].takes) assert_non_null(ang_selfcheck_unless(&all[c], &method_halve));
    }
    assert_non_null(ang_selfcheck_unless(&all[26], &ang_method_reference));
    assert_null(ang_selfcheck_unless(&all[26], &ang_method_singlepass));
}

static void values_are_judged_by_their_range(void **state) {
    (void)state;
    assert_true(ang_measure_holds(&(ang_measure){.value = 0, .low = 0, .high = 0}));
    assert_false(ang_measure_holds(&(ang_measure){.value = 1e-30, .low = 0, .high = 0}));
    assert_false(ang_measure_holds(&(ang_measure){.value = NAN, .low = 0, .high = 1}));
    assert_false(ang_measure_holds(&(ang_measure){.value = 1.89, .low = 1.9, .high = 2.1}));
    assert_true(ang_measure_holds(&(ang_measure){.value = 3, .low = 0.9, .high = INFINITY}));
}

static bool stop_later(void *context, const char *what, double fraction) {
    assert_string_equal(what, "checking");
    assert_true(fraction >= 0 && fraction <= 1);
    return --*(int *)context > 0;
}

static void interruption_is_heard_between_and_within_cases(void **state) {
    (void)state;
    for (int calls = 1; calls < 60; calls += 29) {
        int left = calls;
        ang_progress progress = {stop_later, &left};
        ang_selfcheck_options options = {.backend = ANG_BACKEND_NONE};
        ang_selfcheck_report report;
        ang_error err = {0};
        assert_false(ang_selfcheck_run(&options, &report, &progress, &err));
        assert_int_equal(err.code, ANG_INTERRUPTED);
        ang_selfcheck_report_clear(&report);
    }
}

/* Every method on OSMesa. */
static void this_machine_is_green(void **state) {
    (void)state;
    ang_selfcheck_options options = {.backend = ANG_BACKEND_OSMESA};
    ang_selfcheck_report report;
    assert_true(ang_selfcheck_run(&options, &report, NULL, NULL));
    bool wrong = false;
    for (int r = 0; r < report.count; r++) {
        const ang_selfcheck_result *result = &report.results[r];
        if (result->verdict != ANG_VERDICT_RED) continue;
        print_message("case %d, %s is %s: %s = %g (%g to %g) %s\n", result->which->number,
                      result->method ? result->method->name : "no method", ang_verdict_name(result->verdict),
                      result->worst.what, result->worst.value, result->worst.low, result->worst.high, result->note);
        wrong = true;
    }
    print_message("%d results in %.1f s\n", report.count, report.ms / 1000);
#ifdef ANG_WITH_OSMESA
    assert_true(report.count > 4 * 20);
#endif
    assert_false(wrong);
    ang_selfcheck_report_clear(&report);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_right_method_is_green),
        cmocka_unit_test(half_the_opacity_is_red),
        cmocka_unit_test(a_hole_is_red),
        cmocka_unit_test(one_value_that_is_no_number_is_red_wherever_something_is_drawn),
        cmocka_unit_test(a_careless_method_is_red_where_options_are_compared),
        cmocka_unit_test(each_classification_is_checked),
        cmocka_unit_test(a_shift_by_a_pixel_is_red),
        cmocka_unit_test(a_missed_spike_is_red_unless_it_is_said),
        cmocka_unit_test(a_method_that_fails_is_red_and_says_why),
        cmocka_unit_test(what_does_not_apply_is_asked_of_the_method),
        cmocka_unit_test(values_are_judged_by_their_range),
        cmocka_unit_test(interruption_is_heard_between_and_within_cases),
        cmocka_unit_test(this_machine_is_green),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
