/* angioscope view: the window. */
#include "app/verbs.h"

#ifdef ANG_WITH_WINDOW

#include "app/picture_state.h"
#include "app/view_state.h"
#include "io/font.h"
#include "io/image/image_io.h"
#include "io/load.h"
#include "io/preset.h"
#include "io/replace.h"
#include "io/state.h"
#include "ui/viewer.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { MOST_PRESETS = 126, MOST_FILES = 9999 };

typedef struct view {
    const ang_options *options;
    ang_preset *presets[MOST_PRESETS + 2];
    int preset_count;
    char *state; /* as last written; NULL: not yet */
    bool state_failed;
    ang_state waiting; /* for the study that is opened next; no preset: there is none */
    char *waiting_file;
    bool waiting_any; /* it is for other data than its own, too: they were named beside it */
} view;

static void copy_notes(const ang_load_report *report, ang_study *study) {
    ang_notes_append(&study->notes, &report->warnings);
    study->warnings = (int)study->notes.count;
    ang_notes_append(&study->notes, &report->assumptions);
}

static void write_label(const ang_load_report *report, ang_study *study) {
    const ang_series_info *info = &report->series[report->chosen];
    bool described = info->description && info->description[0], named = strcmp(info->modality, "?") != 0;
    snprintf(study->label, sizeof study->label, "%s series %d%s%.60s", named ? info->modality : report->format,
             info->number, described ? ": " : "", described ? info->description : "");
}

static void release(void *context, ang_study *study) {
    (void)context;
    ang_volume_free(study->volume);
    ang_notes_clear(&study->notes);
    if (study->handle) ang_load_report_clear(study->handle);
    free(study->handle);
    *study = (ang_study){0};
}

/* As the options ask, or the state whose data they are. */
static ang_load_options load_options(const view *view, char series[12]) {
    ang_load_options how = ang_app_load_options(view->options);
    const ang_state *state = &view->waiting;
    int number = state->preset ? ang_state_series(state) : 0;
    snprintf(series, 12, "%d", number);
    if (number > 0 && !how.series) how.series = series;
    if (!how.raw_dims) how.raw_dims = state->raw_dims;
    if (!how.raw_type) how.raw_type = state->raw_type;
    if (!how.raw_spacing) how.raw_spacing = state->raw_spacing;
    return how;
}

static bool load(void *context, const char *path, ang_study *study, const ang_progress *progress, ang_error *err) {
    char series[12];
    ang_load_options how = load_options(context, series);
    *study = (ang_study){0};
    ang_load_report *report = calloc(1, sizeof *report);
    if (!report) return ang_fail(err, ANG_LIMIT, "no memory for a report");
    study->handle = report;
    study->volume = ang_load(path, &how, report, progress, err);
    if (!study->volume) {
        release(context, study);
        return false;
    }
    study->hounsfield = ang_load_report_hounsfield(report);
    study->window_centre = report->window_centre;
    study->window_width = report->window_width;
    write_label(report, study);
    copy_notes(report, study);
    return true;
}

static ang_preset *preset_for(void *context, const ang_study *study, ang_error *err) {
    ang_notes notes = {0};
    ang_preset *preset =
        ang_picture_choose_preset(((view *)context)->options, study->volume, study->handle, &notes, err);
    ang_notes_clear(&notes);
    return preset;
}

/* The path of a file that is not there yet. */
static bool new_file(const view *view, const char *what, const char *ending, char *path, size_t size, ang_error *err) {
    const char *folder = view->options->pictures;
    if (!ang_folder_make(folder, err)) return false;
    for (int i = 1; i <= MOST_FILES; i++) {
        char name[4096];
        int used = snprintf(name, sizeof name, "%s/angioscope-%s-%04d.%s", folder, what, i, ending);
        if (used < 0 || (size_t)used >= size) return ang_fail(err, ANG_OUTPUT, "%s: is too long a name", folder);
        if (access(name, F_OK) == 0) continue;
        memcpy(path, name, (size_t)used + 1);
        return true;
    }
    return ang_fail(err, ANG_OUTPUT, "%s: holds %d files of this kind; name another folder with --pictures", folder,
                    MOST_FILES);
}

static bool state_of(const view *view, const ang_viewer_state *shown, ang_state *state, ang_error *err) {
    ang_load_options how = ang_app_load_options(view->options);
    return ang_view_state_of(shown, &how, state, err);
}

static bool save_picture(void *context, const char *what, const ang_image *image, const ang_viewer_state *shown,
                         char *path, size_t size, ang_error *err) {
    static const double black[4] = {0, 0, 0, 1};
    ang_state state;
    char *text = NULL;
    if (!new_file(context, what, "png", path, size, err)) return false;
    if (shown) {
        if (!state_of(context, shown, &state, err)) return false;
        text = ang_state_print(&state, ANG_VERSION, err);
        ang_state_clear(&state);
        if (!text) return false;
    }
    bool saved = ang_image_write_stated(path, image, black, text, err);
    free(text);
    return saved;
}

static bool save_state(void *context, const ang_viewer_state *shown, char *path, size_t size, ang_error *err) {
    ang_state state;
    if (!new_file(context, "state", "json", path, size, err) || !state_of(context, shown, &state, err)) return false;
    bool saved = ang_state_write(path, &state, ANG_VERSION, err);
    ang_state_clear(&state);
    return saved;
}

static bool is_state(void *context, const char *file) {
    (void)context;
    return ang_state_probe(file);
}

