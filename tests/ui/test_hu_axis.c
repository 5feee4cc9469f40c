/* The range of HU of an editor: limits, round numbers, shares and bars. */
#include "tests/core/fixtures.h"

#include "ui/state/hu_axis.h"

#include <stdlib.h>

static void zooming_keeps_its_place_and_its_limits(void **state) {
    (void)state;
    ang_hu_range all = {-1100, 2100}, range = {0, 400};
    ang_hu_range near = ang_hu_range_zoom(range, 100, 0.5, 1, all);
    assert_close(near.low, 50, 1e-12);
    assert_close(near.high, 250, 1e-12);
    for (int i = 0; i < 40; i++) near = ang_hu_range_zoom(near, 100, 0.5, 1, all);
    assert_close(near.high - near.low, 1, 1e-12);
    assert_true(near.low <= 100 && near.high >= 100);
    ang_hu_range far = ang_hu_range_zoom(range, 100, 1e9, 1, all);
    assert_close(far.low, all.low, 1e-9);
    assert_close(far.high, all.high, 1e-9);
    ang_hu_range right = ang_hu_range_slide(range, 1e9, all);
    assert_close(right.low, 1700, 1e-9);
    assert_close(right.high, 2100, 1e-9);
    ang_hu_range shown = ang_hu_range_with(range, 500);
    assert_close(shown.high - shown.low, 400, 1e-9);
    assert_true(shown.high > 500 && shown.low < 500);
    shown = ang_hu_range_with(range, 200);
    assert_close(shown.low, range.low, 0);
}

static void numbers_on_the_axis_are_round(void **state) {
    (void)state;
    static const ang_hu_range ranges[] = {{-1100, 2100}, {0, 1}, {99.5, 100.5}, {-3e4, 1e5}, {-0.003, 0.001}, {40, 49}};
    for (size_t i = 0; i < sizeof ranges / sizeof *ranges; i++) {
        ang_hu_ticks ticks = ang_hu_ticks_make(ranges[i], 6);
        double width = ranges[i].high - ranges[i].low, power = pow(10, floor(log10(ticks.step) + 1e-9));
        double digit = round(ticks.step / power);
        assert_true(digit == 1 || digit == 2 || digit == 5);
        assert_close(ticks.step / power, digit, 1e-9);
        assert_true(ticks.step >= width / 6 * (1 - 1e-9) && ticks.step <= 2.5 * width / 6);
        assert_true(ticks.count >= 2 && ticks.count <= 7);
        assert_true(ticks.first >= ranges[i].low - 1e-9 * width && ticks.first - ticks.step < ranges[i].low);
        assert_close(remainder(ticks.first, ticks.step), 0, 1e-6 * ticks.step);
        double scaled = ticks.step * pow(10, ticks.decimals);
        assert_close(scaled, round(scaled), 1e-6);
    }
    assert_int_equal(ang_hu_ticks_make((ang_hu_range){5, 5}, 6).count, 0);
}

/* 10 x 10 x 10 voxels of 0.5 x 0.5 x 2 mm: HU -1000 + 2 * stored, stored 0 to 99 ten times each. */
static ang_volume *make(void) {
    ang_volume *volume = ang_volume_create((int[]){10, 10, 10}, NULL);
    assert_non_null(volume);
    for (size_t i = 0; i < 1000; i++) volume->data[i] = (uint16_t)(i % 100);
    volume->slope = 2;
    volume->intercept = -1000;
    volume->affine.m[0][0] = volume->affine.m[1][1] = 0.5;
    volume->affine.m[2][2] = 2;
    ang_volume_update_range(volume, 1);
    return volume;
}

static void shares_are_counted(void **state) {
    (void)state;
    ang_volume *volume = make();
    ang_histogram *histogram = ang_histogram_build(volume, 1, NULL);
    ang_hu_share share = ang_hu_share_of(volume, histogram, (ang_hu_range){-980, -961});
    int counted = 0;
    for (size_t i = 0; i < 1000; i++) {
        double hu = ang_volume_hu(volume, volume->data[i]);
        counted += hu >= -980 && hu <= -961;
    }
    assert_int_equal(share.voxels, counted);
    assert_close(share.low, -980, 1e-9);
    assert_close(share.high, -962, 1e-9);
    assert_close(share.share, 0.1, 1e-12);
    assert_close(share.ml, 100 * 0.5 / 1000, 1e-12);
    share = ang_hu_share_of(volume, histogram, (ang_hu_range){-1e9, 1e9});
    assert_int_equal(share.voxels, 1000);
    share = ang_hu_share_of(volume, histogram, (ang_hu_range){-979.5, -978.5}); /* between two values */
    assert_true(share.first > share.last && share.voxels == 0);
    free(histogram);
    ang_volume_free(volume);
}

static void bars_are_even_where_values_are(void **state) {
    (void)state;
    ang_volume *volume = make();
    ang_histogram *histogram = ang_histogram_build(volume, 1, NULL);
    double bars[300];
    /* Bars of 1.7 values and of a seventh of one: all values are as frequent, so all bars are as high. */
    ang_hu_range inside = {-1000 + 20 - 1, -1000 + 20 - 1 + 2 * 1.7 * 40};
    ang_hu_bars(volume, histogram, inside, 40, bars);
    for (int i = 0; i < 40; i++) assert_close(bars[i], 1, 1e-9);
    ang_hu_bars(volume, histogram, (ang_hu_range){-901, -881}, 70, bars);
    for (int i = 0; i < 70; i++) assert_close(bars[i], 1, 1e-9);
    /* One value alone, seen so near that it takes a third of the plot: sharp edges half-way to its neighbours. */
    for (int v = 0; v < ANG_HISTOGRAM_BINS; v++) histogram->bin[v] = v == 50 ? 1000 : 0;
    ang_hu_bars(volume, histogram, (ang_hu_range){-903, -897}, 300, bars);
    for (int i = 0; i < 300; i++) assert_close(bars[i], i >= 100 && i < 200 ? 1 : 0, 1e-6);
    free(histogram);
    ang_volume_free(volume);
}

static void all_that_there_is_can_be_seen(void **state) {
    (void)state;
    ang_volume *volume = make();
    ang_document document = {.count = 2, .points = {{.hu = -30000}, {.hu = 100000}}};
    ang_hu_range all = ang_hu_range_all(volume, &document);
    assert_true(all.low < -30000 && all.high > 100000);
    document.points[0].hu = -900;
    document.points[1].hu = -890;
    all = ang_hu_range_all(volume, &document);
    assert_true(all.low < -1000 && all.low > -1020 && all.high > -802 && all.high < -780);
    ang_volume_free(volume);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(zooming_keeps_its_place_and_its_limits),
        cmocka_unit_test(numbers_on_the_axis_are_round),
        cmocka_unit_test(shares_are_counted),
        cmocka_unit_test(bars_are_even_where_values_are),
        cmocka_unit_test(all_that_there_is_can_be_seen),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
