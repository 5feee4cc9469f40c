/* Presets between presets, against closed forms. */
#include "tests/core/fixtures.h"

#include "core/transfer/preset_blend.h"

#include <math.h>
#include <string.h>

static ang_preset make(const ang_transfer_point *points, size_t count, double unit, bool by_extinction) {
    ang_preset preset = {.name = (char *)"made",
                         .modality = (char *)"CT",
                         .description = (char *)"",
                         .version = 1,
                         .phong = ang_phong_default,
                         .iso_hu = NAN,
                         .window_centre = 100,
                         .window_width = 200};
    preset.transfer = ang_transfer_create(points, count, unit, by_extinction, NULL, NULL);
    assert_non_null(preset.transfer);
    return preset;
}

/* A ramp in red and, with a step at 150 HU, one in blue. */
static const ang_transfer_point red[] = {{100, {1, 0, 0}, 0}, {200, {1, 0, 0}, 0.8}};
static const ang_transfer_point blue[] = {
    {50, {0, 0, 1}, 0}, {150, {0, 0, 1}, 0}, {150, {0, 0, 1}, 0.4}, {300, {0, 0, 1}, 0.4}};

static void opacities_and_colours_go_over(void **state) {
    (void)state;
    ang_preset a = make(red, 2, 1, false), b = make(blue, 4, 1, false);
    for (int k = 1; k < 4; k++) {
        double t = k / 4.0;
        ang_preset *mixed = ang_preset_blend(&a, &b, t, NULL);
        assert_non_null(mixed);
        for (int i = 0; i < 400; i++) {
            double hu = i + 0.5, first = fmin(fmax((hu - 100) / 100, 0), 1) * 0.8, second = hu < 150 ? 0 : 0.4;
            assert_close(ang_transfer_opacity(mixed->transfer, hu), (1 - t) * first + t * second, 1e-12);
        }
        /* At 200 HU both show: weighted by opacity. At 149 only red does. */
        double colour[3], weight = t * 0.4 / ((1 - t) * 0.8 + t * 0.4);
        ang_transfer_colour(mixed->transfer, 200, colour);
        assert_close(colour[2], weight, 1e-12);
        assert_close(colour[0], 1 - weight, 1e-12);
        ang_transfer_colour(mixed->transfer, 149, colour);
        assert_true(colour[0] > 0.99);
        ang_preset_free(mixed);
    }
    ang_transfer_free(a.transfer);
    ang_transfer_free(b.transfer);
}

static void ends_are_the_presets(void **state) {
    (void)state;
    ang_preset a = make(red, 2, 1, false), b = make(blue, 4, 4, false);
    b.shading = ANG_SHADING_PHONG;
    b.window_width = 400;
    ang_preset *first = ang_preset_blend(&a, &b, 0, NULL), *last = ang_preset_blend(&a, &b, 1, NULL);
    assert_true(first && last);
    assert_true(ang_transfer_same(first->transfer, a.transfer) && ang_transfer_same(last->transfer, b.transfer));
    assert_int_equal(first->shading, ANG_SHADING_NONE);
    ang_preset_free(first);
    ang_preset_free(last);
    /* Near the ends nearly so: nothing jumps. */
    first = ang_preset_blend(&a, &b, 1e-9, NULL);
    last = ang_preset_blend(&a, &b, 1 - 1e-9, NULL);
    assert_true(first && last);
    for (int hu = 0; hu < 400; hu += 7) {
        assert_close(ang_transfer_extinction(first->transfer, hu), ang_transfer_extinction(a.transfer, hu), 1e-7);
        assert_close(ang_transfer_extinction(last->transfer, hu), ang_transfer_extinction(b.transfer, hu), 1e-7);
    }
    assert_int_equal(first->shading, ANG_SHADING_PHONG);
    assert_close(first->phong.ambient, 1, 1e-8); /* as if not shaded */
    assert_close(first->phong.specular, 0, 1e-8);
    ang_preset_free(first);
    ang_preset_free(last);
    ang_preset *middle = ang_preset_blend(&a, &b, 0.5, NULL);
    assert_non_null(middle);
    assert_close(middle->transfer->unit_distance, 2, 1e-12);
    assert_close(middle->window_width, 300, 1e-12);
    assert_close(middle->phong.diffuse, 0.5 * ang_phong_default.diffuse, 1e-12);
    assert_string_equal(middle->name, "made to made 50 %");
    ang_preset_free(middle);
    ang_transfer_free(a.transfer);
    ang_transfer_free(b.transfer);
}

static void extinctions_go_over(void **state) {
    (void)state;
    static const ang_transfer_point thin[] = {{0, {1, 1, 1}, 0.1}, {100, {1, 1, 1}, 0.3}};
    static const ang_transfer_point thick[] = {{0, {1, 1, 1}, 5}};
    ang_preset a = make(thin, 2, 1, true), b = make(thick, 1, 1, true), c = make(red, 2, 1, false);
    ang_preset *mixed = ang_preset_blend(&a, &b, 0.25, NULL);
    assert_non_null(mixed);
    assert_close(ang_transfer_extinction(mixed->transfer, 50), 0.75 * 0.2 + 0.25 * 5, 1e-12);
    ang_preset_free(mixed);
    mixed = ang_preset_blend(&a, &c, 0.5, NULL);
    assert_non_null(mixed);
    assert_false(mixed->transfer->by_extinction);
    assert_close(ang_transfer_opacity(mixed->transfer, 100), -0.5 * expm1(-0.3), 1e-12);
    ang_preset_free(mixed);
    c.mode = ANG_MODE_MIP;
    ang_error err = {0};
    assert_null(ang_preset_blend(&a, &c, 0.5, &err));
    assert_int_equal(err.code, ANG_USAGE);
    ang_transfer_free(a.transfer);
    ang_transfer_free(b.transfer);
    ang_transfer_free(c.transfer);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(opacities_and_colours_go_over),
        cmocka_unit_test(ends_are_the_presets),
        cmocka_unit_test(extinctions_go_over),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