static bool wait_for_study(view *view, const char *file, ang_error *err) {
    free(view->waiting_file);
    view->waiting_file = strdup(file);
    ang_state_clear(&view->waiting);
    return (view->waiting_file || ang_fail(err, ANG_LIMIT, "no memory for a path")) &&
           ang_state_read(file, &view->waiting, err);
}

static bool open_state(void *context, const char *file, char *path, size_t size, ang_error *err) {
    view *view = context;
    view->waiting_any = false;
    if (!wait_for_study(view, file, err)) return false;
    const char *data = view->waiting.input_path;
    if (!data)
        return ang_fail(err, ANG_INPUT, "%s: does not say where its data are. Open them, and they are shown like that.",
                        file);
    if (access(data, F_OK) != 0)
        return ang_fail(err, ANG_INPUT, "%s: its data, %s, are not there. Open them where they are now.", file, data);
    return snprintf(path, size, "%s", data) < (int)size ||
           ang_fail(err, ANG_INPUT, "%s: the path of its data is too long", file);
}

static bool session(void *context, const ang_study *study, ang_session *session, ang_error *err) {
    view *view = context;
    ang_state *state = &view->waiting;
    ang_notes warnings = {0};
    *err = (ang_error){0};
    if (!state->preset) return false;
    bool same = ang_state_matches(state, study->handle, &warnings);
    bool wanted = same || view->waiting_any || state->input_path;
    bool found = wanted && ang_view_session_of(state, view->waiting_file, study, session, err);
    if (warnings.count > 0)
        ang_fail(err, ANG_INPUT, "%s: %s%s", view->waiting_file, warnings.text[0],
                 found ? "" : "; it is not shown of these");
    ang_notes_clear(&warnings);
    ang_state_clear(state);
    return found;
}

static bool save_preset(void *context, const ang_document *document, char *path, size_t size, ang_error *err) {
    char *text = ang_view_preset_print(document, err);
    bool saved =
        text && new_file(context, "preset", "json", path, size, err) && ang_file_replace(path, text, strlen(text), err);
    free(text);
    return saved;
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
    if (!ang_file_replace(view->options->write_state, text, strlen(text), &err) && !view->state_failed) {
        fprintf(stderr, "angioscope: %s\n", err.message);
        view->state_failed = true;
    }
    free(view->state);
    view->state = text;
}

/* The folders' presets; one that cannot be read is said and left out. The one that was asked for comes first where it
 * is a file. */
static bool read_presets(view *view, const char **chosen, ang_error *err) {
    ang_preset_names names;
    if (view->options->preset) {
        ang_preset *asked = ang_preset_find(view->options->preset, ang_app_preset_folders(), err);
        if (!asked) return false;
        view->presets[view->preset_count++] = asked;
        *chosen = asked->name;
    }
    if (!ang_preset_list(ang_app_preset_folders(), &names, err)) return false;
    for (size_t i = 0; i < names.count && view->preset_count < MOST_PRESETS; i++) {
        ang_error broken = {0};
        if (*chosen && strcmp(names.names[i], *chosen) == 0) continue;
        ang_preset *preset = ang_preset_load(names.paths[i], &broken);
        if (preset)
            view->presets[view->preset_count++] = preset;
        else
            fprintf(stderr, "warning: %s\n", broken.message);
    }
    ang_preset_names_clear(&names);
    return true;
}

/* --state: of the data that are named beside it, else of its own. */
static bool begin_with_state(view *view, ang_viewer_options *how, ang_error *err) {
    if (!wait_for_study(view, view->options->state, err)) return false;
    view->waiting_any = how->path != NULL;
    if (!how->path) how->path = view->options->state;
    return true;
}

static bool run(view *view, ang_error *err) {
    const ang_options *options = view->options;
    ang_viewer_options how = {.path = options->argument_count > 0 ? options->arguments[0] : NULL};
    int size[2] = {0};
    if (options->size && !ang_app_parse_dims("size", options->size, 2, 16384, size, err)) return false;
    how.width = size[0];
    how.height = size[1];
    if (!read_presets(view, &how.preset, err)) return false;
    if (options->state && !begin_with_state(view, &how, err)) return false;
    ang_viewer_host host = {.context = view,
                            .load = load,
                            .release = release,
                            .preset_for = preset_for,
                            .save_picture = save_picture,
                            .save_preset = save_preset,
                            .save_state = save_state,
                            .is_state = is_state,
                            .open_state = open_state,
                            .session = session,
                            .shown = options->write_state ? shown : NULL,
                            .presets = (const ang_preset *const *)view->presets,
                            .font = ang_font_find(),
                            .version = ANG_VERSION,
                            .threads = options->threads};
    return ang_viewer_run(&host, &how, err);
}

int ang_app_view(const ang_options *options, ang_error *err) {
    if (options->argument_count > 1 && !ang_app_arguments(options, 1, "view: give one file or folder to open", err))
        return ANG_USAGE;
    view view = {.options = options, .waiting = ang_state_default};
    bool done = run(&view, err);
    for (int i = 0; i < view.preset_count; i++) ang_preset_free(view.presets[i]);
    free(view.state);
    free(view.waiting_file);
    ang_state_clear(&view.waiting);
    return done ? ANG_OK : (int)err->code;
}

#else

int ang_app_view(const ang_options *options, ang_error *err) {
    (void)options;
    ang_fail(err, ANG_USAGE, "view: this build has no window (ANG_WINDOW); 'angioscope render' makes pictures");
    return ANG_USAGE;
}

#endif
