/* What reports say of files with awkward text: nothing of the patient, and always valid UTF-8. */
#define FOLDER ANG_TEST_TMP "/report"
#include "tests/io/small_dicom.h"

#include "io/text.h"

typedef struct reported {
    ang_error err;
    ang_load_report report;
    ang_volume *volume;
    char *json, *table;
} reported;

static reported report_of(const char *path, bool keep_phi) {
    reported r = {0};
    r.volume = ang_load(path, NULL, &r.report, NULL, &r.err);
    cJSON *json = ang_load_report_json(r.volume, &r.report, keep_phi);
    assert_non_null(json);
    r.json = cJSON_PrintUnformatted(json);
    cJSON_Delete(json);
    size_t size;
    FILE *out = open_memstream(&r.table, &size);
    ang_load_report_print(out, r.volume, &r.report, keep_phi);
    fclose(out);
    return r;
}

static void clear(reported *r) {
    ang_volume_free(r->volume);
    ang_load_report_clear(&r->report);
    free(r->json);
    free(r->table);
}

static void expect_in_both(const reported *r, const char *needle) {
    if (!strstr(r->json, needle)) print_message("no %s in %s\n", needle, r->json);
    if (!strstr(r->table, needle)) print_message("no %s in %s\n", needle, r->table);
    assert_non_null(strstr(r->json, needle));
    assert_non_null(strstr(r->table, needle));
}

static void expect_in_neither(const reported *r, const char *needle) {
    if (strstr(r->json, needle)) print_message("%s in %s\n", needle, r->json);
    if (strstr(r->table, needle)) print_message("%s in %s\n", needle, r->table);
    assert_null(strstr(r->json, needle));
    assert_null(strstr(r->table, needle));
}

static void expect_utf8(const char *text) {
    char *copy = strdup(text);
    assert_non_null(copy);
    for (char *c = copy; *c; c++)
        if (*c == '\n') *c = ' ';
    char *before = strdup(copy);
    ang_text_clean(copy);
    assert_string_equal(copy, before);
    free(before);
    free(copy);
}

static void test_text(void **state) {
    (void)state;
    char text[64];
    snprintf(text, sizeof text, "%s",
             "a\x1B[1m \xC3\xA4\xE2\x82\xAC\xF0\x9F\x98\x80 \xC3 \xE4 \xC0\x80 \xED\xA0\x80 \xC2\x9B \xE2\x82");
    ang_text_clean(text);
    assert_string_equal(text, "a?[1m \xC3\xA4\xE2\x82\xAC\xF0\x9F\x98\x80 ? ? ?? ??? ?? ??");
    ang_text_from_latin1("M\xFCller", text, sizeof text);
    assert_string_equal(text, "M\xC3\xBCller");
    ang_text_from_latin1("M\xFCller", text, 3); /* no half character */
    assert_string_equal(text, "M");
}

static void test_file_names_are_masked(void **state) {
    (void)state;
    fresh_folder(FOLDER);
    form f = form_at(0, 1000);
    small("a", &f);
    f = form_at(1, 1100);
    f.cut = true;
    small("Doe\": John.dcm", &f);
    small("M\xFCller.dcm", &f);
    reported r = report_of(FOLDER, false);
    assert_non_null(r.volume);
    expect_in_neither(&r, "Doe");
    expect_in_neither(&r, "John");
    expect_in_neither(&r, "ller");
    expect_in_both(&r, "a file: (7FE0,0010) PixelData is cut off");
    assert_non_null(strstr(r.table, "Warnings (--keep-phi names the files)\n"));
    assert_null(strstr(r.table, "Assumed (")); /* nothing is hidden there */
    clear(&r);
    r = report_of(FOLDER, true);
    assert_null(strstr(r.table, "--keep-phi"));
    expect_in_both(&r, "John.dcm");
    expect_in_both(&r, "M?ller.dcm");
    expect_utf8(r.json);
    expect_utf8(r.table);
    clear(&r);
}

