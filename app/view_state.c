#include "app/view_state.h"

#include "app/picture_state.h"
#include "io/json.h"
#include "io/preset/preset.h"
#include "io/report.h"
#include "ui/state/crop_geometry.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void add_numbers(cJSON *object, const char *name, const double *values, int count) {
    cJSON_AddItemToObject(object, name, cJSON_CreateDoubleArray(values, count));
}

/* Enough digits to come back as the same number. */
static bool add_option_numbers(ang_state *state, const char *option, const double *values, int count, ang_error *err) {
    char text[256], number[40];
    int used = 0;
    for (int i = 0; i < count; i++)
        used += snprintf(text + used, sizeof text - (size_t)used, "%s%s", i > 0 ? "," : "",
                         ang_json_number_text(values[i], number));
    return ang_state_add_option(state, option, text, err);
}

/* Millimetres from the first voxel which `--clip` takes back to this index, to the last digit where there are such. */
static double clip_mm(double index, double spacing) {
    double mm = index * spacing;
    if (mm / spacing < index) mm = nextafter(mm, INFINITY);
    if (mm / spacing > index) mm = nextafter(mm, -INFINITY);
    return mm;
}

/* What cuts the picture. */
static bool add_cutting(const ang_viewer_state *shown, ang_state *state, ang_error *err) {
    const ang_document *document = shown->document;
    const ang_clip_plane *clip = &document->clip;
    double mm[6], plane[4] = {clip->normal.x, clip->normal.y, clip->normal.z, clip->offset_mm};
    for (int i = 0; i < 6; i++) {
        ang_vec3 corner = i % 2 ? document->crop_upper : document->crop_lower;
        mm[i] = clip_mm(ang_vec3_at(corner, i / 2), ang_volume_spacing(shown->study->volume, i / 2));
    }
    return (!document->crop || add_option_numbers(state, "clip", mm, 6, err)) &&
           (!ang_clip_plane_given(clip) || add_option_numbers(state, "clip-plane", plane, 4, err));
}

/* The lengths that the volume rendering shows. */
static bool add_marks(ang_state *state, const ang_measures *measures, ang_error *err) {
    char text[ANG_MEASURES * 6 * 26];
    int used = 0;
    for (int i = 0; i < measures->count && !measures->hidden; i++) {
        const ang_measurement *m = &measures->item[i];
        for (int k = 0; k < 6 && m->kind == ANG_MEASURE_LENGTH; k++)
            used += snprintf(text + used, sizeof text - (size_t)used, "%s%.17g", used > 0 ? "," : "",
                             ang_vec3_at(m->point[k / 3], k % 3));
    }
    return used == 0 || ang_state_add_option(state, "measure", text, err);
}

static bool add_render_options(const ang_viewer_state *shown, ang_state *state, ang_error *err) {
    const ang_view *view = &shown->document->view;
    char size[32];
    snprintf(size, sizeof size, "%dx%d", shown->size[0], shown->size[1]);
    return (shown->size[0] < 1 || ang_state_add_option(state, "size", size, err)) &&
           add_option_numbers(state, "view", (double[]){view->azimuth_deg, view->elevation_deg, view->roll_deg}, 3,
                              err) &&
           add_option_numbers(state, "pan", view->pan_mm, 2, err) &&
           add_option_numbers(state, "zoom", &view->zoom, 1, err) &&
           ang_state_add_option(state, "projection", ang_projection_name(view->projection), err) &&
           add_option_numbers(state, "fov", &view->fov_deg, 1, err) &&
           (!shown->method || ang_state_add_option(state, "method", shown->method, err)) &&
           add_cutting(shown, state, err) && add_marks(state, &shown->document->measures, err);
}

