#include "core/scene/annotation.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

static void letters(double x, double y, double z, const char *wanted) {
    ang_letters made = ang_letters_make((ang_vec3){x, y, z});
    assert_string_equal(made.text, wanted);
}

/* LPS: +x is the patient's left, +y posterior, +z the head. */
static void letters_follow_the_axes(void **state) {
    (void)state;
    letters(1, 0, 0, "L");
    letters(-2, 0, 0, "R");
    letters(0, 1, 0, "P");
    letters(0, -1, 0, "A");
    letters(0, 0, 1, "H");
    letters(0, 0, -1, "F");
    letters(0, 0, 0, "");
    letters(NAN, 0, 1, "");
}

static void oblique_directions_have_more_letters(void **state) {
    (void)state;
    letters(0.5, -1, 0, "AL");
    letters(0.37, -1, 0, "A");
    letters(-1, -0.9, -0.8, "RAF");
    letters(-0.8, 1, 0.9, "PHR");
    letters(0.2, 0.5, -1, "FP");
}

static void lengths_are_round(void **state) {
    (void)state;
    static const double pairs[][2] = {{1, 1},     {1.99, 1},  {2, 2},   {4.9, 2}, {5, 5},       {9.99, 5},
                                      {10, 10},   {49, 20},   {50, 50}, {99, 50}, {100, 100},   {1000, 1000},
                                      {0.7, 0.5}, {0.2, 0.2}, {0, 0},   {-3, 0},  {INFINITY, 0}};
    for (size_t i = 0; i < sizeof pairs / sizeof *pairs; i++) {
        double made = ang_round_length(pairs[i][0]);
        if (fabs(made - pairs[i][1]) > 1e-12) fail_msg("%g gives %g instead of %g", pairs[i][0], made, pairs[i][1]);
    }
}

static ang_scene scene_from_front(void) {
    return (ang_scene){.width = 800,
                       .height = 400,
                       .camera = {.eye = {0, -500, 0},
                                  .forward = {0, 1, 0},
                                  .right = {1, 0, 0},
                                  .up = {0, 0, 1},
                                  .projection = ANG_PERSPECTIVE,
                                  .fov_deg = 30,
                                  .half_height = 100,
                                  .focus_mm = 500}};
}

static void perspective_measures_at_the_centre(void **state) {
    (void)state;
    ang_scene scene = scene_from_front();
    ang_annotation a = ang_annotation_make(&scene, "cta-head");
    double scale = 2 * 500 * tan(15 * M_PI / 180) / 400; /* 0.67 mm a pixel: a fifth of 800 pixels is 107 mm */
    assert_true(fabs(a.mm_per_pixel - scale) < 1e-12);
    assert_true(a.bar_mm == 100);
    assert_true(fabs(a.bar_pixels - 100 / scale) < 1e-9);
    assert_string_equal(a.bar_label, "100 mm at the centre");
    assert_string_equal(a.caption, "cta-head, dvr");
    /* From the front the patient's right is on the left. */
    assert_string_equal(a.left.text, "R");
    assert_string_equal(a.right.text, "L");
    assert_string_equal(a.top.text, "H");
    assert_string_equal(a.bottom.text, "F");
}

static void parallel_measures_everywhere(void **state) {
    (void)state;
    ang_scene scene = scene_from_front();
    scene.camera.projection = ANG_PARALLEL;
    scene.mode = ANG_MODE_MIP;
    ang_annotation a = ang_annotation_make(&scene, NULL);
    assert_true(fabs(a.mm_per_pixel - 0.5) < 1e-15);
    assert_true(a.bar_mm == 50);
    assert_true(fabs(a.bar_pixels - 100) < 1e-9);
    assert_string_equal(a.bar_label, "50 mm");
    assert_string_equal(a.caption, "mip");
}

static void no_scale_no_bar(void **state) {
    (void)state;
    ang_scene scene = scene_from_front();
    scene.camera.focus_mm = -1;
    ang_annotation a = ang_annotation_make(&scene, "x");
    assert_true(isnan(a.mm_per_pixel) && a.bar_mm == 0 && a.bar_label[0] == '\0');
}

static void errors_are_rounded_up(void **state) {
    (void)state;
    static const struct {
        double levels, rms, ms;
        const char *remark;
    } cases[] = {{2.0101, 1, 223.7, "error about 2.1 levels, 224 ms"},
                 {2.1, 1, 9, "error about 2.1 levels, 9 ms"},
                 {0, 0, 12345, "error about 0 levels, 12345 ms"},
                 {0.01234, NAN, 1, "error about 0.013 levels, 1 ms"},
                 {254.2, 9, 1, "error about 255 levels, 1 ms"},
                 {NAN, 0.301, 1, "RMS error 0.31 levels, 1 ms"},
                 {NAN, NAN, 1, "error not known, 1 ms"}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        ang_annotation annotation = {.remark = "old"};
        ang_annotation_add_error(&annotation, cases[i].levels, cases[i].rms, cases[i].ms);
        assert_string_equal(annotation.remark, cases[i].remark);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(letters_follow_the_axes),
        cmocka_unit_test(oblique_directions_have_more_letters),
        cmocka_unit_test(lengths_are_round),
        cmocka_unit_test(perspective_measures_at_the_centre),
        cmocka_unit_test(parallel_measures_everywhere),
        cmocka_unit_test(no_scale_no_bar),
        cmocka_unit_test(errors_are_rounded_up),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