static void test_header_text_is_not_repeated(void **state) {
    (void)state;
    fresh_folder(FOLDER);
    for (int i = 0; i < 3; i++) { /* a volume of an unknown modality */
        form f = form_at(i, 1000);
        f.modality = "DOE^JOHN";
        char name[8];
        snprintf(name, sizeof name, "%d", i);
        small(name, &f);
    }
    form f = form_at(9, 0); /* no image, nor a known kind of object */
    f.no_image = true;
    f.modality = "DOE^JANE";
    f.sop_class = "1.2.840.10008.5.1.4.1.1.19650101";
    small("object", &f);
    f.sop_class = "1.2.840.10008.5.1.4.1.1.104.1";
    small("document", &f);
    f = form_at(9, 0);
    f.image_type = "DERIVED\\SECONDARY\\DOE JIM";
    f.no_position = true;
    small("derived", &f);
    reported r = report_of(FOLDER, false);
    assert_non_null(r.volume);
    expect_in_neither(&r, "DOE");
    expect_in_neither(&r, "1965");
    expect_in_both(&r, "modality is other, not CT");
    expect_in_both(&r, "no image (other)");
    expect_in_both(&r, "no image (Encapsulated PDF)");
    expect_in_both(&r, "derived summary (other)");
    clear(&r);
}

static void test_descriptions_are_utf8(void **state) {
    (void)state;
    static const struct {
        const char *set, *text, *shown;
    } cases[] = {{"ISO_IR 100",
                  "Sch\xE4"
                  "del",
                  "Sch\xC3\xA4"
                  "del"},
                 {"ISO_IR 192",
                  "Sch\xC3\xA4"
                  "del",
                  "Sch\xC3\xA4"
                  "del"},
                 {"ISO_IR 192",
                  "Sch\xE4"
                  "del",
                  "Sch?del"},
                 {"ISO_IR 144",
                  "Sch\xE4"
                  "del",
                  "Sch?del"},
                 {NULL,
                  "Sch\xE4"
                  "del",
                  "Sch?del"}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        fresh_folder(FOLDER);
        form f = form_at(0, 1000);
        f.character_set = cases[i].set;
        f.description = cases[i].text;
        small("a", &f);
        reported r = report_of(FOLDER, true);
        expect_in_both(&r, cases[i].shown);
        expect_utf8(r.json);
        expect_utf8(r.table);
        clear(&r);
    }
}

/* For the screen alone. */
static void test_names_are_read_but_not_reported(void **state) {
    (void)state;
    fresh_folder(FOLDER);
    form f = form_at(0, 1000);
    f.character_set = "ISO_IR 100";
    f.patient = "M\xFCller^Eva";
    small("a", &f);
    ang_load_report report = {0};
    ang_volume *volume = ang_load(FOLDER, &(ang_load_options){0}, &report, NULL, NULL);
    assert_non_null(volume);
    assert_string_equal(report.series[0].patient, "M\xC3\xBCller^Eva");
    ang_volume_free(volume);
    ang_load_report_clear(&report);
    for (int keep = 0; keep < 2; keep++) {
        reported r = report_of(FOLDER, keep);
        expect_in_neither(&r, "Eva");
        clear(&r);
    }
}

static void test_person_names(void **state) {
    (void)state;
    static const char *const cases[][2] = {{"Doe^Jane", "Doe, Jane"},
                                           {"Doe^Jane^Q^Dr^PhD", "Doe, Jane Q"},
                                           {"Doe", "Doe"},
                                           {"Doe^^Q", "Doe, Q"},
                                           {"^Jane", "Jane"},
                                           {"Yamada^Tarou=\xE5\xB1\xB1^x", "Yamada, Tarou"},
                                           {"=\xE5\xB1\xB1", "\xE5\xB1\xB1"},
                                           {"", ""}};
    char text[64];
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        ang_person_name_print(cases[i][0], text, sizeof text);
        assert_string_equal(text, cases[i][1]);
    }
    ang_person_name_print("Doe^Jane", text, 6);
    assert_string_equal(text, "Doe, ");
    ang_person_name_print("D\xC3\xB6", text, 3); /* no half character */
    assert_string_equal(text, "D?");
}

static void test_what_is_not_loaded_is_listed(void **state) {
    (void)state;
    fresh_folder(FOLDER);
    form f = form_at(0, 1000);
    f.image_type = "ORIGINAL\\PRIMARY\\LOCALIZER";
    small("a", &f);
    reported r = report_of(FOLDER, false);
    assert_null(r.volume);
    assert_int_equal(r.err.code, ANG_INPUT);
    expect_in_both(&r, "localizer");
    assert_non_null(strstr(r.json, "\"name\":null"));
    assert_non_null(strstr(r.table, "not loaded"));
    clear(&r);
}