char *ang_view_preset_print(const ang_document *document, const char *name, const char *description, ang_error *err) {
    ang_preset preset = {.name = (char *)name,
                         .modality = "any",
                         .description = (char *)description,
                         .version = 1,
                         .mode = document->mode,
                         .shading = document->shading,
                         .phong = document->phong,
                         .iso_hu = document->iso_hu,
                         .window_centre = document->window_centre,
                         .window_width = document->window_width,
                         .transfer = ang_document_transfer(document, err)};
    char *text = preset.transfer ? ang_preset_print(&preset, err) : NULL;
    ang_transfer_free(preset.transfer);
    return text;
}

static const char *const pane_names[ANG_PANES] = {"axial", "coronal", "sagittal", "volume"};

static ang_preset *preset_of(const ang_document *document, ang_error *err) {
    char *text = ang_view_preset_print(document, document->preset, "as shown", err);
    ang_preset *preset = text ? ang_preset_parse("what is shown", text, err) : NULL;
    free(text);
    return preset;
}

static bool copy_text(const char *text, char **copy, ang_error *err) {
    if (!text) return true;
    *copy = strdup(text);
    return *copy || ang_fail(err, ANG_LIMIT, "no memory for a state");
}

static void copy_window(const ang_viewer_state *shown, ang_state *state) {
    const ang_document *document = shown->document;
    state->preset_changed = document->edited;
    state->shift_hu = document->shift_hu;
    state->stretch = document->stretch;
    state->window_centre = document->window_centre;
    state->window_width = document->window_width;
    state->slab = document->slab;
    state->slab_mm = document->slab_mm;
    const ang_turn *turn = &document->turn;
    const double turned[9] = {turn->x.x, turn->x.y, turn->x.z, turn->y.x, turn->y.y,
                              turn->y.z, turn->z.x, turn->z.y, turn->z.z};
    memcpy(state->planes_turn, turned, sizeof turned);
    state->voxels_shown = shown->voxels_shown;
    state->turns_about_crosshair = shown->turns_about_crosshair;
    state->crosshair = document->crosshair;
    state->crop_lower = document->crop_lower;
    state->crop_upper = document->crop_upper;
    state->measures = document->measures;
    for (int i = 0; i < ANG_STATE_SLICES; i++) {
        state->slice[i].zoom = document->slice_view[i].zoom;
        memcpy(state->slice[i].pan_mm, document->slice_view[i].pan_mm, sizeof state->slice[i].pan_mm);
    }
    snprintf(state->maximised, sizeof state->maximised, "%s",
             shown->maximised >= 0 ? pane_names[shown->maximised] : "");
    snprintf(state->tool, sizeof state->tool, "%s", shown->tool);
    snprintf(state->method, sizeof state->method, "%s", shown->choice);
    state->corner_text = shown->corner_text;
    state->crosshair_lines = shown->crosshair_lines;
}

bool ang_view_state_of(const ang_viewer_state *shown, const ang_load_options *data_options, ang_state *state,
                       ang_error *err) {
    char name[32];
    *state = ang_state_default;
    ang_load_report_name(shown->study->handle, name);
    copy_window(shown, state);
    state->preset = preset_of(shown->document, err);
    bool made = state->preset && copy_text(shown->path[0] ? shown->path : NULL, &state->input_path, err) &&
                copy_text(name, &state->input_name, err) && copy_text(data_options->raw_dims, &state->raw_dims, err) &&
                copy_text(data_options->raw_type, &state->raw_type, err) &&
                copy_text(data_options->raw_spacing, &state->raw_spacing, err) && add_render_options(shown, state, err);
    if (!made) ang_state_clear(state);
    return made;
}

/* The crop box that was kept while it was off; where it is the picture's own, that to the last digit. */
static void take_crop_box(const ang_state *state, const ang_study *study, ang_document *document) {
    ang_crop_box box, shown = ang_crop_box_of(document);
    if (!isfinite(state->crop_lower.x)) return;
    ang_volume_box(study->volume, &box.lower, &box.upper);
    bool same = true;
    for (int face = 0; face < ANG_CROP_FACES; face++) {
        ang_vec3 corner = face % 2 ? state->crop_upper : state->crop_lower;
        ang_crop_face_move(&box, study->volume, face, ang_vec3_at(corner, face / 2));
        same = same && fabs(ang_crop_face_at(&box, face) - ang_crop_face_at(&shown, face)) < 1e-9;
    }
    if (same || !document->crop) ang_crop_box_set(document, &box);
}

