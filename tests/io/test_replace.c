/* Files appear whole or not at all: on full, read-only and forbidden disks, where the writer is killed, and where
 * several write at once. */
#include "tests/core/fixtures.h"

#include "io/replace.h"
#include "tests/io/bad_places.h"

#include <errno.h>
#include <fcntl.h>
#include <sys/stat.h>

#define FOLDER ANG_TEST_TMP "/replace"
#define TARGET FOLDER "/file"

static int clean(void **state) {
    (void)state;
    return system("rm -rf '" FOLDER "' && mkdir -p '" FOLDER "'");
}

static bool write_letters(const char *path, char letter, size_t size, ang_error *err) {
    char *bytes = malloc(size + 1);
    memset(bytes, letter, size);
    bool written = ang_file_replace(path, bytes, size, err);
    free(bytes);
    return written;
}

/* The letter that a file of `size` bytes consists of; 0 where it is not such a file. */
static char letter_of(const char *path, size_t size) {
    FILE *file = fopen(path, "rb");
    char *bytes = malloc(size + 1), letter = 0;
    if (file && fread(bytes, 1, size + 1, file) == size) {
        letter = bytes[0];
        for (size_t i = 0; i < size; i++)
            if (bytes[i] != letter) letter = 0;
    }
    if (file) fclose(file);
    free(bytes);
    return letter;
}

static mode_t mode_of(const char *path) {
    struct stat status;
    assert_int_equal(stat(path, &status), 0);
    return status.st_mode & 07777;
}

/* Whether the failure is one of output, and says in one line which file and why. */
static bool is_told(const ang_error *err, const char *path, int reason) {
    return err->code == ANG_OUTPUT && strncmp(err->message, path, strlen(path)) == 0 &&
           strstr(err->message, strerror(reason)) && !strchr(err->message, '\n');
}

static void what_is_there_is_replaced(void **state) {
    (void)state;
    umask(022);
    assert_true(write_letters(TARGET, 'a', 1000, NULL));
    assert_int_equal(letter_of(TARGET, 1000), 'a');
    assert_int_equal(mode_of(TARGET), 0644); /* as the umask has it */
    assert_true(write_letters(TARGET, 'b', 10, NULL));
    assert_int_equal(letter_of(TARGET, 10), 'b');
    assert_true(ang_file_replace(TARGET, NULL, 0, NULL));
    struct stat status;
    assert_int_equal(stat(TARGET, &status), 0);
    assert_int_equal(status.st_size, 0);
    assert_int_equal(hidden_files(FOLDER), 0);
}

static void permissions_stay(void **state) {
    (void)state;
    assert_true(write_letters(TARGET, 'a', 10, NULL));
    const mode_t modes[] = {0600, 0640, 0664, 0755};
    for (size_t i = 0; i < sizeof modes / sizeof *modes; i++) {
        assert_int_equal(chmod(TARGET, modes[i]), 0);
        assert_true(write_letters(TARGET, 'b', 20, NULL));
        assert_int_equal(mode_of(TARGET), modes[i]);
    }
    if (geteuid() != 0) return;
    struct stat status;
    assert_int_equal(chown(TARGET, 1234, 2345), 0);
    assert_true(write_letters(TARGET, 'c', 30, NULL));
    assert_int_equal(stat(TARGET, &status), 0);
    assert_int_equal(status.st_uid, 1234);
    assert_int_equal(status.st_gid, 2345);
}

/* A file of a group that we are not in, in a folder that is ours: our group must not read it in its stead. */
static int replace_anothers(const char *path) { return be_nobody() && write_letters(path, 'b', 10, NULL) ? 0 : 1; }
static void another_group_gets_nothing(void **state) {
    (void)state;
    if (geteuid() != 0) skip();
    assert_true(write_letters(TARGET, 'a', 10, NULL));
    assert_int_equal(chmod(FOLDER, 0777), 0);
    assert_int_equal(chmod(TARGET, 0662), 0);
    assert_int_equal(in_child(replace_anothers, TARGET), 0);
    assert_int_equal(letter_of(TARGET, 10), 'b');
    assert_int_equal(mode_of(TARGET), 0622);
}

