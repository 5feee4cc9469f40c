/* Fits and fronts against closed forms. */
#include "core/error/convergence.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

static const double steps[] = {2, 1, 0.5, 0.25, 0.125, 1. / 16, 1. / 32};
enum { count = sizeof steps / sizeof *steps };

static void near(double value, double wanted, double tolerance) {
    if (!(fabs(value - wanted) <= tolerance)) fail_msg("%.12g instead of %.12g", value, wanted);
}

static void powers_are_found_exactly(void **state) {
    (void)state;
    static const double orders[] = {0.5, 1, 1.8, 2, 4};
    for (size_t k = 0; k < sizeof orders / sizeof *orders; k++) {
        double error[count];
        for (int i = 0; i < count; i++) error[i] = 3 * pow(steps[i], orders[k]);
        ang_order fit = ang_order_fit(steps, error, count, 0);
        near(fit.order, orders[k], 1e-12);
        near(fit.factor, 3, 1e-11);
        near(fit.spread, 0, 1e-6);
        assert_int_equal(fit.used, count);
        near(fit.coarsest, 2, 0);
        near(fit.finest, 1. / 32, 0);
    }
}

/* By hand: the points (0, 0), (1, 1), (2, 3) in units of log 2 have slope 3/2, and the residuals 1/6, -1/3, 1/6 give
 * the standard error sqrt((1/6) / 1 / 2). */
static void a_line_through_scattered_points(void **state) {
    (void)state;
    double step[] = {4, 2, 1}, error[] = {8, 2, 1};
    ang_order fit = ang_order_fit(step, error, 3, 0);
    near(fit.order, 1.5, 1e-12);
    near(fit.spread, sqrt(1. / 12), 1e-12);
    near(fit.factor, pow(2, -1. / 6), 1e-12);
}

static void floors_are_left_out(void **state) {
    (void)state;
    double error[count];
    for (int i = 0; i < count; i++) error[i] = steps[i] * steps[i] + (i > 4 ? 0.02 : 0);
    ang_order fit = ang_order_fit(steps, error, count, 0);
    near(fit.order, 2, 1e-12);
    assert_int_equal(fit.used, 5);
    for (int i = 0; i < count; i++) error[i] = fmax(steps[i] * steps[i], 0.1);
    fit = ang_order_fit(steps, error, count, 0.1);
    near(fit.order, 2, 1e-12);
    assert_int_equal(fit.used, 3);
}

static void too_little_gives_no_order(void **state) {
    (void)state;
    double zero[count] = {0}, one[count] = {1, NAN}, two[] = {4, 1};
    assert_true(isnan(ang_order_fit(steps, zero, count, 0).order));
    assert_true(isnan(ang_order_fit(steps, one, count, 0).order));
    assert_true(isnan(ang_order_fit(steps, NULL, 0, 0).order));
    ang_order fit = ang_order_fit(steps, two, 2, 0);
    near(fit.order, 2, 1e-12);
    assert_true(isnan(fit.spread));
}

static double expected(const ang_transfer_point *points, size_t points_count, double low, double high) {
    ang_error err = {0};
    ang_transfer *transfer = ang_transfer_create(points, points_count, 1, false, NULL, &err);
    assert_non_null(transfer);
    ang_scene scene = {.mode = ANG_MODE_DVR, .transfer = transfer};
    double least = ang_order_expected(&scene, low, high, false).least;
    ang_transfer_free(transfer);
    return least;
}

static void the_transfer_function_decides_the_order(void **state) {
    (void)state;
    static const ang_transfer_point ramp[] = {{.hu = 0, .opacity = 0}, {.hu = 100, .opacity = 0.5}};
    static const ang_transfer_point tent[] = {
        {.hu = 0, .opacity = 0}, {.hu = 50, .opacity = 0.5}, {.hu = 100, .opacity = 0}};
    static const ang_transfer_point step[] = {{.hu = 50, .opacity = 0}, {.hu = 50, .opacity = 0.5}};
    static const ang_transfer_point plateau[] = {{.hu = 0, .opacity = 0}, {.hu = 50, .opacity = 1}};
    near(expected(ramp, 2, 0, 100), 2, 0);
    near(expected(tent, 3, 0, 100), 1.8, 0);
    near(expected(tent, 3, 0, 40), 2, 0); /* the kink lies beyond the values */
    near(expected(step, 2, 0, 100), 1, 0);
    near(expected(plateau, 2, 0, 100), 1, 0);
    ang_transfer *sudden = ang_transfer_create(step, 2, 1, false, NULL, NULL);
    ang_scene scene = {.mode = ANG_MODE_DVR, .transfer = sudden};
    near(ang_order_expected(&scene, 0, 100, true).most, 2, 0);
    ang_transfer_free(sudden);
}

static void the_front_is_what_nothing_beats(void **state) {
    (void)state;
    double cost[] = {1, 2, 3, 2, 4, 5, 1, NAN, 0.5};
    double error[] = {8, 4, 2, 5, 2, 1, 8, 0, INFINITY};
    /* 3 is beaten by 1, 4 by 2; 0 and 6 are equal; what has no cost or error does not count. */
    static const bool wanted[] = {true, true, true, false, false, true, true, false, false};
    bool front[9];
    ang_pareto_front(cost, error, 9, 0, front);
    for (int i = 0; i < 9; i++)
        if (front[i] != wanted[i]) fail_msg("setting %d is%s on the front", i, front[i] ? "" : " not");
}

/* Half a percent more exact for twice the time is nothing within 1 %; two percent are something. */
static void hardly_more_exact_is_not_better(void **state) {
    (void)state;
    double cost[] = {1, 2, 4, 4}, error[] = {1, 0.995, 0.98, 0.979};
    bool front[4];
    ang_pareto_front(cost, error, 4, 0.01, front);
    assert_true(front[0] && !front[1] && !front[2] && front[3]);
    ang_pareto_front(cost, error, 4, 0, front);
    assert_true(front[0] && front[1] && !front[2] && front[3]);
}

/* On a quarter circle about (1, 1) every point is on the front; points moved away from the axes by a factor are not. */
static void a_convex_front_is_whole(void **state) {
    (void)state;
    enum { points = 40 };
    double cost[2 * points], error[2 * points];
    bool front[2 * points];
    for (int i = 0; i < points; i++) {
        double angle = (i + 0.5) / points * M_PI / 2;
        cost[i] = 1 - cos(angle);
        error[i] = 1 - sin(angle);
        cost[points + i] = 1.01 * cost[i];
        error[points + i] = 1.01 * error[i];
    }
    ang_pareto_front(cost, error, 2 * points, 0, front);
    for (int i = 0; i < points; i++) assert_true(front[i] && !front[points + i]);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(powers_are_found_exactly),
        cmocka_unit_test(a_line_through_scattered_points),
        cmocka_unit_test(floors_are_left_out),
        cmocka_unit_test(too_little_gives_no_order),
        cmocka_unit_test(the_transfer_function_decides_the_order),
        cmocka_unit_test(the_front_is_what_nothing_beats),
        cmocka_unit_test(hardly_more_exact_is_not_better),
        cmocka_unit_test(a_convex_front_is_whole),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
