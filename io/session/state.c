#include "io/session/state.h"

#include "io/json.h"
#include "io/preset/preset.h"
#include "io/replace.h"
#include "io/session/measures.h"

#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

const ang_state ang_state_default = {.stretch = 1,
                                     .window_centre = NAN,
                                     .window_width = NAN,
                                     .crosshair = {NAN, NAN, NAN},
                                     .crop_lower = {NAN, NAN, NAN},
                                     .crop_upper = {NAN, NAN, NAN},
                                     .planes_turn = {1, 0, 0, 0, 1, 0, 0, 0, 1},
                                     .slice = {{.zoom = 1}, {.zoom = 1}, {.zoom = 1}},
                                     .corner_text = true,
                                     .crosshair_lines = true};

void ang_state_clear(ang_state *state) {
    free(state->input_path);
    free(state->input_name);
    free(state->raw_dims);
    free(state->raw_type);
    free(state->raw_spacing);
    ang_preset_free(state->preset);
    for (size_t i = 0; i < state->option_count; i++) {
        free(state->options[i].name);
        free(state->options[i].value);
    }
    free(state->options);
    *state = ang_state_default;
}

bool ang_state_add_option(ang_state *state, const char *name, const char *value, ang_error *err) {
    ang_state_option *grown = realloc(state->options, (state->option_count + 1) * sizeof *grown);
    if (grown) state->options = grown;
    ang_state_option option = {grown ? strdup(name) : NULL, grown ? strdup(value) : NULL};
    if (!option.name || !option.value) {
        free(option.name);
        free(option.value);
        return ang_fail(err, ANG_LIMIT, "no memory for a state");
    }
    state->options[state->option_count++] = option;
    return true;
}

const char *ang_state_option_value(const ang_state *state, const char *name) {
    for (size_t i = 0; i < state->option_count; i++)
        if (strcmp(state->options[i].name, name) == 0) return state->options[i].value;
    return NULL;
}

int ang_state_series(const ang_state *state) {
    const char *dash = state->input_name ? strchr(state->input_name, '-') : NULL;
    return dash ? atoi(dash + 1) : 0;
}

int ang_state_phase(const ang_state *state) {
    const char *point = state->input_name ? strchr(state->input_name, '.') : NULL;
    return point ? atoi(point + 1) : 0;
}

static void add_text(cJSON *object, const char *name, const char *text) {
    if (text && text[0]) cJSON_AddStringToObject(object, name, text);
}

static void add_number(cJSON *object, const char *name, double value) {
    cJSON_AddItemToObject(object, name, ang_json_exact(value));
}

static void add_numbers(cJSON *object, const char *name, const double *values, int count) {
    cJSON *list = cJSON_AddArrayToObject(object, name);
    for (int i = 0; i < count; i++) cJSON_AddItemToArray(list, ang_json_exact(values[i]));
}

/* The path of the data as it is written to `file`: relative where it lies below its folder. */
static void add_path(cJSON *input, const char *path, const char *file) {
    const char *slash = strrchr(file, '/');
    char *folder = slash ? strndup(file, (size_t)(slash - file) + 1) : strdup(".");
    char *above = folder ? realpath(folder, NULL) : NULL, *whole = realpath(path, NULL);
    const char *shown = whole ? whole : path;
    size_t length = above ? strlen(above) : 0;
    if (length > 1 && strncmp(shown, above, length) == 0 && shown[length] == '/') shown += length + 1;
    cJSON_AddStringToObject(input, "path", shown);
    free(folder);
    free(above);
    free(whole);
}

static void add_input(cJSON *root, const ang_state *state, const char *file) {
    cJSON *input = cJSON_AddObjectToObject(root, "input");
    if (file && state->input_path) add_path(input, state->input_path, file);
    add_text(input, "name", state->input_name);
    add_text(input, "raw_dims", state->raw_dims);
    add_text(input, "raw_type", state->raw_type);
    add_text(input, "raw_spacing", state->raw_spacing);
}

