/* Stacks of pictures written here, byte by byte, against what was written. */
#define FOLDER ANG_TEST_TMP "/stack"
#include "tests/io/small_png.h"
#include "tests/io/written.h"

#ifdef ANG_WITH_OIIO

/* The planes as 16-bit pictures; where `offset` is 1000 the values are no negative numbers. */
static void write_pngs(const char *pattern, int first, int step, int offset) {
    for (int z = 0; z < planes; z++) {
        uint8_t samples[2 * columns * rows];
        char name[64], path[512];
        for (int i = 0; i < columns * rows; i++) {
            int value = expected(i % columns, i / columns, z, 0) + offset;
            samples[2 * i] = (uint8_t)(value >> 8);
            samples[2 * i + 1] = (uint8_t)value;
        }
        snprintf(name, sizeof name, pattern, first + z * step);
        snprintf(path, sizeof path, FOLDER "/%s", name);
        write_png(path, columns, rows, 16, 1, samples);
    }
}

static void put16(uint8_t *at, unsigned value) {
    at[0] = (uint8_t)value;
    at[1] = (uint8_t)(value >> 8);
}

static void put32(uint8_t *at, unsigned value) {
    put16(at, value & 0xFFFF);
    put16(at + 2, value >> 16);
}

static void put_tag(uint8_t *at, unsigned tag, unsigned type, unsigned value) {
    put16(at, tag);
    put16(at + 2, type);
    put32(at + 4, 1);
    put32(at + 8, value);
}

/* A little-endian TIFF 6.0 of 16-bit pages, one for each plane; `format` 1: unsigned, 2: signed. */
static void write_tiff(const char *name, int offset, unsigned format) {
    enum { tags = 10, directory = 2 + 12 * tags + 4, pixels = 2 * columns * rows, page = directory + pixels };
    uint8_t file[8 + planes * page] = "II*";
    put32(file + 4, 8);
    for (int z = 0; z < planes; z++) {
        unsigned begin = 8 + (unsigned)(z * page);
        uint8_t *at = file + begin;
        const struct {
            unsigned tag, type, value;
        } entries[tags] = {
            {256, 3, columns},           {257, 3, rows}, {258, 3, 16},   {259, 3, 1},      {262, 3, 1},
            {273, 4, begin + directory}, {277, 3, 1},    {278, 3, rows}, {279, 4, pixels}, {339, 3, format}};
        put16(at, tags);
        for (int i = 0; i < tags; i++) put_tag(at + 2 + 12 * i, entries[i].tag, entries[i].type, entries[i].value);
        put32(at + 2 + 12 * tags, z + 1 < planes ? begin + page : 0);
        for (int i = 0; i < columns * rows; i++)
            put16(at + directory + 2 * i, (unsigned)(expected(i % columns, i / columns, z, 0) + offset) & 0xFFFF);
    }
    write_parts(name, "", file, sizeof file);
}

static const char sidecar[] = "{\"spacing\": [0.5, 0.75, 2], \"origin\": [10, 20, 30], \"intercept\": -1000,\n"
                              "\"directions\": [[0, 1, 0], [0, 0, 1], [-1, 0, 0]]}";
static const double turned[12] = {0, 0, -2, 10, 0.5, 0, 0, 20, 0, 0.75, 0, 30};

static void a_folder_with_a_sidecar(void **state) {
    (void)state;
    fresh_folder(FOLDER "/png");
    write_pngs("png/im%d.png", 9, 1, 1000); /* 9 before 10, by number */
    write_parts("png/stack.json", sidecar, "", 0);
    write_parts("png/notes.txt", "nothing", "", 0);
    expect_volume("png", 0, turned);
    assert_true(ang_load_reads(FOLDER "/png", FOLDER "/png/im9.png"));
    assert_true(ang_load_reads(FOLDER "/png", FOLDER "/png/stack.json"));
    assert_false(ang_load_reads(FOLDER "/png", FOLDER "/png/notes.txt"));
}

static void what_is_assumed_without(void **state) {
    (void)state;
    fresh_folder(FOLDER "/bare");
    write_pngs("bare/im%d.png", 1, 2, 1000);
    ang_load_report report;
    ang_volume *v = load(FOLDER "/bare", &report);
    assert_true(told(&report.warnings, "1 x 1 x 1 mm is taken"));
    assert_true(told(&report.warnings, "how it lies in the patient"));
    assert_true(told(&report.assumptions, "need not be HU"));
    assert_float_equal(ang_volume_hu(v, v->data[0]), expected(0, 0, 0, 0) + 1000, 1e-9);
    assert_float_equal(ang_vec3_length(ang_volume_centre(v)), 0, 1e-12);
    assert_false(told(&report.warnings, "leave out")); /* every second number is a step like any other */
    ang_volume_free(v);
    ang_load_report_clear(&report);
    uint8_t grey[2 * columns * rows] = {0};
    write_png(FOLDER "/bare/im9.png", columns, rows, 16, 1, grey);
    expect_note("bare", true, "leave out 2");
    ang_error err = {0};
    assert_null(ang_load(FOLDER "/bare", &(ang_load_options){.strict = true}, &report, NULL, &err));
    assert_int_equal(err.code, ANG_GEOMETRY);
    ang_load_report_clear(&report);
}

