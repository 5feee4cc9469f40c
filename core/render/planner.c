#include "core/render/planner.h"

#include "core/base/clock.h"
#include "core/render/ray_pass.h"
#include "core/scene/objects.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* Pixels a side of the pictures that show what the scene takes; the reference takes a millisecond a pixel. */
enum { PROBE_SIDE = 64, PROBE_SIDE_REFERENCE = 10, MOST_METHODS = 8, MOST_ROUNDS = 4 };

/* Time for which a picture of some pixels is drawn again, the fastest of which counts. */
static const double least_probe_ms = 50;

/* How much worse than the worst pixel that is looked at the worst of all may be. */
static const double beyond_looked = 2;

/* Steps that are considered, from the coarsest: each has 1.4 times the samples of the one before. */
static const double coarsest_step = 4;
enum { STEPS = 16, STRIDES = 3, MOST_CANDIDATES = MOST_METHODS * STEPS * STRIDES };

/* What a method is off at the step that it was measured with, in levels. */
typedef struct measured_error {
    double fixed, varying, order; /* ang_budget_error; NaN: not known */
    double rms;                   /* the same of the RMS, all of which varies */
} measured_error;

/* What one method's picture of some pixels says. */
typedef struct probe {
    const ang_method *method;
    ang_cost_work work;
    ang_cost_model model; /* scaled to what the picture took */
    double pixels;        /* of the whole picture for one of these */
    measured_error error;
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
    double measured_step; /* voxels */
    /* Levels, the largest and the RMS, of every second of the pixels looked at, from the others... */
    double interpolation, interpolation_rms;
    int interpolation_stride; /* ... which lie so far apart in the picture */
} planning;

/* Voxels: the finest step whose error can be told, from its quarter. */
static double finest_step(const planning *p, const ang_method *method) {
    double finest = coarsest_step * pow(2, -0.5 * (STEPS - 1));
    bool marches = method == &ang_method_envelope || method == &ang_method_raycast || method == &ang_method_singlepass;
    if (!marches) return finest;
    const ang_render_options all = {.step_voxels = 0};
    return fmax(finest, 4 * ang_ray_step(p->volume, &all) / ang_volume_smallest_spacing(p->volume));
}

static double finite_order(const ang_error_estimate *e) {
    return isfinite(e->order) ? fmin(fmax(e->order, 0.7), 2) : 1;
}

/* The stride that leaves about side x side pixels, of a flat picture as many. */
static int probe_stride(const ang_scene *scene, int side) {
    return (int)fmax(ceil(sqrt((double)scene->width * scene->height) / side), 1);
}

static ang_scene probe_scene(const ang_scene *scene, int side) {
    int stride = probe_stride(scene, side);
    return ang_error_grid(scene, stride, stride / 2, stride / 2);
}

/* The error, in levels, of the pixels in odd columns and rows interpolated from those in even ones: of channels the
 * largest and the RMS. Along an axis of fewer than three pixels nothing is interpolated. */
static void interpolation_error(const ang_image *image, double *worst, double *rms) {
    double sum = 0, count = 0;
    int across = image->width > 2, down = image->height > 2;
    *worst = 0;
    for (int y = down; y + down < image->height && across + down > 0; y += 2)
        for (int x = across; x + across < image->width; x += 2)
            for (int c = 0; c < 4; c++) {
                const float *at = image->rgba + 4 * ((size_t)y * (size_t)image->width + (size_t)x) + c;
                ptrdiff_t row = down * 4 * (ptrdiff_t)image->width, column = across * 4;
                double mean = 0.25 * ((double)at[-row - column] + (double)at[-row + column] + (double)at[row - column] +
                                      (double)at[row + column]);
                double off = 255 * fabs(mean - (double)*at);
                *worst = fmax(*worst, off);
                sum += off * off;
                count++;
            }
    *rms = sqrt(sum / fmax(count, 1));
}