static void add_window(cJSON *root, const ang_state *state) {
    static const char *const names[ANG_STATE_SLICES] = {"axial", "coronal", "sagittal"};
    if (isfinite(state->window_centre) && isfinite(state->window_width)) {
        cJSON *window = cJSON_AddObjectToObject(root, "window");
        add_number(window, "centre", state->window_centre);
        add_number(window, "width", state->window_width);
    }
    const ang_vec3 *at = &state->crosshair;
    if (isfinite(at->x)) add_numbers(root, "crosshair_mm", (double[]){at->x, at->y, at->z}, 3);
    const ang_vec3 *lower = &state->crop_lower, *upper = &state->crop_upper;
    if (isfinite(lower->x)) {
        cJSON *crop = cJSON_AddObjectToObject(root, "crop");
        add_numbers(crop, "lower", (double[]){lower->x, lower->y, lower->z}, 3);
        add_numbers(crop, "upper", (double[]){upper->x, upper->y, upper->z}, 3);
    }
    add_numbers(root, "planes_turn", state->planes_turn, 9);
    for (int i = 0; i < ANG_STATE_SLICES; i++) {
        cJSON *slice = cJSON_AddObjectToObject(root, names[i]);
        add_number(slice, "zoom", state->slice[i].zoom);
        add_numbers(slice, "pan_mm", state->slice[i].pan_mm, 2);
    }
    cJSON *slab = cJSON_AddObjectToObject(root, "slab");
    add_number(slab, "mm", state->slab_mm);
    cJSON_AddStringToObject(slab, "mode", ang_slab_name(state->slab));
    if (state->measures.count > 0) cJSON_AddItemToObject(root, "measures", ang_measures_json(&state->measures));
    cJSON_AddBoolToObject(root, "preset_changed", state->preset_changed);
    add_number(root, "shift_hu", state->shift_hu);
    add_number(root, "stretch", state->stretch);
    cJSON_AddStringToObject(root, "maximised", state->maximised);
    add_text(root, "tool", state->tool);
    add_text(root, "method", state->method);
    cJSON_AddBoolToObject(root, "voxels_shown", state->voxels_shown);
    cJSON_AddBoolToObject(root, "turns_about_crosshair", state->turns_about_crosshair);
    cJSON_AddBoolToObject(root, "corner_text", state->corner_text);
    cJSON_AddBoolToObject(root, "crosshair_lines", state->crosshair_lines);
}

cJSON *ang_state_json(const ang_state *state, const char *program_version, const char *file, bool window,
                      ang_error *err) {
    char program[64];
    snprintf(program, sizeof program, "angioscope %s", program_version);
    cJSON *root = cJSON_CreateObject();
    cJSON_AddNumberToObject(root, "angioscope_state", ANG_STATE_VERSION);
    cJSON_AddStringToObject(root, "program", program);
    add_input(root, state, file);
    cJSON *preset = root && state->preset ? ang_preset_json(state->preset, err) : NULL;
    if (!root || (state->preset && !preset)) {
        cJSON_Delete(root);
        ang_fail(err, ANG_LIMIT, "no memory for a state");
        return NULL;
    }
    if (preset) cJSON_AddItemToObject(root, "preset", preset);
    cJSON *options = cJSON_AddObjectToObject(root, "render");
    for (size_t i = 0; i < state->option_count; i++) {
        const ang_state_option *option = &state->options[i];
        cJSON_AddItemToObject(options, option->name,
                              option->value[0] ? cJSON_CreateString(option->value) : cJSON_CreateTrue());
    }
    if (window) add_window(root, state);
    return root;
}

char *ang_state_print(const ang_state *state, const char *program_version, ang_error *err) {
    cJSON *root = ang_state_json(state, program_version, NULL, false, err);
    char *text = root ? cJSON_PrintUnformatted(root) : NULL;
    if (root && !text) ang_fail(err, ANG_LIMIT, "no memory for a state");
    cJSON_Delete(root);
    return text;
}

char *ang_state_text(const ang_state *state, const char *program_version, const char *file, ang_error *err) {
    cJSON *root = ang_state_json(state, program_version, file, true, err);
    char *text = root ? cJSON_Print(root) : NULL;
    if (root && !text) ang_fail(err, ANG_LIMIT, "%s: no memory to write it", file);
    cJSON_Delete(root);
    return text;
}

bool ang_state_write(const char *file, const ang_state *state, const char *program_version, ang_error *err) {
    char *text = ang_state_text(state, program_version, file, err);
    bool written = text && ang_file_replace(file, text, strlen(text), err);
    free(text);
    return written;
}
