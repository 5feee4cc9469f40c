/* A series of two phases in a real window: stepping from one to the other leaves all else as it is. */
#define FOLDER ANG_TEST_TMP "/view_phases"
#include "tests/io/small_dicom.h"

#include "tests/app/viewer_hands.h"

static void write_phases(void) {
    assert_int_equal(mkdir(FOLDER "/study", 0755), 0);
    for (int i = 0; i < 12; i++) {
        char name[32];
        form f = form_at(i % 6, 900 + 100 * (i % 6) + 50 * (i / 6));
        f.temporal_position = i / 6 + 1;
        snprintf(name, sizeof name, "study/%d.dcm", i);
        small(name, &f);
    }
}

static int opening(void **state) {
    (void)state;
    if (open_display() != 0) return -1;
    if (skipped) return 0;
    write_phases();
    start_viewer(FOLDER "/study");
    return 0;
}

static void the_first_phase_opens(void **state) {
    (void)state;
    need_window();
    expect_text("phase", "ready");
    expect_number("series.phases", 2, 0);
    expect_number("series.phase", 1, 0);
}

static void stepping_leaves_the_rest(void **state) {
    (void)state;
    need_window();
    go_to("axial");
    double before = number_now("crosshair_mm.2");
    hands("key Up");
    expect_number("crosshair_mm.2", before + 1, 1e-9);
    go_to("volume");
    hands("key alt+p");
    expect_text("render.view", "180,0,0");
    hands("key ctrl+bracketright");
    expect_number("series.phase", 2, 0);
    expect_number("crosshair_mm.2", before + 1, 1e-9);
    expect_text("render.view", "180,0,0");
    hands("key ctrl+bracketright"); /* behind the last comes the first */
    expect_number("series.phase", 1, 0);
    hands("key ctrl+bracketleft");
    expect_number("series.phase", 2, 0);
}

/* The state says which phase it is of: headless pictures and another window show that. */
static void states_hold_the_phase(void **state) {
    (void)state;
    need_window();
    assert_int_equal(run("render " FOLDER "/study --state " STATE " -q -o " FOLDER "/a.png --json " FOLDER "/a.json"),
                     0);
    ang_json json;
    assert_true(ang_json_open(FOLDER "/a.json", &json, NULL));
    assert_float_equal(number_at(json.root, "input.phase"), 2, 0);
    assert_float_equal(number_at(json.root, "input.hu_range.0"), 900 + 50 - 1024, 1e-9);
    ang_json_close(&json);
    assert_int_equal(system("cp " STATE " " FOLDER "/kept.json"), 0);
    hands("key ctrl+q");
    assert_int_equal(wait_for_end(), 0);
    start_viewer(FOLDER "/study --state " FOLDER "/kept.json");
    expect_number("series.phase", 2, 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_first_phase_opens),
        cmocka_unit_test(stepping_leaves_the_rest),
        cmocka_unit_test(states_hold_the_phase),
        cmocka_unit_test(it_ends_well),
    };
    return cmocka_run_group_tests(tests, opening, close_display);
}
