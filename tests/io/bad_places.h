/* Places where writing fails, for tests: small and read-only file systems, limits, other users. They are made in a
 * child process with mounts of its own, and end with it. cmocka.h and what it needs must be included first. */
#ifndef ANG_TESTS_IO_BAD_PLACES_H
#define ANG_TESTS_IO_BAD_PLACES_H

#include <dirent.h>
#include <sched.h>
#include <signal.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mount.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

enum { NOT_POSSIBLE = 99 /* exit code of a child that may not make such a place */ };

/* What `work` returns in a process of its own, where it ends with it. */
static inline int in_child(int (*work)(const char *path), const char *path) {
    fflush(NULL);
    pid_t child = fork();
    assert_true(child >= 0);
    if (child == 0) _exit(work(path));
    int status = 0;
    assert_int_equal(waitpid(child, &status, 0), child);
    assert_true(WIFEXITED(status));
    return WEXITSTATUS(status);
}

/* Skips the test where the child had to say so. */
static inline void expect_in_child(int code, int (*work)(const char *path), const char *path) {
    int actual = in_child(work, path);
    if (actual == NOT_POSSIBLE) {
        print_message("this user may not make such a place\n");
        skip();
    }
    assert_int_equal(actual, code);
}

static inline bool put_text(const char *path, const char *text) {
    FILE *file = fopen(path, "w");
    bool put = file && fputs(text, file) >= 0;
    return file && fclose(file) == 0 && put;
}

/* Mounts from here on are seen by this process alone. Without root's rights it becomes root of a world of its own. */
static inline bool mounts_of_our_own(void) {
    unsigned user = geteuid(), group = getegid();
    if (unshare(user == 0 ? CLONE_NEWNS : CLONE_NEWNS | CLONE_NEWUSER) != 0) return false;
    char users[64], groups[64];
    snprintf(users, sizeof users, "0 %u 1", user);
    snprintf(groups, sizeof groups, "0 %u 1", group);
    if (user != 0 && !(put_text("/proc/self/uid_map", users) && put_text("/proc/self/setgroups", "deny") &&
                       put_text("/proc/self/gid_map", groups)))
        return false;
    return mount("none", "/", NULL, MS_REC | MS_PRIVATE, NULL) == 0;
}

/* `folder` becomes an empty file system of this many KiB. */
static inline bool make_small(const char *folder, int kib) {
    char options[64];
    snprintf(options, sizeof options, "size=%dk,mode=0777", kib);
    return mounts_of_our_own() && mount("tmpfs", folder, "tmpfs", 0, options) == 0;
}

/* Nothing below `folder` can be written to, by root neither. */
static inline bool make_read_only(const char *folder) {
    return mounts_of_our_own() && mount(folder, folder, NULL, MS_BIND, NULL) == 0 &&
           mount("none", folder, NULL, MS_REMOUNT | MS_BIND | MS_RDONLY, NULL) == 0;
}

/* Root may write anywhere. */
static inline bool be_nobody(void) {
    if (geteuid() != 0) return true;
    return setgid(65534) == 0 && setuid(65534) == 0;
}

/* No file of this process may grow beyond this; that it tries is told by errors, not by a signal. */
static inline bool limit_files(rlim_t bytes) {
    struct rlimit limit = {bytes, bytes};
    signal(SIGXFSZ, SIG_IGN);
    return setrlimit(RLIMIT_FSIZE, &limit) == 0;
}

/* How many files of `folder` have names that begin with a dot. */
static inline int hidden_files(const char *folder) {
    int count = 0;
    DIR *directory = opendir(folder);
    for (struct dirent *entry; directory && (entry = readdir(directory));)
        count += entry->d_name[0] == '.' && strcmp(entry->d_name, ".") != 0 && strcmp(entry->d_name, "..") != 0;
    if (directory) closedir(directory);
    return count;
}

#endif
