/* Loading small files written here, against what was written into them. */
#define FOLDER ANG_TEST_TMP "/load-files"
#include "tests/io/small_dicom.h"

static bool warned(const ang_load_report *report, const char *needle) {
    for (size_t i = 0; i < report->warnings.count; i++)
        if (strstr(report->warnings.text[i], needle)) return true;
    return false;
}

static void test_small_series(void **state) {
    (void)state;
    fresh_folder(FOLDER);
    for (int i = 0; i < 5; i++) { /* names run against positions; one slice is missing, one is twice there */
        form f = form_at(i < 3 ? i : i + 1, 1000 + 100 * i);
        char name[32];
        snprintf(name, sizeof name, "slice%d", 9 - i);
        small(name, &f);
        if (i == 1) small("again", &f);
    }
    FILE *stray = fopen(FOLDER "/notes.txt", "w");
    fputs("not an image\n", stray);
    fclose(stray);
    ang_load_report report;
    ang_volume *v = load(FOLDER, &report);
    assert_int_equal(v->dims[0], width);
    assert_int_equal(v->dims[1], height);
    assert_int_equal(v->dims[2], 6);
    assert_int_equal(report.slices_duplicate, 1);
    assert_int_equal(report.slices_missing, 1);
    assert_int_equal(report.gap_count, 1);
    assert_int_equal(report.gaps[0].after, 2);
    assert_float_equal(hu_at(v, 0, 0, 0), -24, 1e-9);
    assert_float_equal(hu_at(v, 4, 2, 2), 190, 1e-9);
    assert_float_equal(hu_at(v, 0, 0, 3), 226, 1e-9); /* between 176 and 276 */
    assert_float_equal(hu_at(v, 0, 0, 5), 376, 1e-9);
    assert_float_equal(v->affine.m[0][0], 0.25, 1e-9);
    assert_float_equal(v->affine.m[2][2], 1, 1e-9);
    uLong crc = crc32(0, NULL, 0);
    for (int i = 0; i < 5; i++) {
        form f = form_at(0, 1000 + 100 * i);
        crc = crc32(crc, (const Bytef *)f.pixels, sizeof f.pixels);
    }
    assert_int_equal(report.stored_crc32, crc);

    cJSON *json = ang_load_report_json(v, &report, false);
    char *text = cJSON_PrintUnformatted(json);
    assert_null(strstr(text, "JOHN"));
    assert_null(strstr(text, "1.2.3.4"));
    assert_non_null(strstr(text, "\"stored_crc32\""));
    free(text);
    cJSON_Delete(json);
    json = ang_load_report_json(v, &report, true);
    text = cJSON_PrintUnformatted(json);
    assert_non_null(strstr(text, "JOHN DOE HEAD"));
    free(text);
    cJSON_Delete(json);
    ang_volume_free(v);
    ang_load_report_clear(&report);
}

static void test_broken_slices_are_missing(void **state) {
    (void)state;
    fresh_folder(FOLDER);
    for (int i = 0; i < 5; i++) {
        form f = form_at(i, 1000 + 100 * i);
        f.cut = i == 2;
        char name[32];
        snprintf(name, sizeof name, "JOHN_DOE_%d", i);
        small(name, &f);
    }
    ang_load_report report;
    ang_volume *v = load(FOLDER, &report);
    assert_int_equal(v->dims[2], 5);
    assert_int_equal(report.slices_missing, 1);
    assert_float_equal(hu_at(v, 0, 0, 2), 176, 1e-9);
    bool named = false;
    for (size_t i = 0; i < report.warnings.count; i++) {
        named = named || (report.warnings.file[i] && strcmp(report.warnings.file[i], "JOHN_DOE_2") == 0);
        assert_null(strstr(report.warnings.text[i], "JOHN"));
    }
    assert_true(named);
    cJSON *json = ang_load_report_json(v, &report, false);
    char *text = cJSON_PrintUnformatted(json);
    assert_null(strstr(text, "JOHN"));
    free(text);
    cJSON_Delete(json);
    ang_volume_free(v);
    ang_load_report_clear(&report);

    ang_load_options strict = {.strict = true};
    ang_error err = {0};
    assert_null(ang_load(FOLDER, &strict, &report, NULL, &err));
    assert_int_equal(err.code, ANG_GEOMETRY);
    ang_load_report_clear(&report);
}

