/* Slicer's volume-property-schema-v1. Fields that are not known are passed over, as the schema has it. */
#include "io/json.h"
#include "io/preset/slicer/forms.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define SCHEMA                                                                                                         \
    "https://raw.githubusercontent.com/slicer/slicer/main/Modules/Loadable/VolumeRendering/Resources/Schema/"          \
    "volume-property-schema-v1.0.0.json#"

typedef struct reader {
    ang_json json;
    ang_property *property;
    size_t index; /* of the volume property in the file */
    char path[128];
    ang_error *err;
} reader;

static const cJSON *field(const cJSON *object, const char *name) {
    return cJSON_GetObjectItemCaseSensitive(object, name);
}

static const char *path_to(reader *r, const char *name) {
    snprintf(r->path, sizeof r->path, "volumeProperties[%zu].%s", r->index, name);
    return r->path;
}

static bool read_number(reader *r, const cJSON *object, const char *name, const char *path, double *value) {
    return ang_json_number(&r->json, field(object, name), path_to(r, path), -HUGE_VAL, HUGE_VAL, value, r->err);
}

static bool read_flag(reader *r, const cJSON *object, const char *name, const char *path, bool *value) {
    const cJSON *item = field(object, name);
    if (!item) return true;
    if (!cJSON_IsBool(item)) return ang_json_fail(&r->json, path_to(r, path), r->err, "%s must be true or false", name);
    *value = cJSON_IsTrue(item);
    return true;
}

/* Numbers of a point, all of which must be there. */
static bool read_point(const cJSON *item, int channels, ang_property_point *point) {
    const cJSON *x = field(item, "x"), *y = field(item, channels == 1 ? "y" : "color");
    const cJSON *midpoint = field(item, "midpoint"), *sharpness = field(item, "sharpness");
    *point = (ang_property_point){.midpoint = 0.5};
    if (!cJSON_IsNumber(x)) return false;
    point->x = x->valuedouble;
    if (midpoint && !cJSON_IsNumber(midpoint)) return false;
    if (sharpness && !cJSON_IsNumber(sharpness)) return false;
    if (midpoint) point->midpoint = midpoint->valuedouble;
    if (sharpness) point->sharpness = sharpness->valuedouble;
    if (channels == 1) {
        if (!cJSON_IsNumber(y)) return false;
        point->y[0] = y->valuedouble;
        return true;
    }
    if (!cJSON_IsArray(y) || cJSON_GetArraySize(y) != 3) return false;
    const cJSON *channel = y->child;
    for (int c = 0; c < 3; c++, channel = channel->next) {
        if (!cJSON_IsNumber(channel)) return false;
        point->y[c] = channel->valuedouble;
    }
    return true;
}

static bool read_function(reader *r, const cJSON *component, const char *name, ang_property_function *function) {
    const cJSON *object = field(component, name), *points = field(object, "points");
    char path[96];
    if (!object) return true;
    snprintf(path, sizeof path, "components[0].%s.points", name);
    if (!cJSON_IsArray(points))
        return ang_json_fail(&r->json, path_to(r, path), r->err, "%s must have a list of points", name);
    size_t index = 0;
    for (const cJSON *item = points->child; item; item = item->next, index++) {
        ang_property_point point;
        ang_error own = {0};
        snprintf(path, sizeof path, "components[0].%s.points[%zu]", name, index);
        if (!read_point(item, function->channels, &point))
            return ang_json_fail(&r->json, path_to(r, path), r->err, "%s: point %zu lacks x, %s, or holds no numbers",
                                 name, index, function->channels == 1 ? "y" : "color");
        if (!ang_property_function_add(function, &point, &own)) {
            if (own.code == ANG_LIMIT) return ang_fail(r->err, ANG_LIMIT, "%s: %s", r->json.file, own.message);
            return ang_json_fail(&r->json, path_to(r, path), r->err, "%s: %s", name, own.message);
        }
    }
    ang_property_function_settle(function);
    return true;
}

static bool read_component(reader *r, const cJSON *component) {
    ang_property *p = r->property;
    const cJSON *light = field(component, "lighting");
    p->unit_given = field(component, "scalarOpacityUnitDistance") != NULL;
    return read_flag(r, component, "shade", "components[0].shade", &p->shade) &&
           read_flag(r, component, "disableGradientOpacity", "components[0].disableGradientOpacity",
                     &p->gradient_off) &&
           read_number(r, component, "scalarOpacityUnitDistance", "components[0].scalarOpacityUnitDistance",
                       &p->unit_distance) &&
           read_number(r, light, "ambient", "components[0].lighting.ambient", &p->ambient) &&
           read_number(r, light, "diffuse", "components[0].lighting.diffuse", &p->diffuse) &&
           read_number(r, light, "specular", "components[0].lighting.specular", &p->specular) &&
           read_number(r, light, "specularPower", "components[0].lighting.specularPower", &p->power) &&
           read_function(r, component, "scalarOpacity", &p->opacity) &&
           read_function(r, component, "gradientOpacity", &p->gradient) &&
           read_function(r, component, "rgbTransferFunction", &p->colour);
}

