/* The tables against the exact transfer function. */
#include "core/transfer/prefix.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

static uint64_t random_state = 7;

static double random_unit(void) {
    random_state = random_state * 6364136223846793005u + 1442695040888963407u;
    return (double)(random_state >> 11) / 9007199254740992.0;
}

static ang_transfer *make(const ang_transfer_point *points, size_t count) {
    ang_error err;
    ang_transfer *transfer = ang_transfer_create(points, count, 1, false, NULL, &err);
    assert_non_null(transfer);
    return transfer;
}

static ang_transfer_tables *tabulate(const ang_transfer *transfer, double slope, double intercept, int minimum,
                                     int maximum, int limit) {
    ang_error err;
    ang_transfer_tables *tables =
        ang_tables_create(transfer, slope, intercept, (uint16_t)minimum, (uint16_t)maximum, limit, &err);
    assert_non_null(tables);
    assert_true(tables->intervals >= 1 && tables->intervals <= (limit ? limit : 32768));
    return tables;
}

/* What a renderer reads at a stored value. */
static void look_up(const ang_transfer_tables *t, double stored, double rgbk[4]) {
    double place = fmin(fmax((stored - t->first) * t->per_value, 0), t->intervals);
    int i = (int)fmin(floor(place), t->intervals - 1);
    double f = place - i;
    const float *l = &t->entries[8 * (size_t)i], *r = l + 4;
    for (int c = 0; c < 4; c++) rgbk[c] = (1 - f) * l[c] + f * r[c];
    if (l[3] == ANG_TABLE_OPAQUE && r[3] == ANG_TABLE_OPAQUE) rgbk[3] = INFINITY;
}

static ang_prefix *sum_up(const ang_transfer *transfer, const ang_transfer_tables *tables, double intercept) {
    ang_error err;
    ang_prefix *prefix = ang_prefix_create(tables, transfer, 1, intercept, &err);
    assert_non_null(prefix);
    assert_int_equal(prefix->intervals, tables->intervals);
    return prefix;
}

/* At the left end of interval i, in 1/mm * stored values: of colour channel 0 to 2, or 3: of the extinction. */
static double prefix_at(const ang_prefix *prefix, const ang_transfer_tables *tables, int i, int channel) {
    const float *p = &prefix->sums[8 * (size_t)i + channel];
    return ((double)p[0] + (double)p[4]) / tables->per_value;
}

static const ang_transfer_point angio[] = {{-1024, {0, 0, 0}, 0},           {150, {0.6, 0.05, 0.02}, 0},
                                           {220, {0.85, 0.15, 0.08}, 0.12}, {320, {1, 0.35, 0.2}, 0.45},
                                           {450, {1, 0.55, 0.35}, 0.45},    {600, {0.95, 0.85, 0.7}, 0.03},
                                           {1500, {1, 1, 0.95}, 0.15},      {3071, {1, 1, 1}, 0.5}};

static void smooth_functions_are_followed(void **state) {
    (void)state;
    ang_transfer *t = make(angio, 8);
    ang_transfer_tables *tables = tabulate(t, 1, -1024, 0, 4095, 0);
    assert_true(tables->per_value >= 1);
    for (int i = 0; i < 100000; i++) {
        double stored = 4095 * random_unit(), rgbk[4], colour[3];
        look_up(tables, stored, rgbk);
        double kappa = ang_transfer_extinction(t, stored - 1024);
        ang_transfer_colour(t, stored - 1024, colour);
        assert_float_equal(rgbk[3], kappa, 2e-5 * kappa + 2e-6);
        for (int c = 0; c < 3; c++) assert_float_equal(rgbk[c], colour[c], 1e-6);
    }
    ang_prefix *prefix = sum_up(t, tables, -1024);
    for (int i = 0; i <= tables->intervals; i++) {
        double hu = tables->first + i / tables->per_value - 1024;
        ang_transfer_integral k = ang_transfer_integrate_between(t, tables->first - 1024, hu);
        assert_float_equal(prefix_at(prefix, tables, i, 3), k.extinction, 1e-12 * k.extinction);
        for (int c = 0; c < 3; c++)
            assert_float_equal(prefix_at(prefix, tables, i, c), k.colour[c], 1e-12 * k.colour[c]);
    }
    ang_prefix_free(prefix);
    ang_tables_free(tables);
    ang_transfer_free(t);
}

