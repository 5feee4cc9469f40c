/* Sessions of the viewer: saved by hand, restored in another window, drawn without one. */
#include "tests/core/fixtures.h"

#include "io/session/state.h"

#define FOLDER ANG_TEST_TMP "/view_state"
#include "tests/app/viewer_hands.h"

#define DATA  FOLDER "/phantom"
#define SAVED PICTURES "/angioscope-state-0001.json"

static int opening(void **state) {
    (void)state;
    if (open_display() != 0) return -1;
    if (skipped) return 0;
    return run("phantom -o " DATA " --dims 64x64x32 --quiet") != 0 ? -1 : 0;
}

/* The state as its file has it, without what says where the data are; the caller deletes it. */
static cJSON *session_of(const char *path) {
    ang_json json;
    ang_error err = {0};
    if (!ang_json_open(path, &json, &err)) fail_msg("%s", err.message);
    cJSON *root = json.root;
    json.root = NULL;
    ang_json_close(&json);
    cJSON_DeleteItemFromObject(root, "live");
    cJSON_DeleteItemFromObject(field(root, "input"), "path");
    return root;
}

/* Every field of both is the same, to the last digit. */
static void assert_same_session(const char *left, const char *right) {
    cJSON *a = session_of(left), *b = session_of(right);
    char *one = cJSON_Print(a), *other = cJSON_Print(b);
    if (strcmp(one, other) != 0) fail_msg("%s and %s differ:\n%s\n%s", left, right, one, other);
    free(one);
    free(other);
    cJSON_Delete(a);
    cJSON_Delete(b);
}

/* Everything that a hand can change, but for the place where it does. */
static void change_everything(void) {
    go_to("axial");
    hands("click --repeat 5 --delay 12 4");
    hands("key 3");
    hands("keydown ctrl click 4 keyup ctrl");
    drag(2, 13, -7);
    drag(1, 31, -17);
    hands("key i key --repeat 7 --delay 30 alt+Right"); /* voxels as they are; planes turned */
    go_to("coronal");
    hands("key bracketright key bracketright");
    hands("keydown ctrl click 4 click 4 keyup ctrl");
    go_to("volume");
    hands("key 4"); /* a preset */
    drag(1, 37, 23);
    drag(3, 0, -31);
    drag(2, 11, 5);
    hands("keydown shift");
    drag(1, 9, 14);
    hands("keyup shift");
    hands("key k"); /* a clip plane */
    expect_number("clip_plane.offset_mm", 0, 200);
    hands("key o key t key shift+x key shift+c key p");
    expect_text("tool", "pan");
    expect_text("render.projection", "parallel");
}

static void a_session_is_saved_and_restored(void **state) {
    (void)state;
    need_window();
    start_viewer(DATA);
    expect_text("phase", "ready");
    change_everything();
    hands("key ctrl+s");
    expect_text("saved", "angioscope-volume-0001.png");
    hands("key ctrl+alt+s");
    expect_text("saved", "angioscope-state-0001.json");
    expect_number("slab.mm", 5, 0);
    assert_same_session(STATE, SAVED);
    hands("key ctrl+q");
    assert_int_equal(wait_for_end(), 0);
    start_viewer("--state " SAVED);
    expect_text("phase", "ready");
    expect_number("slab.mm", 5, 0);
    assert_same_session(STATE, SAVED);
    /* One step of undo goes nowhere; "Reset" goes to the preset as it is saved. */
    cJSON *now = read_state();
    assert_true(cJSON_IsFalse(field(now, "can_undo")));
    assert_true(cJSON_IsTrue(field(now, "preset_changed")) && cJSON_IsTrue(field(now, "voxels_shown")));
    assert_close(fabs(number_at(now, "axial.turned_deg")), 7, 1e-9);
    assert_non_null(strchr(text_at(now, "render.clip-plane"), ','));
    cJSON_Delete(now);
}

static void assert_same_picture(const char *a, const char *b) {
    double levels = difference(a, b);
    print_message("%s: %.3g levels from %s\n", a, levels, b);
    assert_true(levels <= 0);
}

/* Of the state, and of the picture itself, without a window. */
static void its_picture_is_drawn_without_a_window(void **state) {
    (void)state;
    need_window();
    expect(0, "render --state " SAVED " -q -o " FOLDER "/of-state.png");
    assert_same_picture(FOLDER "/of-state.png", PICTURES "/angioscope-volume-0001.png");
    expect(0, "render " DATA " --state " PICTURES "/angioscope-volume-0001.png -q -o " FOLDER "/of-picture.png");
    assert_same_picture(FOLDER "/of-picture.png", PICTURES "/angioscope-volume-0001.png");
    /* The window that was restored saves it again. */
    go_to("volume");
    hands("key ctrl+s");
    expect_text("saved", "angioscope-volume-0002.png");
    assert_same_picture(PICTURES "/angioscope-volume-0002.png", PICTURES "/angioscope-volume-0001.png");
    /* Nothing of where the data were is in pictures. */
    assert_int_equal(system("grep -qa view_state " PICTURES "/angioscope-volume-0002.png"), 256);
}

