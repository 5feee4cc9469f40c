/* The edges of NIfTI-1 in files written here: left-handed and sheared axes, wrong spacings, phases; against closed
 * forms. */
#define FOLDER ANG_TEST_TMP "/nifti-edges"
#include "tests/io/written.h"

#ifdef ANG_WITH_NIFTI

/* A header by its byte offsets and 16-bit voxels, little endian. */
typedef struct nifti {
    uint8_t header[352];
    uint8_t words[4 * 2 * voxels];
} nifti;

static void put_floats(nifti *n, int at, const float *values, size_t count) {
    memcpy(n->header + at, values, count * sizeof *values);
}

static void put_word(nifti *n, int at, int value) {
    n->header[at] = (uint8_t)value;
    n->header[at + 1] = (uint8_t)(value >> 8);
}

static nifti start(int phases) {
    nifti n = {{0}, {0}};
    const int dim[8] = {phases > 1 ? 4 : 3, columns, rows, planes, phases, 1, 1, 1};
    const float pixdim[8] = {1, 0.5F, 0.75F, 2, 50, 1, 1, 1}, offset = 352;
    put_word(&n, 0, 348);
    for (int i = 0; i < 8; i++) put_word(&n, 40 + 2 * i, dim[i]);
    put_word(&n, 70, 4); /* 16 bits, signed */
    put_word(&n, 72, 16);
    put_floats(&n, 76, pixdim, 8);
    put_floats(&n, 108, &offset, 1);
    memcpy(n.header + 344, "n+1", 4);
    fill_words(n.words, 4, false);
    return n;
}

static void write_nifti(const char *name, const nifti *n, int phases) {
    write_parts(name, "", n, sizeof n->header + (size_t)phases * 2 * voxels);
}

/* A quarter turn about the third axis, which runs up with qfac 1 and down with -1. */
static void left_handed_qform(void **state) {
    (void)state;
    for (int handed = -1; handed <= 1; handed += 2) {
        nifti n = start(1);
        const float qfac = (float)handed, quaternion[6] = {0, 0, sqrtf(0.5F), 7, 8, 9};
        put_floats(&n, 76, &qfac, 1);
        put_word(&n, 252, 1);
        put_floats(&n, 256, quaternion, 6);
        write_nifti("q.nii", &n, 1);
        /* RAS: x along +A, y along -R; here LPS */
        const double affine[12] = {0, 0.75, 0, -7, -0.5, 0, 0, -8, 0, 0, 2.0 * handed, 9};
        expect_volume("q.nii", 0, affine);
        expect_note("q.nii", false, "orientation from the qform (code 1)");
        ang_load_report report;
        ang_volume_free(load(FOLDER "/q.nii", &report));
        assert_int_equal(told(&report.assumptions, "left-handed"), handed < 0);
        assert_false(told(&report.assumptions, "off right angles"));
        ang_load_report_clear(&report);
    }
}

static void sheared_and_mirrored_sform(void **state) {
    (void)state;
    nifti n = start(1);
    const float sform[12] = {-0.5F, 0, 0.25F, 1, 0, 0.75F, 0.5F, 2, 0, 0, -2, 3};
    put_word(&n, 254, 2);
    put_floats(&n, 280, sform, 12);
    write_nifti("s.nii", &n, 1);
    const double affine[12] = {0.5, 0, -0.25, -1, 0, -0.75, -0.5, -2, 0, 0, -2, 3};
    expect_volume("s.nii", 0, affine);
    ang_load_report report;
    ang_volume *v = load(FOLDER "/s.nii", &report);
    assert_float_equal(ang_volume_slice_distance(v), 2, 1e-6);
    /* between the second axis and the third: 0.5 / |(0.25, 0.5, -2)| */
    assert_true(told(&report.assumptions, "up to 13.93 degrees off right angles"));
    assert_true(told(&report.warnings, "along its third axis the sform says voxels of 2.077, pixdim of 2"));
    ang_volume_free(v);
    ang_load_report_clear(&report);
}

static void wrong_spacings(void **state) {
    (void)state;
    nifti n = start(1);
    const float negative[3] = {-0.5F, 0.75F, -2}, none[12] = {0};
    put_floats(&n, 80, negative, 3);
    write_nifti("n.nii", &n, 1);
    const double plain[12] = {-0.5, 0, 0, 0, 0, -0.75, 0, 0, 0, 0, 2, 0};
    expect_volume("n.nii", 0, plain);
    expect_note("n.nii", true, "a spacing is negative");
    expect_note("n.nii", true, "orientation is not known");
    put_word(&n, 252, 1); /* the same by a qform that turns nothing */
    write_nifti("q.nii", &n, 1);
    expect_volume("q.nii", 0, plain);
    put_word(&n, 254, 1);
    put_floats(&n, 280, none, 12);
    write_nifti("s.nii", &n, 1);
    expect_volume("s.nii", 0, plain);
    expect_note("s.nii", true, "its sform is singular");
}