static void range_in_use(void **state) {
    (void)state;
    const ang_transfer_point p[] = {
        {-500, {1, 0, 0}, 0}, {100, {1, 0, 0}, 0}, {200, {1, 1, 0}, 0.5}, {900, {1, 1, 0}, 0.5}};
    ang_transfer *t = make(p, 4);
    ang_transfer_tables *tables = tabulate(t, 1, -1000, 0, 4000, 0);
    assert_float_equal(tables->first, 1100, 0);
    assert_float_equal(tables->intervals / tables->per_value, 100, 0);
    ang_tables_free(tables);
    tables = tabulate(t, 1, -1000, 1150, 1180, 0);
    assert_float_equal(tables->first, 1150, 0);
    assert_float_equal(tables->intervals / tables->per_value, 30, 0);
    ang_tables_free(tables);
    double rgbk[4];
    tables = tabulate(t, 1, -1000, 2000, 3000, 0);
    assert_int_equal(tables->intervals, 1);
    look_up(tables, 2500, rgbk);
    assert_float_equal(rgbk[3], -log1p(-0.5), 1e-7);
    ang_tables_free(tables);
    tables = tabulate(t, 1, -1000, 7, 7, 0);
    look_up(tables, 7, rgbk);
    assert_float_equal(rgbk[3], 0, 0);
    ang_tables_free(tables);
    ang_transfer_free(t);
}

static void steps_are_exact(void **state) {
    (void)state;
    const ang_transfer_point p[] = {{0, {0, 0, 0}, 0.125}, {0, {1, 0, 0}, 0.5}, {40.25, {1, 0, 0}, 0.5},
                                    {40.25, {0, 1, 0}, 0}, {80, {0, 1, 0}, 0},  {80, {0, 1, 1}, 0.25}};
    ang_transfer *t = make(p, 6);
    const double slopes[] = {1, 2, 0.1, 0.7};
    for (int s = 0; s < 4; s++) {
        double slope = slopes[s], intercept = -64 * slope;
        ang_transfer_tables *tables = tabulate(t, slope, intercept, 0, 4000, 0);
        for (int v = 0; v < 4000; v++) {
            double rgbk[4], hu = slope * v + intercept;
            look_up(tables, v, rgbk);
            if (fabs(hu - 80) < 1e-9) continue;
            assert_float_equal(rgbk[3], ang_transfer_extinction(t, hu), 1e-6);
            for (int e = -1; e <= 1; e += 2) {
                double stored = v + e / 64.0;
                look_up(tables, stored, rgbk);
                double hu_aside = slope * stored + intercept;
                double away = fmin(fmin(fabs(hu_aside), fabs(hu_aside - 40.25)), fabs(hu_aside - 80)) / slope;
                if (away > 1.0 / 128) assert_float_equal(rgbk[3], ang_transfer_extinction(t, hu_aside), 1e-6);
            }
        }
        ang_tables_free(tables);
    }
    ang_tables_free(NULL);
    ang_transfer_free(t);
}

/* A step at the greatest value of the volume decides about that value. */
static void steps_at_the_ends(void **state) {
    (void)state;
    const ang_transfer_point p[] = {{10, {0, 0, 0}, 0}, {10, {0, 0, 0}, 0.5}, {20, {0, 0, 0}, 0.5}, {20, {0, 0, 0}, 0}};
    ang_transfer *t = make(p, 4);
    ang_transfer_tables *tables = tabulate(t, 1, 0, 10, 20, 0);
    double rgbk[4];
    look_up(tables, 10, rgbk);
    assert_float_equal(rgbk[3], -log1p(-0.5), 1e-7);
    look_up(tables, 20, rgbk);
    assert_float_equal(rgbk[3], 0, 0);
    look_up(tables, 20 - 1.0 / 1024, rgbk);
    assert_float_equal(rgbk[3], -log1p(-0.5), 1e-7);
    ang_tables_free(tables);
    tables = tabulate(t, 1, 0, 0, 40, 0);
    look_up(tables, 9.5, rgbk);
    assert_float_equal(rgbk[3], 0, 0);
    look_up(tables, 30, rgbk);
    assert_float_equal(rgbk[3], 0, 0);
    ang_tables_free(tables);
    ang_transfer_free(t);
}

