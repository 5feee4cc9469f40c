#include "io/replace.h"

#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#define LEFTOVER "angioscope-" /* after a dot: what names of temporary files begin with */

static bool fail(const char *path, int reason, ang_error *err) {
    char text[128];
    return ang_fail(err, ANG_OUTPUT, "%s: cannot be written (%s); choose another place or free some space", path,
                    strerror_r(reason, text, sizeof text));
}

/* The length of the folder in `path`, with its final slash; 0 where it names none. */
static int folder_length(const char *path) {
    const char *slash = strrchr(path, '/');
    return slash ? (int)(slash - path) + 1 : 0;
}

/* The file itself, in `target` of PATH_MAX bytes, where `path` is a symbolic link or a chain of them, dangling or not:
 * what is replaced must not be the link. False with errno. */
static bool follow_links(const char *path, char *target) {
    if (snprintf(target, PATH_MAX, "%s", path) >= PATH_MAX) {
        errno = ENAMETOOLONG;
        return false;
    }
    for (int links = 0; links < 40; links++) {
        char link[PATH_MAX], next[PATH_MAX];
        ssize_t length = readlink(target, link, sizeof link - 1);
        if (length < 0) return errno == EINVAL || errno == ENOENT; /* no link, or nothing */
        link[length] = '\0';
        int folder = link[0] == '/' ? 0 : folder_length(target);
        if (snprintf(next, sizeof next, "%.*s%s", folder, target, link) >= (int)sizeof next) {
            errno = ENAMETOOLONG;
            return false;
        }
        memcpy(target, next, sizeof next);
    }
    errno = ELOOP;
    return false;
}

/* Gives a new file the permissions and, as far as we may, the owner of the one that it is to replace. */
static bool keep_permissions(int file, const char *target) {
    struct stat old, new;
    if (stat(target, &old) != 0) return true;
    if (fstat(file, &new) != 0) return false;
    mode_t mode = old.st_mode & 07777;
    if (old.st_uid != new.st_uid && fchown(file, old.st_uid, (gid_t)-1) != 0) mode &= ~(mode_t)(S_ISUID | S_ISGID);
    /* Another group must not read what was not for it. */
    if (old.st_gid != new.st_gid && fchown(file, (uid_t)-1, old.st_gid) != 0)
        mode = (mode & ~(mode_t)(S_ISGID | S_IRWXG)) | ((mode & S_IRWXO) << 3 & (mode & S_IRWXG));
    return fchmod(file, mode) == 0;
}

/* Opens a new file beside `target`. O_EXCL instead of mkstemp: it gets the permissions that the user's umask gives, not
 * 0600, and no two processes or threads have the same. -1 with errno. */
