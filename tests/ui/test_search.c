/* Commands are found by parts of their names, the likeliest first. */
#include "tests/core/fixtures.h"

#include "ui/state/search.h"

static void every_word_has_to_occur(void **state) {
    (void)state;
    assert_int_equal(ang_search_rank("", "View: Light theme"), 0);
    assert_int_equal(ang_search_rank("   ", "View: Light theme"), 0);
    assert_int_equal(ang_search_rank("view", "View: Light theme"), 0);
    assert_int_equal(ang_search_rank("THEME", "View: Light theme"), 1);
    assert_int_equal(ang_search_rank("ight", "View: Light theme"), 2);
    assert_int_equal(ang_search_rank("theme view", "View: Light theme"), 1);
    assert_int_equal(ang_search_rank(" th  li ", "View: Light theme"), 2);
    assert_int_equal(ang_search_rank("light dark", "View: Light theme"), -1);
    assert_int_equal(ang_search_rank("themes", "View: Light theme"), -1);
    assert_int_equal(ang_search_rank("x", ""), -1);
}

static void the_best_place_counts(void **state) {
    (void)state;
    assert_int_equal(ang_search_rank("e", "tree eel"), 1); /* within a word first, then at the start of one */
    assert_int_equal(ang_search_rank("ct", "Preset: ct-bone"), 1);
    assert_int_equal(ang_search_rank("bone", "Preset: ct-bone"), 1);
    assert_int_equal(ang_search_rank("10", "W 100 C 10"), 1);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_word_has_to_occur),
        cmocka_unit_test(the_best_place_counts),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
