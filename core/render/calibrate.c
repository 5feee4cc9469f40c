#include "core/render/calibrate.h"

#include "core/base/clock.h"
#include "core/base/median.h"
#include "core/volume/phantom.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* Pictures that tell the terms of the model apart: hardly any rays and many, few and many samples of each, with and
 * without shading, and modes that stop at a surface or look at every sample. What is fast draws more pixels, so that
 * its times are more than the clock's and the threads' noise; the reference, which has no step and takes up to a
 * millisecond a pixel, draws fewer; 0: not this one. In this order few of them need programs of their own. */
static const struct {
    int size, fast_size, exact_size;
    double step;
    ang_mode mode;
    ang_shading shading;
} pictures[] = {{12, 12, 2, 1, ANG_MODE_DVR, ANG_SHADING_NONE},       {48, 96, 8, 1, ANG_MODE_DVR, ANG_SHADING_NONE},
                {128, 256, 24, 1, ANG_MODE_DVR, ANG_SHADING_NONE},    {48, 96, 0, 0.3, ANG_MODE_DVR, ANG_SHADING_NONE},
                {128, 256, 0, 0.4, ANG_MODE_DVR, ANG_SHADING_NONE},   {48, 96, 8, 0.3, ANG_MODE_DVR, ANG_SHADING_PHONG},
                {128, 256, 16, 0.4, ANG_MODE_DVR, ANG_SHADING_PHONG}, {64, 128, 12, 1, ANG_MODE_MIP, ANG_SHADING_NONE},
                {128, 256, 48, 0.5, ANG_MODE_MIP, ANG_SHADING_NONE},  {64, 128, 12, 1, ANG_MODE_ISO, ANG_SHADING_NONE},
                {128, 256, 48, 0.5, ANG_MODE_ISO, ANG_SHADING_NONE}};
enum { PICTURES = sizeof pictures / sizeof *pictures, LEAST_TIMES = 3, MOST_TIMES = 7 };

/* ms: once so much was spent on a picture, the fewest frames do. */
static const double enough_ms = 60;
/* A model that misses its own pictures by a greater factor says nothing. */
static const double most_miss = 2;
static const double surface_hu = 400;

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

/* Counts once, which also builds all that is needed, and times the median of some frames that do not count. */
static bool measure(const ang_method *method, ang_renderer *renderer, const ang_scene *scene,
                    const ang_render_options *options, ang_cost_measured *out) {
    ang_image image;
    ang_frame_stats stats = {0};
    double ms[MOST_TIMES], spent = 0;
    size_t count = 0;
    if (!ang_image_create(&image, scene->width, scene->height, NULL)) return false;
    bool ok = method->render(renderer, scene, options, &image, &stats, NULL, NULL);
    /* Without counting the shader is another one. */
    if (method->needs_gl) ok = ok && method->render(renderer, scene, options, &image, NULL, NULL, NULL);
    while (ok && count < MOST_TIMES && (count < LEAST_TIMES || spent < enough_ms)) {
        double start = ang_now_ms();
        ok = method->render(renderer, scene, options, &image, NULL, NULL, NULL);
        ms[count] = ang_now_ms() - start;
        spent += ms[count++];
    }
    ang_image_clear(&image);
    *out = (ang_cost_measured){ang_cost_work_of(scene, &stats), ang_median(ms, count)};
    return ok;
}

static bool measure_pictures(const ang_method *method, ang_renderer *renderer, const ang_volume *volume,
                             const ang_transfer *transfer, ang_cost_measured *measured, size_t *count) {
    bool exact = method->exact, ok = true;
    *count = 0;
    for (size_t i = 0; i < PICTURES && ok; i++) {
        int size = exact ? pictures[i].exact_size : method->needs_gl ? pictures[i].size : pictures[i].fast_size;
        if (size == 0) continue;
        ang_scene scene = ang_scene_default(volume);
        ang_render_options options = ang_render_options_default;
        scene.transfer = transfer;
        scene.width = scene.height = size;
        scene.mode = pictures[i].mode;
        scene.shading = pictures[i].shading;
        scene.iso_hu = surface_hu;
        options.step_voxels = pictures[i].step;
        ok = measure(method, renderer, &scene, &options, &measured[(*count)++]);
    }
    return ok;
}

static bool fits_its_pictures(ang_cost_model *model, const ang_cost_measured *measured, size_t count) {
    return ang_cost_fit(measured, count, model) && ang_cost_worst(model, measured, count) <= most_miss;
}

/* Measures once more where the model does not even fit what it was made from; other work on the machine only ever adds
 * to times, so that the lower of two holds. Where that fits no better nothing is taken as fixed. False where the method
 * fails. */
static bool measure_method(const ang_method *method, ang_gl *gl, const ang_volume *volume, const ang_transfer *transfer,
                           ang_cost_model *model) {
    ang_renderer *renderer = method->create(gl, volume, &ang_render_options_default, NULL);
    ang_cost_measured measured[PICTURES], again[PICTURES];
    size_t count = 0;
    bool ok = renderer && measure_pictures(method, renderer, volume, transfer, measured, &count);
    bool fits = ok && fits_its_pictures(model, measured, count);
    if (ok && !fits) {
        ok = measure_pictures(method, renderer, volume, transfer, again, &count);
        for (size_t i = 0; i < count && ok; i++) measured[i].ms = fmin(measured[i].ms, again[i].ms);
        fits = ok && fits_its_pictures(model, measured, count);
    }
    if (renderer) method->destroy(renderer);
    return ok && (fits || ang_cost_fit_proportional(measured, count, model));
}

static bool is_missing(const ang_costs *costs, const ang_method *method, ang_gl *gl) {
    return (gl || !method->needs_gl) && costs->count < ANG_COSTS_MOST && !ang_costs_of(costs, method->name);
}

static bool measure_missing(ang_gl *gl, ang_costs *costs, const ang_progress *progress, ang_error *err) {
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
    for (int i = 0; i < methods && going; i++) {
        const ang_method *method = ang_methods()[i];
        ang_cost_model model;
        going = ang_progress_update(progress, "measuring what pictures cost here", (double)i / methods) ||
                ang_fail(err, ANG_INTERRUPTED, "interrupted while measuring what pictures cost");
        if (!going || !is_missing(costs, method, gl) || !measure_method(method, gl, volume, transfer, &model)) continue;
        snprintf(costs->of[costs->count].method, sizeof costs->of[0].method, "%s", method->name);
        costs->of[costs->count++].model = model;
    }
    ang_transfer_free(transfer);
    ang_volume_free(volume);
    return going;
}

bool ang_costs_measure(ang_gl *gl, ang_costs *costs, const ang_progress *progress, ang_error *err) {
    double start = ang_now_ms();
    bool missing = false;
    for (int i = 0; ang_methods()[i]; i++) missing = missing || is_missing(costs, ang_methods()[i], gl);
    if (!missing) return true;
    bool done = measure_missing(gl, costs, progress, err);
    costs->ms += ang_now_ms() - start;
    return done;
}