static void links_stay_links(void **state) {
    (void)state;
    struct stat status;
    assert_int_equal(mkdir(FOLDER "/below", 0755), 0);
    assert_int_equal(symlink("below/real", FOLDER "/first"), 0); /* dangling */
    assert_int_equal(symlink("first", FOLDER "/second"), 0);
    const char *letters = "xyz", *paths[] = {FOLDER "/second", FOLDER "/first", FOLDER "/below/real"};
    for (int i = 0; i < 3; i++) {
        assert_true(ang_file_replaceable(paths[i], NULL));
        assert_true(write_letters(paths[i], letters[i], 100, NULL));
        assert_int_equal(letter_of(FOLDER "/below/real", 100), letters[i]);
    }
    assert_int_equal(lstat(FOLDER "/second", &status), 0);
    assert_true(S_ISLNK(status.st_mode));
    assert_int_equal(lstat(FOLDER "/first", &status), 0);
    assert_true(S_ISLNK(status.st_mode));
    assert_int_equal(hidden_files(FOLDER), 0);
    assert_int_equal(hidden_files(FOLDER "/below"), 0);

    ang_error err = {0};
    assert_int_equal(symlink("round", FOLDER "/round"), 0);
    assert_false(write_letters(FOLDER "/round", 'a', 1, &err));
    assert_true(is_told(&err, FOLDER "/round", ELOOP));
}

static void what_is_no_file_is_refused(void **state) {
    (void)state;
    const char *paths[] = {FOLDER, "/dev/null", "/dev/full"};
    for (size_t i = 0; i < sizeof paths / sizeof *paths; i++) {
        ang_error err = {0};
        assert_false(write_letters(paths[i], 'a', 10, &err));
        assert_int_equal(err.code, ANG_OUTPUT);
        assert_int_equal(strncmp(err.message, paths[i], strlen(paths[i])), 0);
    }
    ang_error err = {0};
    assert_false(write_letters(FOLDER "/missing/file", 'a', 10, &err));
    assert_true(is_told(&err, FOLDER "/missing/file", ENOENT));
}

/* Children that try to replace a file of 10 letters by one of 100,000, and say 0 where that failed as it must. */
static int fails_with(const char *path, int reason) {
    ang_error err = {0};
    if (write_letters(path, 'b', 100000, &err)) return 1;
    if (!is_told(&err, path, reason)) {
        fprintf(stderr, "%s\n", err.message);
        return 2;
    }
    if (letter_of(path, 10) != 'a') return 3;
    return hidden_files(FOLDER) == 0 ? 0 : 4;
}

static int on_a_full_disk(const char *path) {
    if (!make_small(FOLDER, 64)) return NOT_POSSIBLE;
    if (!write_letters(path, 'a', 10, NULL)) return 5;
    int code = fails_with(path, ENOSPC);
    /* What fits is written. */
    return code ? code : write_letters(path, 'c', 20000, NULL) && letter_of(path, 20000) == 'c' ? 0 : 6;
}
static void full_disks_change_nothing(void **state) {
    (void)state;
    expect_in_child(0, on_a_full_disk, TARGET);
}

static int beyond_a_limit(const char *path) { return limit_files(50000) ? fails_with(path, EFBIG) : NOT_POSSIBLE; }
static void limits_change_nothing(void **state) {
    (void)state;
    assert_true(write_letters(TARGET, 'a', 10, NULL));
    expect_in_child(0, beyond_a_limit, TARGET);
}

static int on_a_read_only_disk(const char *path) {
    if (!make_read_only(FOLDER)) return NOT_POSSIBLE;
    ang_error err = {0};
    if (ang_file_replaceable(path, &err) || !is_told(&err, path, EROFS)) return 5;
    return fails_with(path, EROFS);
}
static void read_only_disks_are_told(void **state) {
    (void)state;
    assert_true(write_letters(TARGET, 'a', 10, NULL));
    expect_in_child(0, on_a_read_only_disk, TARGET);
}

