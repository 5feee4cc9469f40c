#include "io/replace.h"

#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static bool fail(const char *path, int reason, ang_error *err) {
    char text[128];
    return ang_fail(err, ANG_OUTPUT, "%s: cannot be written (%s); choose another place or free some space", path,
                    strerror_r(reason, text, sizeof text));
}

/* O_EXCL instead of mkstemp: the file gets the permissions that the user's umask gives, not 0600. */
static int open_temporary(const char *path, const char *ending, char *temporary, size_t size) {
    const char *slash = strrchr(path, '/');
    int folder = slash ? (int)(slash - path) + 1 : 0;
    for (unsigned attempt = 0; attempt < 10000; attempt++) {
        int length = snprintf(temporary, size, "%.*s.ang-%ld-%u.part%s", folder, path, (long)getpid(), attempt, ending);
        if (length < 0 || (size_t)length >= size) {
            errno = ENAMETOOLONG;
            return -1;
        }
        int file = open(temporary, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
        if (file >= 0 || errno != EEXIST) return file;
    }
    errno = EEXIST;
    return -1;
}

/* Some file systems cannot flush: that is no failure to write. */
static bool flush(int file) { return fsync(file) == 0 || errno == EINVAL || errno == EROFS || errno == ENOTSUP; }

static bool write_all(int file, const unsigned char *data, size_t size) {
    while (size > 0) {
        ssize_t written = write(file, data, size);
        if (written < 0) {
            if (errno == EINTR) continue;
            return false;
        }
        data += written;
        size -= (size_t)written;
    }
    return flush(file);
}

/* The folder of `path`, in `folder` of PATH_MAX bytes: with its final slash, or ".". */
static void folder_of(const char *path, char *folder) {
    const char *slash = strrchr(path, '/');
    snprintf(folder, PATH_MAX, "%.*s", slash ? (int)(slash - path) + 1 : 1, slash ? path : ".");
}

bool ang_file_same(const char *a, const char *b) {
    struct stat left, right;
    bool left_is = stat(a, &left) == 0, right_is = stat(b, &right) == 0;
    if (left_is != right_is) return false;
    if (!left_is) {
        const char *left_slash = strrchr(a, '/'), *right_slash = strrchr(b, '/');
        if (strcmp(left_slash ? left_slash + 1 : a, right_slash ? right_slash + 1 : b) != 0) return false;
        char left_folder[PATH_MAX], right_folder[PATH_MAX];
        folder_of(a, left_folder);
        folder_of(b, right_folder);
        if (stat(left_folder, &left) != 0 || stat(right_folder, &right) != 0) return false;
    }
    return left.st_dev == right.st_dev && left.st_ino == right.st_ino;
}

bool ang_file_replaceable(const char *path, ang_error *err) {
    struct stat status;
    if (stat(path, &status) == 0 && !S_ISREG(status.st_mode)) {
        return ang_fail(err, ANG_OUTPUT, "%s: exists and is %s; give the name of a file", path,
                        S_ISDIR(status.st_mode) ? "a folder" : "not a regular file");
    }
    char folder[PATH_MAX];
    folder_of(path, folder);
    return access(folder, W_OK | X_OK) == 0 || fail(path, errno, err);
}

bool ang_file_replace(const char *path, const void *data, size_t size, ang_error *err) {
    if (!ang_file_replaceable(path, err)) return false;
    char temporary[PATH_MAX];
    int file = open_temporary(path, "", temporary, sizeof temporary);
    if (file < 0) return fail(path, errno, err);

    bool good = write_all(file, data, size);
    int reason = errno;
    if (close(file) != 0 && good) {
        good = false;
        reason = errno;
    }
    if (good && rename(temporary, path) != 0) {
        good = false;
        reason = errno;
    }
    if (!good) {
        unlink(temporary);
        return fail(path, reason, err);
    }
    return true;
}

bool ang_file_temporary(const char *path, const char *ending, char *temporary, size_t size, ang_error *err) {
    temporary[0] = '\0';
    if (!ang_file_replaceable(path, err)) return false;
    int file = open_temporary(path, ending, temporary, size);
    if (file < 0) {
        temporary[0] = '\0';
        return fail(path, errno, err);
    }
    close(file);
    return true;
}

bool ang_file_rename(const char *temporary, const char *path, ang_error *err) {
    int file = open(temporary, O_RDONLY | O_CLOEXEC);
    if (file < 0) return fail(path, errno, err);
    bool flushed = flush(file);
    int reason = errno;
    close(file);
    if (!flushed) return fail(path, reason, err);
    return rename(temporary, path) == 0 || fail(path, errno, err);
}

bool ang_folder_make(const char *path, ang_error *err) {
    char part[PATH_MAX];
    size_t length = strlen(path);
    if (length == 0 || length >= sizeof part) return fail(path, length ? ENAMETOOLONG : ENOENT, err);
    for (size_t i = 1; i <= length; i++) {
        if (path[i] != '/' && path[i] != '\0') continue;
        memcpy(part, path, i);
        part[i] = '\0';
        if (mkdir(part, 0777) != 0 && errno != EEXIST) return fail(path, errno, err);
    }
    struct stat status;
    if (stat(path, &status) != 0) return fail(path, errno, err);
    if (!S_ISDIR(status.st_mode)) return ang_fail(err, ANG_OUTPUT, "%s: is not a folder; choose another name", path);
    return true;
}
