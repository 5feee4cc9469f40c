/* The window's shell in a real window: theme, gaps, commands by name, keys alone, what is remembered. */
#include "tests/core/fixtures.h"

#define FOLDER ANG_TEST_TMP "/view_shell"
#include "tests/app/viewer_hands.h"

#include "ui/toolkit/theme.h"

#define PHANTOM FOLDER "/phantom"

static int opening(void **state) {
    (void)state;
    if (open_display() != 0) return -1;
    if (skipped) return 0;
    if (run("phantom -o " PHANTOM " --dims 64x64x32 --quiet") != 0) return -1;
    start_viewer(PHANTOM " --preset cta-head --size 1100x650");
    return 0;
}

/* The pointer where no pane is. */
static void park(void) { hands("mousemove 700 8"); }

static void a_command_is_found_by_its_name(void **state) {
    (void)state;
    need_window();
    expect_text("phase", "ready");
    expect_text("shell.theme", "dark");
    park();
    hands("key ctrl+k");
    expect_flag("shell.palette", true);
    hands("type --delay 20 'theme li'");
    hands("key Return");
    expect_text("shell.theme", "light");
    expect_flag("shell.palette", false);
    hands("key ctrl+shift+p type --delay 20 bone-iso");
    hands("key Return");
    expect_text("preset.name", "ct-bone-iso");
    /* "Bone" is a window too; the second of those that are listed is chosen by an arrow, and Esc does nothing. */
    hands("key ctrl+k type --delay 20 'window lev'");
    hands("key Down Return");
    expect_number("window.width", 600, 0);
    hands("key ctrl+k type --delay 20 brain");
    hands("key Escape");
    expect_flag("shell.palette", false);
    expect_number("window.width", 600, 0);
}

static void expect_colour(const ang_image *picture, double x, double y, ang_ink ink) {
    const float *pixel = picture->rgba + 4 * ((size_t)y * (size_t)picture->width + (size_t)x);
    for (int i = 0; i < 3; i++) assert_close(255 * (double)pixel[i], (double)(ink >> 8 * i & 255), 1);
}

/* The panel has the theme's colour, pictures stay black. */
static void the_light_theme_leaves_pictures_alone(void **state) {
    (void)state;
    need_window();
    hands("key ctrl+shift+s");
    expect_text("saved", "angioscope-window-0001.png");
    ang_image picture;
    assert_true(ang_picture_read(PICTURES "/angioscope-window-0001.png", &picture, NULL));
    assert_int_equal(picture.width, 1100);
    assert_int_equal(picture.height, 650);
    expect_colour(&picture, 3, 400, ang_theme_light.panel);
    expect_colour(&picture, number_now("panes.axial.0") - 2, 300, ang_theme_light.gap);
    static const char *const panes[] = {"axial", "coronal", "sagittal", "volume"};
    for (int i = 0; i < 4; i++) {
        char left[32], top[32];
        snprintf(left, sizeof left, "panes.%s.0", panes[i]);
        snprintf(top, sizeof top, "panes.%s.1", panes[i]);
        expect_colour(&picture, number_now(left) + 6, number_now(top) + 50, ANG_INK(0, 0, 0, 255));
    }
    ang_image_clear(&picture);
}

static void hold(const char *grip, int dx, int dy) {
    char path[4][48];
    double rect[4];
    for (int i = 0; i < 4; i++) {
        snprintf(path[i], sizeof path[i], "shell.grips.%s.%d", grip, i);
        rect[i] = number_now(path[i]);
    }
    /* Off the cross in the middle, for gaps that pass it. */
    bool upright = rect[3] > rect[2] * 2, level = rect[2] > rect[3] * 2;
    int x = (int)(rect[0] + rect[2] * (level ? 0.25 : 0.5)), y = (int)(rect[1] + rect[3] * (upright ? 0.25 : 0.5));
    hands("mousemove %d %d mousedown 1 mousemove_relative -- %d %d mousemove_relative -- %d %d", x, y, dx / 2, dy / 2,
          dx - dx / 2, dy - dy / 2);
}

