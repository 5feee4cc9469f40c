/* DICOMDIR: files found through it, and what happens where it is wrong. */
#define FOLDER ANG_TEST_TMP "/directory"
#include "tests/io/dicom_sequences.h"

#include "io/dicom/directory.h"
#include "io/dicom/disc.h"

/* A file that an index names, and whether its record is in use. */
typedef struct record {
    const char *id;
    bool unused;
} record;

/* Writes FOLDER/name; `cut` bytes are left out at its end. */
static void write_index(const char *name, const record *records, int count, size_t cut) {
    dicom_file f = {.size = 132};
    memcpy(f.bytes + 128, "DICM", 4);
    put_text(&f, 2, 0x02, "UI", "1.2.840.10008.1.3.10");
    put_text(&f, 2, 0x10, "UI", "1.2.840.10008.1.2.1");
    put_text(&f, 4, 0x1130, "CS", "DISC");
    size_t sequence = open_sequence(&f, 4, 0x1220);
    for (int i = 0; i < count; i++) {
        size_t item = open_item(&f);
        add_long(&f, 4, 0x1400, 132); /* the next record is this: a circle */
        add_word(&f, 4, 0x1410, records[i].unused ? 0 : 0xFFFF);
        add_text(&f, 4, 0x1430, "CS", records[i].id ? "IMAGE" : "SERIES");
        if (records[i].id) add_text(&f, 4, 0x1500, "CS", records[i].id);
        close_length(&f, item, 0xE00D, i % 2 == 0);
    }
    close_length(&f, sequence, 0xE0DD, true);
    write_small(name, &f, cut);
}

static void make_folder(const char *name) {
    char path[512];
    snprintf(path, sizeof path, FOLDER "/%s", name);
    assert_int_equal(mkdir(path, 0755), 0);
}

static void write_slice(const char *name, double z) {
    form f = form_at(z, (int)(100 * z));
    small(name, &f);
}

/* Three slices in lower case below FOLDER/disc, one in upper case, and one that the index does not name. */
static void write_disc(void) {
    fresh_folder(FOLDER);
    make_folder("disc");
    make_folder("disc/pt0");
    make_folder("disc/pt0/SE1");
    write_slice("disc/pt0/SE1/im1", 1);
    write_slice("disc/pt0/SE1/IM2", 2);
    write_slice("disc/pt0/SE1/im3.;1", 3);
    write_slice("disc/other.dcm", 4);
    write_slice("outside.dcm", 9);
}

static const record all[] = {{.id = NULL}, {.id = "PT0\\SE1\\IM1"}, {.id = "PT0\\SE1\\IM2"}, {.id = "PT0\\SE1\\IM3"}};

/* Loads and expects so many slices and a warning with `needle`; NULL: none. */
static void expect(const char *path, int slices, const char *needle) {
    ang_load_report report;
    ang_volume *v = load(path, &report);
    assert_int_equal(v->dims[2], slices);
    if (!needle && report.warnings.count) fail_msg("%s", report.warnings.text[0]);
    if (needle) {
        assert_int_equal(report.warnings.count, 1);
        if (!strstr(report.warnings.text[0], needle)) fail_msg("%s", report.warnings.text[0]);
        assert_string_equal(report.warnings.file[0], "DICOMDIR");
        ang_load_report_clear(&report);
        ang_volume_free(v);
        ang_error err = {0};
        v = ang_load(path, &(ang_load_options){.strict = true}, &report, NULL, &err);
        assert_null(v);
        assert_int_equal(err.code, ANG_GEOMETRY);
    }
    ang_volume_free(v);
    ang_load_report_clear(&report);
}

static void test_files_are_found_in_any_case(void **state) {
    (void)state;
    write_disc();
    write_index("disc/DICOMDIR", all, 4, 0);
    expect(FOLDER "/disc/DICOMDIR", 3, NULL);
    expect(FOLDER "/disc", 4, NULL); /* all that is there, whatever the index says */
    assert_int_equal(chdir(FOLDER "/disc"), 0);
    expect("DICOMDIR", 3, NULL);
    assert_int_equal(chdir("/"), 0);
}

static void test_it_is_known_by_its_contents_too(void **state) {
    (void)state;
    write_disc();
    write_index("disc/index.bin", all, 4, 0);
    expect(FOLDER "/disc/index.bin", 3, NULL);
}

static void test_files_that_are_not_there(void **state) {
    (void)state;
    write_disc();
    const record records[] = {{.id = "PT0\\SE1\\IM1"}, {.id = "PT0\\SE1\\IM7"}};
    write_index("disc/DICOMDIR", records, 2, 0);
    expect(FOLDER "/disc/DICOMDIR", 4, "names 1 file that is not there");
    expect(FOLDER "/disc", 4, "names 1 file that is not there");
    const record unused[] = {{.id = "PT0\\SE1\\IM1"}, {.id = "PT0\\SE1\\IM2"}, {.id = "PT0\\SE1\\IM7", .unused = true}};
    write_index("disc/DICOMDIR", unused, 3, 0);
    expect(FOLDER "/disc/DICOMDIR", 2, NULL);
}

