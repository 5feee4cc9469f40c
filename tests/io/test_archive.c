/* Zip archives written here, byte by byte: what is in them, and what becomes of the files that they are unpacked to. */
#define FOLDER ANG_TEST_TMP "/archive"
#include "tests/io/small_dicom.h"
#include "tests/io/written.h"

#include "io/archive/scratch.h"
#include "io/survey.h"

#include <signal.h>
#include <sys/wait.h>

/* A zip file (PKWARE's APPNOTE 6.3) in the making. */
typedef struct zip {
    uint8_t bytes[1 << 16], directory[1 << 14];
    size_t size, directory_size;
    int count;
} zip;

static void le(uint8_t **at, uint64_t value, int size) {
    for (int i = 0; i < size; i++) *(*at)++ = (uint8_t)(value >> (8 * i));
}

/* What a member says of itself beside its bytes. */
typedef struct member {
    const char *name;
    const void *data;
    size_t size;
    bool deflated, encrypted, wrong_sum;
    uint32_t claimed; /* its size; 0: the true one */
} member;

/* What local and central headers have in common. */
static void put_header(uint8_t **at, const member *m, size_t packed) {
    le(at, 20, 2); /* version */
    le(at, m->encrypted ? 1 : 0, 2);
    le(at, m->deflated ? 8 : 0, 2);
    le(at, 0, 4); /* time and date */
    le(at, (uint32_t)crc32(0, m->data, (uInt)m->size) ^ (m->wrong_sum ? 1U : 0U), 4);
    le(at, packed, 4);
    le(at, m->claimed ? m->claimed : m->size, 4);
    le(at, strlen(m->name), 2);
    le(at, 0, 2);
}

static void add(zip *zip, member m) {
    uint8_t packed[8192];
    z_stream z = {.next_in = (Bytef *)(uintptr_t)m.data,
                  .avail_in = (uInt)m.size,
                  .next_out = packed,
                  .avail_out = sizeof packed};
    if (m.deflated) {
        assert_int_equal(deflateInit2(&z, 9, Z_DEFLATED, -15, 8, Z_DEFAULT_STRATEGY), Z_OK);
        assert_int_equal(deflate(&z, Z_FINISH), Z_STREAM_END);
        deflateEnd(&z);
    }
    size_t size = m.deflated ? z.total_out : m.size, name = strlen(m.name);
    uint8_t *at = zip->directory + zip->directory_size;
    le(&at, 0x02014B50, 4);
    le(&at, 20, 2);
    put_header(&at, &m, size);
    le(&at, 0, 6); /* comment, disk, attributes */
    le(&at, 0, 4);
    le(&at, zip->size, 4);
    memcpy(at, m.name, name);
    zip->directory_size = (size_t)(at - zip->directory) + name;
    at = zip->bytes + zip->size;
    le(&at, 0x04034B50, 4);
    put_header(&at, &m, size);
    memcpy(at, m.name, name);
    memcpy(at + name, m.deflated ? packed : m.data, size);
    zip->size = (size_t)(at - zip->bytes) + name + size;
    zip->count++;
}

static void finish(zip *zip, const char *name) {
    uint8_t end[22], *at = end;
    le(&at, 0x06054B50, 4);
    le(&at, 0, 4);
    le(&at, (uint64_t)zip->count, 2);
    le(&at, (uint64_t)zip->count, 2);
    le(&at, zip->directory_size, 4);
    le(&at, zip->size, 4);
    le(&at, 0, 2);
    memcpy(zip->bytes + zip->size, zip->directory, zip->directory_size);
    memcpy(zip->bytes + zip->size + zip->directory_size, end, sizeof end);
    write_parts(name, "", zip->bytes, zip->size + zip->directory_size + sizeof end);
}

/* Where archives are unpacked to. */
#define SCRATCH FOLDER "/scratch"

static int setup(void **state) {
    (void)state;
    fresh_folder(FOLDER);
    fresh_folder(SCRATCH);
    return setenv("TMPDIR", SCRATCH, 1);
}

/* Nothing is left of what was unpacked. */
static void expect_nothing_left(void) {
    DIR *directory = opendir(SCRATCH);
    assert_non_null(directory);
    for (struct dirent *entry; (entry = readdir(directory));)
        if (entry->d_name[0] != '.') fail_msg("%s is left", entry->d_name);
    closedir(directory);
}

static const char nhdr[] = "NRRD0004\ntype: short\ndimension: 3\nsizes: 4 3 2\nspace: LPS\n"
                           "space directions: (0.5,0,0.1) (0,0.75,0) (0,0,2)\nspace origin: (1,-2,3)\n"
                           "encoding: raw\nendian: little\ndata file: voxels.raw\n";
static const double lps[12] = {0.5, 0, 0, 1, 0, 0.75, 0, -2, 0.1, 0, 2, 3};

#ifdef ANG_WITH_ZIP

