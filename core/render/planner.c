#include "core/render/planner.h"

#include "core/base/clock.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* Pixels a side of the pictures that show what the scene takes; the reference takes a millisecond a pixel. */
enum { PROBE_SIDE = 64, PROBE_SIDE_REFERENCE = 10, MOST_METHODS = 8, MOST_ROUNDS = 4 };

/* Steps that are considered, from the coarsest: each has 1.4 times the samples of the one before. */
static const double coarsest_step = 4;
enum { STEPS = 16, STRIDES = 3, MOST_CANDIDATES = MOST_METHODS * STEPS * STRIDES };

/* What one method's picture of some pixels says. */
typedef struct probe {
    const ang_method *method;
    ang_cost_work work;
    ang_cost_model model; /* scaled to what the picture took */
    double pixels;        /* of the whole picture for one of these */
} probe;

typedef struct planning {
    ang_gl *gl;
    const ang_volume *volume;
    const ang_scene *scene;
    ang_render_options options;
    const ang_budget *budget;
    const ang_progress *progress;
    probe probes[MOST_METHODS];
    size_t count;
    double measured_step;         /* voxels */
    double fixed, varying, order; /* levels at measured_step: ang_budget_error */
    double rms;                   /* the same of the RMS, all of which varies */
    /* Levels, the largest and the RMS, of every second of the pixels looked at, from the others... */
    double interpolation, interpolation_rms;
    int interpolation_stride; /* ... which lie so far apart in the picture */
} planning;

static ang_scene probe_scene(const ang_scene *scene, int side) {
    int longest = scene->width > scene->height ? scene->width : scene->height;
    int stride = (longest + side - 1) / side;
    return ang_scene_subset(scene, stride, stride / 2, stride / 2);
}

/* The error, in levels, of the pixels in odd columns and rows interpolated from those in even ones: of channels the
 * largest and the RMS. */
static void interpolation_error(const ang_image *image, double *worst, double *rms) {
    double sum = 0, count = 0;
    *worst = 0;
    for (int y = 1; y + 1 < image->height; y += 2)
        for (int x = 1; x + 1 < image->width; x += 2)
            for (int c = 0; c < 4; c++) {
                const float *at = image->rgba + 4 * ((size_t)y * (size_t)image->width + (size_t)x) + c;
                ptrdiff_t row = 4 * (ptrdiff_t)image->width;
                double mean =
                    0.25 * ((double)at[-row - 4] + (double)at[-row + 4] + (double)at[row - 4] + (double)at[row + 4]);
                double off = 255 * fabs(mean - (double)*at);
                *worst = fmax(*worst, off);
                sum += off * off;
                count++;
            }
    *rms = sqrt(sum / fmax(count, 1));
}

static bool draw_probe(planning *p, const ang_method *method, ang_renderer *renderer, probe *out, ang_error *err) {
    ang_scene scene = probe_scene(p->scene, method->needs_gl ? PROBE_SIDE : PROBE_SIDE_REFERENCE);
    ang_image image;
    ang_frame_stats stats = {0};
    if (!ang_image_create(&image, scene.width, scene.height, err)) return false;
    double start = ang_now_ms();
    bool ok = method->render(renderer, &scene, &p->options, &image, &stats, p->progress, err);
    double ms = ang_now_ms() - start;
    /* The first without counting compiles. */
    for (int i = 0; i < 5 && ok && method->needs_gl; i++) {
        start = ang_now_ms();
        ok = method->render(renderer, &scene, &p->options, &image, NULL, p->progress, err);
        ms = i == 0 ? INFINITY : fmin(ms, ang_now_ms() - start);
    }
    if (ok && method->needs_gl && !(p->interpolation > 0)) {
        interpolation_error(&image, &p->interpolation, &p->interpolation_rms);
        p->interpolation_stride = 2 * scene.sampling.stride;
    }
    ang_image_clear(&image);
    out->method = method;
    out->work = ang_cost_work_of(&scene, &stats);
    out->pixels = (double)p->scene->width * p->scene->height / ((double)scene.width * scene.height);
    double predicted = ang_cost_predict(&out->model, &out->work);
    double scale = predicted > 0 ? ms / predicted : 1;
    for (int k = 0; k < ANG_COST_TERMS; k++) out->model.term[k] *= scale;
    return ok;
}

