/* Means of light and extinction between two values, read as core/transfer/means.h says, against closed forms. */
#include "tests/core/fixtures.h"

#include "core/transfer/means.h"

#include <string.h>

enum { LIGHT = 3, EXTINCTION = 3 }; /* channels of light; the channel behind them */

/* Integrals over stored values, which are HU here, from `from` to `to`. */
typedef struct closed_form {
    double from, to, light[LIGHT], extinction;
} closed_form;

static ang_transfer_tables *make_tables(const ang_transfer_point *points, size_t count, bool by_extinction) {
    ang_transfer *transfer = ang_transfer_create(points, count, 1, by_extinction, NULL, NULL);
    assert_non_null(transfer);
    ang_transfer_tables *tables = ang_tables_create(transfer, 1, 0, 0, 1000, 0, NULL);
    assert_non_null(tables);
    ang_transfer_free(transfer);
    return tables;
}

static const float *record_at(const ang_means *means, int interval) {
    int outside = interval < -1 ? -1 : interval > means->intervals ? means->intervals : interval;
    return means->records + (size_t)(outside + 1) * ANG_MEANS_RECORD;
}

/* The integral from the left end of the table, in 1/mm * intervals. */
static double integral_up_to(const ang_means *means, double x, int channel) {
    int interval = (int)floor(fmin(fmax(x, -1), means->intervals)), whole;
    const float *record = record_at(means, interval);
    memcpy(&whole, record + channel, sizeof whole);
    double share = x - fmax(interval, 0), left = (double)record[4 + channel], half = (double)record[8 + channel];
    return whole * means->unit + share * (left + share * half);
}

static void check(const ang_transfer_point *points, size_t count, const closed_form *expected, size_t forms,
                  double tolerance) {
    ang_transfer_tables *tables = make_tables(points, count, true);
    ang_means *means = ang_means_create(tables, NULL);
    assert_non_null(means);
    assert_int_equal(means->intervals, tables->intervals);
    assert_null(means->plateaus);
    for (size_t f = 0; f < forms; f++) {
        double from = (expected[f].from - tables->first) * tables->per_value;
        double to = (expected[f].to - tables->first) * tables->per_value;
        for (int c = 0; c <= EXTINCTION; c++) {
            double sum = (integral_up_to(means, to, c) - integral_up_to(means, from, c)) / tables->per_value;
            double right = c < LIGHT ? expected[f].light[c] : expected[f].extinction;
            if (!(fabs(sum - right) <= tolerance))
                fail_msg("from %g to %g, channel %d: %.12g, not %.12g", expected[f].from, expected[f].to, c, sum,
                         right);
        }
    }
    ang_means_free(means);
    ang_tables_free(tables);
}

static void a_constant_is_itself(void **state) {
    (void)state;
    static const ang_transfer_point points[] = {{.hu = 500, .colour = {0.25, 0.5, 1}, .opacity = 0.2}};
    static const closed_form expected[] = {{-40, 3, {0.05 * 43, 0.1 * 43, 0.2 * 43}, 0.2 * 43},
                                           {100.3, 100.4, {0.005, 0.01, 0.02}, 0.02},
                                           {20, 2000, {0.05 * 1980, 0.1 * 1980, 0.2 * 1980}, 0.2 * 1980}};
    check(points, 1, expected, sizeof expected / sizeof *expected, 1e-5);
}

/* Colour and extinction rise by a sixteenth and a twentieth a value, so that a line from one end of an interval to the
 * other would be off by 5e-4 in its integral. */
static void lines_have_their_integrals(void **state) {
    (void)state;
    static const ang_transfer_point points[] = {{.hu = 100, .colour = {0, 0.5, 1}, .opacity = 0},
                                                {.hu = 116, .colour = {1, 0.5, 0}, .opacity = 0.8}};
    closed_form expected[4];
    static const double ends[4][2] = {{100, 116}, {103, 104}, {101, 115}, {90, 120}};
    for (int f = 0; f < 4; f++) {
        double from = (fmax(ends[f][0], 100) - 100) / 16, to = (fmin(ends[f][1], 116) - 100) / 16;
        double above = ends[f][1] > 116 ? 0.8 * (ends[f][1] - 116) : 0;
        double squares = 16 * 0.8 * (to * to - from * from) / 2, cubes = 16 * 0.8 * (pow(to, 3) - pow(from, 3)) / 3;
        expected[f] = (closed_form){
            ends[f][0], ends[f][1], {cubes + above, 0.5 * (squares + above), squares - cubes}, squares + above};
    }
    check(points, 2, expected, 4, 2e-6);
}

