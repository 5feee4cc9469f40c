/* NRRD files written here, byte by byte, against what was written. */
#define FOLDER ANG_TEST_TMP "/nrrd"
#include "tests/io/written.h"

#define SIZES "dimension: 3\nsizes: 4 3 2\n"
#define HEAD  "NRRD0004\n# a comment\ntype: short\n" SIZES
#define SPACE                                                                                                          \
    "space: left-posterior-superior\nspace directions: (0.5,0,0.1) (0,0.75,0) (0,0,2)\nspace origin: (1,-2,3)\n"

static uint8_t little[4 * 2 * voxels], big[2 * voxels];
static const double lps[12] = {0.5, 0, 0, 1, 0, 0.75, 0, -2, 0.1, 0, 2, 3};

static int setup(void **state) {
    (void)state;
    fresh_folder(FOLDER);
    fill_words(little, 4, false);
    fill_words(big, 1, true);
    return 0;
}

static void attached_raw(void **state) {
    (void)state;
    write_parts("a.nrrd", HEAD SPACE "encoding: raw\nendian: little\nkey:=value: x\n\n", little, 2 * voxels);
    expect_volume("a.nrrd", 0, lps);
    write_parts("b", "NRRD0001\r\ntype: int16\r\n" SIZES "encoding: RAW\r\nendian: big\r\n\r\n", big, 2 * voxels);
    expect_volume("b", 0, NULL);
    write_parts("rest.nrrd", HEAD SPACE "encoding: raw\nendian: little\nbyte skip: -1\n\nxxxxx", little, 2 * voxels);
    expect_volume("rest.nrrd", 0, lps);
    write_parts("longer.nrrd", HEAD SPACE "encoding: raw\nendian: little\n\n", little, 2 * voxels + 2);
    expect_volume("longer.nrrd", 0, lps);
    expect_note("longer.nrrd", true, "is longer than its voxels");
    write_parts("text.nrrd", "NRRD0004\ntype: uchar\n" SIZES "encoding: ascii\n\n1 2 3 4 5 6 7 8 9 10 11 12 ",
                "13 14 15 16 17 18 19 20 21 22 23 24 \n\n", 38);
    ang_load_report report;
    ang_volume_free(load(FOLDER "/text.nrrd", &report));
    assert_false(told(&report.warnings, "is longer than its voxels"));
    ang_load_report_clear(&report);
}

static void spaces_become_lps(void **state) {
    (void)state;
    static const double ras[12] = {-0.5, 0, 0, -1, 0, -0.75, 0, 2, 0.1, 0, 2, 3};
    static const double las[12] = {0.5, 0, 0, 1, 0, -0.75, 0, 2, 0.1, 0, 2, 3};
    static const double metres[12] = {500, 0, 0, 1000, 0, 750, 0, -2000, 100, 0, 2000, 3000};
    static const char rest[] = "space directions: (0.5,0,0.1) (0,0.75,0) (0,0,2)\nspace origin: (1,-2,3)\n"
                               "encoding: raw\nendian: little\n\n";
    static const struct {
        const char *space;
        const double *affine;
    } cases[] = {{"space: right-anterior-superior\n", ras},
                 {"space: RAS\n", ras},
                 {"space: left-anterior-superior\n", las},
                 {"space: LPS\n", lps},
                 {"space: LPS\nspace units: \"m\" \"m\" \"m\"\n", metres},
                 {"space: 3D-right-handed\n", lps},
                 {"space dimension: 3\n", lps}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char header[1024];
        snprintf(header, sizeof header, HEAD "%s%s", cases[i].space, rest);
        write_parts("space.nrrd", header, little, 2 * voxels);
        expect_volume("space.nrrd", 0, cases[i].affine);
    }
    expect_note("space.nrrd", true, "orientation is not known");
    write_parts("origin.nrrd",
                HEAD "space: LPS\nspace directions: (1,0,0) (0,1,0) (0,0,1)\nencoding: raw\nendian: little\n\n", little,
                2 * voxels);
    expect_note("origin.nrrd", false, "no \"space origin\"");
}

