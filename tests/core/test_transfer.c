/* The transfer function against quadrature and brute force. */
#include "core/transfer/transfer.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static uint64_t random_state = 1;

static double random_unit(void) {
    random_state = random_state * 6364136223846793005u + 1442695040888963407u;
    return (double)(random_state >> 11) / 9007199254740992.0;
}

static ang_transfer *make(const ang_transfer_point *points, size_t count, double unit) {
    ang_error err;
    ang_transfer *transfer = ang_transfer_create(points, count, unit, false, NULL, &err);
    assert_non_null(transfer);
    return transfer;
}

/* Extinction and weight of a segment in long double, with the complement of opacity kept exact. */
typedef struct segment {
    long double a0, a1;
    long double c0, c1;
} segment;

/* Tanh-sinh quadrature over t in 0..1, which bears the logarithm at opacity 1 [Takahasi & Mori 1974]. */
static long double integrate(segment s, bool colour) {
    long double sum = 0, h = 1.0L / 64;
    for (int k = -64 * 5; k <= 64 * 5; k++) {
        long double x = (long double)k * h, e = expl(-3.14159265358979323846264L * sinhl(fabsl(x)));
        long double near = e / (1 + e), far = 1 / (1 + e);
        long double t = x < 0 ? near : far, r = x < 0 ? far : near;
        long double w = 3.14159265358979323846264L * coshl(x) * e / ((1 + e) * (1 + e));
        long double a = s.a0 * r + s.a1 * t, u = (1 - s.a0) * r + (1 - s.a1) * t;
        long double kappa = a < 0.5L ? -log1pl(-a) : -logl(u);
        if (u > 0 && w > 0) sum += h * w * kappa * (colour ? s.c0 * r + s.c1 * t : 1);
    }
    return sum;
}

static void check_relative(double value, long double expected, double tolerance) {
    long double error = fabsl(value - expected);
    if (!(error <= tolerance * fabsl(expected) + 1e-300L)) {
        print_message("%.17g against %.17Lg\n", value, expected);
        fail();
    }
}

static void integrals_match_quadrature(void **state) {
    (void)state;
    for (int i = 0; i < 1600; i++) {
        double a0 = random_unit(), a1 = random_unit();
        switch (i % 8) {
        case 0:
            a0 = 0;
            break;
        case 1:
            a1 = 1;
            break;
        case 2:
            a1 = fmin(a0 + 1e-9 * a1, 1);
            break;
        case 3:
            a0 *= 1e-12, a1 *= 1e-12;
            break;
        case 4:
            a0 = 1 - 1e-10 * a0, a1 = 1 - 1e-10 * a1;
            break;
        case 5:
            a0 = 1, a1 = 0;
            break;
        case 6:
            a1 = a0 + (1 - a0) * (1 - pow(10, -12 * a1));
            break;
        default:
            break;
        }
        ang_transfer_point p[2] = {{100, {random_unit(), 0, 1}, a0}, {300, {random_unit(), 1, 1}, a1}};
        ang_transfer *transfer = make(p, 2, 2);
        segment s = {a0, a1, 0, 0};
        ang_transfer_integral whole = ang_transfer_integrate(transfer, 300);
        check_relative(whole.extinction, 100 * integrate(s, false), 1e-13);
        check_relative(whole.colour[2], 100 * integrate(s, false), 1e-13);
        for (int c = 0; c < 2; c++) {
            s.c0 = p[0].colour[c], s.c1 = p[1].colour[c];
            check_relative(whole.colour[c], 100 * integrate(s, true), 1e-13);
        }
        double middle = 100 + 200 * random_unit();
        ang_transfer_integral left = ang_transfer_integrate_between(transfer, 100, middle);
        ang_transfer_integral right = ang_transfer_integrate_between(transfer, 300, middle);
        check_relative(left.extinction - right.extinction, whole.extinction, 1e-13);
        check_relative(ang_transfer_integrate(transfer, middle).extinction, left.extinction, 1e-13);
        ang_transfer_free(transfer);
    }
}

