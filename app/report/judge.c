/* What follows from the runs: times of whole pictures, Pareto fronts, orders, and what to recommend. */
#include "app/report/report.h"

#include "core/base/median.h"
#include "core/base/memory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* RMS errors below are those of sums in 32 bits, whatever the step. */
static const double rounding_levels = 2e-4;
/* Coarser steps are too coarse for orders to show. */
static const double coarsest_order_step = 1;

double ang_report_error(const ang_report_run *run, ang_report_kind kind) {
    return kind == ANG_REPORT_MAX ? run->error.max : kind == ANG_REPORT_P999 ? run->error.p999 : run->error.rms;
}

static void judge_time(ang_report_run *run) {
    run->samples_per_pixel = run->drawn ? (double)run->samples / (double)run->pixels : (double)NAN;
    run->median_ms = run->least_ms = run->most_ms = (double)NAN;
    if (!run->drawn || run->frames == 0) return;
    double sorted[ANG_REPORT_FRAMES];
    memcpy(sorted, run->frame_ms, sizeof sorted);
    run->median_ms = ang_median(sorted, (size_t)run->frames);
    run->least_ms = sorted[0];
    run->most_ms = sorted[run->frames - 1];
}

static bool same_step(double a, double b) { return fabs(a - b) < 1e-9 * b; }

const ang_report_run *ang_report_find(const ang_report *report, const ang_method *method, ang_report_group group,
                                      double step, bool subset) {
    for (size_t i = 0; i < report->run_count; i++) {
        const ang_report_run *run = &report->run[i];
        if (run->method == method && run->group == group && run->subset == subset &&
            same_step(run->options.step_voxels, step))
            return run;
    }
    return NULL;
}

/* Time and samples of a whole picture of a step that was drawn on the subset: those of the finest whole one, times the
 * ratio of theirs on the subset. Small pictures cost more a pixel, and slicing joins boxes otherwise for them. */
static void scale_time(const ang_report *report, ang_report_run *run) {
    double step = ang_report_fine_step;
    const ang_report_run *whole = ang_report_find(report, run->method, ANG_REPORT_STEPS, step, false);
    const ang_report_run *part = ang_report_find(report, run->method, ANG_REPORT_STEPS, step, true);
    double ratio = whole && part ? whole->median_ms / part->median_ms : (double)NAN;
    run->median_ms *= ratio;
    run->least_ms *= ratio;
    run->most_ms *= ratio;
    if (whole && whole->drawn && part && part->drawn)
        run->samples_per_pixel *= whole->samples_per_pixel / part->samples_per_pixel;
    run->estimated = true;
}

bool ang_report_is_point(const ang_report_run *run) {
    bool twice = run->subset && run->options.step_voxels >= ang_report_fine_step;
    return run->drawn && run->group == ANG_REPORT_STEPS && !twice;
}

static bool judge_fronts(ang_report *report, ang_error *err) {
    /* The exact method is a setting like any other where it has been timed: the last. */
    bool exact = report->truth.whole.rgba && report->truth.whole_timed;
    size_t count = report->run_count + exact;
    double *cost = ang_alloc(count, 2 * sizeof *cost + 1, "fronts", err);
    if (!cost) return false;
    double *error = cost + count;
    bool *front = (bool *)(error + count);
    for (int kind = 0; kind < ANG_REPORT_KINDS; kind++) {
        for (size_t i = 0; i < report->run_count; i++) {
            const ang_report_run *run = &report->run[i];
            cost[i] = ang_report_is_point(run) ? run->median_ms : (double)NAN;
            error[i] = ang_report_error(run, (ang_report_kind)kind);
        }
        if (exact) {
            cost[count - 1] = report->truth.whole_ms;
            error[count - 1] = 0;
        }
        ang_pareto_front(cost, error, count, ang_report_slack, front);
        for (size_t i = 0; i < report->run_count; i++) report->run[i].front[kind] = front[i];
    }
    free(cost);
    return true;
}

/* The run that tells what a step makes of the subset: without termination where there is such. */
static const ang_report_run *order_run(const ang_report *report, const ang_method *method, double step) {
    const ang_report_run *run = ang_report_find(report, method, ANG_REPORT_ORDERS, step, true);
    if (!run) run = ang_report_find(report, method, ANG_REPORT_STEPS, step, true);
    if (!run) run = ang_report_find(report, method, ANG_REPORT_STEPS, step, false);
    return run;
}

