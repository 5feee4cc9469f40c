#include "io/costs.h"

#include "core/base/parallel.h"
#include "core/render/context.h"
#include "io/checksum.h"
#include "io/json.h"
#include "io/machine.h"
#include "io/replace.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* What the models hold for. */
static void make_key(const ang_costs_origin *origin, char *key, size_t size) {
    snprintf(key, size, "%s|%s|%d threads|program %08x", origin->gl, origin->processor, ang_thread_count(0),
             ang_machine_program_checksum());
}

static void find_path(const char *key, char *path, size_t size) {
    const char *cache = getenv("XDG_CACHE_HOME"), *home = getenv("HOME");
    uint32_t sum = ang_checksum(0, (const unsigned char *)key, strlen(key));
    path[0] = '\0';
    /* The specification of XDG wants a relative path to be passed over. */
    if (cache && cache[0] == '/')
        snprintf(path, size, "%s/angioscope/costs-%08x.json", cache, sum);
    else if (home && home[0] == '/')
        snprintf(path, size, "%s/.cache/angioscope/costs-%08x.json", home, sum);
}

static bool read_model(const cJSON *item, ang_costs *costs) {
    const cJSON *name = cJSON_GetObjectItemCaseSensitive(item, "name"),
                *terms = cJSON_GetObjectItemCaseSensitive(item, "terms"),
                *spread = cJSON_GetObjectItemCaseSensitive(item, "spread");
    if (!cJSON_IsString(name) || cJSON_GetArraySize(terms) != ANG_COST_TERMS || costs->count == ANG_COSTS_MOST)
        return false;
    ang_cost_model *model = &costs->of[costs->count].model;
    for (int i = 0; i < ANG_COST_TERMS; i++) {
        const cJSON *term = cJSON_GetArrayItem(terms, i);
        if (!cJSON_IsNumber(term) || !(term->valuedouble >= 0) || !isfinite(term->valuedouble)) return false;
        model->term[i] = term->valuedouble;
    }
    model->spread = cJSON_IsNumber(spread) ? spread->valuedouble : NAN;
    if (!ang_cost_grows(model)) return false;
    snprintf(costs->of[costs->count++].method, sizeof costs->of[0].method, "%s", name->valuestring);
    return true;
}

bool ang_costs_read(const char *path, const char *key, ang_costs *costs) {
    ang_json json;
    *costs = (ang_costs){.count = 0};
    if (!path[0] || !ang_json_open(path, &json, NULL)) return false;
    const cJSON *of = cJSON_GetObjectItemCaseSensitive(json.root, "of"), *item = NULL,
                *methods = cJSON_GetObjectItemCaseSensitive(json.root, "methods"),
                *ms = cJSON_GetObjectItemCaseSensitive(json.root, "measured_ms");
    bool ok = cJSON_IsString(of) && strcmp(of->valuestring, key) == 0 && cJSON_IsArray(methods);
    cJSON_ArrayForEach(item, methods) ok = ok && read_model(item, costs);
    costs->ms = cJSON_IsNumber(ms) && ms->valuedouble >= 0 && isfinite(ms->valuedouble) ? ms->valuedouble : 0;
    ang_json_close(&json);
    if (!ok) *costs = (ang_costs){.count = 0};
    return ok;
}

static void write_costs(const char *path, const char *key, const ang_costs *costs) {
    char folder[512];
    snprintf(folder, sizeof folder, "%.*s", (int)(strrchr(path, '/') - path), path);
    if (!ang_folder_make(folder, NULL)) return;
    cJSON *root = cJSON_CreateObject();
    cJSON_AddStringToObject(root, "of", key);
    ang_json_add_number(root, "measured_ms", costs->ms);
    cJSON *methods = cJSON_AddArrayToObject(root, "methods");
    for (size_t i = 0; i < costs->count; i++) {
        cJSON *item = cJSON_CreateObject();
        cJSON_AddStringToObject(item, "name", costs->of[i].method);
        cJSON_AddItemToObject(item, "terms", cJSON_CreateDoubleArray(costs->of[i].model.term, ANG_COST_TERMS));
        ang_json_add_number(item, "spread", costs->of[i].model.spread);
        cJSON_AddItemToArray(methods, item);
    }
    char *text = cJSON_Print(root);
    cJSON_Delete(root);
    if (text) ang_file_replace(path, text, strlen(text), NULL);
    free(text);
}

bool ang_costs_load(ang_gl *gl, ang_costs *costs, ang_costs_origin *origin, const ang_progress *progress,
                    ang_error *err) {
    char key[640];
    *origin = (ang_costs_origin){.cached = false};
    snprintf(origin->gl, sizeof origin->gl, "%s", gl ? ang_gl_renderer(gl) : "none");
    ang_machine_processor(origin->processor, sizeof origin->processor);
    make_key(origin, key, sizeof key);
    find_path(key, origin->path, sizeof origin->path);
    ang_costs_read(origin->path, key, costs);
    double before = costs->ms;
    if (!ang_costs_measure(gl, costs, progress, err)) return false;
    origin->cached = !(costs->ms > before);
    if (!origin->cached && origin->path[0]) write_costs(origin->path, key, costs);
    return true;
}

bool ang_costs_forget(const ang_costs_origin *origin, const char *method) {
    char key[640];
    ang_costs costs;
    size_t left = 0;
    make_key(origin, key, sizeof key);
    if (!ang_costs_read(origin->path, key, &costs)) return false;
    for (size_t i = 0; i < costs.count; i++)
        if (strcmp(costs.of[i].method, method) != 0) costs.of[left++] = costs.of[i];
    bool found = left < costs.count;
    costs.count = left;
    if (found) write_costs(origin->path, key, &costs);
    return found;
}