static bool draw_probe(planning *p, const ang_method *method, ang_renderer *renderer, probe *out, ang_error *err) {
    ang_scene scene = probe_scene(p->scene, method->exact ? PROBE_SIDE_REFERENCE : PROBE_SIDE);
    ang_image image;
    ang_frame_stats stats = {0};
    if (!ang_image_create(&image, scene.width, scene.height, err)) return false;
    const double first = ang_now_ms();
    double start = first;
    bool ok = method->render(renderer, &scene, &p->options, &image, &stats, p->progress, err);
    double ms = ang_now_ms() - start;
    /* The first without counting compiles. Few pixels may take less time than other work on the machine holds them up.
     */
    for (int i = method->exact; ok && ((!method->exact && i < 5) || ang_now_ms() - first < least_probe_ms); i++) {
        start = ang_now_ms();
        ok = method->render(renderer, &scene, &p->options, &image, NULL, p->progress, err);
        ms = i == 0 ? INFINITY : fmin(ms, ang_now_ms() - start);
    }
    if (ok && !method->exact && !(p->interpolation > 0)) {
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
static bool find_error(planning *p, const ang_method *method, ang_renderer *renderer, measured_error *out,
                       ang_error *err) {
    ang_error_estimate estimate;
    if (!ang_error_estimate_make(method, renderer, p->scene, &p->options, &estimate, p->progress, err)) return false;
    if (estimate.termination > 0.25 * p->budget->max_error) {
        p->options.termination = 1;
        estimate.termination = 0;
    }
    double fixed = isnan(estimate.levels) ? NAN : estimate.termination + estimate.filtering + estimate.arithmetic;
    *out = (measured_error){fixed, estimate.step, finite_order(&estimate), estimate.rms};
    return true;
}

/* The error of the first method with OpenGL serves all of these, which classify and interpolate alike. */
static bool has_error(const planning *p, const ang_method *method, measured_error *out) {
    for (size_t i = 0; i < p->count; i++)
        if (p->probes[i].method->needs_gl && method->needs_gl) {
            *out = p->probes[i].error;
            return true;
        }
    return method->exact;
}

/* Draws what the methods in question take. A method that fails where others may do is passed over. */
static bool probe_methods(planning *p, const ang_method *const *methods, size_t count, const ang_costs *costs,
                          ang_error *err) {
    for (size_t i = 0; i < count; i++) {
        const ang_method *method = methods[i];
        const ang_cost_model *model = ang_costs_of(costs, method->name);
        probe *next = &p->probes[p->count];
        *next = (probe){.model = model ? *model : (ang_cost_model){.term = {0, 1e-3, 1e-4, 1e-4, 1e-2}}};
        ang_renderer *renderer = method->create(p->gl, p->volume, &p->options, err);
        bool ok = renderer && draw_probe(p, method, renderer, next, err);
        if (ok && !has_error(p, method, &next->error)) ok = find_error(p, method, renderer, &next->error, err);
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
static double largest_error(const planning *p, const measured_error *e, double step, int stride) {
    double error = step > 0 ? ang_budget_error(e->fixed, e->varying, e->order, step, p->measured_step) : 0;
    return ang_error_capped(error + (stride > 1 ? p->interpolation : 0));
}
static double rms_error(const planning *p, const measured_error *e, double step, int stride) {
    double error = step > 0 ? ang_budget_error(0, e->rms, e->order, step, p->measured_step) : 0;
    double between = stride > 1 ? p->interpolation_rms * sqrt((double)stride / fmax(p->interpolation_stride, 1)) : 0;
    return hypot(error, between);
}

/* Every method, at every step whose error can be told and with every stride in question; where only a time is given
 * they are compared by the RMS, since the largest error tells coarse pictures apart no more. */
static size_t list_candidates(const planning *p, ang_candidate *list) {
    size_t count = 0;
    /* Lines of opaque objects would fall apart between the pixels that are drawn. */
    bool lines = p->scene->objects && p->scene->objects->count > 0;
    int strides = isnan(p->budget->max_ms) || lines ? 1 : STRIDES;
    bool largest = !isnan(p->budget->max_error);
    for (size_t m = 0; m < p->count; m++)
        for (int s = 0; s < STEPS; s++)
            for (int k = 0; k < strides; k++) {
                const probe *from = &p->probes[m];
                bool exact = from->method->exact, slices = from->method == &ang_method_slicing;
                int stride = 1 << k;
                double step = coarsest_step * pow(2, -0.5 * s), finer = p->measured_step / step;
                if (exact ? s > 0 : step < finest_step(p, from->method) * (1 - 1e-9)) continue;
                double coarsest = from->method->coarsest_step;
                if (coarsest > 0 && step > coarsest * (1 + 1e-9)) continue;
                ang_cost_work work =
                    ang_cost_scale(&from->work, from->pixels / (stride * stride), exact ? 1 : finer, slices);
                if (exact) step = 0;
                double error =
                    largest ? largest_error(p, &from->error, step, stride) : rms_error(p, &from->error, step, stride);
                /* What cannot be told is best left as it is without a budget. */
                bool usual = fabs(step - p->measured_step) < 1e-9;
                if (isnan(error) && isnan(p->budget->max_ms) && !usual) continue;
                list[count++] = (ang_candidate){(int)m, step, stride, ang_cost_predict(&from->model, &work), error};
            }
    return count;
}

/* The estimate that keeps the limit: of pixels that are not looked at the worst may be worse (docs/error.md). */
static double estimate_limit(const planning *p) {
    ang_scene looked = ang_error_subset(p->scene);
    return looked.sampling.stride > 1 ? p->budget->max_error / beyond_looked : p->budget->max_error;
}

/* The step to try after one whose estimate is too great; 0 where no other can keep the limit. A step that was asked
 * for with its method goes as far as it can, so that the best within reach is known. */
static double next_step(const planning *p, const ang_planned *out, bool asked) {
    const ang_error_estimate *e = &out->estimate;
    double fixed = e->termination + e->filtering + e->arithmetic + out->between.max, limit = 0.9 * estimate_limit(p);
    double step = ang_budget_step(fixed, e->step, finite_order(e), out->step_voxels, limit);
    double finest = finest_step(p, out->method);
    if (step < finest && !asked) return 0;
    step = fmax(fmin(step, 0.9 * out->step_voxels), finest);
    return step < out->step_voxels * (1 - 1e-9) ? step : 0;
}

/* Whether the estimate of the choice keeps the limit; else a finer step, as long as there is one, and at last the best
 * that was seen. */
static bool verify(planning *p, bool asked, ang_planned *out, ang_error *err) {
    ang_planned best = {.error = NAN};
    for (out->refinements = 0;; out->refinements++) {
        p->options.step_voxels = out->step_voxels;
        if (!ang_error_estimate_make(out->method, out->renderer, p->scene, &p->options, &out->estimate, p->progress,
                                     err))
            return false;
        out->error = ang_error_capped(out->estimate.levels + out->between.max);
        out->keeps_error = out->error <= estimate_limit(p);
        if (isnan(best.error) || out->error < best.error) best = *out;
        double step = out->keeps_error || isnan(out->error) ? 0 : next_step(p, out, asked);
        if (!(step > 0) || out->refinements == MOST_ROUNDS) break;
        out->ms *= out->step_voxels / step;
        out->step_voxels = step;
    }
    best.refinements = out->refinements;
    *out = best;
    p->options.step_voxels = out->step_voxels;
    return true;
}

static bool take(planning *p, const ang_candidate *chosen, ang_planned *out, ang_error *err) {
    if (out->renderer) out->method->destroy(out->renderer);
    out->method = p->probes[chosen->method].method;
    out->step_voxels = chosen->step_voxels;
    out->stride = chosen->stride;
    out->ms = chosen->ms;
    out->error = largest_error(p, &p->probes[chosen->method].error, chosen->step_voxels, chosen->stride);
    out->between = (ang_metrics){.max = chosen->stride > 1 ? p->interpolation : 0};
    out->estimate = (ang_error_estimate){.levels = NAN};
    out->renderer = out->method->create(p->gl, p->volume, &p->options, err);
    return out->renderer != NULL;
}

/* The pixels of `whole` that are those of the subset. */
static void pick(const ang_image *whole, const ang_scene *subset, ang_image *out) {
    const ang_sampling *at = &subset->sampling;
    for (int y = 0; y < out->height; y++)
        for (int x = 0; x < out->width; x++) {
            size_t column = (size_t)(at->first_x + x * at->stride), row = (size_t)(at->first_y + y * at->stride);
            const float *from = whole->rgba + 4 * (row * (size_t)whole->width + column);
            memcpy(out->rgba + 4 * ((size_t)y * (size_t)out->width + (size_t)x), from, 4 * sizeof *from);
        }
}

/* What interpolating between the pixels of the choice changes at some of those farthest from any of them. */
static bool measure_interpolation(planning *p, ang_planned *out, ang_error *err) {
    int middle = out->stride / 2, apart = (probe_stride(p->scene, PROBE_SIDE) / out->stride + 1) * out->stride;
    ang_scene some = ang_error_grid(p->scene, apart, middle, middle);
    ang_scene drawn = ang_scene_subset(p->scene, out->stride, 0, 0);
    ang_image whole = {0}, exact = {0}, sparse = {0}, between = {0};
    p->options.step_voxels = out->step_voxels > 0 ? out->step_voxels : p->options.step_voxels;
    bool ok = ang_image_create(&whole, p->scene->width, p->scene->height, err) &&
              ang_image_create(&exact, some.width, some.height, err) &&
              ang_image_create(&between, some.width, some.height, err) &&
              ang_image_create(&sparse, drawn.width, drawn.height, err) &&
              out->method->render(out->renderer, &some, &p->options, &exact, NULL, p->progress, err) &&
              out->method->render(out->renderer, &drawn, &p->options, &sparse, NULL, p->progress, err);
    if (ok) {
        ang_image_enlarge(&sparse, out->stride, 0, &whole);
        pick(&whole, &some, &between);
        ok = ang_metrics_compute(&between, &exact, false, &out->between, err);
    }
    ang_image_clear(&whole);
    ang_image_clear(&exact);
    ang_image_clear(&between);
    ang_image_clear(&sparse);
    return ok;
}

static void say_missed(const planning *p, ang_planned *out) {
    if (!out->keeps_error && isnan(out->error))
        snprintf(out->missed, sizeof out->missed,
                 "--max-error %.6g: the error of this picture cannot be told with --method %s", p->budget->max_error,
                 out->method->name);
    else if (!out->keeps_error && out->error <= p->budget->max_error)
        snprintf(out->missed, sizeof out->missed,
                 "--max-error %.6g cannot be promised: %.3g levels are estimated from some pixels, and others may be "
                 "worse; no step of --method %s is better than %.3g voxels",
                 p->budget->max_error, out->error, out->method->name, out->step_voxels);
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

/* Takes the best of the candidates, and looks at what it is off. */
static bool try_best(planning *p, const ang_candidate *list, size_t count, bool asked, ang_planned *out,
                     ang_error *err) {
    ang_choice choice = ang_budget_choose(list, count, p->budget);
    const ang_candidate *best = &list[choice.index];
    out->keeps_error = choice.keeps_error;
    if (!take(p, best, out, err)) return false;
    if (out->stride > 1) {
        if (!measure_interpolation(p, out, err)) return false;
        double step = largest_error(p, &p->probes[best->method].error, out->step_voxels, 1);
        out->error = ang_error_capped(step + out->between.max);
    }
    bool looks = !isnan(p->budget->max_error) && (!out->method->exact || out->stride > 1);
    return !looks || verify(p, asked, out, err);
}

static bool choose(planning *p, const ang_method *asked, ang_planned *out, ang_error *err) {
    ang_candidate list[MOST_CANDIDATES];
    size_t count = out->candidates = list_candidates(p, list);
    bool limited = !isnan(p->budget->max_error);
    if (!try_best(p, list, count, asked != NULL, out, err)) return false;
    if (limited && !out->keeps_error && out->stride > 1) {
        /* What is interpolated may be farther off than was predicted. */
        size_t whole = 0;
        for (size_t i = 0; i < count; i++)
            if (list[i].stride == 1) list[whole++] = list[i];
        count = whole;
        if (!try_best(p, list, count, asked != NULL, out, err)) return false;
    }
    for (size_t i = 0; limited && i < count && !out->keeps_error && !asked; i++) {
        if (!p->probes[list[i].method].method->exact) continue;
        if (!take(p, &list[i], out, err)) return false;
        out->keeps_error = true;
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
    bool any = methods[0] == &ang_method_envelope || (gl && methods[0] == &ang_method_cpu);
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
