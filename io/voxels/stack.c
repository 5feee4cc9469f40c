#include "io/voxels/stack.h"

#include "core/base/memory.h"
#include "core/base/name_order.h"
#include "io/formats.h"
#include "io/image/encode.h"
#include "io/voxels/samples.h"
#include "io/voxels/stack_sidecar.h"

#include <ctype.h>
#include <dirent.h>
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>
#include <unistd.h>

bool ang_stack_probe(const char *path) {
    static const struct {
        const char *bytes;
        size_t size;
    } starts[] = {{"\x89PNG\r\n\x1A\n", 8}, {"II*\0", 4}, {"MM\0*", 4}, {"II+\0", 4}, {"MM\0+", 4}};
    char start[8] = "";
    FILE *file = fopen(path, "rb");
    if (!file) return false;
    size_t got = fread(start, 1, sizeof start, file);
    fclose(file);
    for (size_t i = 0; i < sizeof starts / sizeof *starts; i++)
        if (got >= starts[i].size && memcmp(start, starts[i].bytes, starts[i].size) == 0) return true;
    return false;
}

static bool is_picture_name(const char *name) {
    static const char *const endings[] = {".png", ".tif", ".tiff"};
    const char *dot = strrchr(name, '.');
    for (size_t i = 0; i < 3 && dot && name[0] != '.'; i++)
        if (strcasecmp(dot, endings[i]) == 0) return true;
    return false;
}

/* The paths of the pictures; owns them. */
typedef struct pictures {
    char **path;
    size_t count, room;
} pictures;

static void clear(pictures *pictures) {
    for (size_t i = 0; i < pictures->count; i++) free(pictures->path[i]);
    free(pictures->path);
}

static bool add(pictures *pictures, char *path) {
    if (path && pictures->count == pictures->room) {
        size_t room = pictures->room ? 2 * pictures->room : 64;
        char **grown = realloc(pictures->path, room * sizeof *grown);
        if (grown) {
            pictures->path = grown;
            pictures->room = room;
        }
    }
    if (!path || pictures->count == pictures->room) {
        free(path);
        return false;
    }
    pictures->path[pictures->count++] = path;
    return true;
}

static int compare(const void *a, const void *b) {
    return ang_name_compare(ang_base_name(*(char *const *)a), ang_base_name(*(char *const *)b));
}

static bool find_pictures(const char *path, pictures *found, ang_error *err) {
    DIR *directory = opendir(path);
    bool ok = true;
    if (!directory) return ang_fail(err, ANG_INPUT, "%s: %s", ang_base_name(path), strerror(errno));
    for (struct dirent *entry; ok && (entry = readdir(directory));) {
        char *full = NULL;
        if (!is_picture_name(entry->d_name)) continue;
        if (asprintf(&full, "%s/%s", path, entry->d_name) < 0) full = NULL;
        ok = add(found, full);
    }
    closedir(directory);
    if (!ok) return ang_fail(err, ANG_LIMIT, "no memory for the list of files");
    if (found->count > 1) qsort(found->path, found->count, sizeof *found->path, compare);
    return found->count > 0 || ang_fail(err, ANG_INPUT, "%s: holds no picture", ang_base_name(path));
}

static bool is_folder(const char *path) {
    struct stat status;
    return stat(path, &status) == 0 && S_ISDIR(status.st_mode);
}

char *ang_stack_sidecar(const char *path) {
    char *sidecar = NULL;
    if (!is_folder(path)) return ang_raw_sidecar(path);
    if (asprintf(&sidecar, "%s/stack.json", path) < 0) return NULL;
    if (access(sidecar, R_OK) == 0) return sidecar;
    free(sidecar);
    return NULL;
}

/* The last number in a name, or -1. */
static long long number_of(const char *path) {
    const char *name = ang_base_name(path), *end = name + strlen(name);
    while (end > name && !isdigit((unsigned char)end[-1])) end--;
    const char *begin = end;
    while (begin > name && isdigit((unsigned char)begin[-1])) begin--;
    return end > begin && end - begin < 18 ? strtoll(begin, NULL, 10) : -1;
}

/* Says what of the order of the pictures is in doubt: numbers left out, or none. */
static void note_numbers(const pictures *pictures, ang_load_report *report) {
    long long least = 0, missing = 0;
    for (size_t i = 1; i < pictures->count; i++) {
        long long step = number_of(pictures->path[i]) - number_of(pictures->path[i - 1]);
        if (number_of(pictures->path[i - 1]) < 0 || step <= 0) {
            ang_notes_add(&report->warnings, "its pictures are not all numbered: they are taken in the order of their "
                                             "names");
            return;
        }
        if (least == 0 || step < least) least = step;
    }
    for (size_t i = 1; i < pictures->count; i++)
        missing += (number_of(pictures->path[i]) - number_of(pictures->path[i - 1])) / least - 1;
    if (missing > 0)
        ang_notes_add(&report->warnings, "the numbers of its pictures leave out %lld: nothing is put in their place",
                      missing);
    ang_notes_add(&report->assumptions, "its pictures are taken in the order of their numbers");
}