static void pages_and_signs(void **state) {
    (void)state;
    write_tiff("u.tif", 1000, 1);
    write_parts("u.json", sidecar, "", 0);
    expect_volume("u.tif", 0, turned);
    write_tiff("s.tiff", 0, 2);
    expect_volume("s.tiff", 0, NULL);
    write_tiff("s.png", 0, 2); /* its name says nothing of what it is */
    expect_volume("s.png", 0, NULL);
    write_tiff("wrapped.tif", 0, 1); /* negative values in a file that calls them unsigned */
    write_parts("wrapped.json", "{\"signed\": true}", "", 0);
    expect_volume("wrapped.tif", 0, NULL);
}

static void eight_bits(void **state) {
    (void)state;
    fresh_folder(FOLDER "/byte");
    const uint8_t first[6] = {0, 1, 2, 128, 254, 255}, second[6] = {9, 8, 7, 6, 5, 4};
    write_png(FOLDER "/byte/a1.png", 3, 2, 8, 1, first);
    write_png(FOLDER "/byte/a2.png", 3, 2, 8, 1, second);
    ang_load_report report;
    ang_volume *v = load(FOLDER "/byte", &report);
    for (int i = 0; i < 12; i++)
        assert_float_equal(ang_volume_hu(v, v->data[i]), i < 6 ? first[i] : second[i - 6], 1e-12);
    ang_volume_free(v);
    ang_load_report_clear(&report);
}

static void refused(void **state) {
    (void)state;
    fresh_folder(FOLDER "/bad");
    uint8_t samples[3 * 6] = {0};
    write_png(FOLDER "/bad/a1.png", 3, 2, 8, 3, samples);
    must_fail(FOLDER "/bad", ANG_INPUT, "a1.png: is in colour");
    must_fail(FOLDER "/bad/a1.png", ANG_INPUT, "a1.png: is in colour");
    fresh_folder(FOLDER "/bad");
    write_png(FOLDER "/bad/a1.png", 3, 2, 8, 1, samples);
    write_png(FOLDER "/bad/a2.png", 2, 3, 8, 1, samples);
    must_fail(FOLDER "/bad", ANG_INPUT, "a2.png: is 2 x 3");
    write_png(FOLDER "/bad/a2.png", 3, 2, 16, 1, samples);
    must_fail(FOLDER "/bad", ANG_INPUT, "a2.png: is 3 x 2 of 16 bit");
    write_parts("bad/a2.png", "\x89PNG\r\n\x1A\n", "damaged", 7);
    must_fail(FOLDER "/bad", ANG_INPUT, "a2.png: cannot be read as a picture");
    write_parts("bad/a2.png", "II*", "\0damaged", 8); /* by its content, and by no other than that */
    must_fail(FOLDER "/bad", ANG_INPUT, "a2.png: cannot be read as a picture");
    static const struct {
        const char *text, *needle;
    } cases[] = {{"{\"spacing\": [1, 1]}", "stack.json:1: spacing must be 3 numbers in brackets"},
                 {"{\"spacing\": [1, 1,\n0]}", "spacing[2] is 0"},
                 {"{\"slope\": 0}", "slope must not be 0"},
                 {"{\"directions\": [[1, 0, 0], [0, 1, 0], [0, 0, 0.5]]}", "directions[2] is no unit vector"},
                 {"{\"signed\": 1}", "signed must be true or false"},
                 {"{\"spacings\": [1, 1, 1]}", "spacing"},
                 {"[]", "must be an object"}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        write_parts("bad/stack.json", cases[i].text, "", 0);
        must_fail(FOLDER "/bad", ANG_USAGE, cases[i].needle);
    }
}

static int setup(void **state) {
    (void)state;
    fresh_folder(FOLDER);
    return 0;
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_folder_with_a_sidecar),
        cmocka_unit_test(what_is_assumed_without),
        cmocka_unit_test(pages_and_signs),
        cmocka_unit_test(eight_bits),
        cmocka_unit_test(refused),
    };
    return cmocka_run_group_tests(tests, setup, NULL);
}

#else

static void left_out(void **state) {
    (void)state;
    fresh_folder(FOLDER);
    write_parts("a.png", "\x89PNG\r\n\x1A\n", "", 0);
    must_fail(FOLDER "/a.png", ANG_USAGE, "OpenImageIO");
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(left_out)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}

#endif