static void gaps_follow_the_hand(void **state) {
    (void)state;
    need_window();
    double width = number_now("panes.axial.2"), height = number_now("panes.axial.3"),
           left = number_now("panes.axial.0");
    hold("cross", -60, 40);
    hands("mouseup 1");
    expect_number("panes.axial.2", width - 60, 0);
    expect_number("panes.axial.3", height + 40, 0);
    expect_number("panes.volume.0", left + width - 60 + 4, 0);
    hold("down", 0, -25);
    expect_number("panes.axial.3", height + 15, 0);
    hands("key Escape mouseup 1"); /* a drag is taken back */
    expect_number("panes.axial.3", height + 40, 0);
    hold("panel", 48, 0);
    hands("mouseup 1");
    expect_number("shell.panel", 368, 0);
    expect_number("panes.axial.0", left + 48, 0);
    hold("across", 0, 0);
    hands("mouseup 1 click 1"); /* a double click evens */
    expect_number("shell.split.0", 0.5, 0);
    expect_number("panes.axial.3", height + 40, 0);
    park();
    hands("key ctrl+b");
    expect_number("panes.axial.0", 0, 0);
    hands("key ctrl+b");
    expect_number("panes.axial.0", left + 48, 0);
    hands("key ctrl+shift+Up");
    expect_number("panes.axial.3", height + 16, 0); /* a step of 24 */
}

static void keys_alone_do_everything(void **state) {
    (void)state;
    need_window();
    park();
    hands("key F1");
    expect_flag("shell.help", true);
    hands("key Escape");
    expect_flag("shell.help", false);
    /* From pane to pane. */
    cJSON *before = read_state();
    assert_string_equal(text_at(before, "hovered"), "");
    cJSON_Delete(before);
    hands("key ctrl+k type --delay 20 centre");
    hands("key Return");
    hands("key F6 key F6 key F6 key F6 key F6"); /* four panes and the panel: once around */
    hands("key F6");
    for (int i = 0; i < 5; i++) {
        cJSON *shown = read_state();
        bool coronal = strcmp(text_at(shown, "shell.focus"), "coronal") == 0;
        cJSON_Delete(shown);
        if (coronal) break;
        hands("key F6");
        nap(300);
    }
    expect_text("shell.focus", "coronal");
    double slice = number_now("coronal.slice"), sagittal = number_now("sagittal.slice"),
           axial = number_now("axial.slice");
    hands("key Up Up Up");
    expect_number("coronal.slice", slice + 3, 0);
    hands("key 4");
    expect_number("window.width", 2000, 0);
    /* The crosshair: to the right is to the patient's left, up is to the head. */
    hands("key shift+Right shift+Right shift+Up");
    expect_number("sagittal.slice", sagittal + 2, 0);
    expect_number("axial.slice", axial + 1, 0);
    hands("key plus");
    expect_number("coronal.zoom", 1.15, 1e-9);
    hands("key ctrl+Left");
    assert_true(expect_other("coronal.pan_mm.0", 0, 1) > 1); /* the picture went to the left */
    hands("key r");
    expect_number("coronal.zoom", 1, 0);
    /* The camera. */
    hands("key F6 F6");
    expect_text("shell.focus", "volume");
    hands("key shift+r key shift+Right shift+Right");
    expect_number("azimuth_deg", -10, 1e-9);
    hands("key 1");
    expect_text("preset.name", "cta-head");
    hands("key Return");
    expect_text("maximised", "volume");
    hands("key Return");
    expect_text("maximised", "");
}

