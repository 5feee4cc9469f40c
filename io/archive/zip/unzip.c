#include "io/archive/zip.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/statvfs.h>
#include <unistd.h>
#include <zip.h>

enum { most_files = 500000, piece = 1 << 16, most_name = 1024 };
/* Beyond this an archive is taken for one made to fill the disk. CT packs 2 to 4 times, empty slices 100 times. */
static const double bomb_ratio = 250, bomb_bytes = 256e6;

typedef struct unpacking {
    zip_t *zip;
    const char *label, *folder;
    ang_notes *warnings;
    const ang_progress *progress;
    double total, done; /* bytes, unpacked */
    size_t whole;       /* files that are there as they should be */
    char buffer[piece];
} unpacking;

/* What libzip says of a failure, without line ends. */
static bool fail_zip(const char *label, int code, ang_error *err) {
    zip_error_t error;
    zip_error_init_with_code(&error, code);
    bool damaged = code == ZIP_ER_NOZIP || code == ZIP_ER_INCONS;
    ang_fail(err, code == ZIP_ER_MEMORY ? ANG_LIMIT : ANG_INPUT, "%s: %s (%s)", label,
             damaged ? "is a damaged or cut-off zip archive" : "cannot be read as a zip archive",
             zip_error_strerror(&error));
    zip_error_fini(&error);
    return false;
}

static bool is_encrypted(const zip_stat_t *member) {
    return (member->valid & ZIP_STAT_ENCRYPTION_METHOD) && member->encryption_method != ZIP_EM_NONE;
}

/* What all members claim, before any is unpacked. */
static bool check(unpacking *unpacking, zip_int64_t count, double archive_bytes, ang_error *err) {
    struct statvfs disk;
    zip_stat_t member;
    if (count > most_files)
        return ang_fail(err, ANG_INPUT, "%s: holds %lld files; at most %d are unpacked", unpacking->label,
                        (long long)count, (int)most_files);
    for (zip_int64_t i = 0; i < count; i++) {
        if (zip_stat_index(unpacking->zip, (zip_uint64_t)i, 0, &member) != 0) continue;
        if (is_encrypted(&member))
            return ang_fail(err, ANG_INPUT, "%s: is encrypted: unpack it with its password first", unpacking->label);
        if (member.valid & ZIP_STAT_SIZE) unpacking->total += (double)member.size;
    }
    if (unpacking->total > bomb_bytes && unpacking->total > bomb_ratio * archive_bytes)
        return ang_fail(err, ANG_INPUT, "%s: would unpack to %.0f MB, %.0f times its size: it is refused",
                        unpacking->label, unpacking->total / 1e6, unpacking->total / archive_bytes);
    if (statvfs(unpacking->folder, &disk) == 0) {
        double room = (double)disk.f_bavail * (double)disk.f_frsize;
        if (unpacking->total > 0.95 * room)
            return ang_fail(err, ANG_LIMIT,
                            "%s: unpacks to %.0f MB, for which the disk of temporary files has no room (%.0f MB); set "
                            "TMPDIR to another",
                            unpacking->label, unpacking->total / 1e6, room / 1e6);
    }
    return true;
}

/* The name with plain slashes; false where it leads out of the folder or names none. */
static bool clean_name(const char *name, char out[most_name]) {
    if (!name || strlen(name) >= most_name || name[0] == '/' || name[0] == '\\') return false;
    size_t length = strlen(name);
    for (size_t i = 0; i <= length; i++) out[i] = name[i] == '\\' ? '/' : name[i];
    for (const char *part = out; part; part = strchr(part, '/') ? strchr(part, '/') + 1 : NULL) {
        size_t size = strcspn(part, "/");
        if (size > 255 || (size == 2 && part[0] == '.' && part[1] == '.') || (size == 2 && part[1] == ':'))
            return false;
    }
    return length > 0;
}

/* A new file below the folder, with the folders before it; -1 with errno. */
static int create(int folder, char *name) {
    for (char *slash = strchr(name, '/'); slash; slash = strchr(slash + 1, '/')) {
        *slash = '\0';
        int made = name[0] ? mkdirat(folder, name, 0700) : 0;
        *slash = '/';
        if (made != 0 && errno != EEXIST) return -1;
    }
    return openat(folder, name, O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0600);
}

static bool write_all(int out, const char *bytes, size_t size) {
    while (size > 0) {
        ssize_t wrote = write(out, bytes, size);
        if (wrote < 0 && errno != EINTR) return false;
        if (wrote > 0) {
            bytes += wrote;
            size -= (size_t)wrote;
        }
    }
    return true;
}

/* How a member went. */
typedef enum outcome { WHOLE, DAMAGED, OTHER_SIZE, FAILED } outcome;

