/* The loading rules at their edges, from files; and every warning of the loader under --strict. */
#define FOLDER ANG_TEST_TMP "/edges"
#include "tests/io/small_dicom.h"

static void finish(ang_volume *v, ang_load_report *report) {
    ang_volume_free(v);
    ang_load_report_clear(report);
}

/* `count` slices of a form, 1 mm apart, in files that begin with `prefix`. */
static void write_stack(const char *prefix, form f, int count) {
    for (int z = 0; z < count; z++) {
        char name[32];
        snprintf(name, sizeof name, "%s%d.dcm", prefix, z);
        f.z = z;
        f.instance = z;
        for (int i = 0; i < width * height; i++) f.pixels[i] = (uint16_t)(100 * z + i);
        small(name, &f);
    }
}

static void test_two_patients(void **state) {
    (void)state;
    fresh_folder(FOLDER);
    write_stack("a", (form){.patient_id = "1", .series_uid = "1.2.1"}, 4);
    write_stack("b", (form){.patient_id = "2", .series_uid = "1.2.2"}, 3);
    ang_load_report report;
    ang_volume *v = load(FOLDER, &report);
    assert_int_equal(v->dims[2], 4);
    assert_int_equal(report.warnings.count, 1);
    assert_string_equal(report.warnings.text[0], "3 of 7 images are another patient's than the series that is shown");
    finish(v, &report);
    ang_error err = {0};
    v = ang_load(FOLDER, &(ang_load_options){.series = "2", .strict = true}, &report, NULL, &err);
    assert_non_null(v); /* asked for: only stated */
    assert_int_equal(v->dims[2], 3);
    finish(v, &report);
}

static void test_two_patients_under_one_uid(void **state) {
    (void)state;
    fresh_folder(FOLDER);
    write_stack("a", (form){.patient = "A^A"}, 4);
    write_stack("b", (form){.patient = "B^B", .intercept = "0"}, 3);
    ang_load_report report;
    ang_volume *v = load(FOLDER, &report);
    assert_int_equal(report.series_count, 2);
    assert_int_equal(report.series[0].phases, 1);
    assert_int_equal(v->dims[2], 4);
    assert_int_equal(report.warnings.count, 1);
    finish(v, &report);
}

static void test_mixed_orientations(void **state) {
    (void)state;
    fresh_folder(FOLDER);
    write_stack("a", (form){0}, 4);
    for (int y = 0; y < 3; y++) { /* coronal ones in the same series, and one sagittal: a localizer */
        char name[32], position[32];
        form f = form_at(0, 500);
        snprintf(name, sizeof name, "b%d.dcm", y);
        snprintf(position, sizeof position, "0\\%d\\0", 2 * y);
        f.position = position;
        f.orientation = "1\\0\\0\\0\\0\\-1";
        f.instance = 10 + y;
        small(name, &f);
    }
    form f = form_at(0, 500);
    f.orientation = "0\\1\\0\\0\\0\\-1";
    small("c.dcm", &f);
    ang_load_report report;
    ang_volume *v = load(FOLDER, &report);
    assert_int_equal(report.series_count, 3);
    assert_int_equal(v->dims[2], 4);
    assert_false(report.series[2].loadable);
    assert_non_null(strstr(report.series[2].remark, "localizer"));
    bool told = false;
    for (size_t i = 0; i < report.assumptions.count; i++)
        told = told || strcmp(report.assumptions.text[i], "4 images of this series differ in size, orientation or "
                                                          "spacing: listed apart") == 0;
    assert_true(told);
    finish(v, &report);
    ang_error err = {0};
    v = ang_load(FOLDER, &(ang_load_options){.series = "2"}, &report, NULL, &err);
    assert_non_null(v);
    assert_int_equal(v->dims[2], 3);
    ang_vec3 z = ang_mat4_column(&v->affine, 2); /* row x column = (0, 1, 0): to posterior */
    assert_true(fabs(z.x) < 1e-12 && fabs(z.y - 2) < 1e-12 && fabs(z.z) < 1e-12);
    finish(v, &report);
}