static void judge_order(const ang_report *report, const ang_method *method, ang_report_order *out) {
    double step[ANG_REPORT_STEP_COUNT], error[ANG_REPORT_STEP_COUNT];
    size_t count = 0;
    out->method = method;
    for (int i = 0; i < ANG_REPORT_STEP_COUNT; i++) {
        const ang_report_run *run = order_run(report, method, ang_report_steps[i]);
        out->rms[i] = run && run->drawn ? run->subset_error.rms : (double)NAN;
        /* A method may not go as finely as it is asked to. */
        double used =
            run && run->step_mm > 0 ? run->step_mm / ang_volume_smallest_spacing(report->volume) : ang_report_steps[i];
        bool finer = count == 0 || used < 0.99 * step[count - 1];
        if (ang_report_steps[i] > coarsest_order_step || !isfinite(out->rms[i]) || !finer) continue;
        step[count] = used;
        error[count++] = out->rms[i];
    }
    out->fit = ang_order_fit(step, error, count, rounding_levels);
}

static bool judge_orders(ang_report *report, ang_error *err) {
    const ang_method *const *methods = ang_methods();
    size_t count = 0;
    while (methods[count]) count++;
    report->order = ang_alloc(count, sizeof *report->order, "orders", err);
    if (!report->order) return false;
    for (size_t m = 0; m < count; m++) {
        bool any = false;
        for (size_t i = 0; i < report->run_count; i++)
            any = any || (report->run[i].method == methods[m] && report->run[i].drawn);
        if (any) judge_order(report, methods[m], &report->order[report->order_count++]);
    }
    const ang_volume *volume = report->volume;
    bool prefix = false;
    for (size_t i = 0; i < report->run_count; i++)
        prefix |= report->run[i].group == ANG_REPORT_ORDERS && report->run[i].classification == ANG_CLASSIFY_PREFIX;
    report->expected = ang_order_expected(&report->picture.scene, ang_volume_hu(volume, volume->minimum),
                                          ang_volume_hu(volume, volume->maximum), prefix);
    return true;
}

/* The fastest setting of which 99.9 % of the pixels keep within `levels`, its time and error taken of whole pictures
 * or, where `derived`, of the subset; NULL where none does. */
static const ang_report_run *fastest_within(const ang_report *report, double levels, bool derived) {
    const ang_report_run *best = NULL;
    for (size_t i = 0; i < report->run_count; i++) {
        const ang_report_run *run = &report->run[i];
        if (!ang_report_is_point(run) || run->subset != derived || !isfinite(run->median_ms)) continue;
        if (run->error.p999 <= levels && (!best || run->median_ms < best->median_ms)) best = run;
    }
    return best;
}

/* The fastest of the whole pictures whose error is the least or hardly greater. */
static const ang_report_run *most_exact(const ang_report *report) {
    double least = INFINITY;
    for (size_t i = 0; i < report->run_count; i++) {
        const ang_report_run *run = &report->run[i];
        if (ang_report_is_point(run) && !run->subset && isfinite(run->median_ms)) least = fmin(least, run->error.p999);
    }
    return fastest_within(report, (1 + ang_report_slack) * least, false);
}

static bool is_scaled(const ang_report_run *run) { return run->group == ANG_REPORT_STEPS && run->subset; }

bool ang_report_judge(ang_report *report, ang_error *err) {
    for (size_t i = 0; i < report->run_count; i++) judge_time(&report->run[i]);
    /* What gives the scale last. */
    for (int scale = 0; scale < 2; scale++)
        for (size_t i = 0; i < report->run_count; i++)
            if (is_scaled(&report->run[i]) && ang_report_is_point(&report->run[i]) == (scale == 0))
                scale_time(report, &report->run[i]);
    if (!judge_fronts(report, err) || !judge_orders(report, err)) return false;
    report->exact = most_exact(report);
    report->quick = fastest_within(report, ang_report_quick_levels, false);
    report->recommended = fastest_within(report, ang_report_good_levels, false);
    if (!report->recommended) report->recommended = fastest_within(report, ang_report_good_levels, true);
    report->good = report->recommended != NULL;
    if (!report->good) report->recommended = report->exact;
    return true;
}
