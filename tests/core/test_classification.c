/* Where transfer functions change within few HU, how fast volumes pass these places, and which classification that
 * makes the plan choose; without OpenGL. */
#include "tests/core/fixtures.h"

#include "core/plan/classification.h"

#include <string.h>

static ang_transfer *make(const ang_transfer_point *points, size_t count) {
    ang_transfer *transfer = ang_transfer_create(points, count, 1, false, NULL, NULL);
    assert_non_null(transfer);
    return transfer;
}

static double ramp_y(int x, int y, int z) {
    (void)x, (void)z;
    return 40 * y;
}

/* Opacity rises within 200 HU and stays. */
static const ang_transfer_point smooth[] = {{.hu = 100, .colour = {1, 0.5, 0}, .opacity = 0},
                                            {.hu = 300, .colour = {1, 0.5, 0.5}, .opacity = 0.4},
                                            {.hu = 900, .colour = {1, 1, 1}, .opacity = 0.5}};

static void places_are_found(void **state) {
    (void)state;
    ang_transfer *t = make(smooth, 3);
    ang_stiffness s = ang_stiffness_of(t);
    /* The rises of opacity, and of green and blue, between three points: wide, but there. */
    for (int i = 0; i < s.count; i++) assert_int_equal(s.place[i].kind, ANG_STIFF_STEP);
    assert_int_equal(s.count, 2);
    assert_close(s.place[0].high - s.place[0].low, 200, 0);
    ang_transfer_free(t);

    /* A peak between 200 and 240, a tenth of whose height is left 2 HU from its feet; a step at 500; and a colour that
     * changes at 600 and back at 610, where nothing shows any more. */
    static const ang_transfer_point points[] = {
        {.hu = 200, .opacity = 0},   {.hu = 220, .opacity = 0.2}, {.hu = 240, .opacity = 0},
        {.hu = 500, .opacity = 0},   {.hu = 500, .opacity = 0.3}, {.hu = 550, .opacity = 0.3},
        {.hu = 560, .opacity = 0.3}, {.hu = 560, .opacity = 0},   {.hu = 605, .colour = {1, 0, 0}, .opacity = 0},
        {.hu = 610, .opacity = 0}};
    t = make(points, 10);
    s = ang_stiffness_of(t);
    int peaks = 0, steps = 0;
    for (int i = 0; i < s.count; i++) {
        const ang_stiff_place *p = &s.place[i];
        if (p->kind == ANG_STIFF_STEP && p->low == p->high) steps++;
        if (p->kind == ANG_STIFF_PEAK && p->high < 500) {
            assert_close(p->low, 202, 1e-9);
            assert_close(p->high, 238, 1e-9);
            peaks++;
        } else if (p->kind == ANG_STIFF_PEAK && p->low >= 500) {
            assert_close(p->low, 500, 0);
            assert_close(p->high, 560, 0);
            peaks++;
        } else if (p->kind == ANG_STIFF_PEAK) {
            assert_close(p->low, 222, 1e-9); /* the gap between the two */
            assert_close(p->high, 500, 0);
            peaks++;
        }
        assert_true(p->high <= 560);
    }
    assert_int_equal(peaks, 3);
    assert_int_equal(steps, 2);
    ang_transfer_free(t);

    /* A gap of 4 HU in what shows, and a stripe of another colour. */
    static const ang_transfer_point gap[] = {
        {.hu = 0, .opacity = 0.3},  {.hu = 10, .opacity = 0.3},  {.hu = 12, .opacity = 0},
        {.hu = 14, .opacity = 0.3}, {.hu = 100, .opacity = 0.3}, {.hu = 101, .colour = {0, 1, 0}, .opacity = 0.3},
        {.hu = 102, .opacity = 0.3}};
    t = make(gap, 7);
    s = ang_stiffness_of(t);
    bool found[2] = {false, false};
    for (int i = 0; i < s.count; i++) {
        if (s.place[i].kind != ANG_STIFF_PEAK) continue;
        found[s.place[i].low > 50] = true;
        assert_close(s.place[i].high - s.place[i].low, s.place[i].low > 50 ? 1.8 : 3.6, 1e-9);
    }
    assert_true(found[0] && found[1]);
    ang_transfer_free(t);
}

/* A dip of a fifth on the way up is a ripple; of a half it is a gap. */
static void ripples_do_not_count(void **state) {
    (void)state;
    for (int deep = 0; deep < 2; deep++) {
        const ang_transfer_point points[] = {{.hu = 130, .opacity = 0},
                                             {.hu = 180, .opacity = 0.05},
                                             {.hu = 182, .opacity = deep ? 0.025 : 0.04},
                                             {.hu = 280, .opacity = 0.06}};
        ang_transfer *t = make(points, 4);
        ang_stiffness s = ang_stiffness_of(t);
        assert_int_equal(s.count, deep ? 2 : 0); /* the peak before it and the gap */
        ang_transfer_free(t);
    }
}

