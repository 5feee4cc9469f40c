#include "ui/study.h"

#include "ui/host/state_files.h"
#include "ui/panels/transfer_editor.h"
#include "ui/panes/planes.h"
#include "ui/panes/playing.h"
#include "ui/viewer_private.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* At zoom 1 a picture holds the volume from any side, with much room around it from most. */
const ang_view ang_viewer_first_view = {.zoom = 1.6, .projection = ANG_PERSPECTIVE, .fov_deg = 30};

double ang_viewer_hu_at(const ang_viewer *viewer, ang_vec3 mm) {
    const ang_volume *volume = viewer->study.volume;
    ang_mat4 to_index;
    ang_vec3 lower, upper;
    if (!ang_mat4_inverse(&volume->affine, &to_index)) return NAN;
    ang_volume_box(volume, &lower, &upper);
    ang_vec3 at = ang_mat4_point(&to_index, mm);
    for (int axis = 0; axis < 3; axis++)
        if (ang_vec3_at(at, axis) < ang_vec3_at(lower, axis) - 1e-4 ||
            ang_vec3_at(at, axis) > ang_vec3_at(upper, axis) + 1e-4)
            return NAN;
    return ang_volume_hu(volume, ang_volume_sample(volume, at));
}

void ang_viewer_point_at(ang_viewer *viewer, ang_vec3 mm) {
    for (int i = 0; i < ANG_ORIENTATIONS; i++) mm = ang_slice_move(&viewer->range[i], mm, 0);
    viewer->document.crosshair = mm;
}

void ang_viewer_file_window(const ang_viewer *viewer, double *centre, double *width) {
    const ang_study *study = &viewer->study;
    *centre = study->hounsfield ? 40 : (viewer->editor_low + viewer->editor_high) / 2;
    *width = study->hounsfield ? 400 : viewer->editor_high - viewer->editor_low;
    if (!isfinite(study->window_centre) || !(study->window_width > 0)) return;
    *centre = study->window_centre;
    *width = study->window_width;
}

/* The preset to begin with; one of the host's making where the values are no Hounsfield units. */
static const ang_preset *first_preset(ang_viewer *viewer, const char *wanted, ang_error *err) {
    const ang_preset *found = wanted ? ang_preset_named(viewer, wanted) : NULL;
    if (found) return found;
    ang_preset *made = viewer->host->preset_for(viewer->host->context, &viewer->study, err);
    found = made ? ang_preset_named(viewer, made->name) : NULL;
    if (found)
        ang_preset_free(made);
    else
        viewer->own_preset = made;
    return found ? found : made;
}

void ang_study_close(ang_viewer *viewer) {
    if (!viewer->ready) return;
    ang_playing_stop(viewer);
    ang_thumbnails_clear(viewer);
    viewer->browsing = viewer->preset_dialog.open = viewer->comparing = false;
    ang_volume_picture_clear(viewer);
    for (int i = 0; i < ANG_ORIENTATIONS; i++) ang_slice_picture_clear(viewer, &viewer->slice[i]);
    free(viewer->histogram);
    viewer->histogram = NULL;
    ang_history_clear(&viewer->history);
    ang_preset_free(viewer->own_preset);
    viewer->own_preset = NULL;
    viewer->host->release(viewer->host->context, &viewer->study);
    viewer->study = (ang_study){0};
    viewer->ready = false;
}

void ang_study_show(ang_viewer *viewer, const ang_study *study, const char *wanted_preset) {
    ang_study_close(viewer);
    viewer->study = *study;
    viewer->ready = true;
    memcpy(viewer->path, viewer->asked, sizeof viewer->path);
    ang_document *document = &viewer->document;
    int method = document->method; /* stays from study to study */
    memset(document, 0, sizeof *document);
    document->method = method;
    document->view = ang_viewer_first_view;
    document->iso_hu = 300;
    ang_volume_box(study->volume, &document->crop_lower, &document->crop_upper);
    document->turn = ang_turn_none;
    ang_planes_take(viewer);
    ang_transfer_editor_start(viewer);
    ang_measuring_start(viewer);
    ang_error err = {0};
    const ang_preset *preset = first_preset(viewer, wanted_preset, &err);
    if (!preset) {
        ang_study_close(viewer);
        snprintf(viewer->failure, sizeof viewer->failure, "%s", err.message);
        return;
    }
    ang_viewer_choose_preset(viewer, preset);
    ang_viewer_file_window(viewer, &document->window_centre, &document->window_width);
    for (int i = 0; i < ANG_ORIENTATIONS; i++) viewer->document.slice_view[i] = ang_slice_view_default;
    ang_viewer_point_at(viewer, ang_volume_centre(study->volume));
    ang_session_apply(viewer);
    viewer->cutting.pivot = viewer->document.crosshair;
    ang_history_note(&viewer->history, document, 0);
}
