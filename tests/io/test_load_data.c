/* Loading real data (skipped where it is absent), against independent tools and hand computation. */
#include "tests/io/loading.h"

#define FOLDER  ANG_TEST_TMP "/load-data"
#define SCRATCH FOLDER
#include "tests/io/dcm2niix.h"

/* ---- real data ---- */

static void same_values(const char *a, const char *b) {
    ang_load_report left, right;
    ang_volume *v = load(a, &left), *w = load(b, &right);
    assert_memory_equal(v->dims, w->dims, sizeof v->dims);
    assert_memory_equal(v->data, w->data, ang_volume_count(v) * sizeof *v->data);
    assert_int_equal(left.stored_crc32, right.stored_crc32);
    assert_float_equal(v->slope, w->slope, 0);
    assert_float_equal(v->intercept, w->intercept, 0);
    ang_volume_free(v);
    ang_volume_free(w);
    ang_load_report_clear(&left);
    ang_load_report_clear(&right);
}

static void test_lossless_twins(void **state) {
    (void)state;
    if (!have_data()) skip();
#define T ANG_SHARED_DATA "/transfer-syntaxes/CTImage.dcm"
    static const char *const syntaxes[] = {
        "_BigEndianExplicitTransferSyntax_1.2.840.10008.1.2.2.dcm",
        "_DeflatedExplicitVRLittleEndianTransferSyntax_1.2.840.10008.1.2.1.99.dcm",
        "_LittleEndianExplicitTransferSyntax_1.2.840.10008.1.2.1.dcm",
        "_LittleEndianImplicitTransferSyntax_1.2.840.10008.1.2.dcm",
        "_RLELosslessTransferSyntax_1.2.840.10008.1.2.5.dcm",
#ifdef ANG_WITH_GDCM
        "_JPEG2000LosslessOnlyTransferSyntax_1.2.840.10008.1.2.4.90.dcm",
        "_JPEGLSLosslessTransferSyntax_1.2.840.10008.1.2.4.80.dcm",
        "_JPEGProcess14SV1TransferSyntax_1.2.840.10008.1.2.4.70.dcm",
        "_JPEGProcess14TransferSyntax_1.2.840.10008.1.2.4.57.dcm",
#endif
    };
    for (size_t i = 0; i < sizeof syntaxes / sizeof *syntaxes; i++) {
        char path[512];
        snprintf(path, sizeof path, T "%s", syntaxes[i]);
        same_values(T, path);
    }
#define N ANG_SHARED_DATA "/nema-ct/"
    same_values(N "CT1_UNC", N "CT1_RLE");
    same_values(N "CT2_UNC", N "CT2_RLE");
    same_values(ANG_SHARED_DATA "/odd-dicom/MR_small.dcm", ANG_SHARED_DATA "/odd-dicom/MR_small_RLE.dcm");
    same_values(ANG_SHARED_DATA "/odd-dicom/MR_small.dcm", ANG_SHARED_DATA "/odd-dicom/MR_small_bigendian.dcm");
    same_values(ANG_SHARED_DATA "/odd-dicom/MR_small.dcm", ANG_SHARED_DATA "/odd-dicom/MR_small_implicit.dcm");
#ifdef ANG_WITH_GDCM
    same_values(N "CT1_UNC", N "CT1_J2KR");
    same_values(N "CT1_UNC", N "CT1_JLSL");
    same_values(N "CT1_UNC", N "CT1_JPLL");
    same_values(N "CT2_UNC", N "CT2_J2KR");
    same_values(N "CT2_UNC", N "CT2_JLSL");
    same_values(N "CT2_UNC", N "CT2_JPLL");
    same_values(ANG_SHARED_DATA "/odd-dicom/693_UNCR.dcm", ANG_SHARED_DATA "/odd-dicom/693_J2KR.dcm");
    same_values(ANG_SHARED_DATA "/odd-dicom/MR_small.dcm", ANG_SHARED_DATA "/odd-dicom/MR_small_jp2klossless.dcm");
    same_values(ANG_SHARED_DATA "/odd-dicom/MR_small.dcm", ANG_SHARED_DATA "/odd-dicom/MR_small_jpeg_ls_lossless.dcm");
#endif
}

static void try_all(const char *folder, int *read, int *refused) {
    DIR *directory = opendir(folder);
    assert_non_null(directory);
    for (struct dirent *entry; (entry = readdir(directory));) {
        if (entry->d_name[0] == '.') continue;
        char path[1024];
        snprintf(path, sizeof path, "%s/%s", folder, entry->d_name);
        ang_load_report report;
        ang_error err = {0};
        ang_volume *v = ang_load(path, NULL, &report, NULL, &err);
        if (!v) {
            assert_true(err.code == ANG_INPUT || err.code == ANG_GEOMETRY);
            assert_true(strlen(err.message) > 10);
        }
        v ? ++*read : ++*refused;
        ang_volume_free(v);
        ang_load_report_clear(&report);
        struct stat status;
        if (stat(path, &status) == 0 && S_ISDIR(status.st_mode)) try_all(path, read, refused);
    }
    closedir(directory);
}

