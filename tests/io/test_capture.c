/* DICOM secondary captures: what they keep of the source and what they must not, and that other programs read them. */
#include "tests/core/fixtures.h"

#include "io/dicom/capture.h"
#include "io/dicom/parse.h"

#include <string.h>

#define FOLDER ANG_TEST_TMP "/capture"
#include "tests/io/small_dicom.h"

enum { W = 5, H = 3 };
static const unsigned char rgb[3 * W * H] = {1, 2, 3, 250, 251, 252, 9};

static ang_capture_picture picture(void) {
    return (ang_capture_picture){.width = W,
                                 .height = H,
                                 .rgb = rgb,
                                 .number = 7,
                                 .right = "L",
                                 .down = "F",
                                 .description = "m\xc3\xb6"
                                                "de dvr"};
}

/* Writes the capture of `source` to a file and gives its bytes, to be freed. */
static unsigned char *write_capture(const char *source, bool keep_phi, const char *path, size_t *size,
                                    ang_notes *warnings) {
    ang_capture capture;
    unsigned char *bytes;
    ang_capture_picture shown = picture();
    ang_identity *identity = source ? ang_identity_read(source) : NULL;
    assert_true(!source == !identity);
    assert_true(ang_capture_begin(&capture, identity, keep_phi, "0a1b2c3d-2", "1.2.3", warnings, NULL));
    assert_true(ang_capture_encode(&capture, &shown, &bytes, size, NULL));
    ang_identity_free(identity);
    FILE *out = fopen(path, "wb");
    assert_non_null(out);
    assert_int_equal(fwrite(bytes, 1, *size, out), *size);
    assert_int_equal(fclose(out), 0);
    return bytes;
}

/* The value of an element; false where it is absent. */
static bool value_of(const char *path, uint32_t tag, char *text, size_t size) {
    ang_dicom_reader *reader = malloc(sizeof *reader);
    ang_dicom_element element;
    bool found = false;
    assert_non_null(reader);
    assert_int_equal(ang_dicom_open(reader, path, "", NULL), ANG_DICOM_FOUND);
    text[0] = '\0';
    while (!found && ang_dicom_next(reader, &element)) found = element.tag == tag;
    if (found && element.length > 0) ang_dicom_text(reader, &element, text, size);
    assert_false(reader->truncated);
    ang_dicom_close(reader);
    free(reader);
    return found;
}

static void expect_element(const char *path, uint32_t tag, const char *wanted) {
    char text[512];
    bool found = value_of(path, tag, text, sizeof text);
    if (!wanted && found) fail_msg("(%08x) is there: %s", (unsigned)tag, text);
    if (wanted && (!found || strcmp(text, wanted) != 0))
        fail_msg("(%08x) is %s, not \"%s\"", (unsigned)tag, found ? text : "absent", wanted);
}

/* By dicom3tools, where they are installed: a program that knows the modules. */
static void validate(const char *path) {
    if (system("command -v dciodvfy >/dev/null 2>&1") != 0) {
        print_message("dciodvfy (package dicom3tools) is missing: validity not checked\n");
        return;
    }
    char command[1024], line[1024];
    snprintf(command, sizeof command, "dciodvfy '%s' 2>&1", path);
    FILE *pipe = popen(command, "r");
    assert_non_null(pipe);
    while (fgets(line, sizeof line, pipe))
        if (strncmp(line, "Error", 5) == 0) fail_msg("%s: %s", path, line);
    pclose(pipe);
}

static bool contains(const unsigned char *bytes, size_t size, const char *word) {
    return memmem(bytes, size, word, strlen(word)) != NULL;
}

static const form source = {.patient = "DOE^MARY", .patient_id = "ID-4711", .description = "SECRET HEAD"};

static void nothing_identifies(void **state) {
    (void)state;
    size_t size;
    ang_notes warnings = {0};
    small("source.dcm", &source);
    unsigned char *bytes = write_capture(FOLDER "/source.dcm", false, FOLDER "/plain.dcm", &size, &warnings);
    static const char *const words[] = {"DOE", "MARY", "4711", "SECRET", "1.2.3.4"};
    for (size_t i = 0; i < sizeof words / sizeof *words; i++)
        if (contains(bytes, size, words[i])) fail_msg("the file holds %s", words[i]);
    free(bytes);
    const char *path = FOLDER "/plain.dcm";
    expect_element(path, 0x00100010, "Anonymous^0a1b2c3d-2");
    expect_element(path, 0x00100020, "0a1b2c3d-2");
    /* Type 2: there, without a value. */
    static const uint32_t empty[] = {0x00080020, 0x00080030, 0x00080050, 0x00080090,
                                     0x00100030, 0x00100040, 0x00200010};
    for (size_t i = 0; i < sizeof empty / sizeof *empty; i++) expect_element(path, empty[i], "");
    static const uint32_t absent[] = {0x00080021, 0x00080023, 0x00081030, 0x00101010, 0x00181012, 0x00100021};
    for (size_t i = 0; i < sizeof absent / sizeof *absent; i++) expect_element(path, absent[i], NULL);
    expect_element(path, 0x00120062, "YES");
    expect_element(path, 0x00280303, "REMOVED");
    expect_element(path, 0x00280301, "NO");
    expect_element(path, 0x00080064, "WSD");
    expect_element(path, 0x00080060, "CT");
    expect_element(path, 0x00200013, "7");
    expect_element(path, 0x00200020, "L\\F");
    expect_element(path, 0x00082111, "m?de dvr");
    assert_int_equal(warnings.count, 0);
    validate(path);
}