/* The camera and whatever else options of a picture say. */
static bool take_picture(const ang_state *state, const char *file, const ang_study *study, ang_document *document,
                         ang_error *err) {
    char *arguments[] = {"render", NULL};
    ang_options options;
    ang_picture picture = {.preset = state->preset};
    ang_notes notes = {0};
    bool made =
        ang_options_parse(ANG_VERB_RENDER, 1, arguments, &options, err) && ang_state_offer(state, file, &options, err);
    if (made && !ang_picture_make(&options, study->volume, study->handle, &picture, &notes, err)) {
        ang_error why = *err;
        made = ang_fail(err, why.code, "%s: %.900s", file, why.message);
    }
    if (made) {
        document->view = picture.view;
        document->mode = picture.scene.mode;
        document->shading = picture.scene.shading;
        document->crop = options.clip != NULL;
        document->crop_lower = picture.scene.clip_lower;
        document->crop_upper = picture.scene.clip_upper;
        document->clip = picture.scene.clip_plane;
        take_crop_box(state, study, document);
    }
    picture.preset = NULL; /* the state's */
    ang_picture_clear(&picture);
    ang_notes_clear(&notes);
    return made;
}

/* What a state without measures has as marks of its picture: lengths. */
static bool take_marks(const ang_state *state, ang_measures *measures, ang_error *err) {
    const char *marks = ang_state_option_value(state, "measure");
    double at[6 * ANG_MEASURES];
    int count = 0;
    *measures = state->measures;
    if (!marks || measures->count > 0) return true;
    if (!ang_app_parse_numbers("measure", marks, 6, 6 * ANG_MEASURES, at, &count, err)) return false;
    for (int i = 0; i + 6 <= count; i += 6) {
        ang_measurement m = {.kind = ANG_MEASURE_LENGTH,
                             .point = {{at[i], at[i + 1], at[i + 2]}, {at[i + 3], at[i + 4], at[i + 5]}}};
        ang_measures_add(measures, &m);
    }
    return true;
}

static bool take_maximised(const ang_state *state, const char *file, ang_session *session, ang_error *err) {
    session->maximised = -1;
    for (int i = 0; i < ANG_PANES; i++)
        if (strcmp(state->maximised, pane_names[i]) == 0) session->maximised = i;
    return session->maximised >= 0 || !state->maximised[0] ||
           ang_fail(err, ANG_USAGE, "%s: maximised is \"%s\"; it must be axial, coronal, sagittal, volume or \"\"",
                    file, state->maximised);
}

static bool take_method(const ang_state *state, const char *file, int *method, ang_error *err) {
    const char *name = state->method;
    *method = name[0] ? 0 : -1;
    if (!name[0] || strcmp(name, "auto") == 0) return true;
    for (int i = 0; ang_methods()[i]; i++)
        if (strcmp(ang_methods()[i]->name, name) == 0) *method = i + 1;
    return *method > 0 || ang_fail(err, ANG_USAGE, "%s: method is \"%s\", which there is none of", file, name);
}

/* To the last digit where it is a rotation as it stands: mending one again would change that. */
static bool take_turn(const ang_state *state, const char *file, ang_turn *turn, ang_error *err) {
    const double *t = state->planes_turn;
    *turn = (ang_turn){{t[0], t[1], t[2]}, {t[3], t[4], t[5]}, {t[6], t[7], t[8]}};
    ang_turn mended = *turn;
    if (!ang_turn_mend(&mended)) return ang_fail(err, ANG_USAGE, "%s: planes_turn is no rotation", file);
    double off = ang_vec3_length(ang_vec3_sub(mended.x, turn->x)) + ang_vec3_length(ang_vec3_sub(mended.y, turn->y)) +
                 ang_vec3_length(ang_vec3_sub(mended.z, turn->z));
    if (off > 1e-12) *turn = mended;
    return true;
}

