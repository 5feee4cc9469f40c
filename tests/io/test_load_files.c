/* Loading small files written here, against what was written into them. */
#define FOLDER ANG_TEST_TMP "/load-files"
#include "tests/io/small_dicom.h"

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
    must_fail(FOLDER, ANG_INPUT, "empty");
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

static bool warned(const ang_load_report *report, const char *needle) {
    for (size_t i = 0; i < report->warnings.count; i++)
        if (strstr(report->warnings.text[i], needle)) return true;
    return false;
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

/* ---- raw and NIfTI ---- */

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

static void must_refuse(const char *path, const ang_load_options *options, ang_code code, const char *needle) {
    ang_load_report report;
    ang_error err = {0};
    assert_null(ang_load(path, options, &report, NULL, &err));
    if (err.code != code || !strstr(err.message, needle)) fail_msg("%d, %s", (int)err.code, err.message);
    ang_load_report_clear(&report);
}

static void test_options_for_other_formats(void **state) {
    (void)state;
    fresh_folder(FOLDER);
    form f = form_at(0, 1000);
    small("a", &f);
    const ang_load_options dims = {.raw_dims = "2x2x2", .raw_type = "u8"}, type = {.raw_type = "u8"},
                           spacing = {.raw_spacing = "1,1,1"};
    must_refuse(FOLDER, &dims, ANG_USAGE, "--raw-dims is for raw input, and load-files is a folder");
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
    static const char meta[] = "ObjectType = Image\nNDims = 3\n", plain[] = "NDims = 3\n", nrrd[] = "NRRD0004\n";
    fresh_folder(FOLDER);
    write_file("a.mha", meta, sizeof meta - 1);
    write_file("b.mhd", plain, sizeof plain - 1);
    write_file("c.nrrd", nrrd, sizeof nrrd - 1);
    write_file("d", "NDim", 4);
    must_fail(FOLDER "/a.mha", ANG_INPUT, "a.mha: is MetaImage, which is not read yet");
    must_fail(FOLDER "/b.mhd", ANG_INPUT, "is MetaImage");
    must_fail(FOLDER "/c.nrrd", ANG_INPUT, "is NRRD");
    must_fail(FOLDER "/d", ANG_INPUT, "a raw volume needs --raw-dims");
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

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_small_series),
        cmocka_unit_test(test_broken_slices_are_missing),
        cmocka_unit_test(test_clear_errors),
        cmocka_unit_test(test_rescale_by_slice),
        cmocka_unit_test(test_declared_padding),
        cmocka_unit_test(test_padding_at_a_tie),
        cmocka_unit_test(test_damaged_double_is_left_out),
        cmocka_unit_test(test_doubles_without_orientation_or_position),
        cmocka_unit_test(test_invalid_spacing),
        cmocka_unit_test(test_numbers_with_junk_behind_them),
        cmocka_unit_test(test_interrupt),
        cmocka_unit_test(test_raw),
        cmocka_unit_test(test_options_for_other_formats),
        cmocka_unit_test(test_formats_that_are_not_read),
#ifdef ANG_WITH_NIFTI
        cmocka_unit_test(test_nifti),
#endif
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
