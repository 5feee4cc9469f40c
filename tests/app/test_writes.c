/* Every file that the program writes, on full, limited, read-only and forbidden disks: exit code 7, a sentence that
 * names the file and the reason, and what was there before is there still. Killed or beside another that writes the
 * same, it leaves the old file or the new. */
#include "tests/core/fixtures.h"

#include "tests/app/program.h"
#include "tests/io/bad_places.h"

#include <errno.h>
#include <fcntl.h>
#include <sys/stat.h>

#define FOLDER  ANG_TEST_TMP "/writes"
#define PLACE   FOLDER "/place"
#define PHANTOM FOLDER "/phantom"
#define GOOD    FOLDER "/good.png" /* a picture that can be written, but where limits hold everywhere */
#define OLD     "what was there before"

/* What writes, and the file or folder of PLACE that it writes to. */
typedef struct writer {
    const char *arguments, *file;
    bool folder;
    unsigned only;      /* bits of the places that it can be tried in; 0: all */
    const char *reason; /* that is given on a full disk where the system's is not known */
} writer;
enum { FULL = 1, LIMITED = 2, READ_ONLY = 4, FORBIDDEN = 8 };

static const writer writers[] = {
    {"render " PHANTOM " --size 64x64 -o " PLACE "/out.png", "out.png", false, 0, NULL},
    {"render " PHANTOM " --size 64x64 -o " PLACE "/out.tif", "out.tif", false, 0, NULL},
    {"render " PHANTOM " --size 64x64 -o " PLACE "/out.exr", "out.exr", false, 0, NULL},
    {"render " PHANTOM " --size 64x64 -o " PLACE "/out.ppm", "out.ppm", false, 0, NULL},
    {"render " PHANTOM " --size 64x64 -o " PLACE "/out.pfm", "out.pfm", false, 0, NULL},
    {"render " PHANTOM " --size 64x64 -o " PLACE "/out.dcm", "out.dcm", false, 0, NULL},
#ifdef ANG_WITH_OPENCV
    {"render " PHANTOM " --size 64x64 --frames 4 --orbit 40 -o " PLACE "/film.avi", "film.avi", false, 0, "disk"},
    {"render " PHANTOM " --size 64x64 --frames 4 --orbit 40 -o " PLACE "/film.mp4", "film.mp4", false, 0, "disk"},
#endif
    {"render " PHANTOM " --size 64x64 --frames 2 --orbit 10 -o " PLACE "/turn.png", "turn0000.png", false, 0, NULL},
    {"render " PHANTOM " --size 64x64 -o " GOOD " --json " PLACE "/out.json", "out.json", false,
     FULL | READ_ONLY | FORBIDDEN, NULL},
    {"presets sheet " PHANTOM " -o " PLACE "/sheet.png", "sheet.png", false, 0, NULL},
    {"presets export ct-bone -o " PLACE "/bone.vp", "bone.vp", false, 0, NULL},
    {"presets import " FOLDER "/bone.vp", "angioscope", true, 0, NULL}, /* into XDG_CONFIG_HOME, which is PLACE */
    {"check " FOLDER "/a.png " FOLDER "/b.png --threshold 255 --heat " PLACE "/heat.png", "heat.png", false, 0, NULL},
    {"selfcheck --backend none --cases 1 --json " PLACE "/checked.json", "checked.json", false, 0, NULL},
    {"phantom --dims 16x16x2 -o " PLACE, "IM0001.dcm", false, 0, NULL},
    {"phantom --dims 16x16x2 -o " PLACE "/new", "new", true, 0, NULL},
#ifdef ANG_WITH_WINDOW
    /* What is known before the window opens. */
    {"view " PHANTOM " --write-state " PLACE "/state.json", "state.json", false, READ_ONLY | FORBIDDEN, NULL},
#endif
    {"report " PHANTOM " --size 32x32 --time-limit 0.02 -o " PLACE "/report", "report", true, 0, NULL},
};

/* Makes what the writers read. */
static int prepare(void **state) {
    (void)state;
    if (system("rm -rf '" FOLDER "' && mkdir -p '" PLACE "' && chmod 777 '" FOLDER "'")) return 1;
    return run("phantom -q --dims 48x48x24 -o " PHANTOM) || run("presets export ct-bone -q -o " FOLDER "/bone.vp") ||
           run("render " PHANTOM " -q --size 64x64 -o " FOLDER "/a.png") ||
           run("render " PHANTOM " -q --size 64x64 --view left -o " FOLDER "/b.png");
}

static int clean(void **state) {
    (void)state;
    return system("rm -rf '" PLACE "' '" GOOD "' && mkdir '" PLACE "' && chmod 777 '" PLACE "'");
}

/* What a writer is to replace. */
static bool put_old(const writer *w) {
    char path[512];
    snprintf(path, sizeof path, PLACE "/%s", w->file);
    return w->folder || put_text(path, OLD);
}

