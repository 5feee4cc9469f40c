#include "io/dicom/folder.h"

#include "core/base/memory.h"
#include "core/base/parallel.h"
#include "io/dicom/directory.h"
#include "io/dicom/header.h"
#include "io/formats.h"
#include "io/replace.h"

#include <dirent.h>
#include <errno.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>

enum { deepest = 32, most_warnings = 20 };

void ang_dicom_folder_clear(ang_dicom_folder *folder) {
    for (size_t i = 0; i < folder->count; i++) free(folder->paths[i]);
    free(folder->paths);
    free(folder->labels);
    free(folder->slices);
    *folder = (ang_dicom_folder){0};
}

void ang_dicom_warn_file(ang_notes *notes, const char *label, const char *message) {
    size_t length = strlen(label);
    if (strncmp(message, label, length) == 0 && message[length] == ':') message += length + 1;
    while (*message == ' ') message++;
    ang_notes_add_file(notes, label, "%s", message);
}

static bool add_path(ang_dicom_folder *folder, size_t *capacity, char *path, ang_error *err) {
    if (path && folder->count == *capacity) {
        size_t wanted = *capacity ? *capacity * 2 : 256;
        char **grown = realloc(folder->paths, wanted * sizeof *grown);
        if (!grown) {
            free(path);
            path = NULL;
        } else {
            folder->paths = grown;
            *capacity = wanted;
        }
    }
    if (!path) return ang_fail(err, ANG_LIMIT, "no memory for the list of files");
    folder->paths[folder->count++] = path;
    return true;
}

/* Folders below are followed, links to folders are not: they may lead back here. */
static bool list_files(const char *path, ang_dicom_folder *folder, size_t *capacity, int depth,
                       const ang_progress *progress, ang_error *err) {
    if (!ang_progress_update(progress, "reading headers", 0))
        return ang_fail(err, ANG_INTERRUPTED, "interrupted while looking for files");
    DIR *directory = opendir(path);
    if (!directory) {
        if (depth > 0) return true; /* a folder that we may not enter holds nothing for us */
        return ang_fail(err, ANG_INPUT, "%s: %s", path, strerror(errno));
    }
    bool ok = true;
    for (struct dirent *entry; ok && (entry = readdir(directory));) {
        if (strcmp(entry->d_name, ".") == 0 || strcmp(entry->d_name, "..") == 0) continue;
        if (ang_file_leftover(entry->d_name)) continue;
        char *full = NULL;
        if (asprintf(&full, "%s/%s", path, entry->d_name) < 0) full = NULL;
        struct stat status;
        int type = entry->d_type;
        if (full && (type == DT_UNKNOWN || type == DT_LNK)) {
            bool known = stat(full, &status) == 0;
            if (known && S_ISREG(status.st_mode)) type = DT_REG;
            if (known && S_ISDIR(status.st_mode) && type == DT_UNKNOWN) type = DT_DIR;
        }
        if (full && type == DT_DIR) {
            if (depth < deepest) ok = list_files(full, folder, capacity, depth + 1, progress, err);
            free(full);
        } else if (full && type != DT_REG) {
            free(full);
        } else {
            ok = add_path(folder, capacity, full, err);
        }
    }
    closedir(directory);
    return ok;
}

static int compare_paths(const void *left, const void *right) {
    return strcmp(*(char *const *)left, *(char *const *)right);
}

typedef struct header_job {
    const ang_dicom_folder *folder;
    const ang_progress *progress;
    ang_dicom_reader *readers; /* per worker */
    ang_dicom_slice *slices;   /* per file */
    ang_dicom_slice **frames;  /* per file: of a multi-frame image */
    ang_dicom_found *found;
    char **errors;
    atomic_size_t done;
    atomic_bool stop;
} header_job;