static void spacings_without_a_space(void **state) {
    (void)state;
    static const double plain[12] = {0.5, 0, 0, 0, 0, 0.75, 0, 0, 0, 0, 2, 0};
    static const double cells[12] = {0.5, 0, 0, 10.25, 0, 0.75, 0, 0, 0, 0, 2, 5};
    static const struct {
        const char *fields;
        const double *affine;
    } cases[] = {{"spacings: 0.5 0.75 2\n", plain},
                 /* the first axis by cells from 10 to 12, the last by nodes from 5 to 7 */
                 {"spacings: nan 0.75 nan\naxis mins: 10 nan 5\naxis maxs: 12 nan 7\ncenters: cell cell node\n", cells},
                 {"spacings: 0.5 0.75 nan\nthicknesses: nan nan 2\n", plain},
                 {"kinds: domain domain domain\nspacings: 0.05 0.075 0.2\nunits: \"cm\" \"cm\" \"cm\"\n", plain}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char header[1024];
        snprintf(header, sizeof header, HEAD "%sencoding: raw\nendian: little\n\n", cases[i].fields);
        write_parts("spacings.nrrd", header, little, 2 * voxels);
        expect_volume("spacings.nrrd", 0, cases[i].affine);
    }
    write_parts("none.nrrd", HEAD "encoding: raw\nendian: little\n\n", little, 2 * voxels);
    expect_note("none.nrrd", true, "1 mm is taken");
}

static void packed_and_as_text(void **state) {
    (void)state;
    char text[voxels * 8] = "", hex[voxels * 8] = "";
    for (int i = 0; i < voxels; i++) {
        int value = expected(i % columns, i / columns % rows, i / (columns * rows), 0);
        snprintf(text + strlen(text), 8, "%d%s", value, i % 5 == 4 ? "\n" : " ");
        snprintf(hex + strlen(hex), 8, "%02x%02X\n", big[2 * i], big[2 * i + 1]);
    }
    write_parts("t.nrrd", HEAD SPACE "encoding: ascii\n\n", text, strlen(text));
    expect_volume("t.nrrd", 0, lps);
    write_parts("h.nrrd", HEAD SPACE "encoding: hex\nendian: big\n\n", hex, strlen(hex));
    expect_volume("h.nrrd", 0, lps);

    uint8_t skipped[7 + 2 * voxels] = "1234567";
    memcpy(skipped + 7, little, 2 * voxels);
    write_gzip("v.gz", skipped, sizeof skipped);
    write_parts("g.nhdr", HEAD SPACE "encoding: gzip\nendian: little\nbyte skip: 7\ndata file: v.gz\n", "", 0);
    expect_volume("g.nhdr", 0, lps);
    FILE *made = popen("bzip2 -c > " FOLDER "/v.bz2 2>/dev/null", "w");
    fwrite(little, 1, 2 * voxels, made);
    bool packed = pclose(made) == 0;
    write_parts("z.nhdr", HEAD SPACE "encoding: bz2\nendian: little\ndatafile: v.bz2\n", "", 0);
#ifdef ANG_WITH_BZIP2
    if (packed) expect_volume("z.nhdr", 0, lps);
#else
    if (packed) must_fail(FOLDER "/z.nhdr", ANG_INPUT, "bzip2, which is left out of this build");
#endif
    if (!packed) print_message("skipped: no program bzip2\n");
}

static void detached_in_several_files(void **state) {
    (void)state;
    enum { plane = 2 * columns * rows };
    char first[8 + plane] = "a\nb\nccc";
    memcpy(first + 7, little, plane);
    write_parts("p001.raw", "", first, 7 + plane);
    memcpy(first + 7, little + plane, plane);
    write_parts("p002.raw", "", first, 7 + plane);
    static const char skip[] = "encoding: raw\nendian: little\nline skip: 2\nbyte skip: 3\n";
    char header[1024];
    snprintf(header, sizeof header, HEAD SPACE "%sdata file: p%%03d.raw 1 2 1\n", skip);
    write_parts("numbers.nhdr", header, "", 0);
    expect_volume("numbers.nhdr", 0, lps);
    snprintf(header, sizeof header, HEAD SPACE "%sdata file: LIST 2\np001.raw\np002.raw\n", skip);
    write_parts("list.nhdr", header, "", 0);
    expect_volume("list.nhdr", 0, lps);
    assert_true(ang_load_reads(FOLDER "/list.nhdr", FOLDER "/p002.raw"));
    assert_false(ang_load_reads(FOLDER "/list.nhdr", FOLDER "/numbers.nhdr"));
    snprintf(header, sizeof header, HEAD SPACE "%sdata file: LIST\np001.raw\np003.raw\n", skip);
    write_parts("missing.nhdr", header, "", 0);
    must_fail(FOLDER "/missing.nhdr", ANG_INPUT, "p003.raw");
    /* Looking for lines there would never end. */
    snprintf(header, sizeof header, HEAD SPACE "%sdata file: /dev/zero\n", skip);
    write_parts("device.nhdr", header, "", 0);
    must_fail(FOLDER "/device.nhdr", ANG_INPUT, "zero: is no regular file");
}