static void test_clear_errors(void **state) {
    (void)state;
    fresh_folder(FOLDER);
    form f = form_at(0, 1000);
    f.no_rows = true;
    small("000012.dcm", &f);
    must_fail(FOLDER "/000012.dcm", ANG_INPUT, "000012.dcm: (0028,0010) Rows is missing");
    f.no_rows = false;
    f.cut = true;
    small("cut.dcm", &f);
    must_fail(FOLDER "/cut.dcm", ANG_INPUT, "cut.dcm: (7FE0,0010) PixelData is cut off");
    must_fail(FOLDER, ANG_INPUT, "none of 2 DICOM files");
    must_fail(FOLDER "/nowhere", ANG_INPUT, "nowhere");
    must_fail("/dev/null", ANG_INPUT, "neither a file nor a folder");
    fresh_folder(FOLDER);
    must_fail(FOLDER, ANG_INPUT, "there is no file in it");
}

static void test_rescale_by_slice(void **state) {
    (void)state;
    fresh_folder(FOLDER);
    for (int i = 0; i < 4; i++) {
        form f = form_at(i, 1000);
        f.slope = i % 2 ? "2" : "1";
        f.intercept = i % 2 ? "-2000" : "-1024";
        char name[8];
        snprintf(name, sizeof name, "%d", i);
        small(name, &f);
    }
    ang_load_report report;
    ang_volume *v = load(FOLDER, &report);
    for (int z = 0; z < 4; z++) {
        for (int x = 0; x < width; x++)
            assert_float_equal(hu_at(v, x, 0, z), (z % 2 ? 2 * (1000 + x) - 2000 : 1000 + x - 1024), 1e-9);
    }
    assert_float_equal(report.rescale_error_hu, 0, 1e-12);
    assert_float_equal(ang_volume_hu(v, v->minimum), -24, 1e-9);
    assert_float_equal(ang_volume_hu(v, v->maximum), 28, 1e-9);
    ang_volume_free(v);
    ang_load_report_clear(&report);

    fresh_folder(FOLDER);
    form f = form_at(0, 1000);
    f.slope = "-1";
    f.intercept = "0";
    f.photometric = "MONOCHROME1";
    small("negative", &f);
    v = load(FOLDER, &report);
    assert_true(v->slope > 0);
    assert_float_equal(hu_at(v, 3, 1, 0), -1008, 1e-9);
    assert_true(report.assumptions.count >= 2);
    ang_volume_free(v);
    ang_load_report_clear(&report);
}

static void test_declared_padding(void **state) {
    (void)state;
    fresh_folder(FOLDER);
    for (int i = 0; i < 3; i++) {
        form f = form_at(i, 0);
        f.is_signed = f.has_padding = true;
        f.padding = 63536; /* -2000 in signed data */
        f.intercept = "0";
        f.pixels[7] = (uint16_t)-2000;
        char name[8];
        snprintf(name, sizeof name, "%d", i);
        small(name, &f);
    }
    ang_load_report report;
    ang_volume *v = load(FOLDER, &report);
    assert_true(report.padding_declared);
    assert_int_equal(v->padding_count, 3);
    assert_float_equal(report.padding_hu, -2000, 0);
    assert_float_equal(hu_at(v, 2, 1, 1), -1000, 1e-9);
    assert_true(ang_volume_is_padding(v, 15 + 7));
    assert_false(ang_volume_is_padding(v, 15 + 8));
    assert_float_equal(ang_volume_hu(v, v->minimum), 0, 1e-9);
    ang_volume_free(v);
    ang_load_report_clear(&report);
}

/* One declared value does not switch off the search for what fills the corners. */
static void test_declared_and_found_padding(void **state) {
    (void)state;
    fresh_folder(FOLDER);
    for (int i = 0; i < 3; i++) {
        form f = form_at(i, 1000);
        f.is_signed = f.has_padding = true;
        f.padding = 63536;
        f.intercept = "0";
        f.pixels[0] = f.pixels[4] = f.pixels[10] = f.pixels[14] = (uint16_t)-3000;
        if (i == 1) f.pixels[7] = (uint16_t)-2000;
        char name[8];
        snprintf(name, sizeof name, "%d", i);
        small(name, &f);
    }
    ang_load_report report;
    ang_volume *v = load(FOLDER, &report);
    assert_true(report.padding_declared && report.padding_found);
    assert_float_equal(report.padding_hu, -2000, 0);
    assert_float_equal(report.padding_found_hu, -3000, 0);
    assert_int_equal(v->padding_count, 13);
    assert_float_equal(hu_at(v, 0, 0, 0), -1000, 0);
    assert_float_equal(hu_at(v, 2, 1, 1), -1000, 0);
    assert_float_equal(ang_volume_hu(v, v->minimum), 1001, 0);
    assert_float_equal(ang_volume_hu(v, v->maximum), 1013, 0);
    ang_volume_free(v);
    ang_load_report_clear(&report);
}

