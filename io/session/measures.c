#include "io/session/measures.h"

#include <math.h>
#include <stdio.h>

static const double most_mm = 1e7;

static cJSON *numbers(const double *values, int count) {
    cJSON *list = cJSON_CreateArray();
    for (int i = 0; i < count; i++) cJSON_AddItemToArray(list, ang_json_exact(values[i]));
    return list;
}

static cJSON *place(ang_vec3 at) { return numbers((double[]){at.x, at.y, at.z}, 3); }

static cJSON *measurement_json(const ang_measurement *m) {
    cJSON *object = cJSON_CreateObject();
    cJSON_AddStringToObject(object, "kind", ang_measure_kind_name(m->kind));
    cJSON *points = cJSON_AddArrayToObject(object, "points_mm");
    for (int i = 0; i < ang_measure_points(m->kind); i++) cJSON_AddItemToArray(points, place(m->point[i]));
    if (ang_measure_is_region(m->kind)) {
        cJSON_AddItemToObject(object, "right", place(m->right));
        cJSON_AddItemToObject(object, "down", place(m->down));
    }
    if (m->label_placed) cJSON_AddItemToObject(object, "label_mm", numbers(m->label_mm, 2));
    return object;
}

cJSON *ang_measures_json(const ang_measures *measures) {
    cJSON *object = cJSON_CreateObject();
    cJSON_AddBoolToObject(object, "hidden", measures->hidden);
    cJSON *list = cJSON_AddArrayToObject(object, "list");
    for (int i = 0; i < measures->count; i++) cJSON_AddItemToArray(list, measurement_json(&measures->item[i]));
    return object;
}

static bool read_place(const ang_json *json, const cJSON *list, const char *path, ang_vec3 *at, ang_error *err) {
    double values[3] = {0};
    if (!ang_json_numbers(json, list, path, 3, -most_mm, most_mm, values, err)) return false;
    *at = (ang_vec3){values[0], values[1], values[2]};
    return true;
}

static bool read_sides(const ang_json *json, const cJSON *item, const char *path, ang_measurement *m, ang_error *err) {
    const double slack = 1e-6;
    char right[64], down[64];
    snprintf(right, sizeof right, "%.40s.right", path);
    snprintf(down, sizeof down, "%.40s.down", path);
    if (!read_place(json, cJSON_GetObjectItemCaseSensitive(item, "right"), right, &m->right, err) ||
        !read_place(json, cJSON_GetObjectItemCaseSensitive(item, "down"), down, &m->down, err))
        return false;
    bool unit = fabs(ang_vec3_length(m->right) - 1) <= slack && fabs(ang_vec3_length(m->down) - 1) <= slack;
    return (unit && fabs(ang_vec3_dot(m->right, m->down)) <= slack) ||
           ang_json_fail(json, right, err, "%s and down must be of length 1 and at right angles", right);
}

static bool read_measurement(const ang_json *json, const cJSON *item, const char *path, ang_measurement *m,
                             ang_error *err) {
    static const char *const fields[] = {"kind", "points_mm", "right", "down", "label_mm", NULL};
    char prefix[64], where[64];
    snprintf(prefix, sizeof prefix, "%.40s.", path);
    if (!cJSON_IsObject(item)) return ang_json_fail(json, path, err, "%s must be an object in braces", path);
    if (!ang_json_check_fields(json, item, prefix, fields, err)) return false;
    const char *name = cJSON_GetStringValue(cJSON_GetObjectItemCaseSensitive(item, "kind"));
    int kind = name ? ang_measure_kind_from_name(name) : -1;
    snprintf(where, sizeof where, "%.40s.kind", path);
    if (kind < 0)
        return ang_json_fail(json, where, err, "%s is \"%.40s\"; it must be length, angle, ellipse or rectangle", where,
                             name ? name : "");
    *m = (ang_measurement){.kind = (ang_measure_kind)kind};
    const cJSON *points = cJSON_GetObjectItemCaseSensitive(item, "points_mm");
    int count = ang_measure_points(m->kind);
    snprintf(where, sizeof where, "%.40s.points_mm", path);
    if (!cJSON_IsArray(points) || cJSON_GetArraySize(points) != count)
        return ang_json_fail(json, where, err, "%s must be %d points in brackets", where, count);
    for (int i = 0; i < count; i++) {
        char at[80];
        snprintf(at, sizeof at, "%s[%d]", where, i);
        if (!read_place(json, cJSON_GetArrayItem(points, i), at, &m->point[i], err)) return false;
    }
    if (ang_measure_is_region(m->kind) && !read_sides(json, item, path, m, err)) return false;
    const cJSON *label = cJSON_GetObjectItemCaseSensitive(item, "label_mm");
    m->label_placed = label != NULL;
    snprintf(where, sizeof where, "%.40s.label_mm", path);
    return !label || ang_json_numbers(json, label, where, 2, -most_mm, most_mm, m->label_mm, err);
}

bool ang_measures_read(const ang_json *json, ang_measures *measures, ang_error *err) {
    static const char *const fields[] = {"hidden", "list", NULL};
    const cJSON *object = cJSON_GetObjectItemCaseSensitive(json->root, "measures");
    if (!object) return true;
    if (!cJSON_IsObject(object)) return ang_json_fail(json, "measures", err, "measures must be an object in braces");
    if (!ang_json_check_fields(json, object, "measures.", fields, err)) return false;
    const cJSON *hidden = cJSON_GetObjectItemCaseSensitive(object, "hidden");
    const cJSON *list = cJSON_GetObjectItemCaseSensitive(object, "list");
    if (hidden && !cJSON_IsBool(hidden))
        return ang_json_fail(json, "measures.hidden", err, "measures.hidden must be true or false");
    if (!cJSON_IsArray(list) || cJSON_GetArraySize(list) > ANG_MEASURES)
        return ang_json_fail(json, "measures.list", err, "measures.list must be at most %d measures in brackets",
                             ANG_MEASURES);
    *measures = (ang_measures){.hidden = cJSON_IsTrue(hidden)};
    for (int i = 0; i < cJSON_GetArraySize(list); i++) {
        char path[32];
        ang_measurement m;
        snprintf(path, sizeof path, "measures.list[%d]", i);
        if (!read_measurement(json, cJSON_GetArrayItem(list, i), path, &m, err)) return false;
        ang_measures_add(measures, &m);
    }
    return true;
}
