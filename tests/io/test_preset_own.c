/* The user's own presets: their names, and their folder beside the installed one. */
#include "tests/core/fixtures.h"

#include "io/preset/preset.h"
#include "io/preset/preset_own.h"

#include <stdlib.h>
#include <string.h>

#define FOLDER ANG_TEST_TMP "/preset-own"

static void names_become_files(void **state) {
    (void)state;
    static const char *const good[] = {"a", "my head", "CTA 2", "kopf-gef\xc3\xa4\xc3\x9f", "a.b", "json"};
    static const char *const bad[] = {"",   " a",   "a ",    ".a",   "a.",    "-a",        "a/b",
                                      "..", "a\nb", "a\x7f", "\xff", "\xc3(", "head.json", "\xc3"};
    for (size_t i = 0; i < sizeof good / sizeof *good; i++) assert_true(ang_preset_name_check(good[i], NULL));
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        ang_error err = {0};
        assert_false(ang_preset_name_check(bad[i], &err));
        assert_int_equal(err.code, ANG_USAGE);
        assert_true(strlen(err.message) > 10);
    }
    char name[ANG_PRESET_NAME_LENGTH + 2];
    memset(name, 'x', sizeof name);
    name[ANG_PRESET_NAME_LENGTH] = '\0';
    assert_true(ang_preset_name_check(name, NULL));
    name[ANG_PRESET_NAME_LENGTH] = 'x';
    name[ANG_PRESET_NAME_LENGTH + 1] = '\0';
    assert_false(ang_preset_name_check(name, NULL));
}

static void they_are_saved_found_and_deleted(void **state) {
    (void)state;
    static const char text[] = "{\"description\": \"mine\", \"points\": [[100, 1, 0, 0, 0.5]]}";
    char path[4096];
    assert_int_equal(system("rm -rf " FOLDER), 0);
    setenv("XDG_CONFIG_HOME", FOLDER, 1);
    assert_string_equal(ang_preset_own_folder(), FOLDER "/angioscope/presets");
    assert_false(ang_preset_own_exists("ct-bone"));
    assert_true(ang_preset_own_save("ct-bone", text, path, sizeof path, NULL));
    assert_true(ang_preset_own_exists("ct-bone"));
    const char *const folders[] = {ang_preset_own_folder(), ANG_PRESETS, NULL};
    ang_preset *preset = ang_preset_find("ct-bone", folders, NULL);
    assert_non_null(preset);
    assert_string_equal(preset->description, "mine"); /* not the installed one */
    ang_preset_free(preset);
    assert_false(ang_preset_own_save("a/b", text, path, sizeof path, NULL));
    assert_true(ang_preset_own_delete("ct-bone", NULL));
    ang_error err = {0};
    assert_false(ang_preset_own_delete("ct-bone", &err));
    assert_int_equal(err.code, ANG_OUTPUT);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(names_become_files),
        cmocka_unit_test(they_are_saved_found_and_deleted),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
