/* Reading of states: strict, with errors that name file, line and field. */
#include "io/image/image_io.h"
#include "io/json.h"
#include "io/preset/preset.h"
#include "io/session/measures.h"
#include "io/session/state.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

static const char *const state_fields[] = {"angioscope_state",
                                           "program",
                                           "input",
                                           "preset",
                                           "render",
                                           "window",
                                           "axial",
                                           "coronal",
                                           "sagittal",
                                           "slab",
                                           "crosshair_mm",
                                           "shift_hu",
                                           "preset_changed",
                                           "stretch",
                                           "maximised",
                                           "tool",
                                           "method",
                                           "corner_text",
                                           "live",
                                           "crosshair_lines",
                                           "crop",
                                           "planes_turn",
                                           "voxels_shown",
                                           "turns_about_crosshair",
                                           "measures",
                                           NULL};
static const char *const input_fields[] = {"path", "name", "raw_dims", "raw_type", "raw_spacing", NULL};
static const char *const window_fields[] = {"centre", "width", NULL};
static const char *const crop_fields[] = {"lower", "upper", NULL};
static const char *const slab_fields[] = {"mm", "mode", NULL};
static const char *const slice_names[ANG_STATE_SLICES] = {"axial", "coronal", "sagittal"};
static const char *const slice_fields[] = {"zoom", "pan_mm", NULL};

static const double most_mm = 1e7, most_hu = ANG_TRANSFER_HU_LIMIT, least_width = 1e-6, most_index = 1e6;

/* One file while it is read. */
typedef struct reader {
    ang_json json;
    ang_state *state;
    ang_error *err;
} reader;

/* What stands at `name` of an object whose path is `path` ("" for the root), with its own path in `whole`. */
static const cJSON *field(const cJSON *object, const char *path, const char *name, char whole[96]) {
    snprintf(whole, 96, "%s%s%s", path, path[0] ? "." : "", name);
    return cJSON_GetObjectItemCaseSensitive(object, name);
}

/* An object with fields of `known` only; NULL in *object where it is not there. */
static bool open_object(reader *r, const cJSON *parent, const char *path, const char *name, const char *const *known,
                        const cJSON **object) {
    char whole[96], prefix[100];
    *object = field(parent, path, name, whole);
    if (!*object) return true;
    if (!cJSON_IsObject(*object))
        return ang_json_fail(&r->json, whole, r->err, "%s must be an object in braces", whole);
    snprintf(prefix, sizeof prefix, "%s.", whole);
    return !known || ang_json_check_fields(&r->json, *object, prefix, known, r->err);
}

static bool read_number(reader *r, const cJSON *object, const char *path, const char *name, double low, double high,
                        double *value) {
    char whole[96];
    const cJSON *item = field(object, path, name, whole);
    return ang_json_number(&r->json, item, whole, low, high, value, r->err);
}

static bool read_numbers(reader *r, const cJSON *object, const char *path, const char *name, int count, double limit,
                         double *values) {
    char whole[96];
    const cJSON *list = field(object, path, name, whole);
    return !list || ang_json_numbers(&r->json, list, whole, count, -limit, limit, values, r->err);
}

static bool read_flag(reader *r, const char *name, bool *value) {
    const cJSON *item = cJSON_GetObjectItemCaseSensitive(r->json.root, name);
    if (!item) return true;
    if (!cJSON_IsBool(item)) return ang_json_fail(&r->json, name, r->err, "%s must be true or false", name);
    *value = cJSON_IsTrue(item);
    return true;
}

/* The text, or NULL where there is none; false where it is something else. */
static bool find_text(reader *r, const cJSON *object, const char *path, const char *name, const char **text) {
    char whole[96];
    const cJSON *item = field(object, path, name, whole);
    *text = cJSON_GetStringValue(item);
    return !item || *text || ang_json_fail(&r->json, whole, r->err, "%s must be a text in quotes", whole);
}

static bool read_text(reader *r, const cJSON *object, const char *path, const char *name, char **text) {
    const char *found;
    if (!find_text(r, object, path, name, &found)) return false;
    if (!found) return true;
    *text = strdup(found);
    return *text || ang_fail(r->err, ANG_LIMIT, "%s: no memory to read it", r->json.file);
}

static bool read_word(reader *r, const char *name, char word[16]) {
    const char *found;
    if (!find_text(r, r->json.root, "", name, &found)) return false;
    if (found && strlen(found) > 15)
        return ang_json_fail(&r->json, name, r->err, "%s is \"%.40s\", which there is none of", name, found);
    if (found) snprintf(word, 16, "%s", found);
    return true;
}

