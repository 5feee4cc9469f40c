/* angioscope view: the window. */
#include "app/verbs.h"

#ifdef ANG_WITH_WINDOW

#include "app/picture_state.h"
#include "app/view_load.h"
#include "app/view_preferences.h"
#include "app/view_presets.h"
#include "app/view_saving.h"
#include "app/view_state.h"
#include "app/view_waiting.h"
#include "io/font.h"
#include "io/load.h"
#include "io/replace.h"
#include "io/session/state.h"
#include "ui/viewer.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

typedef struct view {
    const ang_options *options;
    ang_view_presets presets;
    char *state;                        /* as last written; NULL: not yet */
    bool state_failed, settings_failed; /* when last written */
    ang_waiting waiting;
    ang_viewer_settings settings;
} view;

static bool load(void *context, const ang_source *source, const ang_slice_sink *slices, ang_study *study,
                 const ang_progress *progress, ang_error *err) {
    view *view = context;
    ang_load_options how = ang_waiting_load_options(&view->waiting, source->paths[0]);
    return ang_view_load(&how, view->options->keep_phi, source, slices, study, progress, err);
}

static void release(void *context, ang_study *study) {
    (void)context;
    ang_view_release(study);
}

static bool survey(void *context, const ang_source *source, const ang_series_sink *sink, const ang_progress *progress,
                   ang_error *err) {
    return ang_view_survey(((view *)context)->options, source, sink, progress, err);
}

static bool list_folder(void *context, const char *path, ang_file_list *list, ang_error *err) {
    (void)context;
    return ang_view_list_folder(path, list, err);
}

static ang_preset *preset_for(void *context, const ang_study *study, ang_error *err) {
    ang_notes notes = {0};
    ang_preset *preset =
        ang_picture_choose_preset(((view *)context)->options, study->volume, study->handle, &notes, err);
    ang_notes_clear(&notes);
    return preset;
}

static bool save_picture(void *context, const char *what, const ang_image *image, const ang_viewer_state *shown,
                         char *path, size_t size, ang_error *err) {
    return ang_view_save_picture(((view *)context)->options, what, image, shown, path, size, err);
}

static bool save_capture(void *context, const char *what, const ang_image *image, const ang_study *study,
                         const char *right, const char *down, char *path, size_t size, ang_error *err) {
    return ang_view_save_capture(((view *)context)->options, what, image, study, right, down, path, size, err);
}

static bool save_state(void *context, const ang_viewer_state *shown, char *path, size_t size, ang_error *err) {
    return ang_view_save_state(((view *)context)->options, shown, path, size, err);
}

static bool is_state(void *context, const char *file) {
    (void)context;
    return ang_state_probe(file);
}

static bool open_state(void *context, const char *file, char *path, size_t size, ang_error *err) {
    ang_waiting *waiting = &((view *)context)->waiting;
    return ang_waiting_read(waiting, file, err) && ang_waiting_data(waiting, path, size, err);
}

static bool session(void *context, const ang_study *study, ang_session *session, ang_error *err) {
    return ang_waiting_session(&((view *)context)->waiting, study, session, err);
}

static ang_preset_place preset_place(void *context, const char *name) {
    return ang_view_preset_place(&((view *)context)->presets, name);
}

static bool save_preset(void *context, const ang_document *document, const char *name, const char *description,
                        char *path, size_t size, ang_error *err) {
    return ang_view_preset_save(&((view *)context)->presets, document, name, description, path, size, err);
}

static bool delete_preset(void *context, const char *name, ang_error *err) {
    return ang_view_preset_delete(&((view *)context)->presets, name, err);
}

static bool is_preset_file(void *context, const char *file) {
    (void)context;
    return ang_view_preset_is_file(file);
}

static bool import_presets(void *context, const char *file, char *first, size_t first_size, char *said,
                           size_t said_size, ang_error *err) {
    return ang_view_preset_import(&((view *)context)->presets, file, first, first_size, said, said_size, err);
}