/* Levels at options.step_voxels by drawing some pixels with finer steps. What rays that end early leave out is left in
 * where it is most of what may be off. */
static bool find_error(planning *p, const ang_method *method, ang_renderer *renderer, ang_error *err) {
    ang_error_estimate estimate;
    if (!ang_error_estimate_make(method, renderer, p->scene, &p->options, &estimate, p->progress, err)) return false;
    if (estimate.termination > 0.25 * p->budget->max_error) {
        p->options.termination = 1;
        estimate.termination = 0;
    }
    p->fixed = isnan(estimate.levels) ? NAN : estimate.termination + estimate.filtering + estimate.arithmetic;
    p->varying = estimate.step;
    p->rms = estimate.rms;
    p->order = isfinite(estimate.order) ? fmin(fmax(estimate.order, 0.7), 2) : 1;
    return true;
}

/* Draws what the methods in question take; the error is that of the first with OpenGL. A method that fails where others
 * may do is passed over. */
static bool probe_methods(planning *p, const ang_method *const *methods, size_t count, const ang_costs *costs,
                          ang_error *err) {
    p->fixed = NAN;
    for (size_t i = 0; i < count; i++) {
        const ang_method *method = methods[i];
        const ang_cost_model *model = ang_costs_of(costs, method->name);
        probe *next = &p->probes[p->count];
        *next = (probe){.model = model ? *model : (ang_cost_model){.term = {0, 1e-3, 1e-4, 1e-4, 1e-2}}};
        ang_renderer *renderer = method->create(p->gl, p->volume, &p->options, err);
        bool ok = renderer && draw_probe(p, method, renderer, next, err);
        if (ok && method->needs_gl && isnan(p->fixed)) ok = find_error(p, method, renderer, err);
        if (renderer) method->destroy(renderer);
        if (!ok && err->code == ANG_INTERRUPTED) return false;
        if (ok) p->count++;
        if (!ang_progress_update(p->progress, "planning", (double)(i + 1) / (double)count))
            return ang_fail(err, ANG_INTERRUPTED, "interrupted while planning");
    }
    return p->count > 0;
}

/* What a step and a stride are expected to be off, in levels. An edge is as far off at any stride, but the share of
 * pixels beside one grows with it, and with that the square of the RMS. */
static double largest_error(const planning *p, double step, int stride) {
    double error = step > 0 ? ang_budget_error(p->fixed, p->varying, p->order, step, p->measured_step) : 0;
    return fmin(error + (stride > 1 ? p->interpolation : 0), 255);
}
static double rms_error(const planning *p, double step, int stride) {
    double error = step > 0 ? ang_budget_error(0, p->rms, p->order, step, p->measured_step) : 0;
    double between = stride > 1 ? p->interpolation_rms * sqrt((double)stride / fmax(p->interpolation_stride, 1)) : 0;
    return hypot(error, between);
}

/* Every method, at every step and with every stride in question; where only a time is given they are compared by the
 * RMS, since the largest error tells coarse pictures apart no more. */
static size_t list_candidates(const planning *p, ang_candidate *list) {
    size_t count = 0;
    int strides = isnan(p->budget->max_ms) ? 1 : STRIDES;
    bool largest = !isnan(p->budget->max_error);
    for (size_t m = 0; m < p->count; m++)
        for (int s = 0; s < STEPS; s++)
            for (int k = 0; k < strides; k++) {
                const probe *from = &p->probes[m];
                bool exact = !from->method->needs_gl, slices = from->method == &ang_method_slicing;
                if (exact && s > 0) continue;
                int stride = 1 << k;
                double step = coarsest_step * pow(2, -0.5 * s), finer = p->measured_step / step;
                ang_cost_work work =
                    ang_cost_scale(&from->work, from->pixels / (stride * stride), exact ? 1 : finer, slices);
                if (exact) step = 0;
                double error = largest ? largest_error(p, step, stride) : rms_error(p, step, stride);
                list[count++] = (ang_candidate){(int)m, step, stride, ang_cost_predict(&from->model, &work), error};
            }
    return count;
}

