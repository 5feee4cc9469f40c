#include "io/archive/archive.h"

#include "core/base/memory.h"
#include "io/archive/zip.h"
#include "io/formats.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

static bool is_archive(const char *path) {
    struct stat status;
    char start[4] = "";
    if (stat(path, &status) != 0 || !S_ISREG(status.st_mode)) return false;
    FILE *file = fopen(path, "rb");
    if (!file) return false;
    size_t got = fread(start, 1, sizeof start, file);
    fclose(file);
    return got == 4 && (memcmp(start, "PK\3\4", 4) == 0 || memcmp(start, "PK\5\6", 4) == 0);
}

#ifndef ANG_WITH_ZIP
bool ang_zip_unpack(const char *path, const char *label, const char *folder, ang_notes *warnings,
                    const ang_progress *progress, ang_error *err) {
    (void)path, (void)folder, (void)warnings, (void)progress;
    return ang_fail(err, ANG_INPUT, "%s: is a zip archive; reading those is left out of this build (ANG_WITH_ZIP)",
                    label);
}
#endif

/* Unpacks one archive into a folder of its name, so that messages name it. */
static bool unpack_one(ang_unpacked *unpacked, size_t index, ang_notes *warnings, const ang_progress *progress,
                       ang_error *err) {
    const char *path = unpacked->path[index], *label = ang_base_name(path);
    if (!unpacked->scratch.path[0] && !ang_scratch_make(&unpacked->scratch, err)) return false;
    char *folder = NULL;
    /* Two archives may have one name. */
    if (asprintf(&folder, "%s/%zu", unpacked->scratch.path, index) < 0 || mkdir(folder, 0700) != 0) {
        ang_fail(err, ANG_OUTPUT, "%s: %s", unpacked->scratch.path, strerror(errno));
        free(folder);
        return false;
    }
    free(folder);
    if (asprintf(&unpacked->folder[index], "%s/%zu/%s", unpacked->scratch.path, index, label) < 0) {
        unpacked->folder[index] = NULL;
        return ang_fail(err, ANG_LIMIT, "no memory for a name");
    }
    if (mkdir(unpacked->folder[index], 0700) != 0)
        return ang_fail(err, ANG_OUTPUT, "%s: %s", unpacked->folder[index], strerror(errno));
    unpacked->path[index] = unpacked->folder[index];
    return ang_zip_unpack(path, label, unpacked->folder[index], warnings, progress, err);
}

bool ang_unpack(const char *const *paths, size_t count, ang_unpacked *unpacked, ang_notes *warnings,
                const ang_progress *progress, ang_error *err) {
    *unpacked = (ang_unpacked){.scratch = {.line = -1}};
    unpacked->path = ang_alloc(count, sizeof *unpacked->path, "list of files", err);
    unpacked->folder = ang_alloc(count, sizeof *unpacked->folder, "list of files", err);
    if (!unpacked->path || !unpacked->folder) return false;
    unpacked->count = count;
    for (size_t i = 0; i < count; i++) unpacked->path[i] = paths[i];
    for (size_t i = 0; i < count; i++)
        if (is_archive(paths[i]) && !unpack_one(unpacked, i, warnings, progress, err)) return false;
    return true;
}

void ang_unpacked_name(const ang_unpacked *unpacked, ang_error *err) {
    for (size_t i = 0; i < unpacked->count; i++) {
        const char *folder = unpacked->folder[i];
        size_t cut = folder ? (size_t)(ang_base_name(folder) - folder) : 0;
        for (char *at; cut > 0 && (at = strstr(err->message, folder));) memmove(at, at + cut, strlen(at + cut) + 1);
    }
}

void ang_unpacked_clear(ang_unpacked *unpacked) {
    for (size_t i = 0; i < unpacked->count; i++) free(unpacked->folder[i]);
    free(unpacked->folder);
    free(unpacked->path);
    ang_scratch_remove(&unpacked->scratch);
    *unpacked = (ang_unpacked){.scratch = {.line = -1}};
}
