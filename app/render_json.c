#include "app/render_json.h"

#include "core/base/median.h"
#include "io/json.h"
#include "io/replace.h"
#include "io/report.h"

#include <cjson/cJSON.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void ang_render_summary_times(ang_render_summary *summary, double *milliseconds, int count) {
    summary->median_ms = ang_median(milliseconds, (size_t)count);
    summary->timed_frames = count;
    summary->min_ms = milliseconds[0];
    summary->max_ms = milliseconds[count - 1];
}

static cJSON *items_json(const ang_plan_items *items) {
    cJSON *list = cJSON_CreateArray();
    for (size_t i = 0; i < items->count; i++) {
        const ang_plan_item *item = &items->item[i];
        if (!item->why) {
            cJSON_AddItemToArray(list, cJSON_CreateString(item->what));
            continue;
        }
        cJSON *entry = cJSON_CreateObject();
        cJSON_AddStringToObject(entry, "what", item->what);
        cJSON_AddStringToObject(entry, "why", item->why);
        if (item->saves) cJSON_AddStringToObject(entry, "saves", item->saves);
        cJSON_AddItemToArray(list, entry);
    }
    return list;
}

static cJSON *passes_json(const ang_plan *plan) {
    cJSON *list = cJSON_CreateArray();
    for (size_t i = 0; i < plan->pass_count; i++) {
        cJSON *entry = cJSON_CreateObject();
        cJSON_AddStringToObject(entry, "name", plan->pass[i].name);
        cJSON_AddStringToObject(entry, "parts", plan->pass[i].parts);
        cJSON_AddNumberToObject(entry, "lookups", plan->pass[i].lookups);
        cJSON_AddItemToArray(list, entry);
    }
    return list;
}

static cJSON *plan_json(const ang_picture *picture, const ang_method *method, const ang_render_summary *summary) {
    const ang_scene *scene = &picture->scene;
    cJSON *plan = cJSON_CreateObject();
    cJSON_AddStringToObject(plan, "method", method->name);
    cJSON_AddStringToObject(plan, "mode", ang_mode_name(scene->mode));
    cJSON_AddStringToObject(plan, "projection", ang_projection_name(scene->camera.projection));
    cJSON_AddStringToObject(plan, "preset", picture->preset->name);
    if (summary->gl_backend) {
        cJSON_AddStringToObject(plan, "backend", summary->gl_backend);
        cJSON_AddStringToObject(plan, "gl_renderer", summary->gl_renderer);
        cJSON_AddStringToObject(plan, "gl_version", summary->gl_version);
    }
    bool shaded = scene->mode == ANG_MODE_ISO || (scene->mode == ANG_MODE_DVR && scene->shading == ANG_SHADING_PHONG);
    cJSON_AddStringToObject(plan, "shading", ang_shading_name(shaded ? ANG_SHADING_PHONG : ANG_SHADING_NONE));
    cJSON_AddItemToObject(plan, "uses", items_json(&summary->plan.uses));
    cJSON_AddItemToObject(plan, "left_out", items_json(&summary->plan.left_out));
    cJSON_AddItemToObject(plan, "passes", passes_json(&summary->plan));
    return plan;
}

static void add_point(cJSON *object, const char *name, ang_vec3 p) {
    cJSON_AddItemToObject(object, name, cJSON_CreateDoubleArray((double[3]){p.x, p.y, p.z}, 3));
}

static void add_objects(cJSON *out, const ang_objects *objects) {
    cJSON *list = cJSON_AddArrayToObject(out, "objects");
    for (size_t i = 0; objects && i < objects->count; i++) {
        const ang_object *object = &objects->object[i];
        cJSON *entry = cJSON_CreateObject();
        cJSON_AddStringToObject(entry, "kind", object->kind == ANG_OBJECT_PLANE ? "cut plane" : "tube");
        if (object->kind == ANG_OBJECT_PLANE) {
            cJSON_AddNumberToObject(entry, "axis", object->axis);
            ang_json_add_number(entry, "index", object->index);
        } else {
            add_point(entry, "from", object->from);
            add_point(entry, "to", object->to);
            ang_json_add_number(entry, "radius_mm", object->radius_mm);
        }
        cJSON_AddItemToArray(list, entry);
    }
}

