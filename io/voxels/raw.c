#include "io/formats.h"
#include "io/json.h"
#include "io/voxels/samples.h"

#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { most_voxels = 65536 }; /* along one axis */

/* What options or sidecar say; strings as in the options. */
typedef struct raw_form {
    int dims[3];
    double spacing[3];
    bool has_spacing;
    ang_sample type;
} raw_form;

static bool parse_dims(const char *text, int dims[3]) {
    for (int i = 0; i < 3; i++) {
        char *end;
        long value = isdigit((unsigned char)*text) ? strtol(text, &end, 10) : 0; /* strtol alone would skip blanks */
        if (value < 1 || value > most_voxels || *end != (i < 2 ? 'x' : 0)) return false;
        dims[i] = (int)value;
        text = end + 1;
    }
    return true;
}

static bool parse_spacing(const char *text, double spacing[3]) {
    char *end = (char *)(uintptr_t)text;
    for (int i = 0; i < 3; i++) {
        const char *begin = i ? end + 1 : text;
        spacing[i] = strtod(begin, &end);
        if (end == begin || !(spacing[i] > 0) || !isfinite(spacing[i])) return false;
        if (*end != (i < 2 ? ',' : 0)) return false;
    }
    return true;
}

static bool parse_type(const char *text, ang_sample *type) {
    static const struct {
        const char *name;
        ang_sample type;
    } types[] = {{"u8", ANG_SAMPLE_U8},      {"i8", ANG_SAMPLE_I8},      {"u16", ANG_SAMPLE_U16},
                 {"i16", ANG_SAMPLE_I16},    {"f32", ANG_SAMPLE_F32},    {"uint8", ANG_SAMPLE_U8},
                 {"int8", ANG_SAMPLE_I8},    {"uint16", ANG_SAMPLE_U16}, {"int16", ANG_SAMPLE_I16},
                 {"float32", ANG_SAMPLE_F32}};
    for (size_t i = 0; i < sizeof types / sizeof *types; i++) {
        if (strcmp(types[i].name, text) != 0) continue;
        *type = types[i].type;
        return true;
    }
    return false;
}

char *ang_raw_sidecar(const char *path) {
    size_t length = strlen(path), base = (size_t)(ang_base_name(path) - path);
    for (int cut = 0; cut < 3; cut++) {
        char *sidecar = NULL;
        if (asprintf(&sidecar, "%.*s.json", (int)length, path) < 0) return NULL;
        if (access(sidecar, R_OK) == 0 && strcmp(sidecar, path) != 0) return sidecar;
        free(sidecar);
        while (length > base && path[length - 1] != '.') length--;
        if (length <= base + 1) return NULL;
        length--;
    }
    return NULL;
}

static bool is_triple(const cJSON *item) { return cJSON_IsArray(item) && cJSON_GetArraySize(item) == 3; }

static bool use_dims(const ang_json *json, const cJSON *dims, raw_form *form, ang_error *err) {
    double v[3];
    bool ok = cJSON_IsString(dims) && parse_dims(dims->valuestring, form->dims);
    if (!ok && is_triple(dims)) {
        if (!ang_json_numbers(json, dims, "dims", 3, 1, most_voxels, v, err)) return false;
        for (int i = 0; i < 3; i++) form->dims[i] = (int)v[i];
        ok = v[0] == floor(v[0]) && v[1] == floor(v[1]) && v[2] == floor(v[2]);
    }
    return ok || ang_json_fail(json, "dims", err, "dims must be [x, y, z], whole numbers of voxels from 1 to %d",
                               most_voxels);
}

static bool use_sidecar(const ang_json *json, raw_form *form, ang_error *err) {
    if (!cJSON_IsObject(json->root))
        return ang_json_fail(json, "", err, "must be an object with dims, type and spacing");
    const cJSON *type = cJSON_GetObjectItemCaseSensitive(json->root, "type");
    const cJSON *spacing = cJSON_GetObjectItemCaseSensitive(json->root, "spacing");
    if (!use_dims(json, cJSON_GetObjectItemCaseSensitive(json->root, "dims"), form, err)) return false;
    if (!cJSON_IsString(type) || !parse_type(type->valuestring, &form->type))
        return ang_json_fail(json, "type", err, "type must be \"u8\", \"i8\", \"u16\", \"i16\" or \"f32\"");
    if (!spacing) return true;
    form->has_spacing = true;
    if (is_triple(spacing)) return ang_json_numbers(json, spacing, "spacing", 3, 1e-6, 1e6, form->spacing, err);
    return (cJSON_IsString(spacing) && parse_spacing(spacing->valuestring, form->spacing)) ||
           ang_json_fail(json, "spacing", err, "spacing must be [x, y, z] in mm");
}