static void plateaus_carry_the_flag(void **state) {
    (void)state;
    const ang_transfer_point p[] = {{0, {0, 0, 0}, 0},   {100, {0, 0, 0}, 1}, {200, {0, 0, 0}, 1},
                                    {220, {0, 0, 0}, 0}, {300, {0, 0, 0}, 0}, {300, {1, 0, 0}, 1}};
    ang_transfer *t = make(p, 6);
    ang_transfer_tables *tables = tabulate(t, 1, 0, 0, 1000, 0);
    double rgbk[4];
    for (int i = 0; i < 100000; i++) {
        double stored = 1000 * random_unit();
        look_up(tables, stored, rgbk);
        bool opaque = (stored >= 100 && stored < 200) || stored >= 300;
        assert_int_equal(isinf(rgbk[3]), opaque);
    }
    look_up(tables, 300, rgbk);
    assert_true(isinf(rgbk[3]));
    look_up(tables, 1000, rgbk);
    assert_true(isinf(rgbk[3]));
    ang_prefix *prefix = sum_up(t, tables, 0);
    assert_float_equal(prefix_at(prefix, tables, tables->intervals, 3), 120, 1e-9);
    /* For each interval, and for those outside the table, the nearest plateau at or above it and at or below it. */
    for (int i = -1; i <= tables->intervals; i++) {
        double left = tables->first + i / tables->per_value, middle = left + 0.5 / tables->per_value;
        const float *nearest = &prefix->plateaus[2 * (i + 1)];
        double above = tables->first + nearest[0] / tables->per_value;
        double below = tables->first + (nearest[1] + 1) / tables->per_value;
        if (middle >= 300 || (middle >= 100 && middle < 200)) {
            assert_float_equal(nearest[0], i, 0);
            assert_float_equal(nearest[1], i, 0);
            continue;
        }
        assert_float_equal(above, middle < 100 ? 100 : 300, 0);
        if (middle < 100) assert_true(below < tables->first - 1e6);
        if (middle > 200) assert_float_equal(below, 200, 0);
    }
    ang_prefix_free(prefix);
    ang_tables_free(tables);
    ang_transfer_free(t);

    const ang_transfer_point narrow[] = {{0, {0, 0, 0}, 0},      {5000.2, {0, 0, 0}, 0}, {5000.2, {0, 1, 0}, 1},
                                         {5000.4, {0, 1, 0}, 1}, {5000.4, {0, 0, 0}, 0}, {60000, {0, 0, 0}, 0.01}};
    t = make(narrow, 6);
    for (int limit = 1; limit <= 65536; limit *= 4) {
        tables = tabulate(t, 1, 0, 0, 65535, limit);
        look_up(tables, 5000.3, rgbk);
        assert_true(isinf(rgbk[3]));
        ang_tables_free(tables);
    }
    ang_transfer_free(t);
}

/* Exact integral of what the entries give. */
static double table_integral(const ang_transfer_tables *t) {
    double sum = 0;
    for (int i = 0; i < t->intervals; i++) {
        double l = t->entries[8 * (size_t)i + 3], r = t->entries[8 * (size_t)i + 7];
        assert_true(isfinite(l) && isfinite(r) && l >= 0 && r >= 0);
        if (l < ANG_TABLE_OPAQUE) sum += 0.5 * (l + r) / t->per_value;
    }
    return sum;
}

static void peaks_keep_their_integral(void **state) {
    (void)state;
    const double places[] = {500, 500.5, 500.3, 500.001};
    for (int i = 0; i < 4; i++)
        for (int limit = 3; limit < 65536; limit *= 5) {
            double x = places[i];
            const ang_transfer_point p[] = {{x - 100, {1, 0, 0}, 0}, {x, {1, 0, 0}, 1}, {x + 0.75, {1, 0, 0}, 0}};
            ang_transfer *t = make(p, 3);
            ang_transfer_tables *tables = tabulate(t, 1, 0, 0, 4000, limit);
            double exact = ang_transfer_integrate(t, 4000).extinction;
            assert_float_equal(exact, 100.75, 1e-9);
            ang_prefix *prefix = sum_up(t, tables, 0);
            assert_float_equal(prefix_at(prefix, tables, tables->intervals, 3), exact, 1e-9);
            ang_prefix_free(prefix);
            if (tables->per_value >= 1) assert_float_equal(table_integral(tables), exact, 0.02 * exact);
            ang_tables_free(tables);
            ang_transfer_free(t);
        }
}