/* `size` is what the archive claims: no more is written. */
static outcome copy(unpacking *unpacking, zip_file_t *in, int out, zip_uint64_t size, ang_error *err) {
    zip_uint64_t done = 0;
    for (;;) {
        zip_int64_t got = zip_fread(in, unpacking->buffer, piece);
        if (got < 0) return DAMAGED;
        if (got == 0) return done == size ? WHOLE : OTHER_SIZE;
        if (done + (zip_uint64_t)got > size) return OTHER_SIZE;
        if (!write_all(out, unpacking->buffer, (size_t)got)) {
            ang_fail(err, ANG_LIMIT, "%s: its files cannot be written to %s (%s)", unpacking->label, unpacking->folder,
                     strerror(errno));
            return FAILED;
        }
        done += (zip_uint64_t)got;
        unpacking->done += (double)got;
        double share = unpacking->total > 0 ? unpacking->done / unpacking->total : 1;
        if (!ang_progress_update(unpacking->progress, "unpacking", share < 1 ? share : 1)) {
            ang_fail(err, ANG_INTERRUPTED, "interrupted while unpacking");
            return FAILED;
        }
    }
}

static const char *last_name(const char *name) {
    const char *slash = strrchr(name, '/');
    return slash ? slash + 1 : name;
}

/* A file that cannot be unpacked costs a warning, no more. */
static bool unpack_member(unpacking *unpacking, int folder, zip_uint64_t index, ang_error *err) {
    zip_stat_t member;
    char name[most_name];
    const char *given = zip_get_name(unpacking->zip, index, ZIP_FL_ENC_GUESS);
    if (zip_stat_index(unpacking->zip, index, 0, &member) != 0 || !(member.valid & ZIP_STAT_SIZE)) return true;
    if (!clean_name(given, name)) {
        ang_notes_add(unpacking->warnings,
                      "a file of the archive has a name that leads out of it or is too long: it is "
                      "left out");
        return true;
    }
    if (!last_name(name)[0]) return true; /* a folder */
    zip_file_t *in = zip_fopen_index(unpacking->zip, index, 0);
    int out = in ? create(folder, name) : -1;
    outcome outcome = out < 0 ? DAMAGED : copy(unpacking, in, out, member.size, err);
    const char *why = outcome == OTHER_SIZE
                          ? "its size is another than the archive says"
                          : zip_error_strerror(in ? zip_file_get_error(in) : zip_get_error(unpacking->zip));
    if (outcome == DAMAGED && in && out < 0)
        ang_notes_add_file(unpacking->warnings, last_name(name),
                           "is twice in the archive or has no name here: left out");
    else if (outcome == DAMAGED || outcome == OTHER_SIZE)
        ang_notes_add_file(unpacking->warnings, last_name(name), "cannot be unpacked (%s): left out", why);
    unpacking->whole += outcome == WHOLE;
    if (in) zip_fclose(in);
    if (out >= 0) close(out);
    if ((outcome == DAMAGED || outcome == OTHER_SIZE) && out >= 0) unlinkat(folder, name, 0);
    return outcome != FAILED;
}

static bool unzip(const char *path, const char *label, const char *folder, ang_notes *warnings,
                  const ang_progress *progress, ang_error *err) {
    struct stat status;
    int code, below = open(folder, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (below < 0 || stat(path, &status) != 0) {
        if (below >= 0) close(below);
        return ang_fail(err, ANG_INPUT, "%s: %s", label, strerror(errno));
    }
    unpacking *state = malloc(sizeof *state);
    zip_t *zip = state ? zip_open(path, ZIP_RDONLY, &code) : NULL;
    bool ok = zip || (state ? fail_zip(label, code, err) : ang_fail(err, ANG_LIMIT, "no memory to unpack"));
    if (ok) {
        *state = (unpacking){.zip = zip, .label = label, .folder = folder, .warnings = warnings, .progress = progress};
        zip_int64_t count = zip_get_num_entries(zip, 0);
        ok = check(state, count, (double)status.st_size, err);
        size_t told = warnings->count;
        for (zip_int64_t i = 0; ok && i < count; i++) ok = unpack_member(state, below, (zip_uint64_t)i, err);
        char line[ANG_NOTES_LINE];
        if (ok && state->whole == 0 && warnings->count > told)
            ok = ang_fail(err, ANG_INPUT, "%s: nothing of it can be unpacked: %s", label,
                          ang_notes_line(warnings, told, true, line, sizeof line));
    }
    if (zip) zip_discard(zip);
    free(state);
    close(below);
    return ok;
}

__attribute__((visibility("default"))) const ang_zip_functions ang_zip_module = {unzip};
