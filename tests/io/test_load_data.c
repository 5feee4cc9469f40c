/* Loading real data (skipped where it is absent), against independent tools and hand computation. */
#include "tests/io/loading.h"

#define FOLDER ANG_TEST_TMP "/load-data"

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

typedef struct nifti {
    int dim[3], type;
    double slope, inter, srow[3][4];
    uint8_t *bytes, *voxels;
} nifti;

static nifti read_nifti(const char *path) {
    nifti n = {0};
    FILE *in = fopen(path, "rb");
    assert_non_null(in);
    fseek(in, 0, SEEK_END);
    size_t size = (size_t)ftell(in);
    rewind(in);
    n.bytes = malloc(size);
    assert_int_equal(fread(n.bytes, 1, size, in), size);
    fclose(in);
    int16_t dim[8], type;
    float offset, slope, inter, srow[12];
    memcpy(dim, n.bytes + 40, sizeof dim);
    memcpy(&type, n.bytes + 70, 2);
    memcpy(&offset, n.bytes + 108, 4);
    memcpy(&slope, n.bytes + 112, 4);
    memcpy(&inter, n.bytes + 116, 4);
    memcpy(srow, n.bytes + 280, sizeof srow);
    for (int i = 0; i < 3; i++) n.dim[i] = dim[i + 1];
    n.type = type;
    n.slope = slope != 0 ? (double)slope : 1;
    n.inter = slope != 0 ? (double)inter : 0;
    for (int i = 0; i < 12; i++) n.srow[i / 4][i % 4] = (double)srow[i];
    n.voxels = n.bytes + (size_t)offset;
    return n;
}

static double nifti_hu(const nifti *n, size_t index) {
    int16_t value;
    memcpy(&value, n->voxels + 2 * index, 2);
    double stored = n->type == 512 ? (double)(uint16_t)value : (double)value;
    return n->slope * stored + n->inter;
}

static void compare_dcm2niix(const char *folder, const char *series) {
    fresh_folder(FOLDER);
    char command[1024];
    snprintf(command, sizeof command, "dcm2niix -z n -b n -f out%%s -o '" FOLDER "' '%s' > '" FOLDER "/log' 2>&1",
             folder);
    assert_int_equal(system(command), 0);
    char path[512];
    snprintf(path, sizeof path, FOLDER "/out%s.nii", series);
    nifti n = read_nifti(path);
    ang_load_report report;
    ang_volume *v = load(folder, &report);
    assert_true(n.type == 4 || n.type == 512);
    for (int i = 0; i < 3; i++) assert_int_equal(n.dim[i], v->dims[i]);
    /* dcm2niix turns the rows over: its row j is ours height - 1 - j. Same points in the patient, RAS against LPS. */
    for (int corner = 0; corner < 8; corner++) {
        int x = corner & 1 ? v->dims[0] - 1 : 0, y = corner & 2 ? v->dims[1] - 1 : 0,
            z = corner & 4 ? v->dims[2] - 1 : 0;
        ang_vec3 p = ang_mat4_point(&v->affine, (ang_vec3){x, y, z});
        double q[3], ours[3] = {-p.x, -p.y, p.z};
        for (int r = 0; r < 3; r++)
            q[r] = n.srow[r][0] * x + n.srow[r][1] * (v->dims[1] - 1 - y) + n.srow[r][2] * z + n.srow[r][3];
        for (int r = 0; r < 3; r++) assert_float_equal(q[r], ours[r], 2e-3);
    }
    size_t index = 0, wrong = 0;
    for (int z = 0; z < v->dims[2]; z++) {
        for (int y = 0; y < v->dims[1]; y++) {
            for (int x = 0; x < v->dims[0]; x++, index++) {
                size_t theirs =
                    ((size_t)z * (size_t)v->dims[1] + (size_t)(v->dims[1] - 1 - y)) * (size_t)v->dims[0] + (size_t)x;
                double hu = ang_volume_is_padding(v, index) ? report.padding_hu : ang_volume_hu(v, v->data[index]);
                wrong += hu != nifti_hu(&n, theirs);
            }
        }
    }
    assert_int_equal(wrong, 0);
    free(n.bytes);
    ang_volume_free(v);
    ang_load_report_clear(&report);
}

static void test_dcm2niix(void **state) {
    (void)state;
    if (!have_data()) skip();
    if (system("dcm2niix -h > /dev/null 2>&1") != 0) {
        print_message("skipped: dcm2niix is not installed\n");
        skip();
    }
    compare_dcm2niix(ANG_SHARED_DATA "/chest-contrast-ct", "3000566");
    compare_dcm2niix(ANG_SHARED_DATA "/phantom-study", "201");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_lossless_twins), cmocka_unit_test(test_odd_dicom),     cmocka_unit_test(test_chest),
        cmocka_unit_test(test_tilted_head),    cmocka_unit_test(test_phantom_study), cmocka_unit_test(test_dcm2niix),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
