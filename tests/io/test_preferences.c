/* What the viewer remembers comes back, and no file of preferences stops it. */
#include "tests/core/fixtures.h"

#include "io/session/preferences.h"

#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#define FOLDER ANG_TEST_TMP "/preferences"
#define FILE_  FOLDER "/deep/angioscope/viewer.json"

static int clean(void **state) {
    (void)state;
    return system("rm -rf '" FOLDER "' && mkdir -p '" FOLDER "'");
}

static void write_text(const char *path, const char *text) {
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fputs(text, file);
    fclose(file);
}

static void expect_same(const ang_preferences *a, const ang_preferences *b) {
    assert_int_equal(a->light_theme, b->light_theme);
    assert_close(a->split_across, b->split_across, 1e-15);
    assert_close(a->split_down, b->split_down, 1e-15);
    assert_close(a->panel_width, b->panel_width, 1e-12);
    assert_int_equal(a->panel_hidden, b->panel_hidden);
    assert_int_equal(a->corner_text, b->corner_text);
    assert_int_equal(a->crosshair, b->crosshair);
    assert_int_equal(a->window_width, b->window_width);
    assert_int_equal(a->window_height, b->window_height);
    assert_int_equal(a->recent_count, b->recent_count);
    for (int i = 0; i < a->recent_count; i++) assert_string_equal(a->recent[i], b->recent[i]);
}

static void they_come_back(void **state) {
    (void)state;
    static ang_preferences written, read;
    written = (ang_preferences){.light_theme = true,
                                .split_across = 0.3125,
                                .split_down = 0.7,
                                .panel_width = 411,
                                .panel_hidden = true,
                                .window_width = 1600,
                                .window_height = 900,
                                .recent_count = 2,
                                .recent = {"/data/\"odd\" näme\\x", "/data/b"}};
    assert_true(ang_preferences_write(FILE_, &written, NULL)); /* the folder is made */
    assert_true(ang_preferences_read(FILE_, &read, NULL));
    expect_same(&read, &written);
    written.light_theme = false;
    written.recent_count = 0;
    assert_true(ang_preferences_write(FILE_, &written, NULL));
    assert_true(ang_preferences_read(FILE_, &read, NULL));
    expect_same(&read, &written);
}

static void without_a_file_they_are_the_defaults(void **state) {
    (void)state;
    static ang_preferences read;
    assert_true(ang_preferences_read(FOLDER "/none/viewer.json", &read, NULL));
    expect_same(&read, &ang_preferences_default);
}

/* The sentence names the file. */
static void a_damaged_file_gives_a_sentence_and_the_defaults(void **state) {
    (void)state;
    static const char *const damaged[] = {"", "{", "{\"theme\": \"light\", ", "[1, 2]", "7", "\x01\x02\xff\xfe"};
    for (size_t i = 0; i < sizeof damaged / sizeof *damaged; i++) {
        static ang_preferences read;
        ang_error err = {0};
        write_text(FOLDER "/damaged.json", damaged[i]);
        assert_false(ang_preferences_read(FOLDER "/damaged.json", &read, &err));
        assert_non_null(strstr(err.message, "damaged.json"));
        expect_same(&read, &ang_preferences_default);
    }
    static ang_preferences read;
    ang_error err = {0};
    assert_false(ang_preferences_read(FOLDER, &read, &err)); /* a folder */
    expect_same(&read, &ang_preferences_default);
}

static void what_cannot_be_meant_is_passed_over(void **state) {
    (void)state;
    static ang_preferences read;
    write_text(FOLDER "/odd.json",
               "{\"theme\": 3, \"split_across\": 7, \"split_down\": \"x\", \"panel_width\": -1, \"corner_text\": 0,"
               " \"window_width\": 1e99, \"window_height\": 700, \"crosshair\": false, \"of_later\": {},"
               " \"recent\": [1, \"relative\", null, \"/a\", \"/b\", \"/c\", \"/d\", \"/e\", \"/f\", \"/g\", \"/h\","
               " \"/i\", \"/j\", \"/k\", \"/l\"]}");
    assert_true(ang_preferences_read(FOLDER "/odd.json", &read, NULL));
    ang_preferences expected = ang_preferences_default;
    expected.crosshair = false;
    expected.window_height = 700;
    expected.recent_count = 10;
    for (int i = 0; i < 10; i++) snprintf(expected.recent[i], sizeof expected.recent[i], "/%c", 'a' + i);
    expect_same(&read, &expected);
    char text[2 * ANG_RECENT_PATH];
    int used = snprintf(text, sizeof text, "{\"recent\": [\"/");
    memset(text + used, 'x', ANG_RECENT_PATH);
    strcpy(text + used + ANG_RECENT_PATH, "\"]}");
    write_text(FOLDER "/odd.json", text);
    assert_true(ang_preferences_read(FOLDER "/odd.json", &read, NULL));
    assert_int_equal(read.recent_count, 0);
}

/* A folder's place is taken by a file: as for a folder that may not be written, also for root. */
static void where_nothing_can_be_written_a_sentence_says_so(void **state) {
    (void)state;
    ang_error err = {0};
    write_text(FOLDER "/taken", "");
    assert_false(ang_preferences_write(FOLDER "/taken/angioscope/viewer.json", &ang_preferences_default, &err));
    assert_int_equal(err.code, ANG_OUTPUT);
    assert_non_null(strstr(err.message, "taken"));
    assert_int_equal(access(FOLDER "/taken/angioscope", F_OK), -1);
}

static void they_lie_where_xdg_says(void **state) {
    (void)state;
    char path[256];
    setenv("HOME", "/home/someone", 1);
    setenv("XDG_CONFIG_HOME", "/etc/other", 1);
    assert_true(ang_preferences_path(path, sizeof path));
    assert_string_equal(path, "/etc/other/angioscope/viewer.json");
    setenv("XDG_CONFIG_HOME", "relative", 1);
    assert_true(ang_preferences_path(path, sizeof path));
    assert_string_equal(path, "/home/someone/.config/angioscope/viewer.json");
    unsetenv("XDG_CONFIG_HOME");
    assert_true(ang_preferences_path(path, sizeof path));
    assert_string_equal(path, "/home/someone/.config/angioscope/viewer.json");
    assert_false(ang_preferences_path(path, 20));
    unsetenv("HOME");
    assert_false(ang_preferences_path(path, sizeof path));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(they_come_back),
        cmocka_unit_test(without_a_file_they_are_the_defaults),
        cmocka_unit_test(a_damaged_file_gives_a_sentence_and_the_defaults),
        cmocka_unit_test(what_cannot_be_meant_is_passed_over),
        cmocka_unit_test(where_nothing_can_be_written_a_sentence_says_so),
        cmocka_unit_test(they_lie_where_xdg_says),
    };
    return cmocka_run_group_tests(tests, clean, NULL);
}