/* A value range far narrower than an interval still shows with its exact integral. */
static void spikes_do_not_vanish(void **state) {
    (void)state;
    const double at[] = {30001.25, 30000.9, 30000.0, 30001.9};
    for (int i = 0; i < 4; i++) {
        double x = at[i];
        const ang_transfer_point p[] = {{0, {0, 0, 0}, 0},          {x, {1, 0, 0}, 0},        {x, {1, 0, 0}, 0.5},
                                        {x + 0.25, {1, 0, 0}, 0.5}, {x + 0.25, {0, 0, 1}, 0}, {65535, {1, 1, 1}, 0}};
        ang_transfer *t = make(p, 6);
        ang_transfer_tables *tables = tabulate(t, 1, 0, 0, 65535, 0);
        double exact = 0.25 * -log1p(-0.5);
        ang_prefix *prefix = sum_up(t, tables, 0);
        assert_float_equal(prefix_at(prefix, tables, tables->intervals, 3), exact, 1e-9);
        ang_prefix_free(prefix);
        assert_float_equal(table_integral(tables), exact, 1e-6);
        ang_tables_free(tables);
        ang_transfer_free(t);
    }
}

static ang_transfer *random_transfer(double low, double high) {
    ang_transfer_point p[12];
    size_t count = 0, wanted = 1 + (size_t)(8 * random_unit());
    while (count < wanted) {
        double hu = low + (high - low) * random_unit(), kind = random_unit();
        if (kind < 0.5) hu = floor(hu);
        double a = random_unit() < 0.5 ? 0 : random_unit() < 0.9 ? random_unit() : 1;
        p[count++] = (ang_transfer_point){hu, {random_unit(), random_unit(), random_unit()}, a};
        if (kind < 0.3) p[count++] = (ang_transfer_point){hu, {0, 1, 0}, random_unit() < 0.5 ? 0 : random_unit()};
        if (kind > 0.8) p[count++] = (ang_transfer_point){hu + 1, {0, 1, 0}, 0};
    }
    return make(p, count);
}

static void visible_is_exact(void **state) {
    (void)state;
    const double slopes[] = {1, 0.5, 2, 0.1};
    for (int i = 0; i < 60; i++) {
        double slope = slopes[i % 4], intercept = i % 3 ? -1024 : 0;
        ang_transfer *t = random_transfer(intercept, intercept + 60 * slope);
        ang_transfer_tables *tables = tabulate(t, slope, intercept, 3, 50, 0);
        for (int low = 0; low <= 64; low++)
            for (int high = low; high <= 64; high++) {
                bool exact = ang_transfer_visible(t, slope * low + intercept, slope * high + intercept);
                assert_int_equal(ang_tables_visible(tables, (uint16_t)low, (uint16_t)high), exact);
            }
        assert_int_equal(ang_tables_visible(tables, 0, 65535),
                         ang_transfer_visible(t, intercept, slope * 65535 + intercept));
        assert_int_equal(ang_tables_visible(tables, 65535, 65535),
                         ang_transfer_visible(t, slope * 65535 + intercept, slope * 65535 + intercept));
        ang_tables_free(tables);
        ang_transfer_free(t);
    }
}

