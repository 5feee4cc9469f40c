/* Loading raw and NIfTI files written here, and what the formats have in common. */
#define FOLDER ANG_TEST_TMP "/load-samples"
#include "tests/io/small_dicom.h"

static void write_file(const char *name, const void *bytes, size_t size) {
    char path[512];
    snprintf(path, sizeof path, FOLDER "/%s", name);
    FILE *out = fopen(path, "wb");
    assert_non_null(out);
    assert_int_equal(fwrite(bytes, 1, size, out), size);
    fclose(out);
}

static void test_raw(void **state) {
    (void)state;
    fresh_folder(FOLDER);
    int16_t values[24];
    for (int i = 0; i < 24; i++) values[i] = (int16_t)(100 * i - 1000);
    write_file("v.raw", values, sizeof values);
    ang_load_options options = {.raw_dims = "2x3x4", .raw_type = "i16", .raw_spacing = "1,2,0.5"};
    ang_load_report report;
    ang_error err = {0};
    ang_volume *v = ang_load(FOLDER "/v.raw", &options, &report, NULL, &err);
    assert_non_null(v);
    assert_float_equal(hu_at(v, 1, 2, 3), 1300, 1e-9);
    assert_float_equal(v->affine.m[1][1], 2, 1e-12);
    ang_vec3 centre = ang_volume_centre(v);
    assert_float_equal(ang_vec3_length(centre), 0, 1e-12);
    ang_volume_free(v);
    ang_load_report_clear(&report);

    options.raw_dims = "2x3x5";
    assert_null(ang_load(FOLDER "/v.raw", &options, &report, NULL, &err));
    assert_int_equal(err.code, ANG_INPUT);
    ang_load_report_clear(&report);
    static const char *const wrong_dims[] = {
        "2x3", "2000000x2000000x2000000", "99999999999x1x1", "4294967297x1x1", "2x3x4x", "2x3x-4", "2x 3x4", "0x3x4"};
    for (size_t i = 0; i < sizeof wrong_dims / sizeof *wrong_dims; i++) {
        options.raw_dims = wrong_dims[i];
        assert_null(ang_load(FOLDER "/v.raw", &options, &report, NULL, &err));
        assert_int_equal(err.code, ANG_USAGE);
        assert_non_null(strstr(err.message, wrong_dims[i]));
        ang_load_report_clear(&report);
    }

    float floats[8] = {-1000.5F, 0, 1000.25F, NAN, INFINITY, -INFINITY, 3, 4};
    gzFile gz = gzopen(FOLDER "/f.raw.gz", "wb");
    gzwrite(gz, floats, sizeof floats);
    gzclose(gz);
    const char sidecar[] = "{\"dims\": [2, 2, 2], \"type\": \"f32\", \"spacing\": [1, 1, 3]}";
    write_file("f.raw.json", sidecar, sizeof sidecar - 1);
    v = load(FOLDER "/f.raw.gz", &report);
    assert_int_equal(report.nan_count, 1);
    assert_int_equal(report.inf_count, 2);
    assert_float_equal(report.quantisation_hu, 2000.75 / 65535, 1e-6);
    assert_float_equal(hu_at(v, 0, 1, 0), 1000.25, 0.02);
    assert_float_equal(hu_at(v, 1, 1, 0), -1000.5, 0.02); /* not a number: the least */
    assert_float_equal(hu_at(v, 0, 0, 1), 1000.25, 0.02);
    assert_float_equal(hu_at(v, 1, 0, 1), -1000.5, 0.02);
    assert_float_equal(hu_at(v, 0, 1, 1), 3, 0.02);
    assert_float_equal(ang_volume_spacing(v, 2), 3, 1e-9);
    ang_volume_free(v);
    ang_load_report_clear(&report);
    write_file("f.raw.json", "{\"dims\": 3}", 11);
    must_fail(FOLDER "/f.raw.gz", ANG_USAGE, "f.raw.json:1: dims");
    static const struct {
        const char *text, *needle;
    } wrong[] = {
        {"{\"type\": \"u8\",\n\"dims\": [2, 0, 2]}", "f.raw.json:2: dims[1] is 0"},
        {"{\"dims\": [2, 2.5, 2]}", "f.raw.json:1: dims must be"},
        {"{\"dims\": [2, 2, 2],\n\n\"type\": \"u9\"}", "f.raw.json:3: type must be"},
        {"{\"dims\": \"2x2x2\", \"type\": \"u8\",\n\"spacing\": [1, -1, 1]}", "f.raw.json:2: spacing[1] is -1"},
        {"[1, 2]", "f.raw.json:1: must be an object"},
        {"{\"dims\": ", "f.raw.json:1: is not valid JSON"}};
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        write_file("f.raw.json", wrong[i].text, strlen(wrong[i].text));
        must_fail(FOLDER "/f.raw.gz", ANG_USAGE, wrong[i].needle);
    }
}

