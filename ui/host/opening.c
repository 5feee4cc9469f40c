#include "ui/host/opening.h"

#include "core/base/memory.h"
#include "ui/host/preset_files.h"
#include "ui/host/state_files.h"
#include "ui/panes/planes.h"
#include "ui/study.h"
#include "ui/viewer_private.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void ang_viewer_open(ang_viewer *viewer, const char *path) {
    char expanded[ANG_PATH_SIZE];
    ang_path_expand(path, viewer->host->home, expanded, sizeof expanded);
    ang_source source = ang_source_make((const char *const[]){expanded}, 1, 0);
    ang_viewer_open_source(viewer, &source);
}

/* Where a saved state is opened its data are read. */
static bool find_data(ang_viewer *viewer, ang_source *source) {
    char room[sizeof viewer->asked];
    const char *path = source->count > 0 ? source->paths[0] : "";
    const char *data = source->count == 1 ? ang_session_data(viewer, path, room, sizeof room) : path;
    if (data && data != path) {
        ang_source found = ang_source_make(&data, 1, 0);
        ang_source_move(source, &found);
    }
    if (!data) ang_source_clear(source);
    return data != NULL;
}

static void start(ang_viewer *viewer, ang_source *source) {
    ang_error err = {0};
    viewer->failure[0] = '\0';
    ang_source_clear(&viewer->failed);
    viewer->preview.count = 0;
    if (!find_data(viewer, source)) return;
    snprintf(viewer->asked, sizeof viewer->asked, "%s", source->count > 0 ? source->paths[0] : "");
    if (!ang_loading_start(&viewer->loading, viewer->host, source, &err))
        snprintf(viewer->failure, sizeof viewer->failure, "%s", err.message);
}

void ang_viewer_open_source(ang_viewer *viewer, ang_source *source) {
    if (source->count == 1 && ang_preset_file_take(viewer, source->paths[0])) {
        ang_source_clear(source);
        return;
    }
    if (viewer->loading.running) {
        /* It stops soon; the window does not wait for it. */
        ang_loading_stop(&viewer->loading);
        ang_source_move(&viewer->next, source);
    } else {
        start(viewer, source);
    }
}

static void say_loaded(ang_viewer *viewer) {
    int warnings = viewer->study.warnings;
    char text[ANG_NOTES_LINE];
    if (viewer->study.phases > 1 && warnings == 0)
        ang_viewer_say(viewer, false, "Phase %d of %d%s%s", viewer->study.phase, viewer->study.phases,
                       viewer->study.phase_text[0] ? ": " : "", viewer->study.phase_text);
    else if (warnings == 1)
        ang_viewer_say(viewer, false, "%s (F2: the report)",
                       ang_notes_line(&viewer->study.notes, 0, false, text, sizeof text));
    else if (warnings > 1)
        ang_viewer_say(viewer, false, "%d warnings on loading: F2 shows them", warnings);
}

/* Whether the study is another phase of what is shown, voxel for voxel at the same place: nothing else changes then. */
static bool is_other_phase(const ang_viewer *viewer, const ang_study *study, const ang_source *source) {
    const ang_study *shown = &viewer->study;
    return viewer->ready && study->phases > 1 && study->series == shown->series &&
           ang_source_same_files(&viewer->shown, source) &&
           memcmp(study->volume->dims, shown->volume->dims, sizeof shown->volume->dims) == 0 &&
           memcmp(&study->volume->affine, &shown->volume->affine, sizeof shown->volume->affine) == 0;
}

static void show_study(ang_viewer *viewer, const ang_study *study, const ang_source *source, const char *preset) {
    bool stays = is_other_phase(viewer, study, source);
    ang_document kept = viewer->document;
    ang_study_show(viewer, study, preset);
    if (!stays || !viewer->ready) return;
    viewer->document = kept;
    ang_planes_take(viewer);
    ang_history_clear(&viewer->history);
    ang_history_note(&viewer->history, &viewer->document, 0);
}

void ang_viewer_step_phase(ang_viewer *viewer, int step) {
    const ang_study *study = &viewer->study;
    ang_source source = ang_source_of_series(&viewer->shown, study->series);
    source.phase = (study->phase - 1 + step + study->phases) % study->phases + 1;
    ang_viewer_open_source(viewer, &source);
}

void ang_viewer_take_loaded(ang_viewer *viewer, const char *wanted_preset) {
    bool done;
    ang_study study;
    ang_source source = {0};
    ang_error err;
    if (!ang_loading_take(&viewer->loading, &done, &source, &study, &err)) return;
    viewer->redraws = 2;
    if (viewer->next.count > 0) {
        if (done) viewer->host->release(viewer->host->context, &study);
        ang_source_clear(&source);
        start(viewer, &viewer->next);
        return;
    }
    if (done) {
        show_study(viewer, &study, &source, wanted_preset);
        ang_source_move(&viewer->shown, &source);
        if (viewer->shown.count == 1) ang_settings_opened(viewer, viewer->asked);
        if (viewer->ready) say_loaded(viewer);
    } else if (err.code != ANG_INTERRUPTED) {
        snprintf(viewer->failure, sizeof viewer->failure, "%s", err.message);
        ang_source_move(&viewer->failed, &source);
        if (study.series_count == 0) ang_source_clear(&viewer->failed); /* there is nothing to choose from */
    } else {
        ang_viewer_say(viewer, false, "Loading was cancelled.");
        ang_source_clear(&source);
    }
}

const ang_source *ang_viewer_subject(const ang_viewer *viewer) {
    return viewer->failure[0] && viewer->failed.count > 0 ? &viewer->failed : &viewer->shown;
}

void ang_viewer_paint_grey(ang_viewer *viewer, const uint8_t *grey, int width, int height, ang_paint_texture *texture) {
    size_t pixels = (size_t)width * (size_t)height;
    uint8_t *rgba = pixels > 0 ? ang_alloc(pixels, 4, "a picture", NULL) : NULL;
    for (size_t i = 0; rgba && i < pixels; i++) {
        memset(rgba + 4 * i, grey[i], 3);
        rgba[4 * i + 3] = 255;
    }
    if (rgba) ang_painter_picture(viewer->painter, texture, width, height, rgba, true, NULL);
    free(rgba);
}

void ang_viewer_take_preview(ang_viewer *viewer) {
    ang_slice_preview *shown = &viewer->preview;
    ang_preview *preview = ang_alloc(1, sizeof *preview, "a picture", NULL);
    size_t index, count;
    if (preview && ang_loading_preview(&viewer->loading, preview, &index, &count)) {
        ang_viewer_paint_grey(viewer, preview->grey, preview->width, preview->height, &shown->texture);
        shown->index = index;
        shown->count = count;
        shown->pictures++;
    }
    free(preview);
}

void ang_viewer_opening_clear(ang_viewer *viewer) {
    ang_loading_end(&viewer->loading);
    ang_painter_forget(viewer->painter, &viewer->preview.texture);
    ang_source_clear(&viewer->shown);
    ang_source_clear(&viewer->failed);
    ang_source_clear(&viewer->next);
}