/* Whatever the points, the limit and the range: nothing negative, not finite, or visible where all is transparent. */
/* Where intervals are wider than a stored value the interpolant spreads: nothing that it shows may be skipped. */
static void coarse_tables_show_no_more_than_they_say(void **state) {
    (void)state;
    int hidden = 0;
    for (int k = 0; k < 60; k++) {
        double start = 100 + floor(60000 * random_unit()), wide = 1 + floor(3000 * random_unit());
        double opacity = k % 3 ? 0.5 : 1;
        ang_transfer_point points[] = {{10, {0, 0.5, 0}, 0},
                                       {start, {0, 0, 0}, 0},
                                       {k % 2 ? start : start + 7, {1, 1, 1}, opacity},
                                       {start + 7 + wide, {1, 1, 1}, opacity},
                                       {start + 8 + wide, {0, 0, 0}, 0},
                                       {65000, {1, 0, 0}, 0}};
        ang_transfer *t = make(points, 6);
        ang_transfer_tables *tables = tabulate(t, 1, 0, 0, 65535, k & 4 ? 9000 : 30000);
        assert_true(tables->per_value < 1);
        for (int i = 0; i < 400; i++) {
            int low = (int)fmin(fmax(start + (i % 2 ? 0 : wide) + 60 * (random_unit() - 0.5), 0), 65535);
            int high = (int)fmin(low + 6 * random_unit(), 65535);
            bool shows = false;
            for (double v = low; v <= high; v += 0.25) {
                double rgbk[4];
                look_up(tables, v, rgbk);
                shows = shows || rgbk[3] > 0;
            }
            if (shows) assert_true(ang_tables_shows(tables, (uint16_t)low, (uint16_t)high));
            hidden += shows && !ang_tables_visible(tables, (uint16_t)low, (uint16_t)high);
        }
        ang_tables_free(tables);
        ang_transfer_free(t);
    }
    assert_true(hidden > 0); /* or the question would be idle */
}

static void any_function_gives_sound_tables(void **state) {
    (void)state;
    for (int i = 0; i < 300; i++) {
        ang_transfer *t = random_transfer(-20, 120);
        int a = (int)(120 * random_unit()), b = (int)(120 * random_unit());
        int limit = i % 3 ? 1 + (int)(400 * random_unit()) : 0, minimum = a < b ? a : b, maximum = a < b ? b : a;
        ang_transfer_tables *tables = tabulate(t, 1, 0, minimum, maximum, limit);
        for (int e = 0; e < tables->intervals * 8; e++) {
            float value = tables->entries[e];
            assert_true(isfinite(value) && value >= 0 && (e % 4 == 3 || value <= 1));
        }
        ang_prefix *prefix = sum_up(t, tables, 0);
        for (int k = 0; k < tables->intervals; k++)
            for (int c = 0; c < 4; c++) {
                double here = prefix_at(prefix, tables, k, c), next = prefix_at(prefix, tables, k + 1, c);
                assert_true(next >= here && isfinite(next));
                if (c == 3)
                    assert_true(next - here <= prefix->greatest / tables->per_value * (1 + 1e-9) + 1e-12 * next);
            }
        ang_prefix_free(prefix);
        if (tables->per_value >= 1)
            for (int v = minimum; v <= maximum; v++) {
                double rgbk[4], exact = ang_transfer_extinction(t, v);
                look_up(tables, v, rgbk);
                if (exact > 0) continue;
                double reach = 2 / tables->per_value;
                if (!ang_transfer_visible(t, v - reach, v + reach)) assert_float_equal(rgbk[3], 0, 0);
            }
        ang_tables_free(tables);
        ang_transfer_free(t);
    }
}

static void bad_slopes_are_refused(void **state) {
    (void)state;
    ang_transfer *t = make(angio, 8);
    ang_error err;
    assert_null(ang_tables_create(t, 0, 0, 0, 1, 0, &err));
    assert_int_equal(err.code, ANG_USAGE);
    assert_null(ang_tables_create(t, NAN, 0, 0, 1, 0, &err));
    ang_transfer_free(t);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(smooth_functions_are_followed),
        cmocka_unit_test(range_in_use),
        cmocka_unit_test(steps_are_exact),
        cmocka_unit_test(steps_at_the_ends),
        cmocka_unit_test(plateaus_carry_the_flag),
        cmocka_unit_test(peaks_keep_their_integral),
        cmocka_unit_test(spikes_do_not_vanish),
        cmocka_unit_test(visible_is_exact),
        cmocka_unit_test(coarse_tables_show_no_more_than_they_say),
        cmocka_unit_test(any_function_gives_sound_tables),
        cmocka_unit_test(bad_slopes_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