/* The stored values that slope and intercept make of the HU must be those that the checksum is of. */
static void expect_map(const char *path, const ang_load_options *options, double slope, double intercept) {
    ang_load_report report;
    ang_error err = {0};
    ang_volume *v = ang_load(path, options, &report, NULL, &err);
    if (!v) fail_msg("%s: %s", path, err.message);
    if (!isnan(slope)) assert_float_equal(report.slope, slope, 1e-12);
    if (!isnan(intercept)) assert_float_equal(report.intercept, intercept, 1e-9);
    uLong crc = crc32(0, NULL, 0);
    for (size_t i = 0; i < ang_volume_count(v); i++) {
        double stored = (ang_volume_hu(v, v->data[i]) - report.intercept) / report.slope;
        uint16_t word = (uint16_t)(lrint(stored) + (report.signed_stored ? 32768 : 0));
        assert_float_equal(stored, (double)lrint(stored), 1e-6);
        crc = crc32(crc, (const Bytef *)&word, sizeof word);
    }
    assert_int_equal(crc, report.stored_crc32);
    ang_volume_free(v);
    ang_load_report_clear(&report);
}

static void test_maps_belong_to_the_checksum(void **state) {
    (void)state;
    static const struct {
        bool is_signed;
        const char *slope, *intercept;
    } dicom[] = {{false, "1", "-1024"}, {true, "2", "-100"}, {false, "-1", "500"}, {true, "-0.5", "3"}};
    for (size_t i = 0; i < sizeof dicom / sizeof *dicom; i++) {
        fresh_folder(FOLDER);
        for (int z = 0; z < 2; z++) {
            form f = form_at(z, 100 + z);
            f.is_signed = dicom[i].is_signed;
            if (f.is_signed) f.pixels[3] = (uint16_t)-7;
            f.slope = dicom[i].slope;
            f.intercept = dicom[i].intercept;
            small(z ? "b" : "a", &f);
        }
        expect_map(FOLDER, NULL, atof(dicom[i].slope), atof(dicom[i].intercept));
    }

    form f = form_at(1, 100); /* a slice with another map: none for the file, the volume's is told as such */
    f.slope = "3";
    small("b", &f);
    ang_load_report report;
    ang_volume *v = load(FOLDER, &report);
    assert_true(isnan(report.slope) && isnan(report.intercept));
    cJSON *json = ang_load_report_json(v, &report, false);
    assert_true(cJSON_IsNull(cJSON_GetObjectItemCaseSensitive(json, "slope")));
    const cJSON *map = cJSON_GetObjectItemCaseSensitive(json, "volume_map");
    assert_float_equal(cJSON_GetObjectItemCaseSensitive(map, "slope")->valuedouble, v->slope, 1e-12);
    cJSON_Delete(json);
    ang_volume_free(v);
    ang_load_report_clear(&report);

    static const int16_t words[8] = {-5, 0, 7, 300, -300, 1, 2, 3};
    static const float floats[8] = {-5.5F, 0, 7, 300, -300, 1, 2, 3.25F};
    write_file("i16.raw", words, sizeof words);
    write_file("f32.raw", floats, sizeof floats);
    expect_map(FOLDER "/i16.raw", &(ang_load_options){.raw_dims = "2x2x2", .raw_type = "i16"}, 1, 0);
    expect_map(FOLDER "/i16.raw", &(ang_load_options){.raw_dims = "2x2x2", .raw_type = "u16"}, 1, 0);
    expect_map(FOLDER "/f32.raw", &(ang_load_options){.raw_dims = "2x2x2", .raw_type = "f32"}, NAN, NAN);
}