static void a_large_pane_is_restored(void **state) {
    (void)state;
    need_window();
    go_to("sagittal");
    hands("key Return");
    expect_text("maximised", "sagittal");
    hands("key ctrl+alt+s");
    expect_text("saved", "angioscope-state-0002.json");
    hands("key ctrl+q");
    assert_int_equal(wait_for_end(), 0);
    start_viewer(DATA " --state " PICTURES "/angioscope-state-0002.json");
    expect_text("maximised", "sagittal");
    /* What tells of the volume's picture does so though its pane has not been seen: it is drawn at rest. */
    for (int i = 0; i < 200 && !(isfinite(number_now("error_levels")) && number_now("presets_pictured") >= 3); i++)
        nap(50);
    assert_true(isfinite(number_now("error_levels")));
    assert_true(number_now("presets_pictured") >= 3);
    expect_flag("refined", true);
    double drawn = number_now("levels_shown");
    hands("key Return");
    expect_text("maximised", "");
    expect_flag("at_rest", true);
    assert_true(number_now("levels_shown") <= drawn); /* the picture was of the pane's size: it is not drawn again */
    hands("key ctrl+q");
    assert_int_equal(wait_for_end(), 0);
}

/* What a picture shows, of data that are named beside it; a preset goes before the picture's. */
static void a_picture_is_gone_on_with(void **state) {
    (void)state;
    need_window();
    cJSON *saved = session_of(SAVED);
    char view[128];
    snprintf(view, sizeof view, "%s", text_at(saved, "render.view"));
    start_viewer(DATA " --preset ct-skin --state " PICTURES "/angioscope-volume-0001.png");
    expect_text("render.view", view);
    expect_text("render.zoom", text_at(saved, "render.zoom"));
    expect_text("preset.name", "ct-skin");
    expect_text("tool", "window"); /* of which a picture says nothing */
    cJSON_Delete(saved);
    hands("key ctrl+q");
    assert_int_equal(wait_for_end(), 0);
}

/* Opened like data, from a window that shows others; what a picture shows of them too. */
static void a_state_is_opened_in_the_window(void **state) {
    (void)state;
    need_window();
    start_viewer(DATA " --preset cta-head");
    expect_text("phase", "ready");
    expect_text("preset.name", "cta-head");
    hands("key ctrl+alt+o");
    nap(300);
    hands("type --delay 12 " SAVED);
    hands("key Return");
    expect_number("slab.mm", 5, 0);
    expect_text("tool", "pan");
    hands("key ctrl+q");
    assert_int_equal(wait_for_end(), 0);
}

/* Data that are not the state's are shown without it, which is said. */
static void a_state_is_not_shown_of_other_data(void **state) {
    (void)state;
    need_window();
    assert_int_equal(run("phantom -o " FOLDER "/other --dims 64x64x32 --seed 2 --quiet"), 0);
    assert_int_equal(system("mv " DATA " " FOLDER "/moved"), 0);
    start_viewer("--state " SAVED);
    expect_text("phase", "failed");
    hands("key ctrl+o");
    nap(300);
    hands("type --delay 12 " FOLDER "/other");
    hands("key Return");
    expect_text("tool", "window"); /* the study is there */
    expect_text("phase", "failed");
    expect_number("slab.mm", 0, 0);
    hands("key ctrl+q");
    assert_int_equal(wait_for_end(), 0);
    assert_int_equal(system("mv " FOLDER "/moved " DATA), 0);
}

/* Data that have moved: said, and the state waits until they are opened. */
static void a_state_waits_for_data_that_have_moved(void **state) {
    (void)state;
    need_window();
    assert_int_equal(system("mv " DATA " " FOLDER "/moved"), 0);
    start_viewer("--state " SAVED);
    expect_text("phase", "failed");
    hands("key ctrl+o");
    nap(300);
    hands("type --delay 12 " FOLDER "/moved");
    hands("key Return");
    expect_text("phase", "ready");
    expect_number("slab.mm", 5, 0);
    assert_same_session(STATE, SAVED);
    hands("key ctrl+q");
    assert_int_equal(wait_for_end(), 0);
    expect(3, "render --state " SAVED " -q -o " FOLDER "/never.png 2>&1");
    assert_non_null(strstr(output, "are not there"));
    expect(0, "render " FOLDER "/moved --state " SAVED " -q -o " FOLDER "/of-state.png");
    assert_same_picture(FOLDER "/of-state.png", PICTURES "/angioscope-volume-0001.png");
    assert_int_equal(system("mv " FOLDER "/moved " DATA), 0);
}

static void a_broken_state_is_refused(void **state) {
    (void)state;
    need_window();
    write_file(FOLDER "/broken.json", "{\"angioscope_state\": 1,\n\"preset\": {\"points\": [[0,1,1,1,7]]}}");
    expect(2, "view --state " FOLDER "/broken.json 2>&1");
    assert_non_null(strstr(output, "broken.json:2: points[0][4] is 7"));
    start_viewer(FOLDER "/broken.json");
    expect_text("phase", "failed");
    hands("key ctrl+q");
    assert_int_equal(wait_for_end(), 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_session_is_saved_and_restored),
        cmocka_unit_test(its_picture_is_drawn_without_a_window),
        cmocka_unit_test(a_large_pane_is_restored),
        cmocka_unit_test(a_picture_is_gone_on_with),
        cmocka_unit_test(a_state_is_opened_in_the_window),
        cmocka_unit_test(a_state_is_not_shown_of_other_data),
        cmocka_unit_test(a_state_waits_for_data_that_have_moved),
        cmocka_unit_test(a_broken_state_is_refused),
    };
    return cmocka_run_group_tests(tests, opening, close_display);
}