static int open_temporary(const char *target, const char *ending, char *temporary, size_t size) {
    for (unsigned attempt = 0; attempt < 10000; attempt++) {
        int length = snprintf(temporary, size, "%.*s." LEFTOVER "%ld-%u.part%s", folder_length(target), target,
                              (long)getpid(), attempt, ending);
        if (length < 0 || (size_t)length >= size) {
            errno = ENAMETOOLONG;
            return -1;
        }
        int file = open(temporary, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
        if (file < 0 && errno == EEXIST) continue;
        if (file >= 0 && !keep_permissions(file, target)) {
            int reason = errno;
            close(file);
            unlink(temporary);
            errno = reason;
            return -1;
        }
        return file;
    }
    errno = EEXIST;
    return -1;
}

/* Some file systems cannot flush: that is no failure to write. */
static bool flush(int file) { return fsync(file) == 0 || errno == EINVAL || errno == EROFS || errno == ENOTSUP; }

static bool write_all(int file, const unsigned char *data, size_t size) {
    while (size > 0) {
        ssize_t written = write(file, data, size);
        if (written < 0 && errno == EINTR) continue;
        if (written == 0) errno = ENOSPC;
        if (written <= 0) return false;
        data += written;
        size -= (size_t)written;
    }
    return flush(file);
}

/* The folder of `path`, in `folder` of PATH_MAX bytes: with its final slash, or ".". */
static void folder_of(const char *path, char *folder) {
    int length = folder_length(path);
    snprintf(folder, PATH_MAX, "%.*s", length ? length : 1, length ? path : ".");
}

bool ang_file_same(const char *a, const char *b) {
    struct stat left, right;
    bool left_is = stat(a, &left) == 0, right_is = stat(b, &right) == 0;
    if (left_is != right_is) return false;
    if (!left_is) {
        if (strcmp(a + folder_length(a), b + folder_length(b)) != 0) return false;
        char left_folder[PATH_MAX], right_folder[PATH_MAX];
        folder_of(a, left_folder);
        folder_of(b, right_folder);
        if (stat(left_folder, &left) != 0 || stat(right_folder, &right) != 0) return false;
    }
    return left.st_dev == right.st_dev && left.st_ino == right.st_ino;
}

bool ang_file_leftover(const char *name) {
    size_t known = sizeof "." LEFTOVER - 1;
    return strncmp(name, "." LEFTOVER, known) == 0 && strstr(name + known, ".part");
}

/* As ang_file_replaceable, and what `path` leads to, in `target` of PATH_MAX bytes. */
static bool find_target(const char *path, char *target, ang_error *err) {
    struct stat status;
    if (!follow_links(path, target)) return fail(path, errno, err);
    bool there = stat(target, &status) == 0;
    if (there && !S_ISREG(status.st_mode)) {
        return ang_fail(err, ANG_OUTPUT, "%s: exists and is %s; give the name of a file", path,
                        S_ISDIR(status.st_mode) ? "a folder" : "not a regular file");
    }
    char folder[PATH_MAX];
    folder_of(target, folder);
    bool may = access(folder, W_OK | X_OK) == 0 && (!there || access(target, W_OK) == 0);
    return may || fail(path, errno, err);
}

bool ang_file_replaceable(const char *path, ang_error *err) {
    char target[PATH_MAX];
    return find_target(path, target, err);
}

/* A whole file beside `target`, on the disk. What is wrong is said of `path`. */
static bool write_beside(const char *path, const char *target, const void *data, size_t size, char *temporary,
                         size_t room, ang_error *err) {
    int file = open_temporary(target, "", temporary, room);
    if (file < 0) {
        temporary[0] = '\0';
        return fail(path, errno, err);
    }
    bool good = write_all(file, data, size);
    int reason = errno;
    if (close(file) != 0 && good) {
        good = false;
        reason = errno;
    }
    if (good) return true;
    unlink(temporary);
    temporary[0] = '\0';
    return fail(path, reason, err);
}

bool ang_file_replace(const char *path, const void *data, size_t size, ang_error *err) {
    char target[PATH_MAX], temporary[PATH_MAX];
    if (!find_target(path, target, err) || !write_beside(path, target, data, size, temporary, sizeof temporary, err))
        return false;
    if (rename(temporary, target) == 0) return true;
    int reason = errno;
    unlink(temporary);
    return fail(path, reason, err);
}

/* Gives `temporary` a name that nothing has. False with errno, EEXIST where something has it. */
static bool rename_to_new(const char *temporary, const char *target) {
    if (renameat2(AT_FDCWD, temporary, AT_FDCWD, target, RENAME_NOREPLACE) == 0) return true;
    if (errno != EINVAL && errno != ENOSYS) return false; /* else file systems that cannot, such as NFS */
    if (link(temporary, target) != 0) return false;
    unlink(temporary);
    return true;
}

bool ang_file_create(const char *path, const void *data, size_t size, bool *taken, ang_error *err) {
    char temporary[PATH_MAX];
    struct stat status;
    *taken = lstat(path, &status) == 0;
    if (*taken) return fail(path, EEXIST, err);
    if (!write_beside(path, path, data, size, temporary, sizeof temporary, err)) return false;
    if (rename_to_new(temporary, path)) return true;
    int reason = errno;
    *taken = reason == EEXIST;
    unlink(temporary);
    return fail(path, reason, err);
}

bool ang_file_prepare(const char *path, const void *data, size_t size, char *temporary, size_t room, ang_error *err) {
    char target[PATH_MAX];
    temporary[0] = '\0';
    return find_target(path, target, err) && write_beside(path, target, data, size, temporary, room, err);
}

bool ang_file_temporary(const char *path, const char *ending, char *temporary, size_t size, ang_error *err) {
    char target[PATH_MAX];
    temporary[0] = '\0';
    if (!find_target(path, target, err)) return false;
    int file = open_temporary(target, ending, temporary, size);
    if (file < 0) {
        temporary[0] = '\0';
        return fail(path, errno, err);
    }
    close(file);
    return true;
}

bool ang_file_rename(const char *temporary, const char *path, ang_error *err) {
    char target[PATH_MAX];
    if (!find_target(path, target, err)) return false;
    int file = open(temporary, O_RDONLY | O_CLOEXEC);
    if (file < 0) return fail(path, errno, err);
    bool flushed = flush(file);
    int reason = errno;
    close(file);
    if (!flushed) return fail(path, reason, err);
    return rename(temporary, target) == 0 || fail(path, errno, err);
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