static void must_refuse(const char *path, const ang_load_options *options, ang_code code, const char *needle) {
    ang_load_report report;
    ang_error err = {0};
    assert_null(ang_load(path, options, &report, NULL, &err));
    if (err.code != code || !strstr(err.message, needle)) fail_msg("%d, %s", (int)err.code, err.message);
    ang_load_report_clear(&report);
}

#ifdef ANG_WITH_NIFTI

/* A NIfTI-1 header by its byte offsets, little endian. */
static void nifti_header(uint8_t h[352], const int16_t dim[8], int type, int bits) {
    memset(h, 0, 352);
    h[0] = 92;
    h[1] = 1;
    memcpy(h + 40, dim, 16);
    h[70] = (uint8_t)type;
    h[71] = (uint8_t)(type >> 8);
    h[72] = (uint8_t)bits;
    float pixdim[8] = {1, 0.5F, 0.75F, 2, 1, 1, 1, 1}, offset = 352;
    memcpy(h + 76, pixdim, sizeof pixdim);
    memcpy(h + 108, &offset, 4);
    memcpy(h + 344, "n+1", 4);
}

#endif

static void test_absurd_numbers_are_refused(void **state) {
    (void)state;
    static const struct {
        const char *slope, *intercept, *spacing, *position, *orientation;
        ang_code code;
    } cases[] = {{"1e300", "0", .code = ANG_INPUT},
                 {"1e308", "1e308", .code = ANG_INPUT},
                 {"1e-300", "0", .code = ANG_INPUT},
                 {"1", "-1e10", .code = ANG_INPUT},
                 {"1", "0", "1e30\\1", .code = ANG_GEOMETRY},
                 {"1", "0", "1e-30\\1", .code = ANG_GEOMETRY},
                 {"1", "0", .position = "0\\-1e30\\0", .code = ANG_GEOMETRY},
                 {"1", "0", .orientation = "1\\0\\0\\1\\0\\0", .code = ANG_GEOMETRY}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        fresh_folder(FOLDER);
        form f = form_at(0, 1000);
        f.slope = cases[i].slope;
        f.intercept = cases[i].intercept;
        f.spacing = cases[i].spacing;
        if (cases[i].position) f.position = cases[i].position;
        f.orientation = cases[i].orientation;
        small("a", &f);
        must_fail(FOLDER "/a", cases[i].code, "a: ");
    }
    /* A range so small that a 65535th of it is 0. */
    float denormal[8] = {0, 1e-45F, 0, 0, 0, 0, 0, 0};
    write_file("f32.raw", denormal, sizeof denormal);
    ang_load_options options = {.raw_dims = "2x2x2", .raw_type = "f32"};
    must_refuse(FOLDER "/f32.raw", &options, ANG_INPUT, "differ by");
#ifdef ANG_WITH_NIFTI
    struct {
        uint8_t header[352];
        double voxels[8];
    } nifti = {.voxels = {0, 4.9e-324}};
    nifti_header(nifti.header, (const int16_t[8]){3, 2, 2, 2, 1, 1, 1, 1}, 64, 64);
    write_file("denormal.nii", &nifti, sizeof nifti);
    ang_load_report report;
    ang_volume *v = load(FOLDER "/denormal.nii", &report);
    assert_float_equal(v->slope, 1, 0);
    assert_float_equal(hu_at(v, 1, 0, 0), 0, 0);
    ang_volume_free(v);
    ang_load_report_clear(&report);
#endif
}