static bool is_old(const writer *w) {
    char path[512], text[64] = "";
    snprintf(path, sizeof path, PLACE "/%s", w->file);
    if (w->folder) return true;
    FILE *file = fopen(path, "r");
    size_t length = file ? fread(text, 1, sizeof text - 1, file) : 0;
    if (file) fclose(file);
    return length == strlen(OLD) && strcmp(text, OLD) == 0;
}

/* Runs the writer and compares; what is wrong goes to stderr. For children, where cmocka's checks cannot be. */
static bool fails_well(const writer *w, int reason) {
    char command[2048], said[8192], path[512];
    snprintf(command, sizeof command,
             "XDG_CONFIG_HOME=" PLACE " XDG_CACHE_HOME=" FOLDER " " ANG_PROGRAM " %s -q 2>&1 >/dev/null", w->arguments);
    FILE *pipe = popen(command, "r");
    size_t length = pipe ? fread(said, 1, sizeof said - 1, pipe) : 0;
    said[length] = '\0';
    int status = pipe ? pclose(pipe) : -1;
    snprintf(path, sizeof path, PLACE "%s%s", w->folder ? "/" : "", w->folder ? w->file : "");
    bool given = strstr(said, strerror(reason)) || (w->reason && strstr(said, w->reason));
    const char *wrong = !WIFEXITED(status) || WEXITSTATUS(status) != 7 ? "the exit code is not 7"
                        : strncmp(said, "angioscope: ", 12) != 0       ? "the sentence has another beginning"
                        : !strstr(said, path)                          ? "the file is not named"
                        : !given                                       ? "the reason is not named"
                        : strchr(said, '\n') != said + length - 1      ? "it is more than a line"
                        : !is_old(w)                                   ? "the old file is gone"
                        : hidden_files(PLACE)                          ? "a temporary file is left"
                                                                       : NULL;
    if (wrong) fprintf(stderr, "%s (%s): %s; it said: %s\n", w->arguments, strerror(reason), wrong, said);
    return !wrong;
}

static int all_fail_well(unsigned place, int reason) {
    int failed = 0;
    for (size_t i = 0; i < sizeof writers / sizeof *writers; i++)
        if (!writers[i].only || (writers[i].only & place)) failed += !fails_well(&writers[i], reason);
    return failed;
}

static bool put_all_old(void) {
    bool put = true;
    for (size_t i = 0; i < sizeof writers / sizeof *writers; i++) put = put && put_old(&writers[i]);
    return put;
}

static int on_a_full_disk(const char *path) {
    if (!make_small(path, 512) || !put_all_old()) return NOT_POSSIBLE;
    int filler = open(PLACE "/filler", O_WRONLY | O_CREAT, 0666);
    static const char page[4096];
    while (write(filler, page, sizeof page) > 0) continue;
    close(filler);
    return all_fail_well(FULL, ENOSPC);
}
static void on_full_disks(void **state) {
    (void)state;
    expect_in_child(0, on_a_full_disk, PLACE);
}

static int beyond_a_limit(const char *path) {
    (void)path;
    return limit_files(1) ? all_fail_well(LIMITED, EFBIG) : NOT_POSSIBLE;
}
static void beyond_limits(void **state) {
    (void)state;
    assert_true(put_all_old());
    expect_in_child(0, beyond_a_limit, PLACE);
}

static int on_a_read_only_disk(const char *path) {
    return make_read_only(path) ? all_fail_well(READ_ONLY, EROFS) : NOT_POSSIBLE;
}
static void on_read_only_disks(void **state) {
    (void)state;
    assert_true(put_all_old());
    expect_in_child(0, on_a_read_only_disk, PLACE);
}

static int as_nobody(const char *path) {
    (void)path;
    return be_nobody() ? all_fail_well(FORBIDDEN, EACCES) : NOT_POSSIBLE;
}
static void in_forbidden_folders(void **state) {
    (void)state;
    assert_true(put_all_old());
    assert_int_equal(chmod(PLACE, 0555), 0);
    expect_in_child(0, as_nobody, PLACE);
}

/* Standard output, where it is the product. */
static void on_full_standard_output(void **state) {
    (void)state;
    static const char *const arguments[] = {
        "info " PHANTOM,
        "info " PHANTOM " --json",
        "render " PHANTOM " --size 32x32 -o " PLACE "/out.png --json -",
        "presets list",
        "presets show ct-bone",
        "check " FOLDER "/a.png " FOLDER "/a.png",
        "check " FOLDER "/a.png " FOLDER "/a.png --json",
        "selfcheck --backend none --cases 1",
        "selfcheck --backend none --cases 1 --json -",
        "render --help",
        "--help",
        "--version",
    };
    for (size_t i = 0; i < sizeof arguments / sizeof *arguments; i++) {
        char command[1024];
        snprintf(command, sizeof command, "%s 2>&1 >/dev/full", arguments[i]);
        expect(7, command);
        if (!strstr(output, "standard output cannot be written")) fail_msg("%s: %s", arguments[i], output);
    }
}