/* A path that is relative to the state's folder becomes one from the current folder. */
static bool place_path(reader *r) {
    ang_state *state = r->state;
    const char *slash = strrchr(r->json.file, '/');
    if (!state->input_path || state->input_path[0] == '/' || !slash) return true;
    int folder = (int)(slash - r->json.file) + 1;
    size_t size = (size_t)folder + strlen(state->input_path) + 1;
    char *whole = malloc(size);
    if (!whole) return ang_fail(r->err, ANG_LIMIT, "%s: no memory to read it", r->json.file);
    snprintf(whole, size, "%.*s%s", folder, r->json.file, state->input_path);
    free(state->input_path);
    state->input_path = whole;
    return true;
}

static bool read_input(reader *r) {
    const cJSON *input;
    ang_state *state = r->state;
    return open_object(r, r->json.root, "", "input", input_fields, &input) &&
           read_text(r, input, "input", "path", &state->input_path) &&
           read_text(r, input, "input", "name", &state->input_name) &&
           read_text(r, input, "input", "raw_dims", &state->raw_dims) &&
           read_text(r, input, "input", "raw_type", &state->raw_type) &&
           read_text(r, input, "input", "raw_spacing", &state->raw_spacing) && place_path(r);
}

/* Its lines keep their numbers; its fields are named without "preset." before them. */
static bool read_preset(reader *r) {
    if (!cJSON_GetObjectItemCaseSensitive(r->json.root, "preset"))
        return ang_json_fail(&r->json, "", r->err, "the state has no preset");
    char *text = ang_json_part(&r->json, "preset");
    if (!text) return ang_fail(r->err, ANG_LIMIT, "%s: no memory to read it", r->json.file);
    r->state->preset = ang_preset_parse(r->json.file, text, r->err);
    free(text);
    return r->state->preset != NULL;
}

static bool read_options(reader *r) {
    const cJSON *options;
    if (!open_object(r, r->json.root, "", "render", NULL, &options)) return false;
    for (const cJSON *item = options ? options->child : NULL; item; item = item->next) {
        char whole[96], number[40];
        snprintf(whole, sizeof whole, "render.%s", item->string);
        const char *value = cJSON_GetStringValue(item);
        if (cJSON_IsTrue(item)) value = "";
        if (cJSON_IsNumber(item)) value = ang_json_number_text(item->valuedouble, number);
        if (ang_state_option_value(r->state, item->string))
            return ang_json_fail(&r->json, whole, r->err, "%s is given twice; keep one of them", whole);
        if (!value) return ang_json_fail(&r->json, whole, r->err, "%s must be a text, a number or true", whole);
        if (!ang_state_add_option(r->state, item->string, value, r->err)) return false;
    }
    return true;
}

static bool read_slices(reader *r) {
    const cJSON *slice;
    for (int i = 0; i < ANG_STATE_SLICES; i++) {
        const char *name = slice_names[i];
        ang_state_slice *to = &r->state->slice[i];
        if (!open_object(r, r->json.root, "", name, slice_fields, &slice) ||
            !read_number(r, slice, name, "zoom", 1e-3, 1e4, &to->zoom) ||
            !read_numbers(r, slice, name, "pan_mm", 2, most_mm, to->pan_mm))
            return false;
    }
    return true;
}

static bool read_slab(reader *r) {
    const cJSON *slab;
    const char *mode;
    if (!open_object(r, r->json.root, "", "slab", slab_fields, &slab) ||
        !read_number(r, slab, "slab", "mm", 0, most_mm, &r->state->slab_mm) ||
        !find_text(r, slab, "slab", "mode", &mode))
        return false;
    int found = mode ? ang_slab_from_name(mode) : (int)r->state->slab;
    if (found < 0)
        return ang_json_fail(&r->json, "slab.mode", r->err, "slab.mode is \"%.40s\"; it must be mean, mip or minip",
                             mode);
    r->state->slab = (ang_slab)found;
    return true;
}

static bool read_crop(reader *r) {
    const cJSON *crop;
    double lower[3] = {NAN, NAN, NAN}, upper[3] = {NAN, NAN, NAN};
    if (!open_object(r, r->json.root, "", "crop", crop_fields, &crop)) return false;
    if (crop && cJSON_GetArraySize(crop) != 2)
        return ang_json_fail(&r->json, "crop", r->err, "crop must have lower and upper");
    if (!read_numbers(r, crop, "crop", "lower", 3, most_index, lower) ||
        !read_numbers(r, crop, "crop", "upper", 3, most_index, upper))
        return false;
    r->state->crop_lower = (ang_vec3){lower[0], lower[1], lower[2]};
    r->state->crop_upper = (ang_vec3){upper[0], upper[1], upper[2]};
    return true;
}

