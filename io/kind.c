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
    if (options->raw_dims && !options->raw_remembered) return ANG_KIND_RAW;
    if (ang_dicom_probe(path)) return ANG_KIND_DICOM;
    if (ang_nifti_probe(path)) return ANG_KIND_NIFTI;
    if (begins_like(path, nrrd, 1)) return ANG_KIND_NRRD;
    if (begins_like(path, metaimage, 3)) return ANG_KIND_METAIMAGE;
    if (ang_stack_probe(path)) return ANG_KIND_PICTURES;
    return ang_raw_probe(path, options) ? ANG_KIND_RAW : ANG_KIND_NONE;
}

void ang_found_clear(ang_found *found) {
    for (size_t i = 0; i < found->count; i++) free(found->volume[i].path);
    free(found->volume);
    *found = (ang_found){0};
}

/* False where memory is out. */
static bool add(ang_found *found, const char *path, ang_kind kind) {
    if ((found->count & (found->count + 1)) == 0) { /* room for 1, 3, 7, ... */
        ang_found_volume *grown = realloc(found->volume, (2 * found->count + 1) * sizeof *grown);
        if (!grown) return false;
        found->volume = grown;
    }
    char *copy = strdup(path);
    if (copy) found->volume[found->count++] = (ang_found_volume){kind, copy};
    return copy != NULL;
}

typedef struct looking {
    const ang_progress *progress;
    ang_found *found;
    bool dicom, stopped, no_memory;
} looking;

/* `pictures` says whether this folder has been taken for those in it. */
static void look_at_file(looking *looking, const char *folder, const char *path, bool *pictures) {
    /* What options say of raw input is said of no file of a folder. */
    static const ang_load_options none = {0};
    ang_kind kind = kind_of_file(path, &none);
    bool taken = kind == ANG_KIND_NONE || (kind == ANG_KIND_PICTURES && *pictures);
    if (kind == ANG_KIND_DICOM)
        looking->dicom = true;
    else if (!taken && !add(looking->found, kind == ANG_KIND_PICTURES ? folder : path, kind))
        looking->no_memory = true;
    if (kind == ANG_KIND_PICTURES) *pictures = true;
}

/* Until the first DICOM file; links to folders are not followed. */
static void look_in(looking *looking, const char *folder, int depth) {
    DIR *directory = opendir(folder);
    bool pictures = false;
    if (!directory) return;
    for (struct dirent *entry; !looking->dicom && !looking->stopped && (entry = readdir(directory));) {
        struct stat status;
        char *path = NULL;
        if (strcmp(entry->d_name, ".") == 0 || strcmp(entry->d_name, "..") == 0) continue;
        looking->stopped = !ang_progress_update(looking->progress, "reading headers", 0);
        if (asprintf(&path, "%s/%s", folder, entry->d_name) < 0) path = NULL;
        bool link = entry->d_type == DT_LNK;
        if (path && stat(path, &status) == 0) {
            if (S_ISREG(status.st_mode)) look_at_file(looking, folder, path, &pictures);
            if (S_ISDIR(status.st_mode) && !link && depth < deepest) look_in(looking, path, depth + 1);
        }
        free(path);
    }
    closedir(directory);
}

/* Volumes before pictures, each by name. */
static int compare(const void *left, const void *right) {
    const ang_found_volume *a = left, *b = right;
    int order = (a->kind == ANG_KIND_PICTURES) - (b->kind == ANG_KIND_PICTURES);
    return order ? order : ang_name_compare(a->path, b->path);
}

static bool find_in_folder(const char *path, const ang_progress *progress, ang_found *found, ang_error *err) {
    looking looking = {.progress = progress, .found = found};
    look_in(&looking, path, 0);
    if (looking.stopped) return ang_fail(err, ANG_INTERRUPTED, "interrupted while looking for files");
    if (looking.dicom) ang_found_clear(found);
    bool ok = !looking.no_memory && (found->count > 0 || add(found, path, ANG_KIND_DICOM));
    if (!ok) return ang_fail(err, ANG_LIMIT, "no memory for a list of files");
    qsort(found->volume, found->count, sizeof *found->volume, compare);
    return true;
}

static bool find_one(const char *path, const ang_load_options *options, const ang_progress *progress, ang_found *found,
                     ang_error *err) {
    struct stat status;
    if (stat(path, &status) != 0) return ang_fail(err, ANG_INPUT, "%s: %s", path, strerror(errno));
    if (S_ISDIR(status.st_mode)) return find_in_folder(path, progress, found, err);
    if (!S_ISREG(status.st_mode)) return ang_fail(err, ANG_INPUT, "%s: is neither a file nor a folder", path);
    return add(found, path, kind_of_file(path, options)) || ang_fail(err, ANG_LIMIT, "no memory for a name");
}

/* Adds what one path holds to what all do. Sets `dicom`. */
static bool merge(ang_found *all, const ang_found *one, bool *dicom, ang_error *err) {
    bool ok = true;
    for (size_t i = 0; i < one->count && ok; i++) {
        *dicom = *dicom || one->volume[i].kind == ANG_KIND_DICOM;
        if (one->volume[i].kind != ANG_KIND_NONE) ok = add(all, one->volume[i].path, one->volume[i].kind);
    }
    return ok || ang_fail(err, ANG_LIMIT, "no memory for a list of files");
}

bool ang_kind_find(const char *const *paths, size_t count, const ang_load_options *options,
                   const ang_progress *progress, ang_found *found, ang_error *err) {
    bool ok = true, dicom = false;
    *found = (ang_found){0};
    for (size_t i = 0; i < count && ok && !dicom; i++) {
        ang_found one = {0};
        ok = find_one(paths[i], options, progress, &one, err) && merge(found, &one, &dicom, err);
        ang_found_clear(&one);
    }
    if (dicom) ang_found_clear(found);
    if (ok && found->count == 0 && !add(found, paths[0], dicom ? ANG_KIND_DICOM : ANG_KIND_NONE))
        ok = ang_fail(err, ANG_LIMIT, "no memory for a name");
    if (!ok) ang_found_clear(found);
    return ok;
}
