#include "core/error/metrics.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

static ang_image flat(int width, int height, float value) {
    ang_image image;
    ang_error err;
    assert_true(ang_image_create(&image, width, height, &err));
    for (size_t i = 0; i < 4 * (size_t)width * (size_t)height; i++) image.rgba[i] = value;
    return image;
}

static ang_metrics compare(const ang_image *a, const ang_image *b, bool quantised) {
    ang_metrics m;
    ang_error err = {0};
    if (!ang_metrics_compute(a, b, quantised, &m, &err)) fail_msg("%s", err.message);
    return m;
}

static void near(double value, double wanted, double tolerance) {
    if (!(fabs(value - wanted) <= tolerance)) fail_msg("%.12g instead of %.12g", value, wanted);
}

static void equal_pictures(void **state) {
    (void)state;
    ang_image a = flat(32, 16, 0.4F);
    ang_metrics m = compare(&a, &a, false);
    assert_true(m.max == 0 && m.rms == 0 && m.p999 == 0 && m.flipped == 0);
    assert_true(isinf(m.psnr) && m.psnr > 0);
#ifdef ANG_WITH_OPENCV
    near(m.ssim, 1, 1e-12);
#else
    assert_true(isnan(m.ssim));
#endif
    ang_image_clear(&a);
}

/* One channel of one pixel in 100 differs by d levels: rms = d / 10, mean square over channels = d^2 / 400. */
static void one_pixel(void **state) {
    (void)state;
    ang_image a = flat(10, 10, 0), b = flat(10, 10, 0);
    b.rgba[4 * 37 + 2] = 0.25F;
    ang_metrics m = compare(&a, &b, false);
    double d = 0.25 * 255;
    near(m.max, d, 1e-12);
    near(m.rms, d / 10, 1e-12);
    near(m.p999, d, 1e-12); /* 99.9 % of 100 pixels are all of them */
    near(m.psnr, 10 * log10(255 * 255 / (d * d / 400)), 1e-9);
    near(m.flipped, 0.01, 1e-15);
    assert_true(isnan(m.ssim));
    ang_image_clear(&a);
    ang_image_clear(&b);
}

/* Differences 0, 1, ..., 1999 (times a quarter of a thousandth): at least 1998 of 2000 must not exceed p999. */
static void percentile_is_the_nearest_rank(void **state) {
    (void)state;
    ang_image a = flat(50, 40, 0), b = flat(50, 40, 0);
    for (size_t i = 0; i < 2000; i++) b.rgba[4 * (i * 1237 % 2000) + 1] = (float)i / 4096;
    ang_metrics m = compare(&a, &b, false);
    near(m.p999, 255.0 * 1997 / 4096, 1e-4);
    near(m.max, 255.0 * 1999 / 4096, 1e-9);
    double over = 1999 - floor(16.0 / 255 * 4096);
    near(m.flipped, over / 2000, 1e-12);
    ang_image_clear(&a);
    ang_image_clear(&b);
}

static void clipped_and_largest_channel(void **state) {
    (void)state;
    ang_image a = flat(4, 4, 1.5F), b = flat(4, 4, 1);
    assert_true(compare(&a, &b, false).max == 0);
    ang_image c = flat(4, 4, -3), d = flat(4, 4, 0);
    assert_true(compare(&c, &d, false).max == 0);
    d.rgba[0] = 0.1F;
    d.rgba[3] = 0.3F;
    near(compare(&c, &d, false).max, 0.3 * 255, 1e-5);
    d.rgba[5] = NAN;
    assert_true(compare(&c, &d, false).max == 255);
    assert_true(compare(&d, &d, false).max == 255);
    ang_image_clear(&a);
    ang_image_clear(&b);
    ang_image_clear(&c);
    ang_image_clear(&d);
}