static int as_nobody(const char *path) {
    ang_error err = {0};
    if (!be_nobody() || ang_file_replaceable(path, &err) || !is_told(&err, path, EACCES)) return 5;
    return fails_with(path, EACCES);
}
static void forbidden_folders_and_files_are_told(void **state) {
    (void)state;
    assert_true(write_letters(TARGET, 'a', 10, NULL));
    assert_int_equal(chmod(FOLDER, 0555), 0);
    int folder = in_child(as_nobody, TARGET);
    assert_int_equal(chmod(FOLDER, 0777), 0);
    assert_int_equal(folder, 0);
    assert_int_equal(chmod(TARGET, 0444), 0);
    assert_int_equal(in_child(as_nobody, TARGET), 0);
}

/* Overwrites a file again and again until it is killed. */
static pid_t start_writer(const char *letters, size_t size, int times) {
    fflush(NULL);
    pid_t child = fork();
    assert_true(child >= 0);
    for (int i = 0; child == 0 && i < times; i++)
        if (!write_letters(TARGET, letters[i % 2], size, NULL)) _exit(1);
    if (child == 0) _exit(0);
    return child;
}

static void killed_in_the_middle_it_is_the_old_or_the_new(void **state) {
    (void)state;
    enum { size = 3000000, rounds = 60 };
    unsigned seed = 20;
    int left = 0;
    assert_true(write_letters(TARGET, 'a', size, NULL));
    for (int round = 0; round < rounds; round++) {
        pid_t writer = start_writer("ab", size, 1 << 30);
        usleep((useconds_t)(rand_r(&seed) % 30000));
        kill(writer, SIGKILL);
        int status = 0;
        assert_int_equal(waitpid(writer, &status, 0), writer);
        assert_true(WIFSIGNALED(status));
        char letter = letter_of(TARGET, size);
        if (letter != 'a' && letter != 'b') fail_msg("after %d rounds the file is neither", round + 1);
        left += hidden_files(FOLDER) > 0;
        DIR *directory = opendir(FOLDER);
        for (struct dirent *entry; (entry = readdir(directory));)
            if (entry->d_name[0] == '.' && strspn(entry->d_name, ".") != strlen(entry->d_name)) {
                assert_true(ang_file_leftover(entry->d_name));
                unlinkat(dirfd(directory), entry->d_name, 0);
            }
        closedir(directory);
    }
    print_message("%d of %d were killed while they wrote\n", left, rounds);
}

static void of_two_that_write_one_wins(void **state) {
    (void)state;
    enum { size = 300000, times = 60 };
    assert_true(write_letters(TARGET, 'a', size, NULL));
    pid_t writers[] = {start_writer("ab", size, times), start_writer("cd", size, times),
                       start_writer("ef", size, times)};
    int running = 3, seen = 0;
    while (running > 0) {
        int status = 0;
        for (size_t i = 0; i < 3; i++)
            if (writers[i] && waitpid(writers[i], &status, WNOHANG) == writers[i]) {
                assert_true(WIFEXITED(status) && WEXITSTATUS(status) == 0);
                writers[i] = 0;
                running--;
            }
        char letter = letter_of(TARGET, size);
        if (letter < 'a' || letter > 'f') fail_msg("a reader saw a file that is nobody's");
        seen |= 1 << (letter - 'a');
    }
    assert_int_equal(hidden_files(FOLDER), 0);
    print_message("a reader saw files %#x\n", (unsigned)seen);
}

