/* Which settings a report goes over. */
#include "app/report/report.h"

#include "core/base/memory.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

const double ang_report_steps[ANG_REPORT_STEP_COUNT] = {2, 1, 0.5, 0.25, 0.125, 1. / 16, 1. / 32};
const double ang_report_switch_step = 0.5, ang_report_fine_step = 0.125;
const double ang_report_good_levels = 1, ang_report_quick_levels = 8, ang_report_slack = 0.01;

const char *ang_report_group_name(ang_report_group group) {
    static const char *const names[] = {"steps", "orders", "switches"};
    return names[group];
}

const char *ang_report_step_text(double step, char text[16]) {
    double parts = 1 / step;
    if (step < 1 && parts == floor(parts))
        snprintf(text, 16, "1/%.0f", parts);
    else
        snprintf(text, 16, "%.4g", step);
    return text;
}

bool ang_report_is_timed(const ang_report_run *run) { return run->group != ANG_REPORT_ORDERS; }

ang_scene ang_report_scene(const ang_report *report, const ang_report_run *run) {
    ang_scene scene = report->picture.scene;
    scene.shading = run->shading;
    const ang_report_truth *truth = &report->truth;
    return run->subset ? ang_scene_subset(&scene, truth->stride, truth->first_x, truth->first_y) : scene;
}

static ang_report_run *add(ang_report *report, ang_report_group group, const ang_method *method, double step) {
    ang_report_run *run = &report->run[report->run_count++];
    *run = (ang_report_run){
        .group = group, .method = method, .options = report->picture.render, .shading = report->picture.scene.shading};
    run->options.step_voxels = step;
    run->options.forced |= 1u << ANG_PART_REDRAW; /* or frames that are timed would be copies of the one before */
    return run;
}

/* Where rays end early, errors do not fall to nothing with the step: orders are taken without. */
static bool has_order_runs(const ang_report *report, const ang_method *method) {
    return report->picture.scene.mode == ANG_MODE_DVR && (method->takes & ANG_TAKES_TERMINATION) &&
           report->picture.render.termination < 1;
}

static void add_switches(ang_report *report, const ang_method *method) {
    const ang_render_options *usual = &report->picture.render;
    const ang_scene *scene = &report->picture.scene;
    ang_report_run *run;
    for (int proxy = 0; (method->takes & ANG_TAKES_PROXY) && ang_proxy_name((ang_proxy)proxy); proxy++) {
        if (proxy == (int)usual->proxy) continue;
        run = add(report, ANG_REPORT_SWITCHES, method, ang_report_switch_step);
        run->options.proxy = (ang_proxy)proxy;
        snprintf(run->switched, sizeof run->switched, "proxy %s", ang_proxy_name((ang_proxy)proxy));
    }
    if ((method->takes & ANG_TAKES_NO_SKIP) && !usual->no_skip) {
        run = add(report, ANG_REPORT_SWITCHES, method, ang_report_switch_step);
        run->options.no_skip = true;
        snprintf(run->switched, sizeof run->switched, "no skipping");
    }
    if (has_order_runs(report, method)) {
        run = add(report, ANG_REPORT_SWITCHES, method, ang_report_switch_step);
        run->options.termination = 1;
        snprintf(run->switched, sizeof run->switched, "no termination");
    }
    for (int kind = ANG_CLASSIFY_MIDPOINT; kind <= ANG_CLASSIFY_PREFIX; kind++) {
        if (!(method->takes & ANG_TAKES_CLASSIFICATION) || scene->mode != ANG_MODE_DVR) break;
        if (kind == (int)usual->classification) continue;
        run = add(report, ANG_REPORT_SWITCHES, method, ang_report_switch_step);
        run->options.classification = (ang_classify)kind;
        snprintf(run->switched, sizeof run->switched, "classification %s", ang_classify_name((ang_classify)kind));
    }
    if (scene->mode == ANG_MODE_DVR) {
        run = add(report, ANG_REPORT_SWITCHES, method, ang_report_switch_step);
        run->shading = scene->shading == ANG_SHADING_PHONG ? ANG_SHADING_NONE : ANG_SHADING_PHONG;
        snprintf(run->switched, sizeof run->switched, "shading %s", ang_shading_name(run->shading));
    }
}

/* The methods that are judged: all but the one that judges, or the one asked for. */
static bool is_judged(const ang_report *report, const ang_method *method) {
    if (method == &ang_method_reference) return false;
    const char *only = report->options->method;
    return strcmp(only, "auto") == 0 || strcmp(only, method->name) == 0;
}

/* In the order in which they are run: what matters most comes first, methods take turns. */
bool ang_report_plan(ang_report *report, ang_error *err) {
    const ang_method *const *methods = ang_methods();
    size_t count = 0, each = 2 * ANG_REPORT_STEP_COUNT + 32;
    while (methods[count]) count++;
    report->run = ang_alloc(count * each, sizeof *report->run, "report", err);
    if (!report->run) return false;
    for (int i = 0; i < ANG_REPORT_STEP_COUNT; i++)
        for (size_t m = 0; m < count; m++)
            if (is_judged(report, methods[m]) && ang_report_steps[i] >= ang_report_fine_step)
                add(report, ANG_REPORT_STEPS, methods[m], ang_report_steps[i]);
    for (int i = 0; i < ANG_REPORT_STEP_COUNT; i++)
        for (size_t m = 0; m < count; m++)
            if (is_judged(report, methods[m]) && has_order_runs(report, methods[m])) {
                ang_report_run *run = add(report, ANG_REPORT_ORDERS, methods[m], ang_report_steps[i]);
                run->subset = true;
                run->options.termination = 1;
            }
    /* The finest whole picture is drawn on the subset too: what it takes there gives the scale for the finer ones. */
    for (int i = 0; i < ANG_REPORT_STEP_COUNT; i++)
        for (size_t m = 0; m < count; m++)
            if (is_judged(report, methods[m]) && ang_report_steps[i] <= ang_report_fine_step)
                add(report, ANG_REPORT_STEPS, methods[m], ang_report_steps[i])->subset = true;
    for (size_t m = 0; m < count; m++)
        if (is_judged(report, methods[m])) add_switches(report, methods[m]);
    return true;
}