/* Whether the estimate of the choice keeps the limit; else a finer step, as long as there is one. */
static bool verify(planning *p, ang_planned *out, ang_error *err) {
    out->keeps_error = false;
    for (out->refinements = 0;; out->refinements++) {
        p->options.step_voxels = out->step_voxels;
        if (!ang_error_estimate_make(out->method, out->renderer, p->scene, &p->options, &out->estimate, p->progress,
                                     err))
            return false;
        const ang_error_estimate *e = &out->estimate;
        out->error = e->levels + out->interpolation;
        out->keeps_error = out->error <= p->budget->max_error;
        if (out->keeps_error || isnan(out->error) || out->refinements == MOST_ROUNDS) return true;
        double fixed = e->termination + e->filtering + e->arithmetic + out->interpolation;
        double order = isfinite(e->order) ? fmin(fmax(e->order, 0.7), 2) : 1;
        double step = ang_budget_step(fixed, e->step, order, out->step_voxels, 0.9 * p->budget->max_error);
        double least = coarsest_step * pow(2, -0.5 * (STEPS - 1));
        if (!(step >= least)) return true;
        out->ms *= out->step_voxels / fmin(step, out->step_voxels);
        out->step_voxels = fmin(step, 0.9 * out->step_voxels);
    }
}

static bool take(planning *p, const ang_candidate *chosen, ang_planned *out, ang_error *err) {
    if (out->renderer) out->method->destroy(out->renderer);
    out->method = p->probes[chosen->method].method;
    out->step_voxels = chosen->step_voxels;
    out->stride = chosen->stride;
    out->ms = chosen->ms;
    out->error = largest_error(p, chosen->step_voxels, chosen->stride);
    out->interpolation = chosen->stride > 1 ? p->interpolation : 0;
    out->renderer = out->method->create(p->gl, p->volume, &p->options, err);
    return out->renderer != NULL;
}

/* What interpolating between the pixels of the choice changes, in levels, at some of those farthest from any of them.
 */
static bool measure_interpolation(planning *p, ang_planned *out, ang_error *err) {
    int longest = p->scene->width > p->scene->height ? p->scene->width : p->scene->height, middle = out->stride / 2;
    int apart = (longest / PROBE_SIDE / out->stride + 1) * out->stride;
    ang_scene some = ang_scene_subset(p->scene, apart, middle, middle);
    ang_scene drawn = ang_scene_subset(p->scene, out->stride, 0, 0);
    ang_image whole = {0}, exact = {0}, sparse = {0};
    p->options.step_voxels = out->step_voxels > 0 ? out->step_voxels : p->options.step_voxels;
    bool ok = ang_image_create(&whole, p->scene->width, p->scene->height, err) &&
              ang_image_create(&exact, some.width, some.height, err) &&
              ang_image_create(&sparse, drawn.width, drawn.height, err) &&
              out->method->render(out->renderer, &some, &p->options, &exact, NULL, p->progress, err) &&
              out->method->render(out->renderer, &drawn, &p->options, &sparse, NULL, p->progress, err);
    double worst = 0;
    if (ok) ang_image_enlarge(&sparse, out->stride, 0, &whole);
    for (int y = 0; y < exact.height && ok; y++)
        for (int x = 0; x < exact.width; x++) {
            size_t column = (size_t)(some.sampling.first_x + x * some.sampling.stride);
            size_t row = (size_t)(some.sampling.first_y + y * some.sampling.stride);
            const float *now = whole.rgba + 4 * (row * (size_t)whole.width + column);
            const float *truth = exact.rgba + 4 * ((size_t)y * (size_t)exact.width + (size_t)x);
            for (int c = 0; c < 4; c++) worst = fmax(worst, 255 * fabs((double)now[c] - (double)truth[c]));
        }
    ang_image_clear(&whole);
    ang_image_clear(&exact);
    ang_image_clear(&sparse);
    out->interpolation = worst;
    out->error = fmin(largest_error(p, out->step_voxels, 1) + worst, 255);
    return ok;
}