static bool read_form(const char *path, ang_stack_form *form, ang_load_report *report, ang_error *err) {
    *form = ang_stack_form_default();
    char *sidecar = ang_stack_sidecar(path);
    bool ok = !sidecar || ang_stack_form_read(sidecar, form, err);
    free(sidecar);
    if (!ok) return false;
    if (!form->has_spacing)
        ang_notes_add(&report->warnings,
                      "nothing says how large its voxels are: 1 x 1 x 1 mm is taken; lengths are not "
                      "to be trusted");
    if (!form->has_directions)
        ang_notes_add(&report->warnings, "nothing says how it lies in the patient: rows are taken to run to the left, "
                                         "columns to posterior, pictures from the lowest to the highest");
    if (form->slope == 1 && form->intercept == 0)
        ang_notes_add(&report->assumptions, "values of pictures are taken as they are: they need not be HU");
    return true;
}

static void set_affine(const ang_stack_form *form, ang_volume *volume) {
    for (int row = 0; row < 3; row++) {
        double centre = 0;
        for (int axis = 0; axis < 3; axis++) {
            volume->affine.m[row][axis] = form->direction[3 * axis + row] * form->spacing[axis];
            centre += volume->affine.m[row][axis] * (volume->dims[axis] - 1) / 2;
        }
        volume->affine.m[row][3] = form->has_origin ? form->origin[row] : -centre;
    }
}

/* The number type and the size of one picture; pages where it is the only one. */
static bool look_at_first(const pictures *pictures, const ang_stack_form *form, ang_sample_source *source,
                          ang_error *err) {
    ang_grey_form grey;
    void *handle = ang_sandbox_grey_open(source->parts.sandbox, pictures->path[0], &grey, err);
    if (!handle) return false;
    ang_sandbox_grey_close(handle);
    if (pictures->count > 1 && grey.pages > 1)
        return ang_fail(err, ANG_INPUT, "%s: has %d pages, and is one of several files: a stack is one or the other",
                        ang_base_name(pictures->path[0]), grey.pages);
    source->dims[0] = grey.width;
    source->dims[1] = grey.height;
    source->dims[2] = pictures->count > 1 ? (int)pictures->count : grey.pages;
    source->type = form->is_signed ? ang_sample_signed(grey.type) : grey.type;
    source->big_endian = __BYTE_ORDER__ == __ORDER_BIG_ENDIAN__;
    return true;
}

static ang_volume *load_pictures(const pictures *pictures, ang_sandbox *sandbox, const char *label,
                                 const ang_stack_form *form, const ang_load_options *options, ang_load_report *report,
                                 const ang_progress *progress, ang_error *err) {
    ang_sample_source source = {.label = label,
                                .parts = {.sandbox = sandbox},
                                .slope = form->slope,
                                .intercept = form->intercept,
                                .slices = options->slices};
    if (!look_at_first(pictures, form, &source, err)) return NULL;
    ang_byte_part *parts = ang_alloc(pictures->count, sizeof *parts, "list of files", err);
    if (!parts) return NULL;
    for (size_t i = 0; i < pictures->count; i++) parts[i].path = pictures->path[i];
    source.parts =
        (ang_byte_parts){.part = parts, .count = pictures->count, .coding = ANG_CODING_PICTURE, .sandbox = sandbox};
    ang_volume *volume = ang_samples_read(&source, options->threads, report, progress, err);
    free(parts);
    if (!volume) return NULL;
    set_affine(form, volume);
    if (ang_samples_list(volume, 1, "?", label, report, err)) return volume;
    ang_volume_free(volume);
    return NULL;
}

ang_volume *ang_stack_load(const char *path, const ang_load_options *options, ang_load_report *report,
                           const ang_progress *progress, ang_error *err) {
    ang_stack_form form;
    pictures found = {0};
    snprintf(report->format, sizeof report->format, "pictures");
    bool ok = read_form(path, &form, report, err);
    if (ok && is_folder(path))
        ok = find_pictures(path, &found, err);
    else if (ok)
        ok = add(&found, strdup(path)) || ang_fail(err, ANG_LIMIT, "no memory for a name");
    if (ok && found.count > 1) note_numbers(&found, report);
    ang_sandbox *sandbox = ok && !options->no_sandbox ? ang_sandbox_create(ANG_OIIO_MODULE, err) : NULL;
    ok = ok && (sandbox || options->no_sandbox);
    ang_volume *volume =
        ok ? load_pictures(&found, sandbox, ang_base_name(path), &form, options, report, progress, err) : NULL;
    const char *remark = sandbox ? ang_sandbox_remark(sandbox) : NULL;
    if (remark) ang_notes_add(&report->assumptions, "%s", remark);
    ang_sandbox_free(sandbox);
    clear(&found);
    return volume;
}
