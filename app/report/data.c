/* A report for programs: CSV and JSON. */
#include "app/report/report.h"

#include "app/render_json.h"
#include "io/json.h"
#include "io/replace.h"
#include "io/report.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void add_number(FILE *out, double value) {
    if (isinf(value))
        fputs(",inf", out);
    else if (isnan(value))
        fputc(',', out);
    else
        fprintf(out, ",%.9g", value);
}

/* What we name holds neither commas nor quotes; messages of a driver may. */
static void add_text(FILE *out, const char *text) {
    fputs(",\"", out);
    for (; *text; text++) fprintf(out, *text == '"' ? "\"%c" : "%c", *text);
    fputc('"', out);
}

static void add_run(FILE *out, const ang_report *report, const ang_report_run *run) {
    const ang_metrics *error = &run->error;
    fprintf(out, "%s,%s,%.9g,%s,%s", ang_report_group_name(run->group), run->method->name, run->options.step_voxels,
            run->switched, run->subset ? "subset" : "all");
    double values[] = {(double)run->compared, error->max,
                       error->p999,           error->rms,
                       error->psnr,           error->ssim,
                       error->flipped,        run->subset_error.rms,
                       run->median_ms,        run->least_ms,
                       run->most_ms,          run->frames,
                       (double)run->samples,  run->samples_per_pixel,
                       run->passes,           run->step_mm};
    for (size_t i = 0; i < sizeof values / sizeof *values; i++) add_number(out, run->drawn ? values[i] : (double)NAN);
    fprintf(out, ",%d,%d,%d,%d", run->estimated, run->front[ANG_REPORT_MAX], run->front[ANG_REPORT_P999],
            run->front[ANG_REPORT_RMS]);
    fprintf(out, ",%s", run->drawn ? ang_classify_name(run->classification) : "");
    add_text(out, run->drawn ? "" : run->left_out);
    fputc('\n', out);
    (void)report;
}

static bool finish(FILE *out, char **text, size_t *size, const char *path, ang_error *err) {
    bool whole = fclose(out) == 0 && *text;
    bool done = whole ? ang_file_replace(path, *text, *size, err) : ang_fail(err, ANG_LIMIT, "no memory for %s", path);
    free(*text);
    return done;
}

bool ang_report_write_csv(const ang_report *report, const char *path, ang_error *err) {
    char *text = NULL;
    size_t size = 0;
    FILE *out = open_memstream(&text, &size);
    if (!out) return ang_fail(err, ANG_LIMIT, "no memory for %s", path);
    fputs("group,method,step_voxels,switched,pixels,compared_pixels,max,p999,rms,psnr,ssim,flipped,subset_rms,"
          "time_median_ms,time_min_ms,time_max_ms,timed_frames,samples,samples_per_pixel,passes,step_mm,"
          "time_estimated,front_max,front_p999,front_rms,classification,left_out\n",
          out);
    const ang_report_truth *truth = &report->truth;
    const ang_image *pixels = truth->whole.rgba ? &truth->whole : &truth->subset;
    double size_of_truth = (double)pixels->width * pixels->height;
    fprintf(out, "reference,%s,,,%s,%.0f,0,0,0,inf,1,0,0,%.9g,,,%d,,,1,,%d,0,0,0,,\"\"\n", ang_method_reference.name,
            truth->whole.rgba ? "all" : "subset", size_of_truth, truth->whole_ms, truth->whole_timed,
            !truth->whole_timed);
    for (size_t i = 0; i < report->run_count; i++) add_run(out, report, &report->run[i]);
    return finish(out, &text, &size, path, err);
}

static cJSON *metrics_json(const ang_metrics *metrics) {
    cJSON *out = cJSON_CreateObject();
    ang_json_add_number(out, "max", metrics->max);
    ang_json_add_number(out, "p999", metrics->p999);
    ang_json_add_number(out, "rms", metrics->rms);
    ang_json_add_number(out, "psnr", metrics->psnr);
    ang_json_add_number(out, "ssim", metrics->ssim);
    ang_json_add_number(out, "flipped", metrics->flipped);
    return out;
}

static cJSON *run_json(const ang_report_run *run) {
    cJSON *out = cJSON_CreateObject();
    cJSON_AddStringToObject(out, "group", ang_report_group_name(run->group));
    cJSON_AddStringToObject(out, "method", run->method->name);
    cJSON_AddNumberToObject(out, "step_voxels", run->options.step_voxels);
    cJSON_AddNumberToObject(out, "termination", run->options.termination);
    cJSON_AddStringToObject(out, "shading", ang_shading_name(run->shading));
    if (run->switched[0]) cJSON_AddStringToObject(out, "switched", run->switched);
    cJSON_AddStringToObject(out, "pixels", run->subset ? "subset" : "all");
    if (!run->drawn) {
        cJSON_AddStringToObject(out, "left_out", run->left_out);
        return out;
    }
    cJSON_AddItemToObject(out, "error", metrics_json(&run->error));
    cJSON_AddNumberToObject(out, "compared_pixels", (double)run->compared);
    cJSON_AddNumberToObject(out, "subset_rms", run->subset_error.rms);
    cJSON *time = cJSON_AddObjectToObject(out, "time_ms");
    ang_json_add_number(time, "median", run->median_ms);
    ang_json_add_number(time, "min", run->least_ms);
    ang_json_add_number(time, "max", run->most_ms);
    cJSON_AddNumberToObject(time, "frames", run->frames);
    cJSON_AddBoolToObject(time, "estimated", run->estimated);
    cJSON_AddNumberToObject(out, "samples", (double)run->samples);
    cJSON_AddNumberToObject(out, "samples_per_pixel", run->samples_per_pixel);
    cJSON_AddNumberToObject(out, "passes", run->passes);
    cJSON_AddStringToObject(out, "classification", ang_classify_name(run->classification));
    ang_json_add_number(out, "step_mm", run->step_mm > 0 ? run->step_mm : NAN);
    cJSON *front = cJSON_AddObjectToObject(out, "front");
    cJSON_AddBoolToObject(front, "max", run->front[ANG_REPORT_MAX]);
    cJSON_AddBoolToObject(front, "p999", run->front[ANG_REPORT_P999]);
    cJSON_AddBoolToObject(front, "rms", run->front[ANG_REPORT_RMS]);
    return out;
}