/* Unsigned values with intercept 0 start at water: padding must be air all the same. */
static void test_padding_below_the_first_value(void **state) {
    (void)state;
    for (int full = 0; full < 2; full++) {
        fresh_folder(FOLDER);
        form f = form_at(0, 100);
        f.intercept = "0";
        f.has_padding = true;
        f.padding = f.pixels[7] = 4095;
        if (full) f.pixels[8] = 65535; /* no room below */
        small("a", &f);
        ang_load_report report;
        ang_volume *v = load(FOLDER, &report);
        assert_float_equal(hu_at(v, 2, 1, 0), full ? 0 : -1000, 0);
        assert_float_equal(hu_at(v, 1, 1, 0), 106, 0);
        assert_float_equal(ang_volume_hu(v, v->minimum), 100, 0);
        assert_float_equal(report.slope, 1, 0);
        assert_float_equal(report.intercept, 0, 0); /* the file's own, whatever the volume's is */
        assert_int_equal(warned(&report, "16 bits hold no value for -1000 HU"), full);
        ang_volume_free(v);
        ang_load_report_clear(&report);
    }
}

static void test_padding_at_a_tie(void **state) {
    (void)state;
    fresh_folder(FOLDER);
    form f = form_at(0, 100);
    f.slope = "2";
    f.intercept = "-1021"; /* -1000 HU lies half way between 10 and 11 */
    f.has_padding = true;
    f.padding = 3;
    f.pixels[7] = 3;
    small("a", &f);
    ang_load_report report;
    ang_volume *v = load(FOLDER, &report);
    assert_true(report.padding_declared);
    assert_true(ang_volume_is_padding(v, 7));
    assert_int_equal(v->data[7], ang_volume_padding_value(v));
    assert_int_equal(v->data[7], 11);
    ang_volume_free(v);
    ang_load_report_clear(&report);
}

/* A file that cannot be decoded, at the position of a good one, before or after it in order. */
static void test_damaged_double_is_left_out(void **state) {
    (void)state;
    for (int order = 0; order < 2; order++) {
        for (int other_map = 0; other_map < 2; other_map++) {
            fresh_folder(FOLDER);
            for (int i = 0; i < 4; i++) {
                form f = form_at(i, 1000 + 100 * i);
                f.instance = 10 + i;
                char name[16];
                snprintf(name, sizeof name, "slice%d", i);
                small(name, &f);
            }
            form bad = form_at(2, 0);
            bad.damaged = true;
            bad.instance = order ? 99 : 1;
            if (other_map) bad.slope = "3";
            small("JOHN_DOE", &bad);
            ang_load_report report;
            ang_volume *v = load(FOLDER, &report);
            assert_int_equal(report.series_count, 1);
            assert_string_equal(report.series[0].remark, "");
            assert_int_equal(v->dims[2], 4);
            assert_int_equal(report.slices_missing, 0);
            assert_int_equal(report.slices_duplicate, 0);
            assert_float_equal(hu_at(v, 0, 0, 2), 176, 1e-9);
            assert_int_equal(report.warnings.count, 1);
            assert_string_equal(report.warnings.file[0], "JOHN_DOE");
            assert_non_null(strstr(report.warnings.text[0], "damaged"));
            ang_volume_free(v);
            ang_load_report_clear(&report);
        }
    }
}

static void test_doubles_without_orientation_or_position(void **state) {
    (void)state;
    for (int missing = 0; missing < 2; missing++) {
        fresh_folder(FOLDER);
        for (int i = 0; i < 4; i++) {
            form f = form_at(i < 3 ? i : 1, 1000 + 100 * (i < 3 ? i : 1)); /* the last is the second again */
            f.no_orientation = missing == 0;
            f.no_position = missing == 1;
            char name[16];
            snprintf(name, sizeof name, "slice%d", i);
            small(name, &f);
        }
        ang_load_report report;
        ang_volume *v = load(FOLDER, &report);
        assert_int_equal(v->dims[2], 3);
        assert_int_equal(report.slices_duplicate, 1);
        assert_float_equal(hu_at(v, 0, 0, 1), 76, 1e-9);
        assert_float_equal(hu_at(v, 0, 0, 2), 176, 1e-9);
        ang_volume_free(v);
        ang_load_report_clear(&report);
    }
}

