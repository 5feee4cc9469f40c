#include "app/view_state.h"

#include "io/json.h"
#include "io/preset.h"
#include "io/report.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void add_numbers(cJSON *object, const char *name, const double *values, int count) {
    cJSON_AddItemToObject(object, name, cJSON_CreateDoubleArray(values, count));
}

static void add_option(cJSON *list, const char *option, const char *value) {
    cJSON_AddItemToArray(list, cJSON_CreateString(option));
    cJSON_AddItemToArray(list, cJSON_CreateString(value));
}

/* Enough digits to come back as the same number. */
static void add_option_numbers(cJSON *list, const char *option, const double *values, int count) {
    char text[128];
    int used = 0;
    for (int i = 0; i < count; i++)
        used += snprintf(text + used, sizeof text - (size_t)used, "%s%.17g", i > 0 ? "," : "", values[i]);
    add_option(list, option, text);
}

static cJSON *render_options(const ang_viewer_state *state) {
    const ang_document *document = state->document;
    const ang_view *view = &document->view;
    cJSON *list = cJSON_CreateArray();
    char size[32];
    snprintf(size, sizeof size, "%dx%d", state->size[0], state->size[1]);
    add_option(list, "--size", size);
    add_option_numbers(list, "--view", (double[]){view->azimuth_deg, view->elevation_deg, view->roll_deg}, 3);
    add_option_numbers(list, "--pan", view->pan_mm, 2);
    add_option_numbers(list, "--zoom", &view->zoom, 1);
    add_option(list, "--projection", ang_projection_name(view->projection));
    if (state->method) add_option(list, "--method", state->method);
    if (document->mode == ANG_MODE_ISO) add_option_numbers(list, "--iso", &document->iso_hu, 1);
    return list;
}

char *ang_view_preset_print(const ang_document *document, ang_error *err) {
    ang_preset preset = {.name = (char *)document->preset,
                         .modality = "any",
                         .description = "as shown",
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

static cJSON *preset_of(const ang_document *document) {
    char *text = ang_view_preset_print(document, NULL);
    cJSON *object = text ? cJSON_Parse(text) : NULL;
    free(text);
    return object;
}

static void add_slices(cJSON *root, const ang_viewer_state *state) {
    for (int i = 0; i < ANG_ORIENTATIONS; i++) {
        cJSON *slice = cJSON_AddObjectToObject(root, ang_orientation_name((ang_orientation)i));
        cJSON_AddNumberToObject(slice, "slice", state->slice[i].index + 1);
        cJSON_AddNumberToObject(slice, "slices", state->slice[i].count);
        ang_json_add_number(slice, "zoom", state->slice[i].zoom);
        add_numbers(slice, "pan_mm", state->slice[i].pan_mm, 2);
    }
}

static void add_panes(cJSON *root, const ang_viewer_state *state) {
    static const char *const names[ANG_PANES] = {"axial", "coronal", "sagittal", "volume"};
    cJSON *panes = cJSON_AddObjectToObject(root, "panes");
    for (int i = 0; i < ANG_PANES; i++) {
        const ang_rect *rect = &state->pane[i];
        add_numbers(panes, names[i], (double[]){rect->x, rect->y, rect->width, rect->height}, 4);
    }
    cJSON_AddStringToObject(root, "maximised", state->maximised >= 0 ? names[state->maximised] : "");
    cJSON_AddStringToObject(root, "hovered", state->hovered < ANG_PANES ? names[state->hovered] : "");
}

static void add_study(cJSON *root, const ang_viewer_state *state) {
    const ang_document *document = state->document;
    char name[32];
    ang_load_report_name(state->study->handle, name);
    cJSON_AddStringToObject(root, "input", name);
    add_numbers(root, "crosshair_mm", (double[]){state->crosshair.x, state->crosshair.y, state->crosshair.z}, 3);
    add_slices(root, state);
    cJSON *window = cJSON_AddObjectToObject(root, "window");
    ang_json_add_number(window, "centre", document->window_centre);
    ang_json_add_number(window, "width", document->window_width);
    cJSON *slab = cJSON_AddObjectToObject(root, "slab");
    ang_json_add_number(slab, "mm", document->slab_mm);
    cJSON_AddStringToObject(slab, "mode", ang_slab_name(document->slab));
    cJSON_AddItemToObject(root, "preset", preset_of(document));
    cJSON *editor = cJSON_AddObjectToObject(root, "editor");
    const ang_rect *plot = &state->editor;
    add_numbers(editor, "plot", (double[]){plot->x, plot->y, plot->width, plot->height}, 4);
    add_numbers(editor, "hu", (double[]){state->editor_low, state->editor_high}, 2);
    cJSON_AddNumberToObject(editor, "point", state->point);
    cJSON_AddBoolToObject(root, "preset_changed", document->edited);
    ang_json_add_number(root, "shift_hu", document->shift_hu);
    ang_json_add_number(root, "stretch", document->stretch);
    ang_json_add_number(root, "azimuth_deg", document->view.azimuth_deg);
    ang_json_add_number(root, "elevation_deg", document->view.elevation_deg);
    cJSON_AddItemToObject(root, "render", render_options(state));
    cJSON_AddBoolToObject(root, "refined", state->refined);
    ang_json_add_number(root, "latency_ms", state->latency_ms);
    cJSON_AddNumberToObject(root, "frames", state->frames);
    ang_json_add_number(root, "frame_ms", state->frame_ms);
    cJSON_AddBoolToObject(root, "can_undo", state->undo);
    cJSON_AddBoolToObject(root, "can_redo", state->redo);
    add_panes(root, state);
    ang_json_add_number(root, "hovered_hu", state->hovered_hu);
    cJSON_AddStringToObject(root, "tool", state->tool);
}

char *ang_view_state_print(const ang_viewer_state *state) {
    cJSON *root = cJSON_CreateObject();
    cJSON_AddStringToObject(root, "phase", state->phase);
    if (state->study) add_study(root, state);
    /* Without its folder, whose name may identify a patient. */
    const char *slash = state->saved ? strrchr(state->saved, '/') : NULL;
    if (state->saved) cJSON_AddStringToObject(root, "saved", slash ? slash + 1 : state->saved);
    char *text = cJSON_Print(root);
    cJSON_Delete(root);
    return text;
}