static void read_headers(void *context, size_t begin, size_t end, int worker) {
    header_job *job = context;
    for (size_t i = begin; i < end; i++) {
        if (atomic_load_explicit(&job->stop, memory_order_relaxed)) return;
        ang_error why = {0};
        job->slices[i].file = i;
        job->found[i] = ang_dicom_header(job->folder->paths[i], job->folder->labels[i], &job->readers[worker],
                                         &job->slices[i], &job->frames[i], &why);
        if (job->found[i] == ANG_DICOM_BROKEN) job->errors[i] = strdup(why.message);
        double share = (double)(atomic_fetch_add(&job->done, 1) + 1) / (double)job->folder->count;
        if (!ang_progress_update(job->progress, "reading headers", share)) atomic_store(&job->stop, true);
    }
}

/* One record for each picture of the files that can be read. */
static bool collect_slices(ang_dicom_folder *folder, const header_job *job, ang_error *err) {
    size_t count = 0;
    for (size_t i = 0; i < folder->count; i++)
        if (job->found[i] == ANG_DICOM_FOUND) count += job->frames[i] ? (size_t)job->slices[i].frames : 1;
    folder->slices = ang_alloc(count ? count : 1, sizeof *folder->slices, "headers", err);
    if (!folder->slices) return false;
    for (size_t i = 0; i < folder->count; i++) {
        size_t frames = job->frames[i] ? (size_t)job->slices[i].frames : 1;
        if (job->found[i] != ANG_DICOM_FOUND) continue;
        memcpy(folder->slices + folder->slice_count, job->frames[i] ? job->frames[i] : &job->slices[i],
               frames * sizeof *folder->slices);
        folder->slice_count += frames;
    }
    return true;
}

static void sum_up(ang_dicom_folder *folder, const header_job *job, ang_notes *warnings) {
    for (size_t i = 0; i < folder->count; i++) {
        if (job->found[i] == ANG_DICOM_FOREIGN) folder->foreign++;
        if (job->found[i] == ANG_DICOM_BROKEN) {
            const char *why = job->errors[i] ? job->errors[i] : "cannot be read: no memory";
            if (folder->broken++ == 0) snprintf(folder->first_error, sizeof folder->first_error, "%s", why);
            if (folder->broken <= most_warnings) ang_dicom_warn_file(warnings, folder->labels[i], why);
        }
    }
    if (folder->broken > most_warnings)
        ang_notes_add(warnings, "%zu more file%s cannot be read", folder->broken - most_warnings,
                      ang_plural((long long)(folder->broken - most_warnings)));
}

/* Adds the files that a DICOMDIR names, which moves out of it, and says what is wrong with it. */
static bool take_index(const char *path, ang_dicom_directory *index, ang_dicom_folder *folder, size_t *capacity,
                       ang_notes *warnings, ang_error *err) {
    const char *label = ang_base_name(path);
    bool ok = true;
    if (index->damaged)
        ang_notes_add_file(warnings, label, "this index is damaged: its folder is searched");
    else if (index->missing > 0)
        ang_notes_add_file(warnings, label, "this index names %zu file%s not there: its folder is searched",
                           index->missing, index->missing == 1 ? " that is" : "s that are");
    for (size_t i = 0; i < index->count && ok; i++) {
        ok = add_path(folder, capacity, index->paths[i], err);
        index->paths[i] = NULL;
    }
    return ok;
}