/* Eight that take the next free number at the same time: each has files of its own, whole. */
static void new_files_have_one_writer_each(void **state) {
    (void)state;
    enum { writers = 8, each = 20, size = 5000 };
    pid_t writer[writers];
    char path[256];
    for (int w = 0; w < writers; w++) {
        writer[w] = fork();
        assert_true(writer[w] >= 0);
        if (writer[w] > 0) continue;
        char text[size];
        memset(text, 'a' + w, size);
        for (int n = 0, made = 0; made < each; n++) {
            bool taken = false;
            snprintf(path, sizeof path, FOLDER "/new-%04d", n);
            made += ang_file_create(path, text, size, &taken, NULL);
        }
        _exit(0);
    }
    for (int w = 0; w < writers; w++) {
        int status = 0;
        assert_int_equal(waitpid(writer[w], &status, 0), writer[w]);
        assert_int_equal(status, 0);
    }
    int count[writers] = {0};
    for (int n = 0; n < writers * each; n++) {
        snprintf(path, sizeof path, FOLDER "/new-%04d", n);
        char letter = letter_of(path, size);
        assert_true(letter >= 'a' && letter < 'a' + writers);
        count[letter - 'a']++;
    }
    for (int w = 0; w < writers; w++) assert_int_equal(count[w], each);
    assert_int_equal(hidden_files(FOLDER), 0);
    bool taken = false;
    assert_int_equal(symlink("nowhere", FOLDER "/link"), 0);
    assert_false(ang_file_create(FOLDER "/link", "x", 1, &taken, NULL));
    assert_true(taken);
    assert_false(ang_file_create(FOLDER "/none/x", "x", 1, &taken, NULL));
    assert_false(taken);
}

static void files_of_others_are_renamed_whole(void **state) {
    (void)state;
    char temporary[4096];
    ang_error err = {0};
    assert_true(write_letters(TARGET, 'a', 10, NULL));
    assert_int_equal(chmod(TARGET, 0640), 0);
    assert_true(ang_file_temporary(TARGET, ".mp4", temporary, sizeof temporary, &err));
    assert_string_equal(strrchr(temporary, '.'), ".mp4");
    assert_true(ang_file_leftover(strrchr(temporary, '/') + 1));
    FILE *file = fopen(temporary, "wb");
    assert_non_null(file);
    for (int i = 0; i < 20; i++) fputc('b', file);
    assert_int_equal(fclose(file), 0);
    assert_int_equal(letter_of(TARGET, 10), 'a');
    assert_true(ang_file_rename(temporary, TARGET, &err));
    assert_int_equal(letter_of(TARGET, 20), 'b');
    assert_int_equal(mode_of(TARGET), 0640);
    assert_int_equal(hidden_files(FOLDER), 0);
}

static void leftovers_are_known_by_name(void **state) {
    (void)state;
    assert_true(ang_file_leftover(".angioscope-123-0.part"));
    assert_true(ang_file_leftover(".angioscope-123-0.part.mp4"));
    assert_false(ang_file_leftover("angioscope-123-0.part"));
    assert_false(ang_file_leftover(".angioscope-settings"));
    assert_false(ang_file_leftover("IM0001.dcm"));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup(what_is_there_is_replaced, clean),
        cmocka_unit_test_setup(permissions_stay, clean),
        cmocka_unit_test_setup(another_group_gets_nothing, clean),
        cmocka_unit_test_setup(links_stay_links, clean),
        cmocka_unit_test_setup(what_is_no_file_is_refused, clean),
        cmocka_unit_test_setup(full_disks_change_nothing, clean),
        cmocka_unit_test_setup(limits_change_nothing, clean),
        cmocka_unit_test_setup(read_only_disks_are_told, clean),
        cmocka_unit_test_setup(forbidden_folders_and_files_are_told, clean),
        cmocka_unit_test_setup(killed_in_the_middle_it_is_the_old_or_the_new, clean),
        cmocka_unit_test_setup(of_two_that_write_one_wins, clean),
        cmocka_unit_test_setup(new_files_have_one_writer_each, clean),
        cmocka_unit_test_setup(files_of_others_are_renamed_whole, clean),
        cmocka_unit_test(leftovers_are_known_by_name),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