static void integrals_of_extinction(void **state) {
    (void)state;
    ang_transfer_point p[] = {{0, {0, 0, 0}, 2}, {10, {1, 0, 0}, 2}, {10, {0, 1, 0}, 5}, {40, {0, 0, 1}, 0}};
    ang_error err;
    ang_transfer *t = ang_transfer_create(p, 4, 1, true, NULL, &err);
    assert_non_null(t);
    ang_transfer_integral k = ang_transfer_integrate(t, 100);
    assert_float_equal(k.extinction, 20 + 75, 1e-12);
    assert_float_equal(k.colour[0], 10, 1e-12);
    assert_float_equal(k.colour[1], 50, 1e-12);
    assert_float_equal(ang_transfer_integrate(t, -5).extinction, -10, 1e-12);
    assert_float_equal(ang_transfer_extinction(t, 10), 5, 0);
    assert_float_equal(ang_transfer_opacity(t, 10), 1 - exp(-5), 1e-15);
    assert_float_equal(ang_transfer_integrate_between(t, 5, 25).extinction, 10 + 56.25, 1e-12);
    ang_transfer_free(t);
}

static void values_and_steps(void **state) {
    (void)state;
    ang_transfer_point p[] = {{0, {0, 0, 0}, 0}, {100, {1, 0, 0}, 0.5}, {100, {0, 1, 0}, 0.25}, {200, {0, 1, 1}, 1}};
    ang_transfer *t = make(p, 4, 2);
    assert_float_equal(ang_transfer_opacity(t, 100), 0.25, 0);
    assert_float_equal(ang_transfer_opacity(t, nextafter(100, 0)), 0.5, 1e-12);
    assert_float_equal(ang_transfer_extinction(t, 50), -log1p(-0.25) / 2, 1e-15);
    assert_true(isinf(ang_transfer_extinction(t, 200)));
    assert_true(isinf(ang_transfer_extinction(t, INFINITY)));
    assert_float_equal(ang_transfer_extinction(t, -INFINITY), 0, 0);
    double c[3];
    ang_transfer_colour(t, 150, c);
    assert_float_equal(c[2], 0.5, 0);
    ang_error err;
    ang_transfer *s = ang_transfer_shifted(t, 10.5, &err);
    assert_float_equal(ang_transfer_opacity(s, 110.5), 0.25, 0);
    ang_transfer_free(s);
    ang_transfer_free(t);
}

static void plateaus_are_opaque(void **state) {
    (void)state;
    ang_transfer_point p[] = {{0, {0, 0, 0}, 0},   {100, {0, 0, 0}, 1}, {150, {0, 0, 0}, 0}, {200, {0, 0, 0}, 1},
                              {300, {0, 0, 0}, 1}, {300, {0, 0, 0}, 0}, {400, {0, 0, 0}, 1}};
    ang_transfer *t = make(p, 7, 1);
    assert_false(ang_transfer_opaque_between(t, -50, 199));
    assert_true(isfinite(ang_transfer_integrate(t, 1000).extinction));
    assert_float_equal(ang_transfer_integrate_between(t, 200, 300).extinction, 0, 0);
    assert_true(ang_transfer_opaque_between(t, 199, 200));
    assert_true(ang_transfer_opaque_between(t, 200, 200));
    assert_true(ang_transfer_opaque_between(t, 250, 260));
    assert_false(ang_transfer_opaque_between(t, 300, 399));
    assert_true(ang_transfer_opaque_between(t, 400, 400));
    assert_true(ang_transfer_opaque_between(t, 500, INFINITY));
    assert_true(ang_transfer_opaque_between(t, -1, 500));
    ang_transfer_free(t);

    ang_transfer_point descent[] = {{0, {0, 0, 0}, 1}, {50, {0, 0, 0}, 0}};
    t = make(descent, 2, 1);
    assert_true(ang_transfer_opaque_between(t, -5, -4));
    assert_true(ang_transfer_opaque_between(t, 0, 0));
    assert_false(ang_transfer_opaque_between(t, 1e-9, 100));
    assert_float_equal(ang_transfer_integrate_between(t, -100, 50).extinction, 50, 1e-11);
    ang_transfer_free(t);
}

/* Some points at one HU, some transparent, some opaque, on a coarse grid so that queries meet them exactly. */
static ang_transfer *random_transfer(void) {
    ang_transfer_point p[9];
    size_t count = 1 + (size_t)(random_unit() * 8);
    for (size_t i = 0; i < count; i++) {
        double a = random_unit();
        p[i] = (ang_transfer_point){floor(10 * random_unit()), {0, 0, 0}, a < 0.6 ? 0 : a < 0.9 ? a : 1};
    }
    ang_error err;
    ang_transfer *t = ang_transfer_create(p, count, 1, false, NULL, &err);
    assert_non_null(t);
    return t;
}

