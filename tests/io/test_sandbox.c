/* What goes wrong in a codec costs one file and one sentence. The program runs beside a codec that does what the files
 * tell it to, under the name of the real one (bad_codec.c). */
#define FOLDER ANG_TEST_TMP "/sandbox"
#include "tests/io/small_dicom.h"
#include "tests/io/small_png.h"

#include <sys/wait.h>

#ifdef ANG_WITH_GDCM

#define PROGRAM FOLDER "/bin/angioscope"
#define SERIES  FOLDER "/series"

static char output[1 << 16];

static int run(const char *arguments) {
    char command[2048];
    snprintf(command, sizeof command, PROGRAM " %s 2>&1", arguments);
    FILE *pipe = popen(command, "r");
    assert_non_null(pipe);
    output[fread(output, 1, sizeof output - 1, pipe)] = '\0';
    int status = pclose(pipe);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

static void expect(int code, const char *arguments) {
    int actual = run(arguments);
    if (actual != code) fail_msg("%s: exit code %d, not %d; it said: %s", arguments, actual, code, output);
}

static void says(const char *what) {
    if (!strstr(output, what)) fail_msg("nothing of '%s' in: %s", what, output);
}

/* Five slices, of which the middle one holds `action`. */
static void write_series(char action) {
    fresh_folder(SERIES);
    for (int i = 0; i < 5; i++) {
        uint8_t stream[] = {0xFF, 0xD8,  0xFF, 0xC3, 0,    11, 16,   0,    height,
                            0,    width, 1,    1,    0x11, 0,  0xFF, 0xDA, 0,
                            8,    1,     1,    0,    1,    0,  0,    'f',  (uint8_t)(10 * i),
                            0xFF, 0xD9,  0};
        if (i == 2) stream[25] = (uint8_t)action;
        form f = form_at(i, 0);
        f.transfer_syntax = "1.2.840.10008.1.2.4.70";
        f.stream = stream;
        f.stream_length = sizeof stream;
        char name[32];
        snprintf(name, sizeof name, "series/slice%d", i);
        small(name, &f);
    }
}

static int setup(void **state) {
    (void)state;
    fresh_folder(FOLDER "/bin");
    char command[2048];
    snprintf(command, sizeof command,
             "cp '%s' '%s/../angioscope-decode' '%s/bad-codec/angioscope-gdcm.so' " FOLDER "/bin/", ANG_PROGRAM,
             ANG_TEST_TMP, ANG_TEST_TMP);
    return system(command) == 0 ? 0 : -1;
}

static int teardown(void **state) {
    (void)state;
    return system("rm -rf " FOLDER);
}

static void what_is_sound_is_the_same_either_way(void **state) {
    (void)state;
    write_series('f');
    char inside[sizeof output];
    expect(0, "info " SERIES " --json --quiet --no-sandbox");
    memcpy(inside, output, sizeof output);
    says("\"slices_missing\":\t0");
    says("\"hu_range\":\t[-24, 16]");
    expect(0, "info " SERIES " --json --quiet");
    /* A kernel that confines nothing is told of, and that is all. */
    char *remark = strstr(output, ", \"compressed pixels are decoded in a process of its own");
    if (!remark) remark = strstr(output, "\"compressed pixels are decoded in a process of its own");
    if (remark) memmove(remark, strchr(remark, ']'), strlen(strchr(remark, ']')) + 1);
    assert_string_equal(output, inside);
}

/* The slice is left out with a sentence, in which nothing of the codec's own lines is, and the rest is there. */
static void costs_one_slice(char action, const char *sentence) {
    write_series(action);
    expect(0, "info " SERIES " --json --keep-phi --quiet");
    says("\"slices_missing\":\t1");
    says("\"slices_read\":\t4");
    says("\"hu_range\":\t[-24, 16]");
    says("slice2");
    says(sentence);
}

/* One file alone: an error of one line. */
static void is_refused(char action, const char *sentence) {
    write_series(action);
    expect(3, "info " SERIES "/slice2 --quiet");
    says("angioscope: slice2: ");
    says(sentence);
    assert_ptr_equal(strchr(strstr(output, "angioscope: slice2: "), '\n'), output + strlen(output) - 1);
}

static void a_crash_costs_one_slice(void **state) {
    (void)state;
    costs_one_slice('c', "its JPEG stream made the decoder crash");
    expect(4, "info " SERIES " --strict --quiet");
    is_refused('a', "its JPEG stream made the decoder crash");
    is_refused('x', "its JPEG stream made the decoder crash");
}

static void a_hang_costs_one_slice(void **state) {
    (void)state;
    costs_one_slice('h', "its JPEG stream keeps the decoder busy for too long");
    is_refused('l', "its JPEG stream keeps the decoder busy for too long");
}

/* Whether the kernel and the build let the decoder be confined. */
static bool is_confined(void) {
#ifdef __SANITIZE_ADDRESS__
    print_message("skipped: AddressSanitizer needs files and address space\n");
    return false;
#else
    write_series('f');
    expect(0, "info " SERIES " --quiet");
    bool confined = !strstr(output, "does not confine");
    if (!confined) print_message("skipped: the kernel does not confine the decoder\n");
    return confined;
#endif
}

static void memory_is_limited(void **state) {
    (void)state;
    if (is_confined()) costs_one_slice('m', "its pixels cannot? be decoded");
}

static void files_and_network_and_processes_are_out_of_reach(void **state) {
    (void)state;
    if (!is_confined()) return;
    is_refused('o', "its pixels cannot? be decoded");
    costs_one_slice('s', "its JPEG stream made the decoder try what it must not do");
    is_refused('p', "its JPEG stream made the decoder try what it must not do");
}

static void without_its_program_there_is_a_way_out(void **state) {
    (void)state;
    write_series('f');
    assert_int_equal(rename(FOLDER "/bin/angioscope-decode", FOLDER "/bin/gone"), 0);
    expect(3, "info " SERIES " --quiet");
    says("cannot be started");
    says("--no-sandbox");
    expect(0, "info " SERIES " --quiet --no-sandbox");
    assert_int_equal(rename(FOLDER "/bin/gone", FOLDER "/bin/angioscope-decode"), 0);
    assert_int_equal(WEXITSTATUS(system(FOLDER "/bin/angioscope-decode </dev/null 2>/dev/null")), ANG_USAGE);
}

#ifdef ANG_WITH_OIIO

/* With the real reader of pictures. */
static void pictures_are_the_same_either_way(void **state) {
    (void)state;
    fresh_folder(SERIES);
    uint16_t values[24];
    for (int i = 0; i < 4; i++) {
        char path[512];
        snprintf(path, sizeof path, SERIES "/%d.png", i);
        uint8_t samples[12]; /* big endian */
        for (int k = 0; k < 6; k++) {
            values[6 * i + k] = (uint16_t)(300 * i + 250 + k);
            samples[2 * k] = (uint8_t)(values[6 * i + k] >> 8);
            samples[2 * k + 1] = (uint8_t)values[6 * i + k];
        }
        write_png(path, 3, 2, 16, 1, samples);
    }
    for (int i = 0; i < 2; i++) {
        ang_load_options how = {.no_sandbox = i == 1};
        ang_load_report report;
        ang_error err = {0};
        ang_volume *volume = ang_load(SERIES, &how, &report, NULL, &err);
        if (!volume) fail_msg("%s", err.message);
        assert_memory_equal(volume->data, values, sizeof values);
        ang_volume_free(volume);
        ang_load_report_clear(&report);
    }
    assert_int_equal(truncate(SERIES "/2.png", 50), 0);
    must_fail(SERIES, ANG_INPUT, "2.png");
}

#endif

int main(void) {
    const struct CMUnitTest tests[] = {
#ifdef ANG_WITH_OIIO
        cmocka_unit_test(pictures_are_the_same_either_way),
#endif
        cmocka_unit_test(what_is_sound_is_the_same_either_way),
        cmocka_unit_test(a_crash_costs_one_slice),
        cmocka_unit_test(a_hang_costs_one_slice),
        cmocka_unit_test(memory_is_limited),
        cmocka_unit_test(files_and_network_and_processes_are_out_of_reach),
        cmocka_unit_test(without_its_program_there_is_a_way_out),
    };
    return cmocka_run_group_tests(tests, setup, teardown);
}

#else

int main(void) {
    print_message("skipped: this build decodes nothing\n");
    return 0;
}

#endif