static void test_damaged(void **state) {
    (void)state;
    write_disc();
    write_index("disc/DICOMDIR", all, 4, 5);
    expect(FOLDER "/disc/DICOMDIR", 4, "is damaged: its folder is searched");
    expect(FOLDER "/disc", 4, "is damaged: its folder is searched");
    write_index("disc/DICOMDIR", all, 0, 0); /* names nothing */
    expect(FOLDER "/disc/DICOMDIR", 4, "is damaged: its folder is searched");
    FILE *file = fopen(FOLDER "/disc/DICOMDIR", "wb");
    assert_non_null(file);
    fputs("no DICOM at all", file);
    fclose(file);
    expect(FOLDER "/disc/DICOMDIR", 4, "is damaged: its folder is searched");
    assert_int_equal(truncate(FOLDER "/disc/DICOMDIR", 0), 0);
    expect(FOLDER "/disc/DICOMDIR", 4, "is damaged: its folder is searched");
}

static void test_nothing_outside_its_folder(void **state) {
    (void)state;
    write_disc();
    const record records[] = {{.id = "PT0\\SE1\\IM1"}, {.id = "..\\OUTSIDE.DCM"}, {.id = "../OUTSIDE.DCM"}};
    write_index("disc/DICOMDIR", records, 3, 0);
    ang_dicom_directory index = ang_dicom_read_directory(FOLDER "/disc/DICOMDIR");
    assert_int_equal(index.count, 1);
    assert_int_equal(index.missing, 2);
    assert_false(index.damaged);
    ang_dicom_directory_clear(&index);
}

/* Names that differ in case alone, links, and files where folders should be. */
static void test_the_disc(void **state) {
    (void)state;
    write_disc();
    write_slice("disc/pt0/SE1/Im2", 5);
    write_slice("disc/pt0/SE1/im2", 6);
    write_slice("disc/pt0/SE1/im2.", 7);
    assert_int_equal(symlink("..", FOLDER "/disc/pt0/BACK"), 0);
    assert_int_equal(symlink("../../outside.dcm", FOLDER "/disc/pt0/LINK"), 0);
    static const struct {
        const char *id, *file; /* NULL: not there */
    } cases[] = {{"PT0\\SE1\\IM2", "pt0/SE1/IM2"},
                 {"PT0\\SE1\\im2", "pt0/SE1/im2"},
                 {"PT0\\SE1\\iM2", "pt0/SE1/im2"},
                 {"PT0\\SE1\\IM3", "pt0/SE1/im3.;1"},
                 {"PT0\\LINK", "pt0/LINK"},
                 {"OTHER.DCM", "other.dcm"},
                 {"PT0\\SE1", NULL},
                 {"PT0\\SE1\\IM1\\IM1", NULL},
                 {"PT0\\BACK\\PT0\\SE1\\IM1", NULL},
                 {"PT0\\..\\OTHER.DCM", NULL},
                 {"PT0/SE1/IM1", NULL},
                 {"IM1", NULL},
                 {"", NULL}};
    ang_dicom_disc *disc = ang_dicom_disc_open(FOLDER "/disc");
    assert_non_null(disc);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char *path = ang_dicom_disc_find(disc, cases[i].id);
        if (!cases[i].file && path) fail_msg("%s: %s", cases[i].id, path);
        if (cases[i].file && !path) fail_msg("%s is not found", cases[i].id);
        if (path) assert_string_equal(path + strlen(FOLDER "/disc/"), cases[i].file);
        free(path);
    }
    /* Each folder is read once: what comes later is not seen, what goes is. */
    write_slice("disc/pt0/SE1/IM8", 8);
    assert_null(ang_dicom_disc_find(disc, "PT0\\SE1\\IM8"));
    assert_int_equal(unlink(FOLDER "/disc/pt0/SE1/im1"), 0);
    assert_null(ang_dicom_disc_find(disc, "PT0\\SE1\\IM1"));
    ang_dicom_disc_close(disc);
    disc = ang_dicom_disc_open(FOLDER "/nowhere");
    assert_non_null(disc);
    assert_null(ang_dicom_disc_find(disc, "IM1"));
    ang_dicom_disc_close(disc);
}

static void test_what_it_reads(void **state) {
    (void)state;
    write_disc();
    write_index("disc/DICOMDIR", all, 4, 0);
    assert_true(ang_load_reads(FOLDER "/disc/DICOMDIR", FOLDER "/disc/pt0/SE1/im1"));
    assert_true(ang_load_reads(FOLDER "/disc/DICOMDIR", FOLDER "/disc/DICOMDIR"));
    assert_false(ang_load_reads(FOLDER "/disc/DICOMDIR", FOLDER "/outside.dcm"));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_files_are_found_in_any_case),
        cmocka_unit_test(test_it_is_known_by_its_contents_too),
        cmocka_unit_test(test_files_that_are_not_there),
        cmocka_unit_test(test_damaged),
        cmocka_unit_test(test_nothing_outside_its_folder),
        cmocka_unit_test(test_the_disc),
        cmocka_unit_test(test_what_it_reads),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