static void test_options_for_other_formats(void **state) {
    (void)state;
    fresh_folder(FOLDER);
    form f = form_at(0, 1000);
    small("a", &f);
    const ang_load_options dims = {.raw_dims = "2x2x2", .raw_type = "u8"}, type = {.raw_type = "u8"},
                           spacing = {.raw_spacing = "1,1,1"};
    must_refuse(FOLDER, &dims, ANG_USAGE, "--raw-dims is for raw input, and load-samples is a folder");
    must_refuse(FOLDER, &spacing, ANG_USAGE, "--raw-spacing is for raw input");
    must_refuse(FOLDER "/a", &type, ANG_USAGE, "--raw-type is for raw input, and a is DICOM");

    write_file("v.raw", "01234567", 8);
    ang_load_options series = {.raw_dims = "2x2x2", .raw_type = "u8", .series = "2"};
    must_refuse(FOLDER "/v.raw", &series, ANG_INPUT, "--series 2: v.raw holds one volume");
    series.series = "1x";
    must_refuse(FOLDER "/v.raw", &series, ANG_INPUT, "--series 1x");
    series.series = "";
    must_refuse(FOLDER "/v.raw", &series, ANG_INPUT, "--series ");
    series.series = "1";
    ang_load_report report;
    ang_volume *v = ang_load(FOLDER "/v.raw", &series, &report, NULL, NULL);
    assert_non_null(v);
    ang_volume_free(v);
    ang_load_report_clear(&report);
}

static void test_formats_that_are_not_read(void **state) {
    (void)state;
    fresh_folder(FOLDER);
    write_file("d", "NDim", 4);
    write_file("e.jpg", "\xFF\xD8\xFF\xE0", 4);
    must_fail(FOLDER "/d", ANG_INPUT, "a raw volume needs --raw-dims");
    must_fail(FOLDER "/e.jpg", ANG_INPUT, "e.jpg: is neither DICOM");
    write_file("f.nii", "\x1C\x02\0\0n+2\0\r\n\x1A\n", 12);
    must_fail(FOLDER "/f.nii", ANG_INPUT, "f.nii: is NIfTI-2, which is not read");
}

#ifdef ANG_WITH_NIFTI

static void test_nifti(void **state) {
    (void)state;
    fresh_folder(FOLDER);
    struct {
        uint8_t header[352];
        int16_t voxels[2 * 3 * 2 * 2];
    } f;
    int16_t dim[8] = {4, 2, 3, 2, 2, 1, 1, 1};
    nifti_header(f.header, dim, 4, 16);
    for (int i = 0; i < 24; i++) f.voxels[i] = (int16_t)(i - 5);
    float slope = -2, inter = 10, rows[12] = {-0.5F, 0, 0, 7, 0, 0.75F, 0.1F, 8, 0, 0, 2, 9};
    memcpy(f.header + 112, &slope, 4);
    memcpy(f.header + 116, &inter, 4);
    f.header[254] = 1; /* sform_code */
    memcpy(f.header + 280, rows, sizeof rows);
    write_file("no-ending", &f, sizeof f);
    ang_load_report report;
    ang_volume *v = load(FOLDER "/no-ending", &report);
    assert_true(v->slope > 0);
    for (int i = 0; i < 12; i++) assert_float_equal(hu_at(v, i % 2, i / 2 % 3, i / 6), -2 * (i - 5) + 10, 1e-6);
    double expected[3][4] = {{0.5, 0, 0, -7}, {0, -0.75, -0.1, -8}, {0, 0, 2, 9}}; /* RAS to LPS */
    for (int r = 0; r < 3; r++) {
        for (int c = 0; c < 4; c++) assert_float_equal(v->affine.m[r][c], expected[r][c], 1e-6);
    }
    assert_int_equal(report.signed_stored, true);
    ang_volume_free(v);
    ang_load_report_clear(&report);
    expect_map(FOLDER "/no-ending", NULL, -2, 10);
    const ang_load_options second = {.series = "2"}, type = {.raw_type = "u8"};
    must_refuse(FOLDER "/no-ending", &second, ANG_INPUT, "--series 2: no-ending holds one volume");
    must_refuse(FOLDER "/no-ending", &type, ANG_USAGE, "no-ending is NIfTI-1");

    write_file("short.nii", &f, 352 + 10);
    must_fail(FOLDER "/short.nii", ANG_INPUT, "short.nii");
    int16_t huge[8] = {3, 32767, 32767, 32767, 1, 1, 1, 1};
    nifti_header(f.header, huge, 4, 16);
    write_file("huge.nii", &f, sizeof f);
    must_fail(FOLDER "/huge.nii", ANG_INPUT, "huge.nii");
    nifti_header(f.header, dim, 128, 24);
    write_file("rgb.nii", &f, sizeof f);
    must_fail(FOLDER "/rgb.nii", ANG_INPUT, "data type 128");
}