static void study_and_patient_are_kept_on_request(void **state) {
    (void)state;
    size_t size;
    ang_notes warnings = {0};
    small("source.dcm", &source);
    unsigned char *bytes = write_capture(FOLDER "/source.dcm", true, FOLDER "/kept.dcm", &size, &warnings);
    const char *path = FOLDER "/kept.dcm";
    expect_element(path, 0x00100010, "DOE^MARY");
    expect_element(path, 0x00100020, "ID-4711");
    expect_element(path, 0x00120062, NULL);
    char series[65], study[65], again[65];
    assert_true(value_of(path, 0x0020000E, series, sizeof series));
    assert_string_not_equal(series, "1.2.3.4"); /* a series of its own */
    /* This source has no StudyInstanceUID, which is said. */
    assert_int_equal(warnings.count, 1);
    /* Rows of pixels end the file, padded to an even length. */
    assert_memory_equal(bytes + size - sizeof rgb - sizeof rgb % 2, rgb, sizeof rgb);
    free(bytes);
    ang_notes_clear(&warnings);
    /* A capture of the capture stays in its study. */
    validate(path);
    assert_true(value_of(path, 0x0020000D, study, sizeof study));
    bytes = write_capture(path, true, FOLDER "/again.dcm", &size, &warnings);
    free(bytes);
    assert_true(value_of(FOLDER "/again.dcm", 0x0020000D, again, sizeof again));
    assert_string_equal(again, study);
    assert_int_equal(warnings.count, 0);
    bytes = write_capture(path, false, FOLDER "/again.dcm", &size, &warnings);
    assert_false(contains(bytes, size, study));
    free(bytes);
}

/* Names of several character sets: what switches between them is kept (PS3.5 H.3.1). */
static void names_keep_their_character_sets(void **state) {
    (void)state;
    static const char name[] = "Yamada^Tarou=\x1B$B;3ED\x1B(B^\x1B$BB@O:\x1B(B";
    size_t size;
    ang_notes warnings = {0};
    form japanese = source;
    japanese.patient = name;
    japanese.character_set = "\\ISO 2022 IR 87";
    small("japanese.dcm", &japanese);
    unsigned char *bytes = write_capture(FOLDER "/japanese.dcm", true, FOLDER "/kept-japanese.dcm", &size, &warnings);
    assert_true(contains(bytes, size, name));
    free(bytes);
    expect_element(FOLDER "/kept-japanese.dcm", 0x00080005, "\\ISO 2022 IR 87");
    ang_notes_clear(&warnings);
    validate(FOLDER "/kept-japanese.dcm");
}

static void other_inputs_have_no_patient(void **state) {
    (void)state;
    size_t size;
    ang_notes warnings = {0};
    free(write_capture(NULL, true, FOLDER "/none.dcm", &size, &warnings));
    assert_int_equal(warnings.count, 1);
    expect_element(FOLDER "/none.dcm", 0x00080060, "OT");
    expect_element(FOLDER "/none.dcm", 0x00120062, "YES");
    validate(FOLDER "/none.dcm");
    ang_notes_clear(&warnings);
    ang_capture capture;
    ang_capture_picture large = picture();
    unsigned char *bytes;
    ang_error err = {0};
    large.width = 65536;
    assert_true(ang_capture_begin(&capture, NULL, false, "x", "1", &warnings, NULL));
    assert_false(ang_capture_encode(&capture, &large, &bytes, &size, &err));
    assert_int_equal(err.code, ANG_LIMIT);
}

int main(void) {
    if (system("rm -rf " FOLDER " && mkdir -p " FOLDER) != 0) return 1;
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(nothing_identifies),
        cmocka_unit_test(study_and_patient_are_kept_on_request),
        cmocka_unit_test(names_keep_their_character_sets),
        cmocka_unit_test(other_inputs_have_no_patient),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