static void quantised_rounds_first(void **state) {
    (void)state;
    ang_image a = flat(12, 12, 100.4F / 255), b = flat(12, 12, 99.6F / 255), c = flat(12, 12, 100.6F / 255);
    assert_true(compare(&a, &b, true).max == 0);
    assert_true(compare(&a, &c, true).max == 1);
    near(compare(&a, &c, false).max, 0.2, 1e-4);
    ang_image_clear(&a);
    ang_image_clear(&b);
    ang_image_clear(&c);
}

static void sizes_must_agree(void **state) {
    (void)state;
    ang_image a = flat(4, 4, 0), b = flat(4, 5, 0);
    ang_metrics m;
    ang_error err = {0};
    assert_false(ang_metrics_compute(&a, &b, false, &m, &err));
    assert_int_equal(err.code, ANG_USAGE);
    ang_image_clear(&a);
    ang_image_clear(&b);
}

/* Two flat pictures: variances vanish, SSIM = (2 x y + c1) / (x^2 + y^2 + c1). */
static void similarity_of_flat_pictures(void **state) {
    (void)state;
#ifdef ANG_WITH_OPENCV
    ang_image a = flat(20, 15, 0.25F), b = flat(20, 15, 0.5F);
    double x = 0.25 * 255, y = 0.5 * 255, c1 = 2.55 * 2.55;
    near(compare(&a, &b, false).ssim, (2 * x * y + c1) / (x * x + y * y + c1), 1e-6);
    ang_image_clear(&a);
    ang_image_clear(&b);
#endif
}

/* A negative: the structure term turns sign. Symmetric in its arguments too. */
static void similarity_of_a_negative(void **state) {
    (void)state;
#ifdef ANG_WITH_OPENCV
    ang_image a = flat(64, 64, 0), b = flat(64, 64, 0);
    for (size_t i = 0; i < 64 * 64; i++) {
        float value = (i / 2 + i / 128) % 2 ? 0.9F : 0.1F;
        for (size_t c = 0; c < 3; c++) {
            a.rgba[4 * i + c] = value;
            b.rgba[4 * i + c] = 1 - value;
        }
    }
    double there = compare(&a, &b, false).ssim, back = compare(&b, &a, false).ssim;
    assert_true(there < -0.9);
    near(there, back, 1e-12);
    ang_image_clear(&a);
    ang_image_clear(&b);
#endif
}

static void heat_is_black_where_equal(void **state) {
    (void)state;
    ang_image a = flat(8, 8, 0), b = flat(8, 8, 0), heat;
    b.rgba[4 * 9] = 0.5F;
    b.rgba[4 * 10] = 0.25F;
    double scale = 0;
    ang_error err = {0};
#ifdef ANG_WITH_OPENCV
    assert_true(ang_metrics_heat(&a, &b, false, &heat, &scale, &err));
    near(scale, 127.5, 1e-4);
    assert_true(heat.rgba[0] == 0 && heat.rgba[1] == 0 && heat.rgba[2] == 0 && heat.rgba[3] == 1);
    assert_true(heat.rgba[4 * 9] > 0.9F && heat.rgba[4 * 9 + 1] > 0.9F); /* red and green: the map ends in yellow */
    assert_true(heat.rgba[4 * 10] < heat.rgba[4 * 9] && heat.rgba[4 * 10] > 0);
    ang_image_clear(&heat);
    assert_true(ang_metrics_heat(&a, &a, false, &heat, &scale, &err));
    assert_true(scale == 0 && heat.rgba[0] == 0);
    ang_image_clear(&heat);
#else
    assert_false(ang_metrics_heat(&a, &b, false, &heat, &scale, &err));
    assert_int_equal(err.code, ANG_USAGE);
#endif
    ang_image_clear(&a);
    ang_image_clear(&b);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(equal_pictures),
        cmocka_unit_test(one_pixel),
        cmocka_unit_test(percentile_is_the_nearest_rank),
        cmocka_unit_test(clipped_and_largest_channel),
        cmocka_unit_test(quantised_rounds_first),
        cmocka_unit_test(sizes_must_agree),
        cmocka_unit_test(similarity_of_flat_pictures),
        cmocka_unit_test(similarity_of_a_negative),
        cmocka_unit_test(heat_is_black_where_equal),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