/* The phases last, in the middle and first, where each voxel has them side by side. */
static void phases_on_any_axis(void **state) {
    (void)state;
    static const char *const forms[] = {
        "sizes: 4 3 2 4\nkinds: domain domain domain list\nspace: LPS\nspace directions: (0.5,0,0.1) (0,0.75,0) "
        "(0,0,2) "
        "none\n",
        "sizes: 4 3 4 2\nkinds: domain domain time domain\nspace: LPS\nspace directions: (0.5,0,0.1) (0,0.75,0) none "
        "(0,0,2)\n",
        "sizes: 4 4 3 2\nkinds: list domain domain domain\nspace: LPS\nspace directions: none (0.5,0,0.1) (0,0.75,0) "
        "(0,0,2)\n"};
    for (int form = 0; form < 3; form++) {
        uint8_t words[4 * 2 * voxels];
        for (int i = 0; i < 4 * voxels; i++) {
            int voxel = i % voxels, phase = i / voxels; /* as `little` has them */
            int to = form == 0 ? i : form == 1 ? voxel % 12 + 12 * (phase + 4 * (voxel / 12)) : phase + 4 * voxel;
            memcpy(words + 2 * (size_t)to, little + 2 * (size_t)i, 2);
        }
        char header[1024];
        snprintf(header, sizeof header,
                 "NRRD0005\ntype: short\ndimension: 4\n%sspace origin: (1,-2,3)\nencoding: raw\nendian: little\n\n",
                 forms[form]);
        write_parts("4d.nrrd", header, words, sizeof words);
        for (int phase = 0; phase <= 4; phase++) expect_volume("4d.nrrd", phase, lps);
    }
    /* Units of time say what phases are; any other text is not handed on: it may name somebody. */
    static const char *const units[][2] = {{"\"sec\"", "time 3 s"}, {"\"DOE MARY\"", "time 3"}};
    ang_load_report report;
    ang_error err = {0};
    for (int i = 0; i < 2; i++) {
        char header[1024];
        snprintf(header, sizeof header,
                 "NRRD0005\ntype: short\ndimension: 4\n%sspacings: nan nan nan 1.5\nunits: \"\" \"\" \"\" %s\n"
                 "encoding: raw\nendian: little\n\n",
                 forms[0], units[i][0]);
        write_parts("timed.nrrd", header, little, sizeof little);
        ang_volume *timed = load_phase(FOLDER "/timed.nrrd", 3, &report);
        assert_string_equal(ang_series_phase_text(&report.series[0], 3), units[i][1]);
        ang_volume_free(timed);
        ang_load_report_clear(&report);
    }
    ang_volume *v = load_phase(FOLDER "/4d.nrrd", 3, &report);
    assert_int_equal(report.series[0].phases, 4);
    assert_int_equal(report.phase, 3);
    assert_true(told(&report.assumptions, "phase 3 of 4 is shown; --phase picks another"));
    ang_volume_free(v);
    ang_load_report_clear(&report);
    assert_null(ang_load(FOLDER "/4d.nrrd", &(ang_load_options){.phase = 5}, &report, NULL, &err));
    assert_int_equal(err.code, ANG_INPUT);
    assert_non_null(strstr(err.message, "--phase 5: 4d.nrrd has phases 1 to 4"));
    ang_load_report_clear(&report);
}