cJSON *ang_picture_json(const ang_picture *picture) {
    const ang_scene *scene = &picture->scene;
    cJSON *out = cJSON_CreateObject();
    cJSON_AddStringToObject(out, "preset", picture->preset->name);
    cJSON_AddStringToObject(out, "mode", ang_mode_name(scene->mode));
    cJSON_AddStringToObject(out, "shading", ang_shading_name(scene->shading));
    cJSON *window = cJSON_AddObjectToObject(out, "window");
    ang_json_add_number(window, "centre", scene->window_centre);
    ang_json_add_number(window, "width", scene->window_width);
    ang_json_add_number(out, "iso_hu", scene->iso_hu);
    ang_json_add_number(out, "shift", picture->shift_hu);
    cJSON *view = cJSON_AddObjectToObject(out, "view");
    ang_json_add_number(view, "azimuth", picture->view.azimuth_deg);
    ang_json_add_number(view, "elevation", picture->view.elevation_deg);
    ang_json_add_number(view, "roll", picture->view.roll_deg);
    ang_json_add_number(out, "zoom", picture->view.zoom);
    cJSON_AddStringToObject(out, "projection", ang_projection_name(picture->view.projection));
    ang_json_add_number(out, "fov_deg", picture->view.fov_deg);
    cJSON_AddItemToObject(out, "size", cJSON_CreateIntArray((int[2]){scene->width, scene->height}, 2));
    cJSON *clip = cJSON_AddObjectToObject(out, "clip");
    add_point(clip, "lower", scene->clip_lower);
    add_point(clip, "upper", scene->clip_upper);
    if (ang_clip_plane_given(&scene->clip_plane)) {
        cJSON *plane = cJSON_AddObjectToObject(out, "clip_plane");
        add_point(plane, "normal", scene->clip_plane.normal);
        ang_json_add_number(plane, "offset_mm", scene->clip_plane.offset_mm);
    }
    cJSON_AddItemToObject(out, "background", cJSON_CreateDoubleArray(scene->background, 4));
    add_objects(out, scene->objects);
    ang_json_add_number(out, "step_voxels", picture->render.step_voxels);
    ang_json_add_number(out, "termination", picture->render.termination);
    if (picture->every > 1) cJSON_AddNumberToObject(out, "every", picture->every);
    return out;
}

/* Null, not zero, for what is not known. */
static cJSON *error_json(const ang_picture *picture, const ang_method *method, const ang_render_summary *summary) {
    cJSON *error = cJSON_CreateObject();
    bool truth = method == &ang_method_reference, known = summary->estimated;
    const ang_error_estimate *e = &summary->error;
    ang_json_add_number(error, "estimate", known ? e->levels : NAN);
    ang_json_add_number(error, "bound", truth && picture->every <= 1 ? 0 : NAN);
    ang_json_add_number(error, "step_mm", truth ? NAN : summary->stats.step_mm);
    ang_json_add_number(error, "termination_bound",
                        ang_error_termination_bound(method, &picture->scene, picture->render.termination));
    cJSON *parts = cJSON_AddObjectToObject(error, "parts");
    ang_json_add_number(parts, "step", known ? e->step : NAN);
    ang_json_add_number(parts, "termination", known ? e->termination : NAN);
    ang_json_add_number(parts, "filtering", known ? e->filtering : NAN);
    ang_json_add_number(parts, "arithmetic", known ? e->arithmetic : NAN);
    double between = picture->every > 1 ? NAN : 0;
    ang_json_add_number(parts, "interpolation", summary->budget.given ? summary->budget.planned.between.max : between);
    ang_json_add_number(error, "quantisation", summary->quantisation);
    ang_json_add_number(error, "rms", known ? e->rms : NAN);
    ang_json_add_number(error, "p999", known ? e->p999 : NAN);
    ang_json_add_number(error, "flipped", known ? e->flipped : NAN);
    ang_json_add_number(error, "order", known ? e->order : NAN);
    ang_json_add_number(error, "pixels", known ? e->pixels : NAN);
    ang_json_add_number(error, "ms", known ? e->ms : NAN);
    if (known && e->why) cJSON_AddStringToObject(error, "why", e->why);
    return error;
}

