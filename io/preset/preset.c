#include "io/preset/preset.h"

#include "core/base/memory.h"
#include "io/json.h"
#include "io/text.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_POINTS = 65536 };

static const char *const preset_fields[] = {"name",    "version", "modality",      "description", "comment", "mode",
                                            "shading", "phong",   "unit_distance", "unit_mm",     "window",  "iso_hu",
                                            "points",  NULL};
static const char *const phong_fields[] = {"ambient", "diffuse", "specular", "power", "g0", NULL};
static const char *const window_fields[] = {"centre", "width", NULL};
static const char *const point_fields[] = {"hu", "colour", "opacity", "extinction", NULL};

/* One file while it is read. */
typedef struct reader {
    ang_json json;
    ang_preset *preset;
    ang_transfer_point *points;
    size_t count;
    bool by_extinction;
    double unit_distance;
    ang_error *err;
} reader;

static const cJSON *field(const cJSON *object, const char *name) {
    return cJSON_GetObjectItemCaseSensitive(object, name);
}

static bool read_text(reader *r, const char *name, char **text) {
    const cJSON *item = field(r->json.root, name);
    if (!item) return true;
    if (!cJSON_IsString(item)) return ang_json_fail(&r->json, name, r->err, "%s must be a text in quotes", name);
    free(*text);
    *text = strdup(item->valuestring);
    if (!*text) return ang_fail(r->err, ANG_LIMIT, "%s: no memory to read it", r->json.file);
    for (char *c = *text; *c; c++)
        if (*c == '\n' || *c == '\t') *c = ' ';
    ang_text_clean(*text); /* it goes to terminals and into files of other programs */
    return true;
}

/* Reads one of some words; `from_name` gives -1 for others. */
static bool read_word(reader *r, const char *name, int (*from_name)(const char *), const char *words, int *value) {
    const cJSON *item = field(r->json.root, name);
    if (!item) return true;
    *value = cJSON_IsString(item) ? from_name(item->valuestring) : -1;
    if (*value >= 0) return true;
    char *text = cJSON_PrintUnformatted(item);
    ang_json_fail(&r->json, name, r->err, "%s is %.40s; it must be one of %s", name, text ? text : "?", words);
    cJSON_free(text);
    return false;
}

/* The object called `name`, its fields checked. */
static bool open_object(reader *r, const char *name, const char *const *known, const cJSON **object) {
    *object = field(r->json.root, name);
    if (!*object) return true;
    if (!cJSON_IsObject(*object)) return ang_json_fail(&r->json, name, r->err, "%s must be an object in braces", name);
    char prefix[32];
    snprintf(prefix, sizeof prefix, "%s.", name);
    return ang_json_check_fields(&r->json, *object, prefix, known, r->err);
}

static bool read_part(reader *r, const char *object_name, const cJSON *object, const char *name, double low,
                      double high, double *value) {
    char path[64];
    snprintf(path, sizeof path, "%s%s%s", object_name, *object_name ? "." : "", name);
    return ang_json_number(&r->json, field(object, name), path, low, high, value, r->err);
}