static void test_values_that_are_no_hounsfield_units(void **state) {
    (void)state;
    static const char *const modalities[] = {"CT", "MR"};
    for (int m = 0; m < 2; m++) {
        fresh_folder(FOLDER);
        form f = form_at(0, 1000);
        f.modality = modalities[m];
        f.has_padding = true;
        f.padding = 1000;
        small("a", &f);
        reported r = report_of(FOLDER, false);
        assert_non_null(r.volume);
        assert_int_equal(ang_load_report_hounsfield(&r.report), m == 0);
        const char *values = strstr(r.table, "Values\n"), *warnings = strstr(r.table, "Warnings\n");
        assert_non_null(values);
        assert_non_null(warnings);
        const char *unit = strstr(values, "HU");
        assert_true(m == 0 ? unit != NULL : !unit);
        assert_non_null(strstr(values, m == 0 ? "range        -23 to -10 HU\n" : "range        -23 to -10\n"));
        assert_non_null(strstr(r.json, "\"hu_range\"")); /* keys stay */
        clear(&r);
    }
}

/* Slices tilted by 36.87 degrees, the table along z: 0.8 of its way is the distance of the slices. */
static void tilted_series(const double *z, int count) {
    fresh_folder(FOLDER);
    for (int i = 0; i < count; i++) {
        form f = form_at(z[i], 1000 + 100 * i);
        f.orientation = "1\\0\\0\\0\\0.8\\-0.6";
        char name[8];
        snprintf(name, sizeof name, "%d", i);
        small(name, &f);
    }
}

static void expect_in_table(const reported *r, const char *needle) {
    if (!strstr(r->table, needle)) fail_msg("no %s in %s", needle, r->table);
}

static void test_distances_are_along_the_normal(void **state) {
    (void)state;
    static const double regular[] = {0, 5, 10}, missing[] = {0, 5, 10, 20}, irregular[] = {0, 5, 10, 13};
    tilted_series(regular, 3);
    reported r = report_of(FOLDER, false);
    assert_non_null(r.volume);
    assert_float_equal(ang_volume_spacing(r.volume, 2), 5, 1e-9); /* what rendering uses stays the affine's */
    assert_float_equal(r.report.series[0].spacing_mm[2], 4, 1e-9);
    expect_in_table(&r, "0.250 x 0.500 x 4.000 ");
    expect_in_table(&r, "voxel        0.2500 x 0.5000 x 4.0000 mm");
    cJSON *json = cJSON_Parse(r.json);
    const cJSON *spacing = cJSON_GetObjectItemCaseSensitive(json, "spacing_mm");
    assert_float_equal(cJSON_GetArrayItem(spacing, 2)->valuedouble, 4, 1e-9);
    cJSON_Delete(json);
    assert_null(strstr(r.table, "planes"));
    assert_null(strstr(r.table, "after resampling"));
    clear(&r);

    tilted_series(missing, 4);
    r = report_of(FOLDER, false);
    expect_in_table(&r, "4.000 to 8.000 mm, median 4.000 mm, mean 5.333 mm");
    expect_in_table(&r, "planes       5 in the volume, 4.000 mm apart: the 4 slices read and 1 interpolated");
    clear(&r);

    tilted_series(irregular, 4);
    r = report_of(FOLDER, false);
    expect_in_table(&r, "2.400 to 4.000 mm, median 4.000 mm, mean 3.467 mm");
    expect_in_table(&r, "planes       5 in the volume, 2.400 mm apart: resampled from the 4 slices read");
    expect_in_table(&r, "HU, after resampling");
    clear(&r);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_text),
        cmocka_unit_test(test_file_names_are_masked),
        cmocka_unit_test(test_header_text_is_not_repeated),
        cmocka_unit_test(test_descriptions_are_utf8),
        cmocka_unit_test(test_names_are_read_but_not_reported),
        cmocka_unit_test(test_person_names),
        cmocka_unit_test(test_what_is_not_loaded_is_listed),
        cmocka_unit_test(test_values_that_are_no_hounsfield_units),
        cmocka_unit_test(test_distances_are_along_the_normal),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