/* More places than are kept: the narrowest are. */
static void the_narrowest_are_kept(void **state) {
    (void)state;
    enum { peaks = 3 * ANG_STIFF_PLACES };
    ang_transfer_point points[2 * peaks + 1];
    double at = 0;
    for (int i = 0; i < 2 * peaks + 1; i++) {
        points[i] = (ang_transfer_point){.hu = at, .opacity = i % 2 ? 0.05 : 0};
        at += 1 + (i * 37 % peaks); /* rises of less than a tenth are no steps */
    }
    ang_transfer *t = make(points, 2 * peaks + 1);
    ang_stiffness s = ang_stiffness_of(t);
    assert_int_equal(s.count, ANG_STIFF_PLACES);
    double widest = 0;
    for (int i = 0; i < s.count; i++) {
        widest = fmax(widest, s.place[i].high - s.place[i].low);
        if (i > 0) assert_true(s.place[i].low >= s.place[i - 1].low);
    }
    int narrower = 0;
    for (int i = 1; i < 2 * peaks; i += 2)
        narrower += 0.9 * (points[i + 1].hu - points[i - 1].hu) < widest * (1 - 1e-9);
    assert_true(narrower < ANG_STIFF_PLACES);
    ang_transfer_free(t);
}

static void changes_are_those_of_the_volume(void **state) {
    (void)state;
    static const double spacing[3] = {1, 0.5, 2};
    /* 40 HU a voxel along y, of 0.5 mm: 80 HU per mm wherever it is passed. */
    ang_volume *volume = make_volume(9, 20, 7, spacing, ramp_y);
    static const ang_transfer_point points[] = {
        {.hu = 290, .opacity = 0},  {.hu = 300, .opacity = 0.5},  {.hu = 310, .opacity = 0},
        {.hu = 2000, .opacity = 0}, {.hu = 2000, .opacity = 0.5},
    };
    ang_transfer *t = make(points, 5);
    ang_stiffness s = ang_stiffness_of(t);
    ang_stiffness_measure(&s, volume);
    for (int i = 0; i < s.count; i++) {
        if (s.place[i].low < 1000)
            assert_close(s.place[i].change, 80, 3);
        else
            assert_close(s.place[i].change, 0, 0); /* the ramp ends before */
    }
    assert_true(s.count >= 2);
    ang_transfer_free(t);
    ang_volume_free(volume);
}

static void the_choice(void **state) {
    (void)state;
    const ang_stiffness none = {.count = 0};
    ang_classification c = ang_classification_choose(ANG_CLASSIFY_AUTO, &none, 1);
    assert_false(c.prefix || c.may_miss);
    assert_true(ang_classification_choose(ANG_CLASSIFY_PREFIX, &none, 1).prefix);

    /* A peak 20 HU wide where values change by 80 HU per mm: passed in a quarter of a mm. */
    const ang_stiffness peak = {{{ANG_STIFF_PEAK, 290, 310, 80}}, 1};
    assert_false(ang_classification_choose(ANG_CLASSIFY_AUTO, &peak, 0.24).prefix);
    c = ang_classification_choose(ANG_CLASSIFY_AUTO, &peak, 0.26);
    assert_true(c.prefix && !c.may_miss && !c.warning[0]);
    c = ang_classification_choose(ANG_CLASSIFY_MIDPOINT, &peak, 0.26);
    assert_true(!c.prefix && c.may_miss);
    assert_non_null(strstr(c.warning, "290 to 310 HU"));
    c = ang_classification_choose(ANG_CLASSIFY_MIDPOINT, &peak, 0.24);
    assert_true(!c.prefix && !c.may_miss && !c.warning[0]);

    /* A rise within 10 HU: sudden where a step changes values by 80 HU or more; nothing is missed at one. */
    const ang_stiffness rise = {{{ANG_STIFF_STEP, 300, 310, 80}}, 1};
    assert_false(ang_classification_choose(ANG_CLASSIFY_AUTO, &rise, 0.99).prefix);
    assert_true(ang_classification_choose(ANG_CLASSIFY_AUTO, &rise, 1.01).prefix);
    assert_false(ang_classification_choose(ANG_CLASSIFY_MIDPOINT, &rise, 1.01).may_miss);
    const ang_stiffness step = {{{ANG_STIFF_STEP, 300, 300, 1e-3}}, 1};
    assert_true(ang_classification_choose(ANG_CLASSIFY_AUTO, &step, 0.01).prefix);
    /* What the data never pass does not matter. */
    const ang_stiffness beside = {{{ANG_STIFF_STEP, 300, 300, 0}, {ANG_STIFF_PEAK, 300, 301, 0}}, 2};
    assert_false(ang_classification_choose(ANG_CLASSIFY_AUTO, &beside, 100).prefix);
}

/* Bone and vessels change by 400 HU per mm; presets have no points closer than that in a usual step of 0.25 mm. */
static void a_smooth_function_stays_mid_point(void **state) {
    (void)state;
    ang_transfer *t = make(smooth, 3);
    ang_stiffness s = ang_stiffness_of(t);
    for (int i = 0; i < s.count; i++) s.place[i].change = 400;
    assert_false(ang_classification_choose(ANG_CLASSIFY_AUTO, &s, 0.25).prefix);
    assert_true(ang_classification_choose(ANG_CLASSIFY_AUTO, &s, 5).prefix);
    ang_transfer_free(t);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(places_are_found),
        cmocka_unit_test(ripples_do_not_count),
        cmocka_unit_test(the_narrowest_are_kept),
        cmocka_unit_test(changes_are_those_of_the_volume),
        cmocka_unit_test(the_choice),
        cmocka_unit_test(a_smooth_function_stays_mid_point),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