static bool read_property(reader *r, const cJSON *item) {
    ang_property *p = r->property;
    const cJSON *interpolation = field(item, "interpolationType"), *isos = field(item, "isoSurfaceValues");
    const cJSON *components = field(item, "components");
    if (!cJSON_IsObject(item)) return ang_json_fail(&r->json, path_to(r, ""), r->err, "it must be an object in braces");
    p->nearest = cJSON_IsString(interpolation) && strcmp(interpolation->valuestring, "nearest") == 0;
    if (cJSON_IsArray(isos)) p->iso_count = (size_t)cJSON_GetArraySize(isos);
    if (p->iso_count > 0 && cJSON_IsNumber(isos->child)) p->iso = isos->child->valuedouble;
    if (!cJSON_IsArray(components) || !cJSON_IsObject(components->child))
        return ang_json_fail(&r->json, path_to(r, "components"), r->err, "a volume property must have components");
    p->components = (size_t)cJSON_GetArraySize(components);
    return read_component(r, components->child);
}

/* "bone.vp.json" is called "bone", and where it holds several "bone-1", "bone-2", ... */
static ang_property *add(ang_property_list *list, const char *file, bool several, ang_error *err) {
    const char *slash = strrchr(file, '/'), *base = slash ? slash + 1 : file;
    size_t length = strlen(base);
    char name[300];
    if (length > 8) length -= 8;
    snprintf(name, sizeof name, several ? "%.*s-%zu" : "%.*s", (int)(length < 256 ? length : 256), base,
             list->count + 1);
    return ang_property_list_add(list, name, strlen(name), err);
}

bool ang_property_parse_json(const char *file, const char *text, ang_property_list *list, ang_error *err) {
    reader r = {.err = err};
    if (!ang_json_parse(file, text, &r.json, err)) return false;
    const cJSON *all = field(r.json.root, "volumeProperties"), *schema = field(r.json.root, "@schema");
    bool known = cJSON_IsString(schema) && strstr(schema->valuestring, "volume-property-schema-v1.");
    bool read = true;
    if (!cJSON_IsArray(all) || !all->child)
        read = ang_json_fail(&r.json, "volumeProperties", err, "it has no list of volumeProperties");
    else if (!known)
        read = ang_json_fail(&r.json, "@schema", err, "its @schema is not volume-property-schema-v1");
    for (const cJSON *item = read ? all->child : NULL; item && read; item = item->next, r.index++) {
        r.property = add(list, file, all->child->next != NULL, err);
        read = r.property && read_property(&r, item);
    }
    ang_json_close(&r.json);
    return read;
}

static void add_number(cJSON *object, const char *name, double value) {
    cJSON_AddItemToObject(object, name, ang_json_exact(value));
}

static void add_function(cJSON *component, const char *name, const ang_property_function *function) {
    cJSON *points = cJSON_AddArrayToObject(cJSON_AddObjectToObject(component, name), "points");
    for (size_t i = 0; i < function->count; i++) {
        const ang_property_point *p = &function->points[i];
        cJSON *point = cJSON_CreateObject();
        add_number(point, "x", p->x);
        if (function->channels == 1) add_number(point, "y", p->y[0]);
        cJSON *colour = function->channels == 3 ? cJSON_AddArrayToObject(point, "color") : NULL;
        for (int c = 0; colour && c < 3; c++) cJSON_AddItemToArray(colour, ang_json_exact(p->y[c]));
        add_number(point, "midpoint", p->midpoint);
        add_number(point, "sharpness", p->sharpness);
        cJSON_AddItemToArray(points, point);
    }
}

static cJSON *property_json(const ang_property *p) {
    cJSON *item = cJSON_CreateObject(), *component = cJSON_CreateObject();
    double low = p->opacity.count ? p->opacity.points[0].x : 0;
    double high = p->opacity.count ? p->opacity.points[p->opacity.count - 1].x : 0;
    cJSON *range = cJSON_AddArrayToObject(item, "effectiveRange");
    cJSON_AddItemToArray(range, ang_json_exact(low));
    cJSON_AddItemToArray(range, ang_json_exact(high));
    cJSON *isos = cJSON_AddArrayToObject(item, "isoSurfaceValues");
    if (isfinite(p->iso)) cJSON_AddItemToArray(isos, ang_json_exact(p->iso));
    cJSON_AddTrueToObject(item, "independentComponents");
    cJSON_AddStringToObject(item, "interpolationType", p->nearest ? "nearest" : "linear");
    cJSON_AddItemToArray(cJSON_AddArrayToObject(item, "components"), component);
    add_number(component, "componentWeight", 1);
    cJSON_AddBoolToObject(component, "shade", p->shade);
    cJSON *light = cJSON_AddObjectToObject(component, "lighting");
    add_number(light, "ambient", p->ambient);
    add_number(light, "diffuse", p->diffuse);
    add_number(light, "specular", p->specular);
    add_number(light, "specularPower", p->power);
    cJSON_AddBoolToObject(component, "disableGradientOpacity", p->gradient_off);
    add_number(component, "scalarOpacityUnitDistance", p->unit_distance);
    add_function(component, "rgbTransferFunction", &p->colour);
    add_function(component, "scalarOpacity", &p->opacity);
    add_function(component, "gradientOpacity", &p->gradient);
    return item;
}

bool ang_property_write_json(const ang_property_list *list, FILE *out, ang_error *err) {
    cJSON *root = cJSON_CreateObject();
    cJSON_AddStringToObject(root, "@schema", SCHEMA);
    cJSON *all = cJSON_AddArrayToObject(root, "volumeProperties");
    for (size_t i = 0; i < list->count; i++) cJSON_AddItemToArray(all, property_json(&list->item[i]));
    char *text = cJSON_Print(root);
    cJSON_Delete(root);
    if (!text) return ang_fail(err, ANG_LIMIT, "no memory to write a volume property");
    fputs(text, out);
    fputc('\n', out);
    free(text);
    return true;
}