static void visible_matches_brute_force(void **state) {
    (void)state;
    for (int i = 0; i < 2000; i++) {
        ang_transfer *t = random_transfer();
        for (int low = -2; low <= 22; low++)
            for (int high = low; high <= 22; high++) {
                bool visible = false, opaque = false;
                for (int k = 8 * low; k <= 8 * high; k++) {
                    double hu = k / 16.0;
                    visible |= ang_transfer_extinction(t, hu) > 0;
                    bool one = ang_transfer_opacity(t, hu) == 1;
                    opaque |= one && (ang_transfer_opacity(t, hu + 1.0 / 64) == 1 ||
                                      ang_transfer_opacity(t, hu - 1.0 / 64) == 1);
                }
                assert_int_equal(ang_transfer_visible(t, low / 2.0, high / 2.0), visible);
                assert_int_equal(ang_transfer_opaque_between(t, low / 2.0, high / 2.0), opaque);
            }
        ang_transfer_free(t);
    }
    ang_transfer_point spike[] = {
        {0, {0, 0, 0}, 0}, {99.5, {0, 0, 0}, 0}, {100, {0, 0, 0}, 0.5}, {100.5, {0, 0, 0}, 0}};
    ang_transfer *t = make(spike, 4, 1);
    assert_false(ang_transfer_visible(t, -1e9, 99.5));
    assert_true(ang_transfer_visible(t, -1e9, nextafter(99.5, 100)));
    assert_true(ang_transfer_visible(t, 100, 100));
    assert_false(ang_transfer_visible(t, 100.5, 1e9));
    assert_false(ang_transfer_visible(t, 1, 0));
    ang_transfer_free(t);
}

static void bad_points_are_refused(void **state) {
    (void)state;
    const ang_transfer_point good = {0, {0, 0, 0}, 0};
    struct {
        ang_transfer_point point;
        const char *words;
    } bad[] = {
        {{NAN, {0, 0, 0}, 0}, "point 1"},   {{INFINITY, {0, 0, 0}, 0}, "HU"},
        {{1e10, {0, 0, 0}, 0}, "HU"},       {{5, {0, -0.1, 0}, 0}, "green"},
        {{5, {0, 0, NAN}, 0}, "blue"},      {{5, {0, 0, 0}, 1.0001}, "opacity 1.0001"},
        {{5, {0, 0, 0}, -1e-9}, "opacity"}, {{5, {0, 0, 0}, NAN}, "opacity"},
    };
    ang_error err;
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        ang_transfer_point p[2] = {good, bad[i].point};
        assert_null(ang_transfer_create(p, 2, 1, false, NULL, &err));
        assert_int_equal(err.code, ANG_USAGE);
        assert_non_null(strstr(err.message, bad[i].words));
    }
    ang_transfer_point p[1] = {{0, {0, 0, 0}, INFINITY}};
    assert_null(ang_transfer_create(p, 1, 1, true, NULL, &err));
    assert_null(ang_transfer_create(&good, 0, 1, false, NULL, &err));
    assert_null(ang_transfer_create(&good, 1, 0, false, NULL, &err));
    assert_null(ang_transfer_create(&good, 1, NAN, false, NULL, NULL));
}

static void points_are_sorted_and_merged(void **state) {
    (void)state;
    ang_transfer_point p[] = {{10, {0, 0, 0}, 0.1}, {10, {0, 0, 0}, 0.2}, {10, {0, 0, 0}, 0.3}, {0, {0, 0, 0}, 0.4}};
    ang_notes notes = {0};
    ang_error err;
    ang_transfer *t = ang_transfer_create(p, 4, 1, false, &notes, &err);
    assert_non_null(t);
    assert_int_equal(t->count, 3);
    assert_float_equal(t->points[0].opacity, 0.4, 0);
    assert_float_equal(t->points[1].opacity, 0.1, 0);
    assert_float_equal(t->points[2].opacity, 0.3, 0);
    assert_int_equal(notes.count, 2);
    ang_notes_clear(&notes);
    ang_transfer_free(t);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(integrals_match_quadrature),
        cmocka_unit_test(integrals_of_extinction),
        cmocka_unit_test(values_and_steps),
        cmocka_unit_test(plateaus_are_opaque),
        cmocka_unit_test(visible_matches_brute_force),
        cmocka_unit_test(bad_points_are_refused),
        cmocka_unit_test(points_are_sorted_and_merged),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