static bool read_settings(reader *r) {
    const cJSON *root = r->json.root, *phong, *window;
    ang_preset *p = r->preset;
    double version = 1;
    if (!ang_json_number(&r->json, field(root, "version"), "version", 0, INFINITY, &version, r->err)) return false;
    if (version != 1)
        return ang_json_fail(&r->json, "version", r->err, "version is %g; this program reads version 1", version);
    if (field(root, "unit_distance") && field(root, "unit_mm"))
        return ang_json_fail(&r->json, "unit_mm", r->err, "unit_mm repeats unit_distance; keep one of them");
    if (field(root, "description") && field(root, "comment"))
        return ang_json_fail(&r->json, "comment", r->err, "comment repeats description; keep one of them");
    int mode = (int)p->mode, shading = (int)p->shading;
    if (!read_text(r, "name", &p->name) || !read_text(r, "modality", &p->modality) ||
        !read_text(r, "description", &p->description) || !read_text(r, "comment", &p->description) ||
        !read_word(r, "mode", ang_mode_from_name, "dvr, mip, minip, mean, iso", &mode) ||
        !read_word(r, "shading", ang_shading_from_name, "none, phong", &shading))
        return false;
    p->mode = (ang_mode)mode;
    p->shading = (ang_shading)shading;
    if (!open_object(r, "phong", phong_fields, &phong) || !open_object(r, "window", window_fields, &window))
        return false;
    const double limit = ANG_TRANSFER_HU_LIMIT, least = 1e-6;
    return read_part(r, "phong", phong, "ambient", 0, 1, &p->phong.ambient) &&
           read_part(r, "phong", phong, "diffuse", 0, 1, &p->phong.diffuse) &&
           read_part(r, "phong", phong, "specular", 0, 1, &p->phong.specular) &&
           read_part(r, "phong", phong, "power", 0, 1000, &p->phong.power) &&
           read_part(r, "phong", phong, "g0", least, INFINITY, &p->phong.g0) &&
           read_part(r, "window", window, "centre", -limit, limit, &p->window_centre) &&
           read_part(r, "window", window, "width", least, INFINITY, &p->window_width) &&
           read_part(r, "", root, "iso_hu", -limit, limit, &p->iso_hu) &&
           read_part(r, "", root, "unit_distance", least, INFINITY, &r->unit_distance) &&
           read_part(r, "", root, "unit_mm", least, INFINITY, &r->unit_distance);
}

static bool read_point_object(reader *r, const cJSON *item, size_t index, ang_transfer_point *point) {
    char here[48], path[96];
    snprintf(here, sizeof here, "points[%zu]", index);
    snprintf(path, sizeof path, "%s.", here);
    if (!ang_json_check_fields(&r->json, item, path, point_fields, r->err)) return false;
    const cJSON *hu = field(item, "hu"), *colour = field(item, "colour"), *opacity = field(item, "opacity"),
                *extinction = field(item, "extinction");
    if (!hu || !colour || (!opacity && !extinction))
        return ang_json_fail(&r->json, here, r->err, "%s has no %s; give one", here,
                             !hu       ? "hu"
                             : !colour ? "colour"
                                       : "opacity (or extinction)");
    if (opacity && extinction)
        return ang_json_fail(&r->json, here, r->err, "%s has opacity and extinction; keep one of them", here);
    if (index == 0) r->by_extinction = extinction != NULL;
    if (r->by_extinction != (extinction != NULL))
        return ang_json_fail(&r->json, here, r->err, "%s gives %s and points[0] %s; all points must give the same",
                             here, extinction ? "extinction" : "opacity", extinction ? "opacity" : "extinction");
    if (!cJSON_IsArray(colour) || cJSON_GetArraySize(colour) != 3) {
        snprintf(path, sizeof path, "%s.colour", here);
        return ang_json_fail(&r->json, path, r->err, "%s must be three numbers [red, green, blue]", path);
    }
    snprintf(path, sizeof path, "%s.hu", here);
    if (!ang_json_number(&r->json, hu, path, -ANG_TRANSFER_HU_LIMIT, ANG_TRANSFER_HU_LIMIT, &point->hu, r->err))
        return false;
    const cJSON *channel = colour->child;
    for (int c = 0; c < 3; c++, channel = channel->next) {
        snprintf(path, sizeof path, "%s.colour[%d]", here, c);
        if (!ang_json_number(&r->json, channel, path, 0, 1, &point->colour[c], r->err)) return false;
    }
    snprintf(path, sizeof path, "%s.%s", here, extinction ? "extinction" : "opacity");
    return ang_json_number(&r->json, extinction ? extinction : opacity, path, 0,
                           extinction ? ANG_TRANSFER_EXTINCTION_LIMIT : 1, &point->opacity, r->err);
}