static bool read_window(reader *r) {
    const cJSON *root = r->json.root, *window;
    ang_state *state = r->state;
    double at[3] = {NAN, NAN, NAN};
    if (!open_object(r, root, "", "window", window_fields, &window) ||
        !read_number(r, window, "window", "centre", -most_hu, most_hu, &state->window_centre) ||
        !read_number(r, window, "window", "width", least_width, INFINITY, &state->window_width) ||
        !read_numbers(r, root, "", "crosshair_mm", 3, most_mm, at) ||
        !read_numbers(r, root, "", "planes_turn", 9, 1 + 1e-6, state->planes_turn) || !read_slices(r) ||
        !read_slab(r) || !read_crop(r) || !ang_measures_read(&r->json, &state->measures, r->err))
        return false;
    state->crosshair = (ang_vec3){at[0], at[1], at[2]};
    return read_flag(r, "preset_changed", &state->preset_changed) &&
           read_number(r, root, "", "shift_hu", -most_hu, most_hu, &state->shift_hu) &&
           read_number(r, root, "", "stretch", 1e-9, 1e9, &state->stretch) &&
           read_word(r, "maximised", state->maximised) && read_word(r, "tool", state->tool) &&
           read_word(r, "method", state->method) && read_flag(r, "corner_text", &state->corner_text) &&
           read_flag(r, "voxels_shown", &state->voxels_shown) &&
           read_flag(r, "turns_about_crosshair", &state->turns_about_crosshair) &&
           read_flag(r, "crosshair_lines", &state->crosshair_lines);
}

static bool read_state(reader *r) {
    const cJSON *root = r->json.root;
    double version = 0;
    if (!cJSON_IsObject(root) || !cJSON_GetObjectItemCaseSensitive(root, "angioscope_state"))
        return ang_json_fail(&r->json, "", r->err, "is no state of angioscope: it has no field angioscope_state");
    if (!read_number(r, root, "", "angioscope_state", 0, INFINITY, &version)) return false;
    if (version != ANG_STATE_VERSION)
        return ang_json_fail(&r->json, "angioscope_state", r->err,
                             "angioscope_state is %g; this program reads version %d", version, ANG_STATE_VERSION);
    const char *program;
    return ang_json_check_fields(&r->json, root, "", state_fields, r->err) &&
           find_text(r, root, "", "program", &program) && read_input(r) && read_preset(r) && read_options(r) &&
           read_window(r);
}

static bool finish(reader *r, bool opened) {
    *r->state = ang_state_default;
    bool read = opened && read_state(r);
    ang_json_close(&r->json);
    if (!read) ang_state_clear(r->state);
    return read;
}

bool ang_state_parse(const char *file, const char *text, ang_state *state, ang_error *err) {
    reader r = {.state = state, .err = err};
    return finish(&r, ang_json_parse(file, text, &r.json, err));
}

static bool is_picture(const char *file) {
    size_t length = strlen(file);
    return length > 4 && (strcasecmp(file + length - 4, ".png") == 0 || strcasecmp(file + length - 4, ".exr") == 0);
}

static bool open_picture(reader *r, const char *file) {
    char *text = ang_image_state(file, r->err);
    bool opened = text && ang_json_parse(file, text, &r->json, r->err);
    free(text);
    return opened;
}

bool ang_state_read(const char *file, ang_state *state, ang_error *err) {
    ang_error own = {0};
    if (!err) err = &own;
    reader r = {.state = state, .err = err};
    bool opened = is_picture(file) ? open_picture(&r, file) : ang_json_open(file, &r.json, err);
    if (!opened && err->code == ANG_INPUT) err->code = ANG_USAGE; /* a state is no input but part of the wish */
    return finish(&r, opened);
}

bool ang_state_probe(const char *file) {
    char start[256];
    if (is_picture(file)) {
        char *carried = ang_image_state(file, NULL);
        bool carries = carried != NULL;
        free(carried);
        return carries;
    }
    FILE *stream = fopen(file, "rb");
    if (!stream) return false;
    size_t length = fread(start, 1, sizeof start - 1, stream);
    fclose(stream);
    start[length] = '\0';
    return start[strspn(start, " \t\r\n")] == '{' && strstr(start, "\"angioscope_state\"") != NULL;
}