static void refused(void **state) {
    (void)state;
    static const struct {
        const char *text, *needle;
        ang_code code;
    } cases[] = {
        {"NRRD0004\ntype: short\ndimension: 3\nsizes: 65535 65535 65535\nencoding: raw\nendian: little\n\n",
         "65535 x 65535 x 65535 voxels of 2 bytes (sizes) do not fit a file", ANG_INPUT},
        {"NRRD0004\ntype: short\ndimension: 3\nsizes: 65535 65535 65535\nencoding: gzip\nendian: little\n\n",
         "do not fit a file", ANG_INPUT},
        {"NRRD0004\ntype: short\ndimension: 3\nsizes: 2000000000 2000000000 2000000000\nencoding: raw\n\n",
         "more samples than", ANG_INPUT},
        {"NRRD0004\ntype: short\ndimension: 3\nsizes: 4 0 2\nencoding: raw\n\n", "an axis of 0 samples", ANG_INPUT},
        {"NRRD0004\ntype: short\ndimension: 3\nsizes: 4 nan 2\nencoding: raw\n\n", "an axis of nan", ANG_INPUT},
        {"NRRD0004\ntype: block\n" SIZES "encoding: raw\n\n", "\"type: block\"", ANG_INPUT},
        {"NRRD0004\nsizes: 4 3 2\n", "before \"dimension\"", ANG_INPUT},
        {"NRRD0004\ntype: short\ndimension: 17\n", "\"dimension: 17\"", ANG_INPUT},
        {HEAD "encoding: raw\nendian: little\n", "does not end", ANG_INPUT},
        {HEAD "endian: little\n\n", "has no \"encoding\"", ANG_INPUT},
        {HEAD "encoding: zip\n\n", "\"encoding: zip\"", ANG_INPUT},
        {HEAD "nonsense\n\n", "no field", ANG_INPUT},
        {HEAD "encoding: raw\ndata file: x%s.raw 1 2 1\n", "no pattern", ANG_INPUT},
        {HEAD "encoding: raw\ndata file: x%d.raw 1 2 0\n", "makes no list", ANG_INPUT},
        {HEAD "encoding: raw\ndata file: x%d.raw 1 99999999 1\n", "makes no list", ANG_INPUT},
        {HEAD "encoding: raw\ndata file: LIST\n", "list of files is empty", ANG_INPUT},
        {HEAD "encoding: raw\ndata file: nowhere.raw\n", "nowhere.raw, which does not exist", ANG_INPUT},
        {HEAD "encoding: raw\ndata file: /dev/zero\n", "no regular file", ANG_INPUT},
        {HEAD "encoding: ascii\n\n1 2 3 x 5 6 7 8 9 10 11 12 13 14 15 16 17 18 19 20 21 22 23 24", "no number",
         ANG_INPUT},
        {HEAD "encoding: ascii\n\n1 2 3 40000 5 6 7 8 9 10 11 12 13 14 15 16 17 18 19 20 21 22 23 24", "40000",
         ANG_INPUT},
        {HEAD "encoding: gzip\nendian: little\n\nthis is no gzip at all", "damaged", ANG_INPUT},
        {"NRRD0004\ntype: uchar\ndimension: 4\nsizes: 3 2 2 2\nkinds: RGB-color domain domain domain\nencoding: raw\n\n"
         "123456789012345678901234",
         "kind RGB-color", ANG_INPUT},
        {"NRRD0004\ntype: uchar\ndimension: 4\nsizes: 1 1 1 2000000000\nencoding: raw\n\n", "at most 65536", ANG_INPUT},
        {"NRRD0004\ntype: uchar\ndimension: 1\nsizes: 24\nencoding: raw\n\n123456789012345678901234", "1 axis",
         ANG_INPUT},
        {HEAD "space: LPS\nspace directions: (1,0,0) (2,0,0) (0,0,1)\nencoding: raw\nendian: little\n\n", "do not span",
         ANG_GEOMETRY},
        {HEAD "space: LPS\nspace directions: (0,0,0) (0,1,0) (0,0,1)\nencoding: raw\n\n", "space directions",
         ANG_INPUT},
        {HEAD "space: LPS\nspace directions: (1,nan,0) (0,1,0) (0,0,1)\nencoding: raw\n\n", "space directions",
         ANG_INPUT},
        {HEAD "space: LPS\nspace directions: (1,0) (0,1) (0,0)\nencoding: raw\n\n", "space directions", ANG_INPUT}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        write_parts("bad.nrrd", cases[i].text, "", 0);
        must_fail(FOLDER "/bad.nrrd", cases[i].code, cases[i].needle);
    }
    write_parts("short.nrrd", HEAD "encoding: raw\nendian: little\n\n", little, 2 * voxels - 1);
    must_fail(FOLDER "/short.nrrd", ANG_INPUT, "do not fit a file");
    ang_load_report report;
    ang_error err = {0};
    write_parts("a.nrrd", HEAD "encoding: raw\nendian: little\n\n", little, 2 * voxels);
    assert_null(ang_load(FOLDER "/a.nrrd", &(ang_load_options){.raw_type = "u8"}, &report, NULL, &err));
    assert_int_equal(err.code, ANG_USAGE);
    assert_non_null(strstr(err.message, "a.nrrd is NRRD"));
    ang_load_report_clear(&report);
}

/* A prefix of a sound file, however short, is refused with a sentence, or, where its header is whole, for its voxels.
 */
static void cut_anywhere(void **state) {
    (void)state;
    char whole[512];
    int head = snprintf(whole, sizeof whole, "%s", HEAD SPACE "encoding: raw\nendian: little\n\n");
    memcpy(whole + head, little, 2 * voxels);
    for (size_t length = 1; length < (size_t)head + 2 * voxels; length++) {
        write_parts("cut.nrrd", "", whole, length);
        ang_load_report report;
        ang_error err = {0};
        assert_null(ang_load(FOLDER "/cut.nrrd", NULL, &report, NULL, &err));
        assert_int_equal(err.code, ANG_INPUT);
        ang_load_report_clear(&report);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(attached_raw),
        cmocka_unit_test(spaces_become_lps),
        cmocka_unit_test(spacings_without_a_space),
        cmocka_unit_test(packed_and_as_text),
        cmocka_unit_test(detached_in_several_files),
        cmocka_unit_test(phases_on_any_axis),
        cmocka_unit_test(refused),
        cmocka_unit_test(cut_anywhere),
    };
    return cmocka_run_group_tests(tests, setup, NULL);
}