#endif

static void write_nrrd(const char *name, int width, const char *encoding) {
    char text[256];
    int length = snprintf(text, sizeof text,
                          "NRRD0004\ntype: uint8\ndimension: 3\nsizes: %d 1 2\nspace: LPS\nspace directions: (1,0,0) "
                          "(0,1,0) (0,0,1)\nspace origin: (0,0,0)\nencoding: %s\n\n0 1 2 3 4 5 6 7",
                          width, encoding);
    write_file(name, text, (size_t)length);
}

/* Loads FOLDER with --series `series` and expects so many columns as number `number` of 4. */
static void expect_series(const char *const *paths, size_t count, const char *series, int columns, int number) {
    ang_load_options options = {.series = series};
    ang_load_report report;
    ang_error err = {0};
    ang_volume *v = ang_load_all(paths, count, &options, &report, NULL, &err);
    if (!v) fail_msg("%s", err.message);
    assert_int_equal(v->dims[0], columns);
    assert_int_equal(report.series_count, 4);
    assert_int_equal(report.chosen, number - 1);
    assert_int_equal(report.phase, 1);
    for (int i = 0; i < 4; i++) assert_int_equal(report.series[i].number, i + 1);
    assert_int_equal(report.series[0].width, 2);
    assert_int_equal(report.series[1].width, 3);
    assert_string_equal(report.series[1].remark, "NRRD");
    assert_false(report.series[2].loadable);
    assert_non_null(strstr(report.series[2].remark, "x12.nrrd: "));
    assert_int_equal(report.assumptions.count, series ? 0 : 1);
    if (!series)
        assert_non_null(strstr(report.assumptions.text[0], "series 1 of 4 is shown: the first volume by name"));
    ang_load_report_clear(&report);
    ang_volume_free(v);
}

/* Several volumes that are no DICOM, in a folder or as several paths: each is a series. */
static void test_several_volumes(void **state) {
    (void)state;
    fresh_folder(FOLDER);
    write_nrrd("x9.nrrd", 2, "ascii");
    write_nrrd("X10.nrrd", 3, "ascii");
    write_nrrd("x12.nrrd", 3, "none of all"); /* its header is wrong */
    write_nrrd("y.nrrd", 4, "ascii");
    static const char *const folder[] = {FOLDER};
    static const char *const files[] = {FOLDER "/x9.nrrd", FOLDER "/X10.nrrd", FOLDER "/x12.nrrd", FOLDER "/y.nrrd"};
    expect_series(folder, 1, NULL, 2, 1);
    expect_series(folder, 1, "1", 2, 1);
    expect_series(folder, 1, "2", 3, 2);
    expect_series(folder, 1, "y.nrrd", 4, 4);
    expect_series(files, 4, "4", 4, 4);
    const ang_load_options none = {.series = "5"}, wrong = {.series = "3"};
    must_refuse(FOLDER, &none, ANG_INPUT, "--series 5: there are volumes 1 to 4, and no file's name ends so");
    must_refuse(FOLDER, &wrong, ANG_INPUT, "x12.nrrd: ");
    /* What is refused is listed, so that another can be picked. */
    ang_load_report report;
    ang_error err = {0};
    assert_null(ang_load(FOLDER, &wrong, &report, NULL, &err));
    assert_int_equal(report.series_count, 4);
    ang_load_report_clear(&report);
    for (size_t i = 0; i < 4; i++) assert_true(ang_load_reads(FOLDER, files[i]));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_raw),
        cmocka_unit_test(test_maps_belong_to_the_checksum),
        cmocka_unit_test(test_absurd_numbers_are_refused),
        cmocka_unit_test(test_options_for_other_formats),
        cmocka_unit_test(test_formats_that_are_not_read),
#ifdef ANG_WITH_NIFTI
        cmocka_unit_test(test_nifti),
        cmocka_unit_test(test_several_volumes),
#endif
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