static void say_missed(const planning *p, ang_planned *out) {
    if (!out->keeps_error && isnan(out->error))
        snprintf(out->missed, sizeof out->missed,
                 "--max-error %.6g: the error of this picture cannot be told with --method %s", p->budget->max_error,
                 out->method->name);
    else if (!out->keeps_error)
        snprintf(out->missed, sizeof out->missed,
                 "--max-error %.6g cannot be kept: the best within reach is %.3g levels by --method %s at a step of "
                 "%.3g voxels",
                 p->budget->max_error, out->error, out->method->name, out->step_voxels);
    else if (!out->keeps_time)
        snprintf(out->missed, sizeof out->missed,
                 "--max-time %.6g cannot be kept: the fastest that will do is --method %s, about %.0f ms",
                 p->budget->max_ms, out->method->name, out->ms);
}

static bool choose(planning *p, const ang_method *asked, ang_planned *out, ang_error *err) {
    ang_candidate list[MOST_CANDIDATES];
    out->candidates = list_candidates(p, list);
    ang_choice choice = ang_budget_choose(list, out->candidates, p->budget);
    out->keeps_error = choice.keeps_error;
    if (!take(p, &list[choice.index], out, err)) return false;
    if (out->stride > 1 && !measure_interpolation(p, out, err)) return false;
    if (!isnan(p->budget->max_error) && out->method->needs_gl) {
        if (!verify(p, out, err)) return false;
        /* The reference alone has no error. */
        for (size_t i = 0; i < out->candidates && !out->keeps_error && !asked; i++) {
            if (p->probes[list[i].method].method->needs_gl || list[i].stride > 1) continue;
            if (!take(p, &list[i], out, err)) return false;
            out->keeps_error = true;
        }
    }
    out->keeps_time = isnan(p->budget->max_ms) || out->ms <= p->budget->max_ms;
    out->termination = p->options.termination;
    say_missed(p, out);
    return true;
}

bool ang_planner_plan(ang_gl *gl, const ang_volume *volume, const ang_scene *scene, const ang_render_options *options,
                      const ang_method *asked, const ang_budget *budget, const ang_costs *costs, ang_planned *planned,
                      const ang_progress *progress, ang_error *err) {
    double start = ang_now_ms();
    *planned = (ang_planned){.stride = 1};
    planning p = {
        .gl = gl, .volume = volume, .scene = scene, .options = *options, .budget = budget, .progress = progress};
    p.options.step_voxels = p.measured_step = ang_render_options_default.step_voxels;
    const ang_method *methods[MOST_METHODS];
    const char *why;
    size_t count = 0;
    methods[count++] = asked ? asked : ang_method_choose(gl, volume, scene, options, &why);
    /* Where only one method can draw the volume or takes the options there is nothing but the reference beside it. */
    bool any = methods[0] == &ang_method_envelope;
    for (int i = 0; !asked && ang_methods()[i] && count < MOST_METHODS; i++) {
        const ang_method *method = ang_methods()[i];
        if (method != methods[0] && (any || !method->needs_gl)) methods[count++] = method;
    }
    bool ok = probe_methods(&p, methods, count, costs, err) && choose(&p, asked, planned, err);
    if (!ok && planned->renderer) planned->method->destroy(planned->renderer);
    if (!ok) planned->renderer = NULL;
    planned->planning_ms = ang_now_ms() - start;
    return ok;
}
