#include "io/formats.h"
#include "io/samples.h"

#include <cjson/cJSON.h>
#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { largest_sidecar = 1 << 20 };

/* What options or sidecar say; strings as in the options. */
typedef struct raw_form {
    int dims[3];
    double spacing[3];
    ang_sample type;
} raw_form;

static bool parse_dims(const char *text, int dims[3]) {
    int used = 0;
    if (sscanf(text, "%dx%dx%d%n", &dims[0], &dims[1], &dims[2], &used) != 3 || text[used]) return false;
    return dims[0] > 0 && dims[1] > 0 && dims[2] > 0;
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

/* The sidecar's path, or NULL: NAME.json, where NAME is the file with all, one or two of its endings. To be freed. */
static char *find_sidecar(const char *path) {
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

static bool numbers(const cJSON *array, double out[3]) {
    if (!cJSON_IsArray(array) || cJSON_GetArraySize(array) != 3) return false;
    for (int i = 0; i < 3; i++) {
        const cJSON *item = cJSON_GetArrayItem(array, i);
        if (!cJSON_IsNumber(item)) return false;
        out[i] = item->valuedouble;
    }
    return true;
}

static bool use_sidecar(const cJSON *json, const char *label, raw_form *form, ang_error *err) {
    const cJSON *dims = cJSON_GetObjectItemCaseSensitive(json, "dims");
    const cJSON *type = cJSON_GetObjectItemCaseSensitive(json, "type");
    const cJSON *spacing = cJSON_GetObjectItemCaseSensitive(json, "spacing");
    double v[3];
    bool ok = false;
    if (cJSON_IsString(dims)) {
        ok = parse_dims(dims->valuestring, form->dims);
    } else if (numbers(dims, v)) {
        ok = true;
        for (int i = 0; i < 3; i++) {
            ok = ok && v[i] >= 1 && v[i] <= 2147483647.0 && v[i] == floor(v[i]);
            form->dims[i] = ok ? (int)v[i] : 0;
        }
    }
    if (!ok) return ang_fail(err, ANG_INPUT, "%s: \"dims\" must be [x, y, z], whole numbers of voxels", label);
    if (!cJSON_IsString(type) || !parse_type(type->valuestring, &form->type))
        return ang_fail(err, ANG_INPUT, "%s: \"type\" must be u8, i8, u16, i16 or f32", label);
    if (!spacing) return true;
    ok = cJSON_IsString(spacing) ? parse_spacing(spacing->valuestring, form->spacing) : numbers(spacing, form->spacing);
    for (int i = 0; i < 3; i++) ok = ok && form->spacing[i] > 0 && isfinite(form->spacing[i]);
    return ok || ang_fail(err, ANG_INPUT, "%s: \"spacing\" must be [x, y, z] in mm", label);
}

static bool read_sidecar(const char *path, raw_form *form, ang_error *err) {
    const char *label = ang_base_name(path);
    FILE *file = fopen(path, "rb");
    if (!file) return ang_fail(err, ANG_INPUT, "%s: %s", label, strerror(errno));
    char *text = malloc(largest_sidecar);
    size_t length = text ? fread(text, 1, largest_sidecar, file) : 0;
    fclose(file);
    cJSON *json = text ? cJSON_ParseWithLength(text, length) : NULL;
    free(text);
    bool ok = cJSON_IsObject(json) ? use_sidecar(json, label, form, err)
                                   : ang_fail(err, ANG_INPUT, "%s: is no JSON object", label);
    cJSON_Delete(json);
    return ok;
}

bool ang_raw_probe(const char *path, const ang_load_options *options) {
    if (options->raw_dims || options->raw_type) return true;
    char *sidecar = find_sidecar(path);
    free(sidecar);
    return sidecar != NULL;
}

static bool find_form(const char *path, const ang_load_options *options, raw_form *form, ang_load_report *report,
                      ang_error *err) {
    *form = (raw_form){.spacing = {1, 1, 1}};
    if (!options->raw_dims) {
        char *sidecar = find_sidecar(path);
        bool ok = sidecar ? read_sidecar(sidecar, form, err)
                          : ang_fail(err, ANG_USAGE, "%s: a raw volume needs --raw-dims XxYxZ or a sidecar %s.json",
                                     ang_base_name(path), ang_base_name(path));
        free(sidecar);
        if (!ok) return false;
    } else if (!parse_dims(options->raw_dims, form->dims)) {
        return ang_fail(err, ANG_USAGE, "--raw-dims %s: must be XxYxZ, such as 256x256x128", options->raw_dims);
    } else if (!options->raw_type) {
        return ang_fail(err, ANG_USAGE, "--raw-dims needs --raw-type u8, i8, u16, i16 or f32");
    }
    if (options->raw_type && !parse_type(options->raw_type, &form->type))
        return ang_fail(err, ANG_USAGE, "--raw-type %s: must be u8, i8, u16, i16 or f32", options->raw_type);
    if (options->raw_spacing && !parse_spacing(options->raw_spacing, form->spacing))
        return ang_fail(err, ANG_USAGE, "--raw-spacing %s: must be X,Y,Z in mm", options->raw_spacing);
    if (options->raw_dims && !options->raw_spacing)
        ang_notes_add(&report->assumptions, "no --raw-spacing: voxels are taken as 1 x 1 x 1 mm");
    return true;
}

ang_volume *ang_raw_load(const char *path, const ang_load_options *options, ang_load_report *report,
                         const ang_progress *progress, ang_error *err) {
    snprintf(report->format, sizeof report->format, "raw");
    raw_form form;
    if (!find_form(path, options, &form, report, err)) return NULL;
    ang_sample_source source = {
        .path = path, .label = ang_base_name(path), .type = form.type, .slope = 1, .exact_length = true};
    memcpy(source.dims, form.dims, sizeof form.dims);
    ang_volume *volume = ang_samples_read(&source, options->threads, report, progress, err);
    if (!volume) return NULL;
    for (int axis = 0; axis < 3; axis++) {
        volume->affine.m[axis][axis] = form.spacing[axis];
        volume->affine.m[axis][3] = -form.spacing[axis] * (volume->dims[axis] - 1) / 2;
    }
    ang_notes_add(&report->assumptions, "a raw volume says nothing of the patient: x is taken as left, y as posterior, "
                                        "z as superior, values as HU");
    if (ang_samples_list(volume, "?", ang_base_name(path), report, err)) return volume;
    ang_volume_free(volume);
    return NULL;
}
