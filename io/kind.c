#include "io/kind.h"

#include "core/base/name_order.h"
#include "io/dicom/dicom.h"
#include "io/formats.h"
#include "io/voxels/stack.h"

#include <dirent.h>
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

enum { deepest = 32 };

static bool begins_like(const char *path, const char *const *starts, size_t count) {
    char start[16] = "";
    FILE *file = fopen(path, "rb");
    if (!file) return false;
    size_t length = fread(start, 1, sizeof start, file);
    fclose(file);
    for (size_t i = 0; i < count; i++) {
        size_t needed = strlen(starts[i]);
        if (length >= needed && memcmp(start, starts[i], needed) == 0) return true;
    }
    return false;
}

static ang_kind kind_of_file(const char *path, const ang_load_options *options) {
    static const char *const nrrd[] = {"NRRD000"};
    static const char *const metaimage[] = {"ObjectType", "NDims", "Comment = "};
    if (options->raw_dims) return ANG_KIND_RAW;
    if (ang_dicom_probe(path)) return ANG_KIND_DICOM;
    if (ang_nifti_probe(path)) return ANG_KIND_NIFTI;
    if (begins_like(path, nrrd, 1)) return ANG_KIND_NRRD;
    if (begins_like(path, metaimage, 3)) return ANG_KIND_METAIMAGE;
    if (ang_stack_probe(path)) return ANG_KIND_PICTURES;
    return ang_raw_probe(path, options) ? ANG_KIND_RAW : ANG_KIND_NONE;
}

void ang_found_clear(ang_found *found) {
    free(found->path);
    *found = (ang_found){0};
}

typedef struct looking {
    const ang_load_options *options;
    const ang_progress *progress;
    ang_found volume; /* the first by name */
    size_t volumes;
    char *pictures; /* the first folder that holds some */
    bool dicom, stopped;
} looking;

static void take_volume(looking *looking, const char *path, ang_kind kind) {
    looking->volumes++;
    if (looking->volume.path && ang_name_compare(looking->volume.path, path) <= 0) return;
    char *copy = strdup(path);
    if (!copy) return;
    free(looking->volume.path);
    looking->volume.path = copy;
    looking->volume.kind = kind;
}

static void take_pictures(looking *looking, const char *folder) {
    if (looking->pictures && ang_name_compare(looking->pictures, folder) <= 0) return;
    char *copy = strdup(folder);
    if (!copy) return;
    free(looking->pictures);
    looking->pictures = copy;
}

static void look_at_file(looking *looking, const char *folder, const char *path) {
    ang_kind kind = kind_of_file(path, looking->options);
    if (kind == ANG_KIND_DICOM)
        looking->dicom = true;
    else if (kind == ANG_KIND_PICTURES)
        take_pictures(looking, folder);
    else if (kind != ANG_KIND_NONE)
        take_volume(looking, path, kind);
}

/* Until the first DICOM file; links to folders are not followed. */
static void look_in(looking *looking, const char *folder, int depth) {
    DIR *directory = opendir(folder);
    if (!directory) return;
    for (struct dirent *entry; !looking->dicom && !looking->stopped && (entry = readdir(directory));) {
        struct stat status;
        char *path = NULL;
        if (strcmp(entry->d_name, ".") == 0 || strcmp(entry->d_name, "..") == 0) continue;
        looking->stopped = !ang_progress_update(looking->progress, "reading headers", 0);
        if (asprintf(&path, "%s/%s", folder, entry->d_name) < 0) path = NULL;
        bool link = entry->d_type == DT_LNK;
        if (path && stat(path, &status) == 0) {
            if (S_ISREG(status.st_mode)) look_at_file(looking, folder, path);
            if (S_ISDIR(status.st_mode) && !link && depth < deepest) look_in(looking, path, depth + 1);
        }
        free(path);
    }
    closedir(directory);
}

/* What a look has found; takes its strings. */
static void conclude(looking *looking, const char *path, ang_found *found) {
    if (looking->dicom || (!looking->volume.path && !looking->pictures)) {
        *found = (ang_found){.kind = ANG_KIND_DICOM, .path = strdup(path)};
    } else if (looking->volume.path) {
        *found = looking->volume;
        found->others = looking->volumes - 1;
        looking->volume.path = NULL;
    } else {
        *found = (ang_found){.kind = ANG_KIND_PICTURES, .path = looking->pictures};
        looking->pictures = NULL;
    }
    free(looking->volume.path);
    free(looking->pictures);
}

bool ang_kind_find(const char *path, const ang_load_options *options, const ang_progress *progress, ang_found *found,
                   ang_error *err) {
    struct stat status;
    *found = (ang_found){0};
    if (stat(path, &status) != 0) return ang_fail(err, ANG_INPUT, "%s: %s", path, strerror(errno));
    bool folder = S_ISDIR(status.st_mode);
    if (!folder && !S_ISREG(status.st_mode))
        return ang_fail(err, ANG_INPUT, "%s: is neither a file nor a folder", path);
    /* What options say of raw input is said of no file of a folder. */
    static const ang_load_options none = {0};
    looking looking = {.options = &none, .progress = progress};
    if (folder) {
        look_in(&looking, path, 0);
        conclude(&looking, path, found);
    } else {
        *found = (ang_found){.kind = kind_of_file(path, options), .path = strdup(path)};
    }
    bool done = looking.stopped ? ang_fail(err, ANG_INTERRUPTED, "interrupted while looking for files")
                                : found->path || ang_fail(err, ANG_LIMIT, "no memory for a name");
    if (!done) ang_found_clear(found);
    return done;
}

bool ang_kind_choose(const char *const *paths, size_t count, const ang_load_options *options,
                     const ang_progress *progress, size_t *index, ang_found *found, ang_error *err) {
    *index = 0;
    if (!ang_kind_find(paths[0], options, progress, found, err)) return false;
    for (size_t i = 1; i < count && found->kind != ANG_KIND_DICOM; i++) {
        ang_found other;
        if (!ang_kind_find(paths[i], options, progress, &other, err)) {
            ang_found_clear(found);
            return false;
        }
        bool better = other.kind == ANG_KIND_DICOM || (found->kind == ANG_KIND_NONE && other.kind != ANG_KIND_NONE);
        ang_found_clear(better ? found : &other);
        if (!better) continue;
        *found = other;
        *index = i;
    }
    return true;
}