static void a_header_and_its_voxels(void **state) {
    (void)state;
    uint8_t words[2 * voxels];
    fill_words(words, 1, false);
    for (int deflated = 0; deflated < 2; deflated++) {
        zip zip = {0};
        add(&zip, (member){.name = "a folder/v.nhdr", .data = nhdr, .size = sizeof nhdr - 1, .deflated = deflated});
        add(&zip, (member){.name = "a folder/voxels.raw", .data = words, .size = sizeof words, .deflated = deflated});
        finish(&zip, "nrrd.zip");
        expect_volume("nrrd.zip", 0, lps);
        expect_nothing_left();
    }
}

/* Three slices in folders, with a file beside them, against the same slices in a plain folder. */
static void a_study(void **state) {
    (void)state;
    zip zip = {0};
    for (int i = 0; i < 3; i++) {
        form f = form_at(i, 1000 + 100 * i);
        char name[64], bytes[8192];
        small("slice", &f);
        FILE *in = fopen(FOLDER "/slice", "rb");
        size_t size = fread(bytes, 1, sizeof bytes, in);
        fclose(in);
        remove(FOLDER "/slice");
        snprintf(name, sizeof name, "STUDY/S1/IM%d", 9 - i);
        add(&zip, (member){.name = name, .data = bytes, .size = size, .deflated = true});
    }
    add(&zip, (member){.name = "STUDY/", .data = "", .size = 0});
    add(&zip, (member){.name = "STUDY/readme.txt", .data = "hello", .size = 5});
    finish(&zip, "study.zip");
    ang_load_report report;
    ang_volume *v = load(FOLDER "/study.zip", &report);
    assert_string_equal(report.format, "DICOM");
    assert_int_equal(v->dims[2], 3);
    for (int z = 0; z < 3; z++) {
        double hu = ang_volume_hu(v, v->data[(size_t)z * width * height + 4]);
        assert_float_equal(hu, 1000 + 100 * z + 4 - 1024, 1e-9);
    }
    ang_volume_free(v);
    ang_load_report_clear(&report);
    expect_nothing_left();
}

typedef struct seen {
    size_t listed, pictures;
} seen;

static void count_listed(void *context, const ang_load_report *report) {
    ((seen *)context)->listed = report->series_count;
}

static void count_picture(void *context, size_t index, const ang_raw_slice *middle, const ang_notes *warnings,
                          const char *refusal) {
    (void)index, (void)warnings, (void)refusal;
    ((seen *)context)->pictures += middle != NULL;
}

static void is_surveyed(void **state) {
    (void)state;
    const char *path = FOLDER "/study.zip";
    seen seen = {0};
    ang_survey_sink sink = {count_listed, count_picture, &seen};
    ang_load_report report;
    ang_error err = {0};
    assert_true(ang_survey(&path, 1, NULL, &report, &sink, NULL, &err));
    assert_int_equal(seen.listed, 1);
    assert_int_equal(seen.pictures, 1);
    ang_load_report_clear(&report);
    expect_nothing_left();
}

/* Names that lead elsewhere, a damaged member and one that is twice there: what is sound is read. */
static void bad_members_are_left_out(void **state) {
    (void)state;
    uint8_t words[2 * voxels];
    fill_words(words, 1, false);
    static const char *const outside[] = {"../escaped.nhdr", "/escaped.nhdr", "a/../../escaped.nhdr",
                                          "..\\escaped.nhdr", "C:\\escaped.nhdr"};
    zip zip = {0};
    for (size_t i = 0; i < sizeof outside / sizeof *outside; i++)
        add(&zip, (member){.name = outside[i], .data = nhdr, .size = sizeof nhdr - 1});
    add(&zip, (member){.name = "v.nhdr", .data = nhdr, .size = sizeof nhdr - 1});
    add(&zip, (member){.name = "voxels.raw", .data = words, .size = sizeof words});
    add(&zip, (member){.name = "voxels.raw", .data = "other", .size = 5});
    add(&zip, (member){.name = "sum", .data = "damaged", .size = 7, .wrong_sum = true});
    add(&zip, (member){.name = "more", .data = "more than is claimed", .size = 20, .deflated = true, .claimed = 4});
    finish(&zip, "mixed.zip");
    expect_volume("mixed.zip", 0, lps);
    expect_note("mixed.zip", true, "leads out of it");
    expect_note("mixed.zip", true, "is twice in the archive");
    expect_note("mixed.zip", true, "cannot be unpacked");
    expect_note("mixed.zip", true, "its size is another than the archive says");
    expect_nothing_left();
    assert_int_not_equal(access(FOLDER "/escaped.nhdr", F_OK), 0);
    assert_int_not_equal(access(SCRATCH "/escaped.nhdr", F_OK), 0);
}