static bool read_point_array(reader *r, const cJSON *item, size_t index, ang_transfer_point *point) {
    char path[64];
    snprintf(path, sizeof path, "points[%zu]", index);
    if (cJSON_GetArraySize(item) != 5)
        return ang_json_fail(&r->json, path, r->err, "%s must be five numbers [HU, red, green, blue, opacity]", path);
    if (r->by_extinction)
        return ang_json_fail(&r->json, path, r->err,
                             "%s gives opacity and points[0] extinction; all points must give the same", path);
    double *const values[5] = {&point->hu, &point->colour[0], &point->colour[1], &point->colour[2], &point->opacity};
    const cJSON *number = item->child;
    for (int k = 0; k < 5; k++, number = number->next) {
        double limit = k == 0 ? ANG_TRANSFER_HU_LIMIT : 1;
        snprintf(path, sizeof path, "points[%zu][%d]", index, k);
        if (!ang_json_number(&r->json, number, path, k == 0 ? -limit : 0, limit, values[k], r->err)) return false;
    }
    return true;
}

static bool check_order(const reader *r, size_t i) {
    char path[48];
    snprintf(path, sizeof path, "points[%zu]", i);
    if (i >= 1 && r->points[i].hu < r->points[i - 1].hu)
        return ang_json_fail(&r->json, path, r->err,
                             "%s is at %g HU, below the point before it (%g HU); points must rise", path,
                             r->points[i].hu, r->points[i - 1].hu);
    if (i >= 2 && r->points[i].hu == r->points[i - 2].hu)
        return ang_json_fail(&r->json, path, r->err, "%s is the third at %g HU; two make a step, a third means nothing",
                             path, r->points[i].hu);
    return true;
}

static bool read_points(reader *r) {
    const cJSON *points = field(r->json.root, "points");
    if (!points) return ang_json_fail(&r->json, "", r->err, "the preset has no points; give at least one");
    if (!cJSON_IsArray(points) || !points->child)
        return ang_json_fail(&r->json, "points", r->err, "points must be a list in brackets with at least one point");
    r->count = (size_t)cJSON_GetArraySize(points);
    if (r->count > MOST_POINTS)
        return ang_json_fail(&r->json, "points", r->err, "points has %zu entries; at most %d are read", r->count,
                             MOST_POINTS);
    r->points = ang_alloc(r->count, sizeof *r->points, "points of the preset", r->err);
    if (!r->points) return false;
    size_t i = 0;
    for (const cJSON *item = points->child; item; item = item->next, i++) {
        char path[48];
        snprintf(path, sizeof path, "points[%zu]", i);
        bool read = cJSON_IsArray(item) ? read_point_array(r, item, i, &r->points[i])
                    : cJSON_IsObject(item)
                        ? read_point_object(r, item, i, &r->points[i])
                        : ang_json_fail(&r->json, path, r->err,
                                        "%s must be an object {hu, colour, opacity} or five numbers", path);
        if (!read || !check_order(r, i)) return false;
    }
    return true;
}

/* The file's name without folder and ending. */
static char *stem_of(const char *path) {
    const char *slash = strrchr(path, '/'), *name = slash ? slash + 1 : path;
    size_t length = strlen(name);
    if (length > 5 && strcmp(name + length - 5, ".json") == 0) length -= 5;
    return strndup(name, length);
}

static bool read_preset(reader *r) {
    ang_preset *p = r->preset = ang_alloc(1, sizeof *p, "preset", r->err);
    if (!p) return false;
    p->version = 1;
    p->mode = ANG_MODE_DVR;
    p->shading = ANG_SHADING_NONE;
    p->phong = ang_phong_default;
    p->iso_hu = NAN;
    p->window_centre = 40;
    p->window_width = 400;
    r->unit_distance = 1;
    p->name = stem_of(r->json.file);
    p->modality = strdup("CT");
    p->description = strdup("");
    if (!p->name || !p->modality || !p->description)
        return ang_fail(r->err, ANG_LIMIT, "%s: no memory to read it", r->json.file);
    if (!cJSON_IsObject(r->json.root))
        return ang_json_fail(&r->json, "", r->err, "a preset must be an object in braces");
    if (!ang_json_check_fields(&r->json, r->json.root, "", preset_fields, r->err) || !read_settings(r) ||
        !read_points(r))
        return false;
    p->transfer = ang_transfer_create(r->points, r->count, r->unit_distance, r->by_extinction, NULL, r->err);
    return p->transfer != NULL;
}

