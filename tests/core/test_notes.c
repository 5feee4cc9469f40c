/* Notes: the name of a file stays apart from what is said of it. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "core/base/notes.h"

#include <string.h>

static void names_stay_apart(void **state) {
    (void)state;
    ang_notes notes = {0}, all = {0};
    char line[ANG_NOTES_LINE];
    ang_notes_add(&notes, "%d of %d", 1, 2);
    ang_notes_add_file(&notes, "Doe\": John.dcm", "is cut off at %s", "byte 7");
    assert_int_equal(notes.count, 2);
    assert_null(notes.file[0]);
    assert_string_equal(notes.text[1], "is cut off at byte 7");
    assert_string_equal(ang_notes_line(&notes, 0, true, line, sizeof line), "1 of 2");
    assert_string_equal(ang_notes_line(&notes, 0, false, line, sizeof line), "1 of 2");
    assert_string_equal(ang_notes_line(&notes, 1, true, line, sizeof line),
                        "file \"Doe\": John.dcm\": is cut off at byte 7");
    assert_string_equal(ang_notes_line(&notes, 1, false, line, sizeof line), "a file: is cut off at byte 7");
    ang_notes_append(&all, &notes);
    ang_notes_append(&all, &notes);
    assert_int_equal(all.count, 2);
    assert_string_equal(all.file[1], "Doe\": John.dcm");
    ang_notes_clear(&notes);
    ang_notes_clear(&all);
}

static void repeats_are_dropped(void **state) {
    (void)state;
    ang_notes notes = {0};
    ang_notes_add(&notes, "same");
    ang_notes_add(&notes, "same");
    ang_notes_add_file(&notes, "a", "same");
    ang_notes_add_file(&notes, "b", "same");
    ang_notes_add_file(&notes, "b", "same");
    assert_int_equal(notes.count, 3);
    ang_notes_clear(&notes);
    assert_null(notes.text);
    assert_null(notes.file);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(names_stay_apart),
        cmocka_unit_test(repeats_are_dropped),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
