#include "app/view_saving.h"

#ifdef ANG_WITH_WINDOW

#include "app/verbs.h"
#include "app/view_state.h"
#include "io/dicom/capture.h"
#include "io/image/image_io.h"
#include "io/replace.h"
#include "io/report.h"
#include "io/session/state.h"

#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { MOST_FILES = 9999 };
static const double black[4] = {0, 0, 0, 1};

/* The file of a number. */
static bool name_file(const char *folder, const char *what, int number, const char *ending, char *path, size_t size,
                      ang_error *err) {
    int used =
        snprintf(path, size, "%s/angioscope-%s-%04d.%s", strcmp(folder, "/") == 0 ? "" : folder, what, number, ending);
    return (used >= 0 && (size_t)used < size) || ang_fail(err, ANG_OUTPUT, "%s: is too long a name", folder);
}

static bool write_new(const ang_options *options, const char *what, const char *ending, const void *data, size_t length,
                      char *path, size_t size, ang_error *err) {
    const char *folder = options->pictures;
    char whole[PATH_MAX];
    if (!ang_folder_make(folder, err)) return false;
    if (realpath(folder, whole)) folder = whole;
    for (int i = 1; i <= MOST_FILES; i++) {
        bool taken = false;
        if (!name_file(folder, what, i, ending, path, size, err)) return false;
        if (access(path, F_OK) == 0) continue;
        if (ang_file_create(path, data, length, &taken, err)) return true;
        if (!taken) return false;
    }
    return ang_fail(err, ANG_OUTPUT, "%s: holds %d files of this kind; name another folder with --pictures", folder,
                    (int)MOST_FILES);
}

static bool state_of(const ang_options *options, const ang_viewer_state *shown, ang_state *state, ang_error *err) {
    ang_load_options how = ang_app_load_options(options);
    return ang_view_state_of(shown, &how, state, err);
}

bool ang_view_save_picture(const ang_options *options, const char *what, const ang_image *image,
                           const ang_viewer_state *shown, char *path, size_t size, ang_error *err) {
    ang_state state;
    char *text = NULL;
    unsigned char *png = NULL;
    size_t length = 0;
    if (shown) {
        if (!state_of(options, shown, &state, err)) return false;
        text = ang_state_print(&state, ANG_VERSION, err);
        ang_state_clear(&state);
        if (!text) return false;
    }
    bool saved = ang_image_png(image, black, text, &png, &length, err) &&
                 write_new(options, what, "png", png, length, path, size, err);
    free(png);
    free(text);
    return saved;
}

bool ang_view_save_capture(const ang_options *options, const char *what, const ang_image *image, const ang_study *study,
                           const char *right, const char *down, char *path, size_t size, ang_error *err) {
    const ang_load_report *report = study->handle;
    ang_notes warnings = {0};
    ang_capture capture;
    char name[32], description[128];
    unsigned char *rgb = NULL, *file = NULL;
    size_t length = 0;
    ang_load_report_name(report, name);
    snprintf(description, sizeof description, "Angioscope " ANG_VERSION ": %s pane. Not for diagnosis.", what);
    bool saved = ang_capture_begin(&capture, report->identity, options->keep_phi, name, ANG_VERSION, &warnings, err) &&
                 ang_image_rgb(image, black, &rgb, err);
    ang_capture_picture picture = {.width = image->width,
                                   .height = image->height,
                                   .rgb = rgb,
                                   .number = 1,
                                   .right = right,
                                   .down = down,
                                   .description = description};
    saved = saved && ang_capture_encode(&capture, &picture, &file, &length, err) &&
            write_new(options, what, "dcm", file, length, path, size, err);
    ang_app_say(&warnings, "warning: ", NULL);
    ang_notes_clear(&warnings);
    free(rgb);
    free(file);
    return saved;
}

bool ang_view_save_state(const ang_options *options, const ang_viewer_state *shown, char *path, size_t size,
                         ang_error *err) {
    ang_state state;
    char first[PATH_MAX]; /* any file of the folder: paths are relative to that */
    if (!ang_folder_make(options->pictures, err) ||
        !name_file(options->pictures, "state", 1, "json", first, sizeof first, err) ||
        !state_of(options, shown, &state, err))
        return false;
    char *text = ang_state_text(&state, ANG_VERSION, first, err);
    ang_state_clear(&state);
    bool saved = text && write_new(options, "state", "json", text, strlen(text), path, size, err);
    free(text);
    return saved;
}

#endif
