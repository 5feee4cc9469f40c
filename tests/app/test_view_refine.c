/* The volume's picture sharpens level by level at rest, through input that changes nothing, to the headless one. */
#include "tests/core/fixtures.h"

#define FOLDER ANG_TEST_TMP "/view_refine"
#include "tests/app/viewer_hands.h"

#define SESSION FOLDER "/session.json"

/* The method that takes longest: its levels last. */
static int opening(void **state) {
    (void)state;
    if (open_display() != 0) return -1;
    if (skipped) return 0;
    if (run("phantom -o " FOLDER "/phantom --dims 48x48x24 --quiet") != 0) return -1;
    write_file(SESSION, "{\"angioscope_state\": 1, \"method\": \"reference\",\n"
                        "\"preset\": {\"name\": \"vessels\", \"version\": 1, \"mode\": \"dvr\", \"unit_distance\": 1,\n"
                        "\"points\": [{\"hu\": 100, \"colour\": [0.7, 0.1, 0.1], \"opacity\": 0},\n"
                        "{\"hu\": 400, \"colour\": [1, 0.9, 0.8], \"opacity\": 0.4}]}}");
    start_viewer(FOLDER "/phantom --size 640x480 --threads 1 --state " SESSION);
    return 0;
}

/* Slow: it may take many times as long as other pictures. */
static void wait_until_refined(void) {
    for (int i = 0; i < 600; i++) {
        cJSON *state = read_state();
        bool refined = cJSON_IsTrue(field(state, "refined"));
        cJSON_Delete(state);
        if (refined) return;
        nap(100);
    }
    fail_msg("the picture is not refined");
}

static void turn(void) {
    int frames = (int)number_now("frames");
    drag(1, 21, 8);
    while (number_now("frames") <= frames) nap(10);
}

static void levels_are_shown_whatever_the_pointer_does(void **state) {
    (void)state;
    need_window();
    expect_text("phase", "ready");
    wait_until_refined();
    go_to("volume");
    /* The first pictures tell how coarse one has to be. */
    for (int i = 0; i < 2; i++) {
        turn();
        wait_until_refined();
    }
    double before = number_now("levels_shown");
    turn();
    for (int i = 0; i < 4; i++) {
        hands("mousemove_relative -- %d 1", i % 2 ? -1 : 1);
        nap(100);
    }
    wait_until_refined();
    assert_true(number_now("levels_shown") > before);
    hands("key ctrl+s");
    expect_text("saved", "angioscope-volume-0001.png");
    compare_with_headless("angioscope-volume-0001.png", FOLDER "/phantom");
}

/* Input while the picture sharpens is answered with another one. */
static void a_turn_begins_it_anew(void **state) {
    (void)state;
    need_window();
    double before = number_now("azimuth_deg");
    turn();
    turn();
    wait_until_refined();
    assert_true(fabs(number_now("azimuth_deg") - before) > 1);
    hands("key ctrl+s");
    expect_text("saved", "angioscope-volume-0002.png");
    compare_with_headless("angioscope-volume-0002.png", FOLDER "/phantom");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(levels_are_shown_whatever_the_pointer_does),
        cmocka_unit_test(a_turn_begins_it_anew),
        cmocka_unit_test(it_ends_well),
    };
    return cmocka_run_group_tests(tests, opening, close_display);
}
