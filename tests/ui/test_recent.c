/* The list of the last files. */
#include "tests/core/fixtures.h"

#include "ui/state/recent.h"

#include <string.h>

static void the_last_one_comes_first(void **state) {
    (void)state;
    static ang_recent recent;
    ang_recent_add(&recent, "/a");
    ang_recent_add(&recent, "/b");
    ang_recent_add(&recent, "/c");
    ang_recent_add(&recent, "/a");
    assert_int_equal(recent.count, 3);
    assert_string_equal(recent.path[0], "/a");
    assert_string_equal(recent.path[1], "/c");
    assert_string_equal(recent.path[2], "/b");
    ang_recent_add(&recent, recent.path[2]); /* one of its own */
    assert_string_equal(recent.path[0], "/b");
    assert_string_equal(recent.path[1], "/a");
    assert_string_equal(recent.path[2], "/c");
}

static void the_oldest_falls_out(void **state) {
    (void)state;
    static ang_recent recent;
    char name[16];
    for (int i = 0; i < 13; i++) {
        snprintf(name, sizeof name, "/%d", i);
        ang_recent_add(&recent, name);
    }
    assert_int_equal(recent.count, ANG_RECENT_MOST);
    assert_string_equal(recent.path[0], "/12");
    assert_string_equal(recent.path[9], "/3");
    ang_recent_add(&recent, "/3");
    assert_string_equal(recent.path[0], "/3");
    assert_string_equal(recent.path[9], "/4");
}

static void what_does_not_fit_is_left_out(void **state) {
    (void)state;
    static ang_recent recent;
    static char path[ANG_RECENT_SIZE + 1];
    memset(path, 'x', ANG_RECENT_SIZE);
    ang_recent_add(&recent, path);
    ang_recent_add(&recent, "");
    assert_int_equal(recent.count, 0);
    path[ANG_RECENT_SIZE - 1] = '\0';
    ang_recent_add(&recent, path);
    assert_int_equal(recent.count, 1);
}

static void lists_show_the_end_of_a_path(void **state) {
    (void)state;
    char text[128], path[200];
    assert_string_equal(ang_recent_short("/data/head", text, sizeof text), "/data/head");
    memset(path, 'a', 100);
    strcpy(path + 100, "/some/folder/series 1");
    assert_string_equal(ang_recent_short(path, text, sizeof text), "\u2026/some/folder/series 1");
    for (int i = 0; i < 99; i += 2) memcpy(path + i, "\u00e4", 2);
    strcpy(path + 100, "x");
    ang_recent_short(path, text, sizeof text);
    assert_true((text[3] & 0xc0) != 0x80); /* after the ellipsis a letter begins */
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_last_one_comes_first),
        cmocka_unit_test(the_oldest_falls_out),
        cmocka_unit_test(what_does_not_fit_is_left_out),
        cmocka_unit_test(lists_show_the_end_of_a_path),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