static void both_sides_of_a_step_count(void **state) {
    (void)state;
    static const ang_transfer_point points[] = {{.hu = 100, .colour = {1, 0, 0.5}, .opacity = 0},
                                                {.hu = 100, .colour = {1, 0, 0.5}, .opacity = 0.05},
                                                {.hu = 300, .colour = {1, 0, 0.5}, .opacity = 0.05},
                                                {.hu = 300, .colour = {0, 1, 0.5}, .opacity = 0.2},
                                                {.hu = 400, .colour = {0, 1, 0.5}, .opacity = 0.2}};
    static const closed_form expected[] = {{200, 350, {5, 10, 7.5}, 15},
                                           {299.5, 300, {0.025, 0, 0.0125}, 0.025},
                                           {300, 300.5, {0, 0.1, 0.05}, 0.1},
                                           {50, 150, {2.5, 0, 1.25}, 2.5},
                                           {50, 100, {0, 0, 0}, 0}};
    check(points, 5, expected, sizeof expected / sizeof *expected, 2e-6);
}

static void a_spike_of_one_value_keeps_its_area(void **state) {
    (void)state;
    static const ang_transfer_point points[] = {{.hu = 200, .colour = {1, 0.5, 0.25}, .opacity = 0},
                                                {.hu = 200.5, .colour = {1, 0.5, 0.25}, .opacity = 8},
                                                {.hu = 201, .colour = {1, 0.5, 0.25}, .opacity = 0}};
    static const closed_form expected[] = {{0, 1000, {4, 2, 1}, 4},
                                           {200, 200.5, {2, 1, 0.5}, 2},
                                           {200.25, 200.5, {1.5, 0.75, 0.375}, 1.5},
                                           {200.75, 200.25, {-3, -1.5, -0.75}, -3},
                                           {201, 700, {0, 0, 0}, 0}};
    check(points, 3, expected, sizeof expected / sizeof *expected, 2e-6);
}

/* A plateau at opacity 1 has no mean: its colours are kept, inside and outside the table, and nothing is added. */
static void plateaus_add_nothing(void **state) {
    (void)state;
    static const ang_transfer_point points[] = {{.hu = 100, .colour = {0.5, 0.5, 1}, .opacity = 0.5},
                                                {.hu = 260, .colour = {0.5, 0.5, 1}, .opacity = 0.5},
                                                {.hu = 260, .colour = {1, 0.5, 0.25}, .opacity = 1},
                                                {.hu = 300, .colour = {1, 0.75, 0.25}, .opacity = 1}};
    ang_transfer_tables *tables = make_tables(points, 4, false);
    ang_means *means = ang_means_create(tables, NULL);
    assert_non_null(means);
    assert_non_null(means->plateaus);
    double before = (260 - tables->first) * tables->per_value, inside = (280 - tables->first) * tables->per_value;
    for (int c = 0; c <= EXTINCTION; c++) {
        int first, last;
        memcpy(&first, record_at(means, (int)before) + c, sizeof first);
        memcpy(&last, record_at(means, means->intervals) + c, sizeof last);
        assert_true(first > 0);
        assert_int_equal(first, last);
    }
    const float *middle = record_at(means, (int)inside), *behind = record_at(means, means->intervals);
    assert_close(middle[5], 0.625, 1e-6);
    assert_close(behind[5], 0.75, 1e-6);
    assert_true(middle[4 + EXTINCTION] == 0 && middle[8 + EXTINCTION] == 0 && behind[4 + EXTINCTION] == 0);
    ang_means_free(means);
    ang_tables_free(tables);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_constant_is_itself),       cmocka_unit_test(lines_have_their_integrals),
        cmocka_unit_test(both_sides_of_a_step_count), cmocka_unit_test(a_spike_of_one_value_keeps_its_area),
        cmocka_unit_test(plateaus_add_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