bool ang_view_session_of(const ang_state *state, const char *file, const ang_study *study, ang_session *session,
                         ang_error *err) {
    *session = (ang_session){.corner_text = state->corner_text, .crosshair_lines = state->crosshair_lines};
    ang_document *document = &session->document;
    document->iso_hu = 300;
    document->window_centre = document->window_width = NAN;
    ang_document_take_preset(document, state->preset);
    document->edited = state->preset_changed;
    document->shift_hu = state->shift_hu;
    document->stretch = state->stretch;
    document->slab = state->slab;
    document->slab_mm = state->slab_mm;
    document->crosshair = state->crosshair;
    if (isfinite(state->window_centre) && isfinite(state->window_width)) {
        document->window_centre = state->window_centre;
        document->window_width = state->window_width;
    }
    for (int i = 0; i < ANG_ORIENTATIONS; i++) {
        document->slice_view[i].zoom = state->slice[i].zoom;
        memcpy(document->slice_view[i].pan_mm, state->slice[i].pan_mm, sizeof document->slice_view[i].pan_mm);
    }
    memcpy(session->tool, state->tool, sizeof session->tool);
    session->voxels_shown = state->voxels_shown;
    session->turns_about_crosshair = state->turns_about_crosshair;
    return take_picture(state, file, study, document, err) && take_turn(state, file, &document->turn, err) &&
           take_marks(state, &document->measures, err) && take_maximised(state, file, session, err) &&
           take_method(state, file, &document->method, err);
}

static void add_slices(cJSON *live, const ang_viewer_state *shown) {
    for (int i = 0; i < ANG_ORIENTATIONS; i++) {
        cJSON *slice = cJSON_AddObjectToObject(live, ang_orientation_name((ang_orientation)i));
        cJSON_AddNumberToObject(slice, "slice", shown->slice[i].index + 1);
        cJSON_AddNumberToObject(slice, "slices", shown->slice[i].count);
        const ang_slice_axes *axes = &shown->slice[i].axes;
        add_numbers(slice, "right", (double[]){axes->right.x, axes->right.y, axes->right.z}, 3);
        add_numbers(slice, "down", (double[]){axes->down.x, axes->down.y, axes->down.z}, 3);
        ang_json_add_number(slice, "mm_per_pixel", shown->slice[i].mm_per_pixel);
        ang_json_add_number(slice, "lean_deg", ang_slice_lean(&shown->document->turn, (ang_orientation)i));
        ang_json_add_number(slice, "turned_deg", ang_slice_turned(&shown->document->turn, (ang_orientation)i));
    }
}

static void add_panes(cJSON *live, const ang_viewer_state *shown) {
    cJSON *panes = cJSON_AddObjectToObject(live, "panes");
    for (int i = 0; i < ANG_PANES; i++) {
        const ang_rect *rect = &shown->pane[i];
        add_numbers(panes, pane_names[i], (double[]){rect->x, rect->y, rect->width, rect->height}, 4);
    }
    cJSON_AddStringToObject(live, "hovered", shown->hovered < ANG_PANES ? pane_names[shown->hovered] : "");
}

static void add_clip_plane(cJSON *live, const ang_clip_plane *clip) {
    cJSON *plane = cJSON_AddObjectToObject(live, "clip_plane");
    add_numbers(plane, "normal", (double[]){clip->normal.x, clip->normal.y, clip->normal.z}, 3);
    ang_json_add_number(plane, "offset_mm", clip->offset_mm);
}

static cJSON *values_of(const ang_measurement *m, const ang_region_values *values) {
    cJSON *object = cJSON_CreateObject();
    ang_json_add_number(object, "value", ang_measurement_value(m));
    cJSON_AddStringToObject(object, "unit", ang_measurement_unit(m->kind));
    if (!ang_measure_is_region(m->kind)) return object;
    ang_json_add_number(object, "mean_hu", values->mean);
    ang_json_add_number(object, "sd_hu", values->sd);
    ang_json_add_number(object, "least_hu", values->least);
    ang_json_add_number(object, "most_hu", values->most);
    cJSON_AddNumberToObject(object, "count", (double)values->count);
    return object;
}