static void test_invalid_spacing(void **state) {
    (void)state;
    fresh_folder(FOLDER);
    form f = form_at(0, 100);
    f.spacing = "0\\0";
    small("a", &f);
    ang_load_report report;
    ang_volume *v = load(FOLDER, &report);
    assert_int_equal(report.warnings.count, 1);
    assert_non_null(strstr(report.warnings.text[0], "(0028,0030) PixelSpacing is invalid"));
    ang_volume_free(v);
    ang_load_report_clear(&report);
    f.spacing = "";
    small("a", &f);
    v = load(FOLDER, &report);
    assert_non_null(strstr(report.warnings.text[0], "(0028,0030) PixelSpacing is missing"));
    ang_volume_free(v);
    ang_load_report_clear(&report);
}

/* "1,5" is no decimal string: its first digits are no value. */
static void test_numbers_with_junk_behind_them(void **state) {
    (void)state;
    static const struct {
        form form;
        const char *needle; /* NULL: sound */
    } cases[] = {{{.spacing = "1,5\\1,5"}, "(0028,0030) PixelSpacing is invalid"},
                 {{.spacing = "1.5mm\\1.5"}, "(0028,0030) PixelSpacing is invalid"},
                 {{.position = "0,5\\0\\0,5"}, "(0020,0032) ImagePositionPatient is invalid"},
                 {{.orientation = "1\\0\\0\\0\\1\\0x"}, "(0020,0037) ImageOrientationPatient is invalid"},
                 {{.intercept = "-1024 HU"}, "(0028,1052) RescaleIntercept is invalid in 2 slices: 0 is taken"},
                 {{.slope = "1e"}, "(0028,1053) RescaleSlope is invalid in 2 slices: 1 is taken"},
                 {{.slope = "0x1"}, "(0028,1053) RescaleSlope is invalid"},
                 {{.spacing = " 5.0e-1 \\+.25", .slope = "10E-1 ", .intercept = " -1024. "}, NULL}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        fresh_folder(FOLDER);
        for (int z = 0; z < 2; z++) {
            form f = cases[i].form;
            f.instance = z;
            f.z = z;
            small(z ? "b" : "a", &f);
        }
        ang_load_report report;
        ang_volume *v = load(FOLDER, &report);
        bool as_wanted = cases[i].needle ? warned(&report, cases[i].needle) : report.warnings.count == 0;
        if (!as_wanted) fail_msg("case %zu: no %s", i, cases[i].needle ? cases[i].needle : "silence");
        if (!cases[i].needle) {
            assert_float_equal(v->affine.m[0][0], 0.25, 1e-12);
            assert_float_equal(v->affine.m[1][1], 0.5, 1e-12);
            assert_float_equal(v->slope, 1, 0);
            assert_float_equal(hu_at(v, 0, 0, 0), -1024, 1e-12);
        }
        ang_volume_free(v);
        ang_load_report_clear(&report);
    }
    fresh_folder(FOLDER); /* one of a series: left out, said and interpolated */
    for (int i = 0; i < 5; i++) {
        form f = form_at(i, 1000 + 100 * i);
        if (i == 2) f.position = "0\\0\\2,0";
        char name[8];
        snprintf(name, sizeof name, "%d", i);
        small(name, &f);
    }
    ang_load_report report;
    ang_volume *v = load(FOLDER, &report);
    assert_int_equal(report.slices_missing, 1);
    assert_int_equal(report.series_count, 2);
    assert_string_equal(report.series[1].remark, "(0020,0032) ImagePositionPatient is invalid");
    ang_volume_free(v);
    ang_load_report_clear(&report);
}

static bool stop_at_once(void *context, const char *what, double fraction) {
    (void)what, (void)fraction;
    atomic_fetch_add((atomic_int *)context, 1);
    return false;
}

static void test_interrupt(void **state) {
    (void)state;
    fresh_folder(FOLDER);
    form f = form_at(0, 0);
    small("a", &f);
    atomic_int calls = 0;
    ang_progress progress = {stop_at_once, &calls};
    ang_load_report report;
    ang_error err = {0};
    assert_null(ang_load(FOLDER, NULL, &report, &progress, &err));
    assert_int_equal(err.code, ANG_INTERRUPTED);
    assert_true(calls > 0);
    ang_load_report_clear(&report);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_small_series),
        cmocka_unit_test(test_broken_slices_are_missing),
        cmocka_unit_test(test_clear_errors),
        cmocka_unit_test(test_rescale_by_slice),
        cmocka_unit_test(test_declared_padding),
        cmocka_unit_test(test_declared_and_found_padding),
        cmocka_unit_test(test_padding_below_the_first_value),
        cmocka_unit_test(test_padding_at_a_tie),
        cmocka_unit_test(test_damaged_double_is_left_out),
        cmocka_unit_test(test_doubles_without_orientation_or_position),
        cmocka_unit_test(test_invalid_spacing),
        cmocka_unit_test(test_numbers_with_junk_behind_them),
        cmocka_unit_test(test_interrupt),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