static bool read_sidecar(const char *path, raw_form *form, ang_error *err) {
    ang_json json;
    if (!ang_json_open(path, &json, err)) return false;
    bool ok = use_sidecar(&json, form, err);
    ang_json_close(&json);
    return ok;
}

bool ang_raw_probe(const char *path, const ang_load_options *options) {
    if (options->raw_dims || options->raw_type) return true;
    char *sidecar = ang_raw_sidecar(path);
    free(sidecar);
    return sidecar != NULL;
}

static bool find_form(const char *path, const ang_load_options *options, raw_form *form, ang_load_report *report,
                      ang_error *err) {
    *form = (raw_form){.spacing = {1, 1, 1}};
    if (!options->raw_dims) {
        char *sidecar = ang_raw_sidecar(path);
        bool ok = sidecar ? read_sidecar(sidecar, form, err)
                          : ang_fail(err, ANG_USAGE, "%s: a raw volume needs --raw-dims XxYxZ or a sidecar %s.json",
                                     ang_base_name(path), ang_base_name(path));
        free(sidecar);
        if (!ok) return false;
    } else if (!parse_dims(options->raw_dims, form->dims)) {
        return ang_fail(err, ANG_USAGE, "--raw-dims %s: must be XxYxZ, such as 256x256x128, each from 1 to %d",
                        options->raw_dims, most_voxels);
    } else if (!options->raw_type) {
        return ang_fail(err, ANG_USAGE, "--raw-dims needs --raw-type u8, i8, u16, i16 or f32");
    }
    if (options->raw_type && !parse_type(options->raw_type, &form->type))
        return ang_fail(err, ANG_USAGE, "--raw-type %s: must be u8, i8, u16, i16 or f32", options->raw_type);
    if (options->raw_spacing && !parse_spacing(options->raw_spacing, form->spacing))
        return ang_fail(err, ANG_USAGE, "--raw-spacing %s: must be X,Y,Z in mm", options->raw_spacing);
    if (!form->has_spacing && !options->raw_spacing)
        ang_notes_add(&report->assumptions, "%s: voxels are taken as 1 x 1 x 1 mm",
                      options->raw_dims ? "no --raw-spacing" : "the sidecar gives no spacing");
    return true;
}

ang_volume *ang_raw_load(const char *path, const ang_load_options *options, ang_load_report *report,
                         const ang_progress *progress, ang_error *err) {
    snprintf(report->format, sizeof report->format, "raw");
    raw_form form;
    if (!find_form(path, options, &form, report, err)) return NULL;
    const ang_byte_part part = {.path = path};
    ang_sample_source source = {.label = ang_base_name(path),
                                .field = options->raw_dims ? "--raw-dims" : "dims",
                                .parts = {.part = &part, .count = 1},
                                .type = form.type,
                                .slope = 1,
                                .slices = options->slices};
    memcpy(source.dims, form.dims, sizeof form.dims);
    ang_volume *volume = ang_samples_read(&source, options->threads, report, progress, err);
    if (!volume) return NULL;
    for (int axis = 0; axis < 3; axis++) {
        volume->affine.m[axis][axis] = form.spacing[axis];
        volume->affine.m[axis][3] = -form.spacing[axis] * (volume->dims[axis] - 1) / 2;
    }
    ang_notes_add(&report->assumptions, "a raw volume says nothing of the patient: x is taken as left, y as posterior, "
                                        "z as superior; its values need not be HU");
    if (ang_samples_list(volume, 1, "?", ang_base_name(path), report, err)) return volume;
    ang_volume_free(volume);
    return NULL;
}