/* Numbers that are none: told, or refused. */
static void wrong_numbers(void **state) {
    (void)state;
    static const double plain[12] = {-1, 0, 0, 0, 0, -0.75, 0, 0, 0, 0, 2, 0};
    const float lengths[] = {0, NAN, INFINITY}, not_there[] = {NAN, -352, 100, 352.5F, 1e30F, 1e9F}, unsaid = 0;
    for (size_t i = 0; i < sizeof lengths / sizeof *lengths; i++) {
        nifti n = start(1);
        put_floats(&n, 80, &lengths[i], 1);
        write_nifti("l.nii", &n, 1);
        expect_volume("l.nii", 0, plain);
        expect_note("l.nii", true, "a spacing (pixdim) is 0 or no number: 1 is taken");
    }
    nifti n = start(1);
    put_floats(&n, 268, &lengths[1], 1);
    put_word(&n, 252, 1);
    write_nifti("q.nii", &n, 1);
    expect_note("q.nii", true, "its qform holds what is no number");
    for (size_t i = 0; i < sizeof not_there / sizeof *not_there; i++) {
        n = start(1);
        put_floats(&n, 108, &not_there[i], 1);
        write_nifti("o.nii", &n, 1);
        must_fail(FOLDER "/o.nii", ANG_INPUT, not_there[i] == 1e9F ? "do not fit a file" : "cannot begin at byte");
    }
    n = start(1);
    put_floats(&n, 108, &unsaid, 1);
    write_nifti("o.nii", &n, 1);
    expect_volume("o.nii", 0, NULL);
    expect_note("o.nii", true, "vox_offset is 0");
    n = start(1);
    put_word(&n, 70, 9999);
    write_nifti("t.nii", &n, 1);
    must_fail(FOLDER "/t.nii", ANG_INPUT, "its NIfTI-1 header is damaged");
}

/* The same file with every number turned over. */
static void other_byte_order(void **state) {
    (void)state;
    nifti n = start(1);
    const float negative[3] = {-0.5F, 0.75F, -2};
    put_floats(&n, 80, negative, 3);
    static const struct {
        int from, count, size;
    } fields[] = {{0, 1, 4}, {40, 8, 2}, {70, 2, 2}, {76, 8, 4}, {108, 1, 4}};
    for (size_t f = 0; f < sizeof fields / sizeof *fields; f++)
        for (int i = 0; i < fields[f].count; i++) {
            uint8_t *at = n.header + fields[f].from + i * fields[f].size, copy[4];
            memcpy(copy, at, (size_t)fields[f].size);
            for (int b = 0; b < fields[f].size; b++) at[b] = copy[fields[f].size - 1 - b];
        }
    fill_words(n.words, 1, true);
    write_nifti("big.nii", &n, 1);
    expect_volume("big.nii", 0, (const double[12]){-0.5, 0, 0, 0, 0, -0.75, 0, 0, 0, 0, 2, 0});
    expect_note("big.nii", true, "a spacing is negative");
}

/* Voxels without their header name it. */
static void voxels_point_to_their_header(void **state) {
    (void)state;
    static const char bytes[64] = "no header of anything";
    static const char *const pairs[][2] = {{"pair.img", "pair.hdr"}, {"pair.raw", "pair.nhdr"}, {"p.raw.gz", "p.nhdr"}};
    for (size_t i = 0; i < sizeof pairs / sizeof *pairs; i++) {
        char path[256], says[128];
        write_parts(pairs[i][0], "", bytes, sizeof bytes);
        snprintf(path, sizeof path, FOLDER "/%s", pairs[i][0]);
        must_fail(path, ANG_INPUT, "is neither DICOM");
        write_parts(pairs[i][1], "", bytes, sizeof bytes);
        snprintf(says, sizeof says, "%s: holds voxels only; open the header beside it, %s", pairs[i][0], pairs[i][1]);
        must_fail(path, ANG_INPUT, says);
    }
}

static void phases(void **state) {
    (void)state;
    nifti n = start(4);
    const float offset = 100;
    n.header[123] = 2 | 16; /* mm, ms */
    put_floats(&n, 136, &offset, 1);
    write_nifti("4d.nii", &n, 4);
    write_gzip("4d.nii.gz", &n, sizeof n);
    for (int phase = 0; phase <= 4; phase++) {
        expect_volume("4d.nii", phase, NULL);
        expect_volume("4d.nii.gz", phase, NULL);
    }
    ang_load_report report;
    ang_error err = {0};
    ang_volume *v = load_phase(FOLDER "/4d.nii", 3, &report);
    assert_int_equal(report.series[0].phases, 4);
    assert_int_equal(report.phase, 3);
    assert_string_equal(ang_series_phase_text(&report.series[0], 3), "time 200 ms");
    assert_true(told(&report.assumptions, "phase 3 of 4 is shown, time 200 ms; --phase picks another"));
    ang_volume_free(v);
    ang_load_report_clear(&report);
    assert_null(ang_load(FOLDER "/4d.nii", &(ang_load_options){.phase = 5}, &report, NULL, &err));
    assert_int_equal(err.code, ANG_INPUT);
    assert_non_null(strstr(err.message, "--phase 5: 4d.nii has phases 1 to 4"));
    ang_load_report_clear(&report);
    write_nifti("cut.nii", &n, 3); /* all that the header claims must be there */
    must_fail(FOLDER "/cut.nii", ANG_INPUT, "4 phases of 4 x 3 x 2 voxels of 2 bytes (dim) do not fit a file");
}

static int setup(void **state) {
    (void)state;
    fresh_folder(FOLDER);
    return 0;
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(left_handed_qform),
        cmocka_unit_test(sheared_and_mirrored_sform),
        cmocka_unit_test(wrong_spacings),
        cmocka_unit_test(wrong_numbers),
        cmocka_unit_test(other_byte_order),
        cmocka_unit_test(voxels_point_to_their_header),
        cmocka_unit_test(phases),
    };
    return cmocka_run_group_tests(tests, setup, NULL);
}

#else

int main(void) { return 0; }

#endif