static cJSON *time_json(const ang_render_summary *summary) {
    cJSON *time = cJSON_CreateObject();
    ang_json_add_number(time, "load", summary->load_ms);
    ang_json_add_number(time, "octree", summary->stats.octree_ms > 0 ? summary->stats.octree_ms : NAN);
    ang_json_add_number(time, "upload", summary->upload_ms + summary->stats.upload_ms);
    ang_json_add_number(time, "first_frame", summary->first_frame_ms);
    bool timed = summary->timed_frames > 0;
    ang_json_add_number(time, "frame_median", timed ? summary->median_ms : NAN);
    ang_json_add_number(time, "frame_min", timed ? summary->min_ms : NAN);
    ang_json_add_number(time, "frame_max", timed ? summary->max_ms : NAN);
    cJSON_AddNumberToObject(time, "frames", summary->timed_frames);
    return time;
}

bool ang_render_json_write(const char *path, const ang_volume *volume, const ang_load_report *report,
                           const ang_picture *picture, const ang_method *method, const ang_render_summary *summary,
                           bool keep_phi, ang_error *err) {
    cJSON *root = cJSON_CreateObject();
    cJSON_AddStringToObject(root, "version", ANG_VERSION);
    cJSON_AddItemToObject(root, "input", ang_load_report_json(volume, report, keep_phi));
    cJSON_AddItemToObject(root, "picture", ang_picture_json(picture));
    cJSON_AddItemToObject(root, "plan", plan_json(picture, method, summary));
    cJSON_AddItemToObject(root, "error", error_json(picture, method, summary));
    if (summary->budget.given) cJSON_AddItemToObject(root, "budget", ang_app_budget_json(&summary->budget));
    cJSON_AddItemToObject(root, "time_ms", time_json(summary));
    cJSON *counts = cJSON_AddObjectToObject(root, "counts");
    ang_json_add_number(counts, "samples", (double)summary->stats.samples);
    ang_json_add_number(counts, "bricks_drawn", (double)summary->stats.bricks_drawn);
    ang_json_add_number(counts, "bricks_total", (double)summary->stats.bricks_total);
    ang_json_add_number(counts, "boxes", (double)summary->stats.boxes);
    ang_json_add_number(counts, "bricks_uploaded", (double)summary->stats.bricks_uploaded);
    bool unknown = summary->stats.fragments == 0 && summary->stats.samples > 0;
    ang_json_add_number(counts, "fragments", unknown ? NAN : (double)summary->stats.fragments);
    ang_json_add_number(counts, "polygons", (double)summary->stats.polygons);
    ang_json_add_number(counts, "passes", summary->stats.passes);
    cJSON *warnings = cJSON_AddArrayToObject(root, "warnings");
    for (size_t i = 0; i < summary->warnings.count; i++)
        cJSON_AddItemToArray(warnings, cJSON_CreateString(summary->warnings.text[i]));

    char *text = cJSON_Print(root);
    cJSON_Delete(root);
    if (!text) return ang_fail(err, ANG_LIMIT, "no memory for the JSON");
    bool done = true;
    if (strcmp(path, "-") == 0)
        done = puts(text) >= 0 || ang_fail(err, ANG_OUTPUT, "standard output cannot be written");
    else
        done = ang_file_replace(path, text, strlen(text), err);
    free(text);
    return done;
}