static void test_odd_dicom(void **state) {
    (void)state;
    if (!have_data()) skip();
    int read = 0, refused = 0;
    try_all(ANG_SHARED_DATA "/odd-dicom", &read, &refused);
    print_message("odd-dicom: %d read, %d refused\n", read, refused);
    assert_true(read > 20 && refused > 20);
    must_fail(ANG_SHARED_DATA "/odd-dicom/MR_truncated.dcm", ANG_INPUT, "MR_truncated.dcm: (7FE0,0010)");
    must_fail(ANG_SHARED_DATA "/odd-dicom/emri_small.dcm", ANG_INPUT, "without functional groups");
}

static void test_chest(void **state) {
    (void)state;
    if (!have_data()) skip();
    ang_load_report report;
    ang_volume *v = load(ANG_SHARED_DATA "/chest-contrast-ct", &report);
    int dims[3] = {512, 512, 133};
    assert_memory_equal(v->dims, dims, sizeof dims);
    assert_float_equal(ang_volume_spacing(v, 0), 0.703125, 1e-9);
    assert_float_equal(ang_volume_spacing(v, 2), 2.5, 1e-9);
    assert_false(report.padding_declared); /* 63536 occurs nowhere */
    assert_true(report.padding_found);
    assert_float_equal(report.padding_hu, -2048, 0);
    assert_true(v->padding_count > 0.2 * (double)ang_volume_count(v));
    assert_true(v->padding_count < 0.23 * (double)ang_volume_count(v));
    assert_float_equal(ang_volume_hu(v, v->minimum), -1024, 0);
    assert_int_equal(report.gap_count, 0);
    assert_int_equal(report.warnings.count, 0);
    assert_true(report.signed_stored);
    ang_volume_free(v);
    ang_load_report_clear(&report);
}

static void test_tilted_head(void **state) {
    (void)state;
    if (!have_data()) skip();
    ang_load_report report;
    ang_volume *v = load(ANG_SHARED_DATA "/head-ct-tilted-irregular", &report);
    /* By hand from the files: the table moves along z only, columns run along (0, 0.9483237, -0.3173047). The normal is
     * (0, 0.3173047, 0.9483237), so the angle between it and z is atan(0.3173047 / 0.9483237) = 18.5000 degrees. */
    assert_float_equal(report.tilt_deg, atan2(0.3173047, 0.9483237) * 180 / acos(-1), 0.01);
    assert_float_equal(report.tilt_nominal_deg, 18.5, 1e-9);
    assert_int_equal(report.slices_read, 28);
    assert_int_equal(report.series_count, 1);
    assert_true(report.resampled);
    double cosine = 0.9483237 / hypot(0.3173047, 0.9483237);
    /* 4.22 mm of table 13 times, then once 1.14, then 7.38: the median is the first */
    assert_float_equal(report.slice_gap_median_mm, 4.22 * cosine, 1e-5);
    assert_int_equal(report.gap_count, 14);
    for (size_t i = 0; i < report.gap_count; i++) {
        assert_int_equal(report.gaps[i].after, 13 + (int)i);
        assert_int_equal(report.gaps[i].missing, 0);
        assert_float_equal(report.gaps[i].mm, ((i == 0 ? 1.14 : 7.38) * cosine), 1e-5);
    }
    ang_vec3 z = ang_mat4_column(&v->affine, 2);
    assert_float_equal(z.x, 0, 1e-9);
    assert_float_equal(z.y, 0, 1e-9); /* sheared: along the table, not along the normal */
    assert_float_equal(z.z, 1.14, 1e-5);
    assert_true(report.padding_declared);
    assert_float_equal(report.padding_hu, -1500, 0);
    ang_volume_free(v);
    ang_load_report_clear(&report);
}

static void test_phantom_study(void **state) {
    (void)state;
    if (!have_data()) skip();
    ang_load_report report;
    ang_volume *v = load(ANG_SHARED_DATA "/phantom-study", &report);
    int dims[3] = {512, 512, 28};
    assert_memory_equal(v->dims, dims, sizeof dims);
    const ang_series_info *chosen = &report.series[report.chosen];
    assert_int_equal(chosen->slices, 28);
    bool localizer = false, summary = false;
    for (size_t i = 0; i < report.series_count; i++) {
        localizer = localizer || (!report.series[i].loadable && strstr(report.series[i].remark, "localizer"));
        summary = summary || (!report.series[i].loadable && strstr(report.series[i].remark, "derived summary"));
    }
    assert_true(localizer);
    assert_true(summary);
    assert_int_equal(report.warnings.count, 0);
    ang_volume_free(v);
    ang_load_report_clear(&report);
}

/* ---- dcm2niix ---- */

static void test_dcm2niix(void **state) {
    (void)state;
    if (!have_data()) skip();
    need_dcm2niix();
    compare_dcm2niix(ANG_SHARED_DATA "/chest-contrast-ct", "out%s", "out3000566");
    compare_dcm2niix(ANG_SHARED_DATA "/phantom-study", "out%s", "out201");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_lossless_twins), cmocka_unit_test(test_odd_dicom),     cmocka_unit_test(test_chest),
        cmocka_unit_test(test_tilted_head),    cmocka_unit_test(test_phantom_study), cmocka_unit_test(test_dcm2niix),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
