/* Cine: steps at a steady rate, none late, and what comes after the last. */
#include "tests/core/fixtures.h"

#include "ui/state/cine.h"

static void steps_come_at_the_rate(void **state) {
    (void)state;
    ang_cine cine = ang_cine_default;
    assert_int_equal(ang_cine_due(&cine, 100), 0); /* it does not run */
    ang_cine_start(&cine, 2, 10);
    assert_int_equal(cine.pane, 2);
    assert_int_equal(ang_cine_due(&cine, 10 + 0.9 / 15), 0);
    assert_int_equal(ang_cine_due(&cine, 10 + 1.1 / 15), 1);
    assert_int_equal(ang_cine_due(&cine, 10 + 1.9 / 15), 0);
    assert_int_equal(ang_cine_due(&cine, 10 + 2.1 / 15), 1);
    assert_close(cine.due_seconds, 10 + 3.0 / 15, 1e-9);
}

/* However slowly frames are drawn, after a second it is a second further. */
static void a_slow_screen_leaves_out_frames(void **state) {
    (void)state;
    static const double frames[] = {0.003, 0.0137, 0.041, 0.2, 0.61};
    for (size_t i = 0; i < sizeof frames / sizeof *frames; i++) {
        ang_cine cine = ang_cine_default;
        cine.per_second = 60;
        ang_cine_start(&cine, 0, 5);
        int steps = 0;
        double now = 5;
        for (; now < 15; now += frames[i]) steps += ang_cine_due(&cine, now);
        steps += ang_cine_due(&cine, now);
        assert_close(steps, (now - 5) * 60, 1.01);
    }
    ang_cine cine = ang_cine_default;
    ang_cine_start(&cine, 0, 5);
    assert_true(ang_cine_due(&cine, 1e12) > 0);
    assert_int_equal(ang_cine_due(&cine, 1e12), 0);
}

static void rates_stay_between_1_and_60(void **state) {
    (void)state;
    ang_cine cine = ang_cine_default;
    ang_cine_set_faster(&cine, 1, 0);
    assert_close(cine.per_second, 20, 0);
    for (int i = 0; i < 30; i++) ang_cine_set_faster(&cine, 1, 0);
    assert_close(cine.per_second, 60, 0);
    for (int i = 0; i < 30; i++) ang_cine_set_faster(&cine, -1, 7);
    assert_close(cine.per_second, 1, 0);
    assert_close(cine.due_seconds, 8, 0);
}

static void it_begins_again_or_turns_back(void **state) {
    (void)state;
    ang_cine cine = ang_cine_default;
    static const int again[] = {3, 0, 1, 2, 3, 0}, back[] = {3, 2, 1, 0, 1, 2, 3, 2};
    int index = 2;
    for (size_t i = 0; i < sizeof again / sizeof *again; i++) {
        index = ang_cine_advance(&cine, index, 4, 1);
        assert_int_equal(index, again[i]);
    }
    cine.back_and_forth = true;
    index = 2;
    for (size_t i = 0; i < sizeof back / sizeof *back; i++) {
        index = ang_cine_advance(&cine, index, 4, 1);
        assert_int_equal(index, back[i]);
    }
    /* Several steps at once lead where single ones do. */
    for (int steps = 0; steps < 30; steps++) {
        ang_cine one = {.back_and_forth = true, .direction = 1}, many = one;
        int slow = 1;
        for (int i = 0; i < steps; i++) slow = ang_cine_advance(&one, slow, 5, 1);
        assert_int_equal(ang_cine_advance(&many, 1, 5, steps), slow);
    }
    assert_int_equal(ang_cine_advance(&cine, 0, 1, 9), 0);
    cine.back_and_forth = false;
    assert_int_equal(ang_cine_advance(&cine, 0, 1, 9), 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(steps_come_at_the_rate),
        cmocka_unit_test(a_slow_screen_leaves_out_frames),
        cmocka_unit_test(rates_stay_between_1_and_60),
        cmocka_unit_test(it_begins_again_or_turns_back),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
