/* The scale of the interface on screens that there are. */
#include "tests/core/fixtures.h"

#include "ui/toolkit/scale.h"

static void what_the_window_system_says_holds(void **state) {
    (void)state;
    assert_close(ang_screen_scale(2, 1920, 510), 2, 0);
    assert_close(ang_screen_scale(1.25, 3840, 597), 1.25, 0);
    assert_close(ang_screen_scale(0, 1920, 510), 1, 0);
    assert_close(ang_screen_scale(NAN, 1920, 510), 1, 0);
}

static void else_the_screens_pixels_decide(void **state) {
    (void)state;
    assert_close(ang_screen_scale(1, 1920, 527), 1, 0);    /* 24 inches: 93 pixels an inch */
    assert_close(ang_screen_scale(1, 2560, 597), 1, 0);    /* 27 inches: 109 */
    assert_close(ang_screen_scale(1, 3840, 941), 1, 0);    /* a television of 42 inches: 104 */
    assert_close(ang_screen_scale(1, 3840, 708), 1, 0);    /* 32 inches: 138 */
    assert_close(ang_screen_scale(1, 3840, 597), 1.75, 0); /* 27 inches: 163 */
    assert_close(ang_screen_scale(1, 3840, 344), 3, 0);    /* a laptop of 15.6 inches: 284 */
    assert_close(ang_screen_scale(1, 2880, 290), 2.5, 0);  /* 13.3 inches: 252 */
}

static void what_cannot_be_true_is_passed_over(void **state) {
    (void)state;
    assert_close(ang_screen_scale(1, 3840, 0), 1, 0);
    assert_close(ang_screen_scale(1, 1920, 160), 1, 0); /* "16 : 9" as centimetres */
    assert_close(ang_screen_scale(1, 3840, 16), 1, 0);
    assert_true(ang_screen_scale(1, 30000, 200) <= 4);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_the_window_system_says_holds),
        cmocka_unit_test(else_the_screens_pixels_decide),
        cmocka_unit_test(what_cannot_be_true_is_passed_over),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
