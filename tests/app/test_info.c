/* What `angioscope info` says of what it cannot load. */
#define FOLDER ANG_TEST_TMP "/info"
#include "tests/io/small_dicom.h"
/* after it */
#include "tests/app/program.h"

static void what_is_not_loaded_is_listed(void **state) {
    (void)state;
    fresh_folder(FOLDER);
    form f = form_at(0, 1000);
    f.image_type = "ORIGINAL\\PRIMARY\\LOCALIZER";
    small("a", &f);
    assert_int_equal(run("info --quiet " FOLDER " 2>&1"), 3);
    const char *table = strstr(output, "not a volume: localizer");
    assert_non_null(table);
    assert_non_null(strstr(table, "angioscope: ")); /* the error comes last */
    assert_int_equal(run("info --json " FOLDER " 2>/dev/null"), 3);
    cJSON *json = cJSON_Parse(output);
    assert_non_null(json);
    const cJSON *input = cJSON_GetObjectItemCaseSensitive(json, "input");
    const cJSON *series = cJSON_GetArrayItem(cJSON_GetObjectItemCaseSensitive(input, "series"), 0);
    assert_string_equal(cJSON_GetObjectItemCaseSensitive(series, "remark")->valuestring, "localizer");
    assert_true(cJSON_IsFalse(cJSON_GetObjectItemCaseSensitive(series, "chosen")));
    assert_null(cJSON_GetObjectItemCaseSensitive(input, "dims"));
    cJSON_Delete(json);
    assert_int_equal(run("info " FOLDER "/nowhere 2>/dev/null"), 3); /* nothing found, nothing listed */
    assert_string_equal(output, "");
}

static void wrong_raw_options_give_two(void **state) {
    (void)state;
    fresh_folder(FOLDER);
    form f = form_at(0, 1000);
    small("a", &f);
    assert_int_equal(run("info " FOLDER "/a --raw-type u8 --raw-dims 99999999999x1x1 2>&1"), 2);
    assert_non_null(strstr(output, "--raw-dims 99999999999x1x1"));
}

static void libraries_keep_quiet(void **state) {
    (void)state;
    fresh_folder(FOLDER);
    unsigned char header[352] = {92, 1};
    header[40] = 3; /* dim[0]; dim[1] is -3 */
    header[42] = 0xFD;
    header[43] = 0xFF;
    header[44] = header[46] = 2;
    header[70] = 2; /* uint8 */
    header[72] = 8;
    memcpy(header + 344, "n+1", 4);
    FILE *out = fopen(FOLDER "/bad.nii", "wb");
    assert_non_null(out);
    fwrite(header, 1, sizeof header, out);
    fclose(out);
    assert_int_equal(run("info --quiet " FOLDER "/bad.nii 2>&1"), 3);
    assert_int_equal(strncmp(output, "angioscope: bad.nii: ", 21), 0);
}

/* Names and headers of files move no cursor: what is said is one line. */
static void terminals_are_safe(void **state) {
    (void)state;
    static const char header[] = "NRRD0004\ntype: \033[31mred\033[0m\n\n";
    fresh_folder(FOLDER);
    FILE *out = fopen(FOLDER "/a\033[2Jb\nc.nrrd", "wb");
    assert_non_null(out);
    fwrite(header, 1, sizeof header - 1, out);
    fclose(out);
    assert_int_equal(run("info --quiet " FOLDER "/a*c.nrrd 2>&1"), 3);
    assert_string_equal(output, "angioscope: a?[2Jb?c.nrrd: its NRRD header says \"type: ?[31mred?[0m\", which is not "
                                "understood\n");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_is_not_loaded_is_listed),
        cmocka_unit_test(wrong_raw_options_give_two),
        cmocka_unit_test(libraries_keep_quiet),
        cmocka_unit_test(terminals_are_safe),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