static void the_panel_takes_keys_from_tab_to_esc(void **state) {
    (void)state;
    need_window();
    park();
    hands("key ctrl+Tab");
    expect_text("shell.focus", "widgets");
    hands("key Escape");
    expect_text("shell.focus", "volume");
    double slice = number_now("axial.slice"), zoom = atof("1.6");
    hands("key Tab");
    expect_text("shell.focus", "widgets");
    /* The first is the list of presets: Enter opens it, an arrow and Enter choose. */
    hands("key --delay 150 Return Down Return");
    char next[64] = "cta-head";
    for (int i = 0; i < 200 && strcmp(next, "cta-head") == 0; i++) {
        cJSON *state_now = read_state();
        snprintf(next, sizeof next, "%s", text_at(state_now, "preset.name"));
        cJSON_Delete(state_now);
        nap(50);
    }
    cJSON *shown = read_state();
    assert_string_not_equal(next, "cta-head");
    assert_close(number_at(shown, "axial.slice"), slice, 0);
    assert_close(atof(text_at(shown, "render.zoom")), zoom, 1e-9);
    cJSON_Delete(shown);
    expect_text("shell.focus", "widgets");
    hands("key ctrl+z");
    expect_text("preset.name", "cta-head"); /* shortcuts go on */
    /* The strip of pictures, two controls on: an arrow goes to the next one, which Enter takes. */
    hands("key --delay 150 Tab Tab Right Return");
    expect_text("preset.name", next);
    hands("key --delay 150 Left Return");
    expect_text("preset.name", "cta-head");
    /* Moving the pointer onto a pane gives the keyboard to it. */
    go_to("axial");
    expect_text("shell.focus", "axial");
    hands("key Down");
    expect_number("axial.slice", slice - 1, 0);
    /* By menu: File, Edit; its first entry is to undo. */
    hands("key --delay 150 2");
    expect_number("window.width", 600, 0);
    hands("key --delay 150 F10 Right Down Return");
    expect_number("window.width", 2000, 0);
    /* As fast as fingers, by Alt alone; Alt with another key is none of that. */
    hands("key --delay 150 2");
    expect_number("window.width", 600, 0);
    hands("key --delay 12 Alt_L Down Right Return");
    expect_number("window.width", 2000, 0);
    hands("key --delay 30 alt+Up"); /* faster cine */
    hands("key Up");
    expect_number("axial.slice", slice, 0); /* the bar has been left */
    /* From the menu beside it, which is open before another key comes. */
    hands("key --delay 150 2");
    expect_number("window.width", 600, 0);
    hands("key --delay 300 F10 Down");
    nap(500);
    hands("key Right");
    nap(1500);
    hands("key Return");
    expect_number("window.width", 2000, 0);
    hands("key Down");
    expect_number("axial.slice", slice - 1, 0);
    hands("key Up");
    expect_number("axial.slice", slice, 0);
}

static void what_was_chosen_is_there_again(void **state) {
    (void)state;
    need_window();
    hands("key t"); /* no text on the panes */
    double down = number_now("shell.split.1");
    hands("key ctrl+q");
    assert_int_equal(wait_for_end(), 0);
    start_viewer(PHANTOM);
    expect_text("phase", "ready");
    expect_text("shell.theme", "light");
    expect_number("shell.split.0", 0.5, 0);
    expect_number("shell.split.1", down, 1e-12);
    expect_number("shell.panel", 368, 0);
    expect_number("shell.recent", 1, 0);
    assert_close(number_now("panes.volume.0") + number_now("panes.volume.2"), 1100, 0); /* the window's size */
    hands("key ctrl+q");
    assert_int_equal(wait_for_end(), 0);
}

static void a_damaged_file_is_told_once(void **state) {
    (void)state;
    need_window();
    write_file(FOLDER "/config/angioscope/viewer.json", "{ not json");
    for (int i = 0; i < 2; i++) {
        start_viewer(PHANTOM " 2>" FOLDER "/said");
        expect_text("phase", "ready");
        expect_text("shell.theme", "dark");
        hands("key ctrl+q");
        assert_int_equal(wait_for_end(), 0);
        int found = system("grep -q 'viewer.json.*defaults' " FOLDER "/said");
        assert_int_equal(found == 0, i == 0);
    }
}

/* Where the folder cannot be made, here since a file has its name, the viewer works all the same. */
static void without_a_place_nothing_is_remembered(void **state) {
    (void)state;
    need_window();
    write_file(FOLDER "/taken", "");
    setenv("XDG_CONFIG_HOME", FOLDER "/taken", 1);
    start_viewer(PHANTOM " 2>" FOLDER "/said");
    expect_text("phase", "ready");
    expect_text("shell.theme", "dark");
    hands("key ctrl+q");
    assert_int_equal(wait_for_end(), 0);
    /* Said once, and that is all. */
    assert_int_equal(system("test $(grep -c 'will be forgotten' " FOLDER "/said) = 1"), 0);
    assert_int_equal(system("test $(wc -l < " FOLDER "/said) = 1"), 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_command_is_found_by_its_name),
        cmocka_unit_test(the_light_theme_leaves_pictures_alone),
        cmocka_unit_test(gaps_follow_the_hand),
        cmocka_unit_test(keys_alone_do_everything),
        cmocka_unit_test(the_panel_takes_keys_from_tab_to_esc),
        cmocka_unit_test(what_was_chosen_is_there_again),
        cmocka_unit_test(a_damaged_file_is_told_once),
        cmocka_unit_test(without_a_place_nothing_is_remembered),
    };
    return cmocka_run_group_tests(tests, opening, close_display);
}
