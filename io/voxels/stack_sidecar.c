#include "io/voxels/stack_sidecar.h"

#include "io/json.h"

#include <math.h>
#include <stdio.h>

ang_stack_form ang_stack_form_default(void) {
    return (ang_stack_form){.spacing = {1, 1, 1}, .direction = {1, 0, 0, 0, 1, 0, 0, 0, 1}, .slope = 1};
}

static bool read_directions(const ang_json *json, const cJSON *array, double out[9], ang_error *err) {
    if (!cJSON_IsArray(array) || cJSON_GetArraySize(array) != 3)
        return ang_json_fail(
            json, "directions", err,
            "directions must be three unit vectors: along rows, down columns, from picture to picture");
    for (int i = 0; i < 3; i++) {
        char path[32];
        double *v = out + 3 * i;
        snprintf(path, sizeof path, "directions[%d]", i);
        if (!ang_json_numbers(json, cJSON_GetArrayItem(array, i), path, 3, -1, 1, v, err)) return false;
        if (fabs(sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]) - 1) > 1e-3)
            return ang_json_fail(json, path, err, "%s is no unit vector", path);
    }
    return true;
}

static bool use(const ang_json *json, ang_stack_form *form, ang_error *err) {
    static const char *const known[] = {"spacing", "origin", "directions", "slope", "intercept", "signed", NULL};
    if (!cJSON_IsObject(json->root)) return ang_json_fail(json, "", err, "must be an object with spacing and more");
    if (!ang_json_check_fields(json, json->root, "", known, err)) return false;
    const cJSON *spacing = cJSON_GetObjectItemCaseSensitive(json->root, "spacing");
    const cJSON *origin = cJSON_GetObjectItemCaseSensitive(json->root, "origin");
    const cJSON *directions = cJSON_GetObjectItemCaseSensitive(json->root, "directions");
    const cJSON *is_signed = cJSON_GetObjectItemCaseSensitive(json->root, "signed");
    form->has_spacing = spacing != NULL;
    form->has_origin = origin != NULL;
    form->has_directions = directions != NULL;
    form->is_signed = cJSON_IsTrue(is_signed);
    if (is_signed && !cJSON_IsBool(is_signed))
        return ang_json_fail(json, "signed", err, "signed must be true or false");
    return (!spacing || ang_json_numbers(json, spacing, "spacing", 3, 1e-6, 1e6, form->spacing, err)) &&
           (!origin || ang_json_numbers(json, origin, "origin", 3, -1e6, 1e6, form->origin, err)) &&
           (!directions || read_directions(json, directions, form->direction, err)) &&
           ang_json_number(json, cJSON_GetObjectItemCaseSensitive(json->root, "slope"), "slope", -1e6, 1e6,
                           &form->slope, err) &&
           ang_json_number(json, cJSON_GetObjectItemCaseSensitive(json->root, "intercept"), "intercept", -1e6, 1e6,
                           &form->intercept, err) &&
           (form->slope != 0 || ang_json_fail(json, "slope", err, "slope must not be 0"));
}

bool ang_stack_form_read(const char *path, ang_stack_form *form, ang_error *err) {
    ang_json json;
    *form = ang_stack_form_default();
    if (!ang_json_open(path, &json, err)) return false;
    bool ok = use(&json, form, err);
    ang_json_close(&json);
    return ok;
}