/* The bytes of a file, up to `size`; how many. */
static size_t bytes_of(const char *path, char *bytes, size_t size) {
    FILE *file = fopen(path, "rb");
    size_t length = file ? fread(bytes, 1, size, file) : 0;
    if (file) fclose(file);
    return length;
}

/* Whether PLACE/out.png is a.png or b.png, byte for byte; *which is 1 or 2. */
static bool is_one_of_both(int *which) {
    enum { most = 1 << 20 };
    static char written[most], known[2][most];
    size_t length = bytes_of(PLACE "/out.png", written, most);
    const char *paths[] = {FOLDER "/a.png", FOLDER "/b.png"};
    *which = 0;
    for (int i = 0; i < 2; i++)
        if (bytes_of(paths[i], known[i], most) == length && memcmp(written, known[i], length) == 0) *which = i + 1;
    return *which != 0;
}

static pid_t start_render(bool left) {
    fflush(NULL);
    pid_t child = fork();
    assert_true(child >= 0);
    if (child > 0) return child;
    const char *arguments[] = {
        ANG_PROGRAM, "render", PHANTOM, "-q", "--size", "64x64", "-o", PLACE "/out.png", left ? "--view" : NULL,
        "left",      NULL};
    execv(ANG_PROGRAM, (char *const *)arguments);
    _exit(127);
}

static void killed_in_the_middle(void **state) {
    (void)state;
    assert_int_equal(system("cp '" FOLDER "/a.png' '" PLACE "/out.png'"), 0);
    unsigned seed = 8;
    int killed = 0, which = 0;
    for (int round = 0; round < 24; round++) {
        int status = 0;
        pid_t child = start_render(round % 2 == 0);
        usleep((useconds_t)(rand_r(&seed) % 150000));
        kill(child, SIGKILL);
        assert_int_equal(waitpid(child, &status, 0), child);
        killed += WIFSIGNALED(status);
        if (!is_one_of_both(&which)) fail_msg("after %d rounds the picture is neither", round + 1);
    }
    print_message("%d of 24 were killed before their end\n", killed);
}

static void two_at_once(void **state) {
    (void)state;
    int times[3] = {0};
    for (int round = 0; round < 8; round++) {
        pid_t children[] = {start_render(false), start_render(true)};
        for (int i = 0; i < 2; i++) {
            int status = 0, which = 0;
            assert_int_equal(waitpid(children[i], &status, 0), children[i]);
            assert_true(WIFEXITED(status) && WEXITSTATUS(status) == 0);
            assert_true(is_one_of_both(&which));
            times[which]++;
        }
    }
    assert_int_equal(hidden_files(PLACE), 0);
    print_message("seen: %d times the one, %d times the other\n", times[1], times[2]);
}

static int phantom_on_a_full_disk(const char *path) {
    if (!make_small(path, 150)) return NOT_POSSIBLE;
    /* The first series takes two thirds of the disk, so that the second cannot be written beside it. */
    char sums[2][256] = {"", ""};
    for (int i = 0; i < 2; i++) {
        int code = run(i == 0 ? "phantom -q --dims 48x48x8 -o " PLACE
                              : "phantom -q --dims 48x48x8 --seed 2 -o " PLACE " 2>&1");
        if (code != (i == 0 ? 0 : 7)) return 1;
        FILE *pipe = popen("cat '" PLACE "'/* | cksum", "r");
        if (!pipe || !fgets(sums[i], sizeof sums[i], pipe)) return 2;
        pclose(pipe);
    }
    return strcmp(sums[0], sums[1]) != 0 ? 3 : hidden_files(path) ? 4 : 0;
}
static void a_series_is_replaced_as_a_whole(void **state) {
    (void)state;
    expect_in_child(0, phantom_on_a_full_disk, PLACE);
}

/* Half a slice under the name of a leftover is not read; under another name it is a reason for a warning. */
static void leftovers_are_not_read(void **state) {
    (void)state;
    assert_int_equal(system("cp '" PHANTOM "'/*.dcm '" PLACE "' && head -c 3000 '" PLACE "/IM0003.dcm' >'" PLACE
                            "/.angioscope-77-0.part'"),
                     0);
    expect(0, "info " PLACE " --strict -q");
    assert_int_equal(rename(PLACE "/.angioscope-77-0.part", PLACE "/IM0099.dcm"), 0);
    expect(4, "info " PLACE " --strict -q 2>&1");
}

int main(void) {
    setenv("XDG_CACHE_HOME", FOLDER, 1);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup(on_full_disks, clean),
        cmocka_unit_test_setup(beyond_limits, clean),
        cmocka_unit_test_setup(on_read_only_disks, clean),
        cmocka_unit_test_setup(in_forbidden_folders, clean),
        cmocka_unit_test_setup(on_full_standard_output, clean),
        cmocka_unit_test_setup(killed_in_the_middle, clean),
        cmocka_unit_test_setup(a_series_is_replaced_as_a_whole, clean),
        cmocka_unit_test_setup(two_at_once, clean),
        cmocka_unit_test_setup(leftovers_are_not_read, clean),
    };
    return cmocka_run_group_tests(tests, prepare, NULL);
}