static void test_smallest_series(void **state) {
    (void)state;
    for (int count = 1; count <= 2; count++) {
        for (int side = 1; side <= 2; side++) {
            fresh_folder(FOLDER);
            write_stack("a", (form){.columns = side, .rows = side == 1 ? 1 : 3}, count);
            ang_load_report report;
            ang_volume *v = load(FOLDER, &report);
            int dims[3] = {side, side == 1 ? 1 : 3, count};
            assert_memory_equal(v->dims, dims, sizeof dims);
            for (int z = 0; z < count; z++) assert_true(fabs(hu_at(v, 0, 0, z) - (100 * z - 1024)) < 1e-9);
            assert_true(fabs(ang_volume_spacing(v, 0) - 0.25) < 1e-12); /* columns: the second value */
            assert_true(fabs(ang_volume_spacing(v, 1) - 0.5) < 1e-12);
            assert_true(fabs(ang_volume_spacing(v, 2) - 1) < 1e-12);
            assert_int_equal(report.warnings.count, 0);
            finish(v, &report);
        }
    }
}

/* Fragments within a deflated data set are nothing that the standard has: as plain pixels they would be noise. */
static void test_fragments_in_a_deflated_data_set(void **state) {
    (void)state;
    enum { begin = 132 + 8 + 22, most = 1 << 14 }; /* behind the meta header */
    static const uint8_t stream[4 * width * height] = {1, 2, 3};
    uint8_t plain[most], packed[most];
    fresh_folder(FOLDER);
    small("a.dcm",
          &(form){.transfer_syntax = "1.2.840.10008.1.2.1.99", .stream = stream, .stream_length = sizeof stream});
    FILE *file = fopen(FOLDER "/a.dcm", "rb+");
    assert_non_null(file);
    size_t size = fread(plain, 1, most, file);
    z_stream z = {.next_in = plain + begin, .avail_in = (uInt)(size - begin), .next_out = packed, .avail_out = most};
    assert_int_equal(deflateInit2(&z, 9, Z_DEFLATED, -MAX_WBITS, 8, Z_DEFAULT_STRATEGY), Z_OK);
    assert_int_equal(deflate(&z, Z_FINISH), Z_STREAM_END);
    deflateEnd(&z);
    assert_int_equal(fseek(file, begin, SEEK_SET), 0);
    assert_int_equal(fwrite(packed, 1, z.total_out, file), z.total_out);
    assert_int_equal(ftruncate(fileno(file), (off_t)(begin + z.total_out)), 0);
    fclose(file);
    must_fail(FOLDER, ANG_INPUT, "transfer syntax 1.2.840.10008.1.2.1.99: not supported");
}

static int told_of_overlays(const ang_load_report *report) {
    int told = 0;
    for (size_t i = 0; i < report->assumptions.count; i++)
        told += strstr(report->assumptions.text[i], "1 slice with bits set outside the 12 of BitsStored") != NULL;
    return told;
}

static void test_overlays_in_high_bits(void **state) {
    (void)state;
    for (int is_signed = 0; is_signed < 2; is_signed++) {
        fresh_folder(FOLDER);
        form f = {.bits_stored = 12, .is_signed = is_signed};
        for (int i = 0; i < width * height; i++) f.pixels[i] = (uint16_t)(0x8000 | (i % 2) << 12 | (0xFF0 + i));
        small("a.dcm", &f);
        ang_load_report report;
        ang_volume *v = load(FOLDER, &report);
        for (int i = 0; i < width * height; i++) {
            int stored = 0xFF0 + i;
            if (is_signed) stored -= 4096;
            assert_true(fabs(hu_at(v, i % width, i / width, 0) - (stored - 1024)) < 1e-9);
        }
        assert_int_equal(told_of_overlays(&report), 1);
        finish(v, &report);
    }
    fresh_folder(FOLDER);
    form plain = {.bits_stored = 12};
    for (int i = 0; i < width * height; i++) plain.pixels[i] = (uint16_t)(0xFF0 + i);
    small("a.dcm", &plain);
    ang_load_report report;
    ang_volume *v = load(FOLDER, &report);
    assert_int_equal(told_of_overlays(&report), 0);
    finish(v, &report);
}

/* The two bytes count, whatever the VR says they are (rule 10). */
static void test_padding_of_any_vr(void **state) {
    (void)state;
    static const char *const vrs[] = {"US", "SS"};
    for (int i = 0; i < 2; i++) {
        for (int is_signed = 0; is_signed < 2; is_signed++) {
            fresh_folder(FOLDER);
            form f = {.has_padding = true, .padding_vr = vrs[i], .padding = 63536, .is_signed = is_signed};
            for (int p = 0; p < width * height; p++) f.pixels[p] = (uint16_t)(p % 4 ? 1000 + p : 63536);
            small("a.dcm", &f);
            ang_load_report report;
            ang_volume *v = load(FOLDER, &report);
            assert_true(report.padding_declared);
            assert_true(fabs(report.padding_hu - ((is_signed ? -2000 : 63536) - 1024)) < 1e-9);
            assert_int_equal(v->padding_count, 4);
            finish(v, &report);
        }
    }
}

