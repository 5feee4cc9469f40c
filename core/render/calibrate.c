#include "core/render/calibrate.h"

#include "core/base/clock.h"
#include "core/volume/phantom.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* Pictures that tell the terms of the model apart: few and many rays, few and many samples of each, with and without
 * shading. */
static const struct {
    int size;
    double step;
    ang_shading shading;
} pictures[] = {{48, 1, ANG_SHADING_NONE},    {48, 0.3, ANG_SHADING_NONE},  {112, 1, ANG_SHADING_NONE},
                {112, 0.3, ANG_SHADING_NONE}, {48, 1, ANG_SHADING_PHONG},   {48, 0.3, ANG_SHADING_PHONG},
                {112, 1, ANG_SHADING_PHONG},  {112, 0.3, ANG_SHADING_PHONG}};
enum { PICTURES = sizeof pictures / sizeof *pictures, TIMES = 2 };

/* The reference takes about a millisecond a pixel. */
static const int reference_size[2] = {8, 20};

const ang_cost_model *ang_costs_of(const ang_costs *costs, const char *method) {
    for (size_t i = 0; i < costs->count; i++)
        if (strcmp(costs->of[i].method, method) == 0) return &costs->of[i].model;
    return NULL;
}

ang_cost_work ang_cost_work_of(const ang_scene *scene, const ang_frame_stats *stats) {
    bool shaded = scene->mode == ANG_MODE_DVR && scene->shading == ANG_SHADING_PHONG;
    return (ang_cost_work){(double)stats->fragments, (double)stats->samples, shaded ? (double)stats->samples : 0,
                           (double)stats->polygons};
}

/* Counts once, which also builds all that is needed, and times the best of a few frames that do not count. */
static bool measure(const ang_method *method, ang_renderer *renderer, const ang_scene *scene,
                    const ang_render_options *options, ang_cost_measured *out, const ang_progress *progress,
                    ang_error *err) {
    ang_image image;
    ang_frame_stats stats = {0};
    if (!ang_image_create(&image, scene->width, scene->height, err)) return false;
    bool ok = method->render(renderer, scene, options, &image, &stats, progress, err);
    double start = ang_now_ms();
    /* Without OpenGL nothing is compiled, and counting costs nothing. */
    ok = ok && method->render(renderer, scene, options, &image, NULL, progress, err);
    double best = ang_now_ms() - start;
    for (int i = 0; i < TIMES && ok && method->needs_gl; i++) {
        start = ang_now_ms();
        ok = method->render(renderer, scene, options, &image, NULL, progress, err);
        best = fmin(best, ang_now_ms() - start);
    }
    ang_image_clear(&image);
    *out = (ang_cost_measured){ang_cost_work_of(scene, &stats), best};
    return ok;
}

static bool measure_method(const ang_method *method, ang_gl *gl, const ang_volume *volume, const ang_transfer *transfer,
                           ang_cost_model *model, ang_error *err) {
    ang_render_options options = ang_render_options_default;
    ang_cost_measured measured[PICTURES];
    size_t count = 0;
    ang_renderer *renderer = method->create(gl, volume, &options, err);
    if (!renderer) return false;
    bool ok = true, exact = method->exact;
    for (size_t i = 0; i < PICTURES && ok; i++) {
        /* Steps are nothing to the reference. */
        if (exact && pictures[i].step < 1) continue;
        ang_scene scene = ang_scene_default(volume);
        scene.transfer = transfer;
        scene.width = scene.height = exact ? reference_size[pictures[i].size > 100] : pictures[i].size;
        scene.shading = pictures[i].shading;
        options.step_voxels = pictures[i].step;
        ok = measure(method, renderer, &scene, &options, &measured[count], NULL, err);
        count++;
    }
    method->destroy(renderer);
    return ok && ang_cost_fit(measured, count, model);
}

bool ang_costs_measure(ang_gl *gl, ang_costs *costs, const ang_progress *progress, ang_error *err) {
    *costs = (ang_costs){.count = 0};
    double start = ang_now_ms();
    ang_phantom_params params = ang_phantom_params_default;
    for (int axis = 0; axis < 3; axis++) params.dims[axis] = axis < 2 ? 96 : 64;
    const ang_transfer_point points[] = {{.hu = 150, .colour = {0.6, 0.1, 0.05}, .opacity = 0},
                                         {.hu = 350, .colour = {0.9, 0.4, 0.2}, .opacity = 0.1},
                                         {.hu = 1200, .colour = {1, 0.95, 0.9}, .opacity = 0.5}};
    ang_transfer *transfer = ang_transfer_create(points, 3, 1, false, NULL, err);
    ang_volume *volume = transfer ? ang_phantom_make(&params, 0, NULL, NULL, err) : NULL;
    bool going = volume != NULL;
    int methods = 0;
    while (ang_methods()[methods]) methods++;
    for (int i = 0; i < methods && going && costs->count < ANG_COSTS_MOST; i++) {
        const ang_method *method = ang_methods()[i];
        ang_cost_model model;
        going = ang_progress_update(progress, "measuring what pictures cost here", (double)i / methods) ||
                ang_fail(err, ANG_INTERRUPTED, "interrupted while measuring what pictures cost");
        if (!going || (method->needs_gl && !gl)) continue;
        if (!measure_method(method, gl, volume, transfer, &model, NULL)) continue;
        snprintf(costs->of[costs->count].method, sizeof costs->of[0].method, "%s", method->name);
        costs->of[costs->count++].model = model;
    }
    ang_transfer_free(transfer);
    ang_volume_free(volume);
    costs->ms = ang_now_ms() - start;
    return going;
}