/* Only what has changed is written. */
static void shown(void *context, const ang_viewer_state *state) {
    view *view = context;
    ang_load_options how = ang_app_load_options(view->options);
    char *text = ang_view_state_print(state, &how);
    if (!text || (view->state && strcmp(text, view->state) == 0)) {
        free(text);
        return;
    }
    ang_error err = {0};
    bool written = ang_file_replace(view->options->write_state, text, strlen(text), &err);
    if (!written && !view->state_failed) fprintf(stderr, "angioscope: %s\n", err.message);
    view->state_failed = !written;
    free(view->state);
    view->state = text;
}

static void remember(void *context, const ang_viewer_settings *settings) {
    view *view = context;
    ang_error err = {0};
    bool written = ang_view_preferences_write(settings, &err);
    if (!written && !view->settings_failed)
        fprintf(stderr, "warning: %s; layout and recent files will be forgotten\n", err.message);
    view->settings_failed = !written;
}

static bool full_path(void *context, const char *path, char *full, size_t size) {
    (void)context;
    char *found = realpath(path, NULL);
    bool fits = found && strlen(found) < size;
    if (fits) strcpy(full, found);
    free(found);
    return fits;
}

static bool run(view *view, ang_error *err) {
    const ang_options *options = view->options;
    ang_viewer_options how = {.paths = (const char *const *)options->arguments,
                              .path_count = (size_t)options->argument_count};
    char folder[4096] = "/";
    if (!getcwd(folder, sizeof folder)) snprintf(folder, sizeof folder, "/");
    int size[2] = {0};
    if (options->size && !ang_app_parse_dims("size", options->size, 2, 16384, size, err)) return false;
    if (options->write_state && !ang_file_replaceable(options->write_state, err)) return false;
    how.width = size[0];
    how.height = size[1];
    how.scale = options->scale;
    if (!ang_view_presets_read(&view->presets, &how.preset, err)) return false;
    if (options->state && !ang_waiting_read(&view->waiting, options->state, err)) return false;
    if (options->state && how.path_count == 0) {
        how.paths = &options->state;
        how.path_count = 1;
    }
    ang_view_preferences_read(&view->settings);
    ang_viewer_host host = {.context = view,
                            .load = load,
                            .release = release,
                            .survey = survey,
                            .list_folder = list_folder,
                            .home = getenv("HOME"),
                            .folder = folder,
                            .preset_for = preset_for,
                            .save_picture = save_picture,
                            .save_capture = save_capture,
                            .preset_place = preset_place,
                            .save_preset = save_preset,
                            .save_state = save_state,
                            .is_state = is_state,
                            .open_state = open_state,
                            .session = session,
                            .delete_preset = delete_preset,
                            .is_preset_file = is_preset_file,
                            .import_presets = import_presets,
                            .shown = options->write_state ? shown : NULL,
                            .remember = remember,
                            .full_path = full_path,
                            .settings = &view->settings,
                            .presets = (const ang_preset *const *)view->presets.list,
                            .font = ang_font_find(),
                            .version = ANG_VERSION,
                            .threads = options->threads,
                            .keep_phi = options->keep_phi};
    return ang_viewer_run(&host, &how, err);
}

int ang_app_view(const ang_options *options, ang_error *err) {
    view view = {.options = options,
                 .presets = {.options = options},
                 .waiting = {.options = options, .state = ang_state_default}};
    bool done = run(&view, err);
    ang_view_presets_clear(&view.presets);
    free(view.state);
    ang_waiting_clear(&view.waiting);
    if (done && view.state_failed) return ANG_OUTPUT; /* said when it failed */
    return done ? ANG_OK : (int)err->code;
}

#else

int ang_app_view(const ang_options *options, ang_error *err) {
    (void)options;
    ang_fail(err, ANG_USAGE, "view: this build has no window (ANG_WINDOW); 'angioscope render' makes pictures");
    return ANG_USAGE;
}

#endif