static cJSON *environment_json(const ang_report *report) {
    cJSON *out = cJSON_CreateObject();
    if (report->gl) {
        cJSON_AddStringToObject(out, "backend", ang_gl_backend(report->gl));
        cJSON_AddStringToObject(out, "gl_renderer", ang_gl_renderer(report->gl));
        cJSON_AddStringToObject(out, "gl_version", ang_gl_version(report->gl));
        ang_json_add_number(out, "filter_bits", report->filter_bits > 0 ? report->filter_bits : NAN);
        ang_json_add_number(out, "filter_deviation", report->filter_bits > 0 ? report->filter_deviation : NAN);
    }
    cJSON_AddStringToObject(out, "processor", report->processor);
    cJSON_AddNumberToObject(out, "threads", report->threads);
    return out;
}

static cJSON *truth_json(const ang_report *report) {
    const ang_report_truth *truth = &report->truth;
    cJSON *out = cJSON_CreateObject();
    cJSON_AddStringToObject(out, "pixels", truth->whole.rgba ? "all" : "subset");
    cJSON *subset = cJSON_AddObjectToObject(out, "subset");
    cJSON_AddNumberToObject(subset, "stride", truth->stride);
    cJSON_AddItemToObject(subset, "first", cJSON_CreateIntArray((int[2]){truth->first_x, truth->first_y}, 2));
    cJSON_AddItemToObject(subset, "size", cJSON_CreateIntArray((int[2]){truth->subset.width, truth->subset.height}, 2));
    ang_json_add_number(out, "time_ms", truth->whole_ms);
    cJSON_AddBoolToObject(out, "time_estimated", !truth->whole_timed);
    return out;
}

static cJSON *orders_json(const ang_report *report) {
    cJSON *out = cJSON_CreateObject();
    cJSON *expected = cJSON_AddObjectToObject(out, "expected");
    cJSON_AddNumberToObject(expected, "least", report->expected.least);
    cJSON_AddNumberToObject(expected, "most", report->expected.most);
    cJSON_AddStringToObject(expected, "why", report->expected.why);
    cJSON *fitted = cJSON_AddArrayToObject(out, "fitted");
    for (size_t i = 0; i < report->order_count; i++) {
        const ang_order *fit = &report->order[i].fit;
        cJSON *one = cJSON_CreateObject();
        cJSON_AddStringToObject(one, "method", report->order[i].method->name);
        ang_json_add_number(one, "order", fit->order);
        ang_json_add_number(one, "standard_error", fit->spread);
        ang_json_add_number(one, "coarsest_step", fit->coarsest);
        ang_json_add_number(one, "finest_step", fit->finest);
        cJSON_AddNumberToObject(one, "errors_used", fit->used);
        cJSON_AddItemToArray(fitted, one);
    }
    return out;
}

static cJSON *setting_json(const ang_report_run *run) {
    if (!run) return cJSON_CreateNull();
    cJSON *out = cJSON_CreateObject();
    cJSON_AddStringToObject(out, "method", run->method->name);
    cJSON_AddNumberToObject(out, "step_voxels", run->options.step_voxels);
    return out;
}

bool ang_report_write_json(const ang_report *report, const char *path, ang_error *err) {
    cJSON *root = cJSON_CreateObject();
    cJSON_AddStringToObject(root, "version", ANG_VERSION);
    cJSON_AddItemToObject(root, "input", ang_load_report_json(report->volume, &report->input, false));
    cJSON_AddItemToObject(root, "picture", ang_picture_json(&report->picture));
    cJSON_AddItemToObject(root, "environment", environment_json(report));
    cJSON_AddItemToObject(root, "reference", truth_json(report));
    cJSON *recommended = cJSON_AddObjectToObject(root, "settings");
    cJSON_AddItemToObject(recommended, "recommended", setting_json(report->recommended));
    cJSON_AddBoolToObject(recommended, "recommended_within_a_level", report->good);
    cJSON_AddItemToObject(recommended, "quick", setting_json(report->quick));
    cJSON_AddItemToObject(recommended, "exact", setting_json(report->exact));
    cJSON_AddItemToObject(root, "orders", orders_json(report));
    cJSON *runs = cJSON_AddArrayToObject(root, "runs");
    for (size_t i = 0; i < report->run_count; i++) cJSON_AddItemToArray(runs, run_json(&report->run[i]));
    cJSON *notes = cJSON_AddArrayToObject(root, "notes");
    for (size_t i = 0; i < report->notes.count; i++)
        cJSON_AddItemToArray(notes, cJSON_CreateString(report->notes.text[i]));
    char *text = cJSON_Print(root);
    cJSON_Delete(root);
    if (!text) return ang_fail(err, ANG_LIMIT, "no memory for %s", path);
    bool done = ang_file_replace(path, text, strlen(text), err);
    free(text);
    return done;
}