static void add_measures(cJSON *live, const ang_viewer_state *shown) {
    const ang_measures *measures = &shown->document->measures;
    cJSON *object = cJSON_AddObjectToObject(live, "measures");
    cJSON *list = cJSON_AddArrayToObject(object, "values");
    for (int i = 0; i < measures->count; i++)
        cJSON_AddItemToArray(list, values_of(&measures->item[i], &shown->region_values[i]));
    cJSON_AddNumberToObject(object, "count", measures->count);
    cJSON_AddNumberToObject(object, "chosen", shown->measure);
}

/* What is chosen in the transfer-function editor, and what the slices show of it. */
static void add_editing(cJSON *editor, const ang_viewer_state *shown) {
    const ang_editing *editing = shown->editing;
    cJSON *points = cJSON_AddArrayToObject(editor, "points");
    for (int i = 0; i < shown->document->count; i++)
        if (editing->chosen.has[i]) cJSON_AddItemToArray(points, cJSON_CreateNumber(i));
    cJSON_AddBoolToObject(editor, "has_keys", editing->focused);
    if (!editing->marked) return;
    const ang_hu_share *mark = &editing->mark;
    cJSON *range = cJSON_AddObjectToObject(editor, "in_slices");
    add_numbers(range, "hu", (double[]){mark->low, mark->high}, 2);
    cJSON_AddNumberToObject(range, "voxels", (double)mark->voxels);
    ang_json_add_number(range, "share", mark->share);
    ang_json_add_number(range, "ml", mark->ml);
}

/* The dialog for saving a preset. */
static void add_saving(cJSON *live, const ang_viewer_state *shown) {
    cJSON *saving = cJSON_AddObjectToObject(live, "saving_preset");
    cJSON_AddStringToObject(saving, "name", shown->saving.name);
    cJSON_AddStringToObject(saving, "problem", shown->saving.problem);
    cJSON_AddBoolToObject(saving, "replaces", shown->saving.replaces);
}

static void add_live(cJSON *live, const ang_viewer_state *shown) {
    add_slices(live, shown);
    cJSON *cine = cJSON_AddObjectToObject(live, "cine");
    cJSON_AddStringToObject(cine, "pane", shown->cine->running ? pane_names[shown->cine->pane] : "");
    ang_json_add_number(cine, "per_second", shown->cine->per_second);
    cJSON_AddBoolToObject(cine, "back_and_forth", shown->cine->back_and_forth);
    cJSON_AddBoolToObject(live, "names_hidden", shown->names_hidden);
    cJSON *editor = cJSON_AddObjectToObject(live, "editor");
    const ang_rect *plot = &shown->editor;
    add_numbers(editor, "plot", (double[]){plot->x, plot->y, plot->width, plot->height}, 4);
    add_numbers(editor, "hu", (double[]){shown->editor_low, shown->editor_high}, 2);
    cJSON_AddNumberToObject(editor, "point", shown->point);
    add_clip_plane(live, &shown->document->clip);
    add_editing(editor, shown);
    if (shown->saving.name) add_saving(live, shown);
    ang_json_add_number(live, "azimuth_deg", shown->document->view.azimuth_deg);
    ang_json_add_number(live, "elevation_deg", shown->document->view.elevation_deg);
    cJSON_AddBoolToObject(live, "refined", shown->refined);
    cJSON_AddNumberToObject(live, "levels_shown", shown->levels_shown);
    cJSON_AddBoolToObject(live, "at_rest", shown->at_rest);
    cJSON_AddNumberToObject(live, "presets_pictured", shown->presets_pictured);
    if (shown->judged) ang_json_add_number(live, "error_levels", shown->error);
    ang_json_add_number(live, "latency_ms", shown->latency_ms);
    cJSON_AddNumberToObject(live, "frames", shown->frames);
    ang_json_add_number(live, "frame_ms", shown->frame_ms);
    cJSON_AddBoolToObject(live, "can_undo", shown->undo);
    cJSON_AddBoolToObject(live, "can_redo", shown->redo);
    add_panes(live, shown);
    add_measures(live, shown);
    ang_json_add_number(live, "hovered_hu", shown->hovered_hu);
}