/* ---- every warning ---- */

typedef struct warning {
    const char *needle;
    form all;     /* of every slice of a stack of six */
    form special; /* laid over the third */
    bool lost;    /* the third is not there */
} warning;

static void put_special(const warning *w) {
    form f = w->all;
    const form *s = &w->special;
    f.z = 2;
    f.instance = 2;
    for (int i = 0; i < width * height; i++) f.pixels[i] = (uint16_t)(200 + i);
    if (s->slope) f.slope = s->slope;
    if (s->intercept) f.intercept = s->intercept;
    if (s->position) f.position = s->position;
    if (s->z != 0) f.z = s->z;
    f.damaged = s->damaged;
    f.cut = s->cut;
    if (w->lost)
        assert_int_equal(unlink(FOLDER "/a2.dcm"), 0);
    else
        small("a2.dcm", &f);
}

static void test_strict_refuses_every_warning(void **state) {
    (void)state;
    static const warning warnings[] = {
        {.needle = "ImageOrientationPatient is missing", .all = {.no_orientation = true}},
        {.needle = "ImageOrientationPatient is invalid", .all = {.orientation = "1\\0\\0"}},
        {.needle = "row and column are not at right angles", .all = {.orientation = "1\\0\\0\\0.5\\0.9\\0"}},
        {.needle = "PixelSpacing is invalid", .all = {.spacing = "0\\1"}},
        {.needle = "ImagePositionPatient is missing", .all = {.no_position = true}},
        {.needle = "modality is MR", .all = {.modality = "MR"}},
        {.needle = "RescaleSlope is invalid", .all = {.slope = "x"}},
        {.needle = "RescaleIntercept is invalid", .all = {.intercept = "x"}},
        {.needle = "which may also be tissue", .all = {.has_padding = true, .padding = 103, .intercept = "0"}},
        {.needle = "TransferSyntaxUID does not fit", .all = {.transfer_syntax = "1.2.840.10008.1.2"}},
        {.needle = "TransferSyntaxUID does not fit", .all = {.transfer_syntax = "1.2.840.10008.1.2.2"}},
        {.needle = "TransferSyntaxUID does not fit", .all = {.transfer_syntax = "1.2.840.10008.1.2.4.90"}},
        {.needle = "TransferSyntaxUID does not fit", .all = {.transfer_syntax = "1.2.840.113619.5.2"}},
        {.needle = "1 missing slice", .lost = true},
        {.needle = "slice distances are irregular", .special = {.z = 2.4}},
        {.needle = "beside the line from the first to the last", .special = {.position = "4\\-2\\2"}},
        {.needle = "run lengths are damaged", .special = {.damaged = true}},
        {.needle = "is cut off", .special = {.cut = true}},
        {.needle = "rescale differs between slices", .special = {.slope = "0.0001"}},
    };
    for (size_t i = 0; i < sizeof warnings / sizeof *warnings; i++) {
        const warning *w = &warnings[i];
        fresh_folder(FOLDER);
        write_stack("a", w->all, 6);
        put_special(w);
        ang_load_report report;
        ang_error err = {0};
        ang_volume *v = ang_load(FOLDER, NULL, &report, NULL, &err);
        if (!v) fail_msg("%s: %s", w->needle, err.message);
        bool found = false;
        for (size_t k = 0; k < report.warnings.count; k++) found = found || strstr(report.warnings.text[k], w->needle);
        if (!found)
            fail_msg("%s: is not said; %s is", w->needle, report.warnings.count ? report.warnings.text[0] : "nothing");
        finish(v, &report);
        v = ang_load(FOLDER, &(ang_load_options){.strict = true}, &report, NULL, &err);
        assert_null(v);
        assert_int_equal(err.code, ANG_GEOMETRY);
        assert_ptr_equal(strstr(err.message, "--strict: "), err.message);
        ang_load_report_clear(&report);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_two_patients),
        cmocka_unit_test(test_two_patients_under_one_uid),
        cmocka_unit_test(test_mixed_orientations),
        cmocka_unit_test(test_smallest_series),
        cmocka_unit_test(test_fragments_in_a_deflated_data_set),
        cmocka_unit_test(test_overlays_in_high_bits),
        cmocka_unit_test(test_padding_of_any_vr),
        cmocka_unit_test(test_strict_refuses_every_warning),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