static void refused(void **state) {
    (void)state;
    zip encrypted = {0}, bomb = {0}, many = {0}, none = {0}, lying = {0};
    add(&encrypted, (member){.name = "v.nhdr", .data = nhdr, .size = sizeof nhdr - 1, .encrypted = true});
    finish(&encrypted, "encrypted.zip");
    must_fail(FOLDER "/encrypted.zip", ANG_INPUT, "encrypted.zip: is encrypted: unpack it with its password first");
    add(&bomb, (member){.name = "b", .data = "x", .size = 1, .deflated = true, .claimed = 0xFFFFFFF0});
    finish(&bomb, "bomb.zip");
    must_fail(FOLDER "/bomb.zip", ANG_INPUT, "bomb.zip: would unpack to 4295 MB");
    for (int i = 0; i < 100; i++) {
        char name[8];
        snprintf(name, sizeof name, "b%d", i);
        add(&many, (member){.name = name, .data = "x", .size = 1, .deflated = true, .claimed = 10000000});
    }
    finish(&many, "many.zip"); /* each of them is harmless */
    must_fail(FOLDER "/many.zip", ANG_INPUT, "many.zip: would unpack to 1000 MB");
    add(&none, (member){.name = "readme.txt", .data = "hello", .size = 5});
    finish(&none, "none.zip");
    must_fail(FOLDER "/none.zip", ANG_INPUT, "none.zip: ");
    char whole[4096];
    FILE *in = fopen(FOLDER "/none.zip", "rb");
    size_t size = fread(whole, 1, sizeof whole, in);
    fclose(in);
    for (size_t length = 4; length < size; length++) {
        write_parts("cut.zip", "", whole, length);
        must_fail(FOLDER "/cut.zip", ANG_INPUT, "cut.zip: is a damaged or cut-off zip archive");
    }
    /* One that unpacks to more than it claims is no file at all. */
    add(&lying, (member){.name = "v.nhdr", .data = nhdr, .size = sizeof nhdr - 1, .deflated = true, .claimed = 10});
    finish(&lying, "lying.zip");
    must_fail(FOLDER "/lying.zip", ANG_INPUT,
              "lying.zip: nothing of it can be unpacked: file \"v.nhdr\": cannot be unpacked (its size is another");
    expect_nothing_left();
}

static bool stop(void *context, const char *what, double fraction) {
    (void)context, (void)fraction;
    return strcmp(what, "unpacking") != 0;
}

static void interrupted(void **state) {
    (void)state;
    ang_load_report report;
    ang_error err = {0};
    ang_progress progress = {stop, NULL};
    assert_null(ang_load(FOLDER "/study.zip", NULL, &report, &progress, &err));
    assert_int_equal(err.code, ANG_INTERRUPTED);
    ang_load_report_clear(&report);
    expect_nothing_left();
}

static void no_place_to_unpack_to(void **state) {
    (void)state;
    setenv("TMPDIR", FOLDER "/nowhere", 1);
    must_fail(FOLDER "/study.zip", ANG_OUTPUT, "no folder for an archive's files can be made there");
    setenv("TMPDIR", SCRATCH, 1);
}

#else

static void left_out(void **state) {
    (void)state;
    zip zip = {0};
    add(&zip, (member){.name = "v.nhdr", .data = nhdr, .size = sizeof nhdr - 1});
    finish(&zip, "a.zip");
    must_fail(FOLDER "/a.zip", ANG_INPUT, "left out of this build");
    (void)lps;
}

#endif

/* The guard: a process that is killed leaves nothing behind, however it is killed. */
static void killed_in_the_middle(void **state) {
    (void)state;
    pid_t child = fork();
    assert_true(child >= 0);
    if (child == 0) {
        ang_scratch scratch;
        char path[512];
        if (!ang_scratch_make(&scratch, NULL)) _exit(1);
        for (int i = 0; i < 300; i++) { /* folders in folders, more than one list of names */
            snprintf(path, sizeof path, "%s/a file with a long name, number %d", scratch.path, i);
            FILE *file = fopen(path, "w");
            if (file) fclose(file);
        }
        snprintf(path, sizeof path, "%s/folder", scratch.path);
        mkdir(path, 0700);
        snprintf(path, sizeof path, "%s/folder/file", scratch.path);
        FILE *file = fopen(path, "w");
        if (file) fclose(file);
        raise(SIGKILL);
    }
    int status;
    assert_int_equal(waitpid(child, &status, 0), child);
    assert_true(WIFSIGNALED(status));
    bool left = true;
    for (int i = 0; left && i < 6000; i++) { /* the guard is a moment behind */
        DIR *directory = opendir(SCRATCH);
        left = false;
        for (struct dirent *entry; (entry = readdir(directory));) left = left || entry->d_name[0] != '.';
        closedir(directory);
        if (left) usleep(10000);
    }
    assert_false(left);
}

int main(void) {
    const struct CMUnitTest tests[] = {
#ifdef ANG_WITH_ZIP
        cmocka_unit_test(a_header_and_its_voxels),  cmocka_unit_test(a_study), cmocka_unit_test(is_surveyed),
        cmocka_unit_test(bad_members_are_left_out), cmocka_unit_test(refused), cmocka_unit_test(interrupted),
        cmocka_unit_test(no_place_to_unpack_to),
#else
        cmocka_unit_test(left_out),
#endif
        cmocka_unit_test(killed_in_the_middle),
    };
    return cmocka_run_group_tests(tests, setup, NULL);
}