/* The window's own: nothing of the study. */
static void add_shell(cJSON *live, const ang_viewer_state *shown) {
    static const char *const grips[ANG_GRIPS] = {"cross", "across", "down", "panel"};
    const ang_layout *layout = shown->layout;
    cJSON *shell = cJSON_AddObjectToObject(live, "shell");
    cJSON_AddStringToObject(shell, "theme", shown->theme);
    cJSON_AddStringToObject(shell, "focus", shown->widgets ? "widgets" : pane_names[shown->focus]);
    cJSON_AddBoolToObject(shell, "help", shown->help);
    cJSON_AddBoolToObject(shell, "palette", shown->palette);
    add_numbers(shell, "split", (double[]){layout->across, layout->down}, 2);
    ang_json_add_number(shell, "panel", layout->panel_hidden ? 0 : layout->panel);
    cJSON_AddNumberToObject(shell, "recent", shown->recent->count);
    cJSON *list = cJSON_AddObjectToObject(shell, "grips");
    for (int i = 0; i < ANG_GRIPS; i++) {
        const ang_rect *rect = &shown->grip[i];
        add_numbers(list, grips[i], (double[]){rect->x, rect->y, rect->width, rect->height}, 4);
    }
}

/* Numbers only: names of files and descriptions may identify a patient. */
static void add_browsers(cJSON *live, const ang_viewer_state *state) {
    cJSON_AddStringToObject(live, "open", state->open);
    cJSON *files = cJSON_AddObjectToObject(live, "files");
    cJSON_AddNumberToObject(files, "listed", state->files.listed);
    cJSON_AddNumberToObject(files, "chosen", state->files.chosen);
    cJSON *series = cJSON_AddObjectToObject(live, "series");
    cJSON_AddNumberToObject(series, "listed", state->series.listed);
    cJSON_AddNumberToObject(series, "chosen", state->series.chosen);
    cJSON_AddNumberToObject(series, "looked_at", state->series.looked_at);
    cJSON_AddBoolToObject(series, "dates", state->series.dates);
    if (state->study) {
        cJSON_AddNumberToObject(series, "shown", state->study->series);
        cJSON_AddNumberToObject(series, "phase", state->study->phase);
        cJSON_AddNumberToObject(series, "phases", state->study->phases);
    }
    cJSON_AddNumberToObject(live, "warnings", state->study ? state->study->warnings : 0);
    cJSON_AddNumberToObject(live, "slices_previewed", state->slices_previewed);
}

char *ang_view_state_print(const ang_viewer_state *shown, const ang_load_options *data_options) {
    ang_state state;
    bool there = shown->study && ang_view_state_of(shown, data_options, &state, NULL);
    cJSON *root = there ? ang_state_json(&state, ANG_VERSION, NULL, true, NULL) : cJSON_CreateObject();
    if (there) ang_state_clear(&state);
    cJSON *live = cJSON_AddObjectToObject(root, "live");
    cJSON_AddStringToObject(live, "phase", shown->phase);
    if (there) add_live(live, shown);
    add_shell(live, shown);
    add_browsers(live, shown);
    /* Without its folder, whose name may identify a patient. */
    const char *slash = shown->saved ? strrchr(shown->saved, '/') : NULL;
    if (shown->saved) cJSON_AddStringToObject(live, "saved", slash ? slash + 1 : shown->saved);
    char *text = cJSON_Print(root);
    cJSON_Delete(root);
    return text;
}