/* One path of the caller: a folder, a DICOMDIR or another file. */
static bool take_path(const char *path, ang_dicom_folder *folder, size_t *capacity, ang_notes *warnings,
                      const ang_progress *progress, ang_error *err) {
    struct stat status;
    if (stat(path, &status) != 0) return ang_fail(err, ANG_INPUT, "%s: %s", path, strerror(errno));
    if (S_ISDIR(status.st_mode)) {
        size_t before = folder->count;
        bool ok = list_files(path, folder, capacity, 0, progress, err);
        for (size_t i = before, listed = folder->count; i < listed && ok; i++) {
            if (strcasecmp(ang_base_name(folder->paths[i]), "DICOMDIR") != 0) continue;
            ang_dicom_directory index = ang_dicom_read_directory(folder->paths[i]);
            ok = take_index(folder->paths[i], &index, folder, capacity, warnings, err);
            ang_dicom_directory_clear(&index);
        }
        return ok;
    }
    if (!S_ISREG(status.st_mode) || !ang_dicom_is_directory(path)) return add_path(folder, capacity, strdup(path), err);
    ang_dicom_directory index = ang_dicom_read_directory(path);
    bool ok = take_index(path, &index, folder, capacity, warnings, err);
    if (ok && (index.damaged || index.missing > 0)) {
        char *around = ang_dicom_folder_of(path);
        ok = around ? list_files(around, folder, capacity, 0, progress, err)
                    : ang_fail(err, ANG_LIMIT, "no memory for a path");
        free(around);
    } else {
        folder->indexed += index.count;
    }
    ang_dicom_directory_clear(&index);
    return ok;
}

/* The files at and below the paths, sorted, each once. */
static bool find_files(const char *const *paths, size_t count, ang_dicom_folder *folder, ang_notes *warnings,
                       const ang_progress *progress, ang_error *err) {
    size_t capacity = 0, kept = 0;
    for (size_t i = 0; i < count; i++)
        if (!take_path(paths[i], folder, &capacity, warnings, progress, err)) return false;
    if (folder->count == 0) return ang_fail(err, ANG_INPUT, "%s: there is no file in it", paths[0]);
    qsort(folder->paths, folder->count, sizeof *folder->paths, compare_paths);
    for (size_t i = 0; i < folder->count; i++) {
        if (kept > 0 && strcmp(folder->paths[kept - 1], folder->paths[i]) == 0)
            free(folder->paths[i]);
        else
            folder->paths[kept++] = folder->paths[i];
    }
    folder->count = kept;
    return true;
}

bool ang_dicom_read_folder(const char *const *paths, size_t count, int threads, ang_dicom_folder *folder,
                           ang_notes *warnings, const ang_progress *progress, ang_error *err) {
    *folder = (ang_dicom_folder){0};
    if (!find_files(paths, count, folder, warnings, progress, err)) {
        ang_dicom_folder_clear(folder);
        return false;
    }
    folder->labels = ang_alloc(folder->count, sizeof *folder->labels, "list of files", err);
    for (size_t i = 0; folder->labels && i < folder->count; i++) folder->labels[i] = ang_base_name(folder->paths[i]);
    int workers = ang_thread_count(threads);
    header_job job = {.folder = folder, .progress = progress};
    job.readers = ang_alloc((size_t)workers, sizeof *job.readers, "headers", err);
    job.slices = ang_alloc(folder->count, sizeof *job.slices, "headers", err);
    job.found = ang_alloc(folder->count, sizeof *job.found, "headers", err);
    job.errors = ang_alloc(folder->count, sizeof *job.errors, "headers", err);
    job.frames = ang_alloc(folder->count, sizeof *job.frames, "headers", err);
    bool ok = folder->labels && job.readers && job.slices && job.found && job.errors && job.frames;
    if (ok) {
        ang_parallel_for(folder->count, 8, threads, read_headers, &job);
        if (job.stop) ok = ang_fail(err, ANG_INTERRUPTED, "interrupted while reading headers");
    }
    ok = ok && collect_slices(folder, &job, err);
    if (ok) sum_up(folder, &job, warnings);
    for (size_t i = 0; job.errors && i < folder->count; i++) free(job.errors[i]);
    for (size_t i = 0; job.frames && i < folder->count; i++) free(job.frames[i]);
    free(job.frames);
    free(job.readers);
    free(job.slices);
    free(job.found);
    free(job.errors);
    if (!ok) ang_dicom_folder_clear(folder);
    return ok;
}