static ang_preset *finish(reader *r, bool opened) {
    bool read = opened && read_preset(r);
    free(r->points);
    ang_json_close(&r->json);
    if (read) return r->preset;
    ang_preset_free(r->preset);
    return NULL;
}

ang_preset *ang_preset_load(const char *path, ang_error *err) {
    ang_error own = {0};
    if (!err) err = &own;
    reader r = {.err = err};
    bool opened = ang_json_open(path, &r.json, err);
    if (!opened && err->code == ANG_INPUT) err->code = ANG_USAGE; /* a preset is no input but part of the wish */
    return finish(&r, opened);
}

ang_preset *ang_preset_parse(const char *file, const char *text, ang_error *err) {
    reader r = {.err = err};
    return finish(&r, ang_json_parse(file, text, &r.json, err));
}

static void add_number(cJSON *object, const char *name, double value) {
    cJSON_AddItemToObject(object, name, ang_json_exact(value));
}

static cJSON *print_points(const ang_transfer *transfer) {
    cJSON *points = cJSON_CreateArray();
    for (size_t i = 0; i < transfer->count; i++) {
        const ang_transfer_point *p = &transfer->points[i];
        cJSON *point = cJSON_CreateObject();
        cJSON *colour = cJSON_CreateArray();
        for (int c = 0; c < 3; c++) cJSON_AddItemToArray(colour, ang_json_exact(p->colour[c]));
        add_number(point, "hu", p->hu);
        cJSON_AddItemToObject(point, "colour", colour);
        add_number(point, transfer->by_extinction ? "extinction" : "opacity", p->opacity);
        cJSON_AddItemToArray(points, point);
    }
    return points;
}

cJSON *ang_preset_json(const ang_preset *preset, ang_error *err) {
    cJSON *root = cJSON_CreateObject();
    if (!root) {
        ang_fail(err, ANG_LIMIT, "no memory to print the preset %s", preset->name);
        return NULL;
    }
    cJSON_AddStringToObject(root, "name", preset->name);
    add_number(root, "version", 1);
    cJSON_AddStringToObject(root, "modality", preset->modality);
    cJSON_AddStringToObject(root, "description", preset->description);
    cJSON_AddStringToObject(root, "mode", ang_mode_name(preset->mode));
    cJSON_AddStringToObject(root, "shading", ang_shading_name(preset->shading));
    cJSON *phong = cJSON_AddObjectToObject(root, "phong");
    add_number(phong, "ambient", preset->phong.ambient);
    add_number(phong, "diffuse", preset->phong.diffuse);
    add_number(phong, "specular", preset->phong.specular);
    add_number(phong, "power", preset->phong.power);
    add_number(phong, "g0", preset->phong.g0);
    add_number(root, "unit_distance", preset->transfer->unit_distance);
    cJSON *window = cJSON_AddObjectToObject(root, "window");
    add_number(window, "centre", preset->window_centre);
    add_number(window, "width", preset->window_width);
    if (isfinite(preset->iso_hu)) add_number(root, "iso_hu", preset->iso_hu);
    cJSON_AddItemToObject(root, "points", print_points(preset->transfer));
    return root;
}

char *ang_preset_print(const ang_preset *preset, ang_error *err) {
    cJSON *root = ang_preset_json(preset, err);
    if (!root) return NULL;
    char *text = cJSON_Print(root);
    cJSON_Delete(root);
    if (!text) ang_fail(err, ANG_LIMIT, "no memory to print the preset %s", preset->name);
    return text;
}
