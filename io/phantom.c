#include "io/phantom.h"

#include "core/base/memory.h"
#include "io/dicom/write.h"
#include "io/replace.h"

#include <cjson/cJSON.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Positions and sizes have an exact meaning to a micrometre; more digits would only be noise of the arithmetic. */
static double micrometres(double mm) { return round(mm * 1e3) / 1e3; }

static void add_point(cJSON *to, const char *name, ang_vec3 p) {
    cJSON *array = cJSON_AddArrayToObject(to, name);
    for (int i = 0; i < 3; i++) cJSON_AddItemToArray(array, cJSON_CreateNumber(micrometres(ang_vec3_at(p, i))));
}

static void add_params(cJSON *root, const ang_phantom_params *p) {
    cJSON *params = cJSON_AddObjectToObject(root, "params");
    cJSON_AddItemToObject(params, "dims", cJSON_CreateIntArray(p->dims, 3));
    cJSON_AddItemToObject(params, "spacing_mm", cJSON_CreateDoubleArray(p->spacing_mm, 3));
    add_point(params, "centre_mm", p->centre_mm);
    cJSON_AddNumberToObject(params, "seed", (double)p->seed);
    cJSON_AddNumberToObject(params, "noise_hu", p->noise_hu);
}

static void add_tissues(cJSON *root, const ang_phantom_truth *t) {
    cJSON *hu = cJSON_AddObjectToObject(root, "hu");
    cJSON_AddNumberToObject(hu, "artery", t->artery_hu);
    cJSON_AddNumberToObject(hu, "vein", t->vein_hu);
    cJSON_AddNumberToObject(hu, "brain", t->brain_hu);
    cJSON_AddNumberToObject(hu, "soft_tissue", t->soft_tissue_hu);
    cJSON_AddItemToObject(hu, "bone", cJSON_CreateDoubleArray(t->bone_hu, 2));
    cJSON_AddNumberToObject(hu, "air", t->air_hu);
}

static void add_lesions(cJSON *root, const ang_phantom_truth *t) {
    cJSON *aneurysm = cJSON_AddObjectToObject(root, "aneurysm");
    add_point(aneurysm, "centre_mm", t->aneurysm.centre);
    cJSON_AddNumberToObject(aneurysm, "diameter_mm", t->aneurysm.diameter_mm);
    cJSON_AddNumberToObject(aneurysm, "neck_mm", t->aneurysm.neck_mm);
    cJSON_AddStringToObject(aneurysm, "parent", t->aneurysm.parent);
    cJSON *stenosis = cJSON_AddObjectToObject(root, "stenosis");
    add_point(stenosis, "centre_mm", t->stenosis.centre);
    add_point(stenosis, "direction", t->stenosis.direction);
    cJSON_AddNumberToObject(stenosis, "minimum_mm", micrometres(t->stenosis.minimum_mm));
    cJSON_AddNumberToObject(stenosis, "normal_mm", micrometres(t->stenosis.normal_mm));
    cJSON_AddNumberToObject(stenosis, "length_mm", micrometres(t->stenosis.length_mm));
    cJSON_AddStringToObject(stenosis, "profile", "raised cosine");
    cJSON_AddNumberToObject(stenosis, "percent", micrometres(t->stenosis.percent));
    cJSON_AddStringToObject(stenosis, "parent", t->stenosis.parent);
}

static void add_vessels(cJSON *root, const ang_phantom_truth *t) {
    cJSON *vessels = cJSON_AddArrayToObject(root, "vessels");
    for (int i = 0; i < t->vessel_count; i++) {
        const ang_phantom_vessel *v = &t->vessels[i];
        cJSON *vessel = cJSON_CreateObject();
        cJSON_AddStringToObject(vessel, "name", v->name);
        cJSON_AddStringToObject(vessel, "kind", v->arterial ? "artery" : "vein");
        cJSON_AddNumberToObject(vessel, "hu", v->hu);
        cJSON_AddNumberToObject(vessel, "length_mm", micrometres(v->length_mm));
        cJSON *points = cJSON_AddArrayToObject(vessel, "points_mm");
        cJSON *radii = cJSON_AddArrayToObject(vessel, "radii_mm");
        for (int k = 0; k < v->count; k++) {
            double p[3] = {micrometres(v->points[k].x), micrometres(v->points[k].y), micrometres(v->points[k].z)};
            cJSON_AddItemToArray(points, cJSON_CreateDoubleArray(p, 3));
            cJSON_AddItemToArray(radii, cJSON_CreateNumber(micrometres(v->radii_mm[k])));
        }
        cJSON_AddItemToArray(vessels, vessel);
    }
}

bool ang_phantom_truth_write(const char *path, const ang_phantom_truth *truth, ang_error *err) {
    cJSON *root = cJSON_CreateObject();
    if (root) {
        cJSON_AddNumberToObject(root, "version", 1);
        cJSON_AddStringToObject(root, "axes", "LPS, mm");
        cJSON_AddStringToObject(root, "centre_lines", "uniform Catmull-Rom through points_mm, end points reflected");
        add_params(root, &truth->params);
        add_tissues(root, truth);
        add_lesions(root, truth);
        add_vessels(root, truth);
    }
    char *text = root ? cJSON_Print(root) : NULL;
    cJSON_Delete(root);
    bool good = text ? ang_file_replace(path, text, strlen(text), err)
                     : ang_fail(err, ANG_LIMIT, "%s: no memory for the phantom's truth", path);
    free(text);
    return good;
}

bool ang_phantom_write(const char *folder, const ang_phantom_params *params, int threads, const ang_progress *progress,
                       ang_error *err) {
    char path[4096];
    if (snprintf(path, sizeof path, "%s/truth.json", folder) >= (int)sizeof path) {
        return ang_fail(err, ANG_OUTPUT, "%s: the name is too long; choose another place", folder);
    }
    ang_phantom_truth *truth = ang_alloc(1, sizeof *truth, "phantom", err);
    if (!truth) return false;
    ang_volume *volume = ang_phantom_make(params, threads, progress, truth, err);
    bool good = volume && ang_dicom_write(folder, volume, params->seed, progress, err) &&
                ang_phantom_truth_write(path, truth, err);
    ang_volume_free(volume);
    free(truth);
    return good;
}
