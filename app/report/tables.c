/* The tables of the page. */
#include "app/report/report.h"

#include "io/report.h"
#include "io/text.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

const char *ang_report_time_text(double milliseconds, char text[32]) {
    if (!isfinite(milliseconds))
        snprintf(text, 32, "not timed");
    else if (milliseconds < 999.5)
        snprintf(text, 32, "%.*f ms", milliseconds < 9.95 ? 1 : 0, milliseconds);
    else if (milliseconds < 99.5e3)
        snprintf(text, 32, "%.*f s", milliseconds < 9.95e3 ? 1 : 0, milliseconds / 1000);
    else
        snprintf(text, 32, "%.0f minutes", milliseconds / 60e3);
    return text;
}

/* Three digits, but nothing below a ten-thousandth of a level, which no picture holds. */
const char *ang_report_levels_text(double levels, char text[32]) {
    if (!isfinite(levels))
        snprintf(text, 32, "&ndash;");
    else if (levels < 0.001)
        snprintf(text, 32, levels > 0 ? "&lt; 0.001" : "0");
    else
        snprintf(text, 32, "%.*f", levels < 0.1 ? 3 : levels < 10 ? 2 : levels < 100 ? 1 : 0, levels);
    return text;
}

static void put_levels(FILE *out, double levels, bool front) {
    char text[32];
    fprintf(out, "<td%s>%s</td>", front ? " class=\"front\"" : "", ang_report_levels_text(levels, text));
}

static void put_ms(FILE *out, const ang_report_run *run) {
    if (!isfinite(run->median_ms))
        fputs("<td>&ndash;</td>", out);
    else
        fprintf(out, "<td>%s%.*f</td>", run->estimated ? "&asymp; " : "", run->median_ms < 99.5 ? 1 : 0,
                run->median_ms);
}

static void put_similarity(FILE *out, const ang_metrics *error) {
    if (isinf(error->psnr))
        fputs("<td>&infin;</td>", out);
    else
        fprintf(out, "<td>%.1f</td>", error->psnr);
    if (isfinite(error->ssim))
        fprintf(out, "<td>%.5f</td>", error->ssim);
    else
        fputs("<td>&ndash;</td>", out);
}

static void put_setting(FILE *out, const ang_report *report, const ang_report_run *run, bool first) {
    char step[16];
    bool chosen = run == report->recommended;
    fprintf(out, "<tr class=\"%s%s\"><th>%s</th><td>%s</td>", first ? "first " : "", chosen ? "chosen" : "",
            run->method->name, ang_report_step_text(run->options.step_voxels, step));
    put_ms(out, run);
    put_levels(out, run->error.max, run->front[ANG_REPORT_MAX]);
    put_levels(out, run->error.p999, run->front[ANG_REPORT_P999]);
    put_levels(out, run->error.rms, run->front[ANG_REPORT_RMS]);
    put_similarity(out, &run->error);
    fprintf(out, "<td>%.1f</td><td>%d</td><td>%zu</td></tr>\n", run->samples_per_pixel, run->frames, run->compared);
}

void ang_report_put_settings_table(FILE *out, const ang_report *report) {
    fputs("<table><thead><tr><th>method</th><th>step<br>voxels</th><th>time<br>ms</th><th>max<br>levels</th>"
          "<th>99.9 %<br>levels</th><th>RMS<br>levels</th><th>PSNR<br>dB</th><th>SSIM</th><th>samples<br>a pixel</th>"
          "<th>frames<br>timed</th><th>pixels<br>compared</th></tr></thead><tbody>\n",
          out);
    for (size_t m = 0; m < report->order_count; m++) {
        bool first = true;
        for (size_t i = 0; i < report->run_count; i++) {
            const ang_report_run *run = &report->run[i];
            if (run->method != report->order[m].method || !ang_report_is_point(run)) continue;
            put_setting(out, report, run, first);
            first = false;
        }
    }
    const ang_report_truth *truth = &report->truth;
    fprintf(out,
            "<tr class=\"first\"><th>%s</th><td>exact</td><td>%s%.0f</td><td>0</td><td>0</td><td>0</td>"
            "<td>&infin;</td><td>1</td><td></td><td>%d</td><td></td></tr>\n</tbody></table>\n",
            ang_method_reference.name, truth->whole_timed ? "" : "&asymp; ", truth->whole_ms, truth->whole_timed);
}

static void put_switch(FILE *out, const ang_report_run *run, const ang_report_run *base) {
    fprintf(out, "<tr class=\"%s\"><th>%s</th><td class=\"words\">", run == base ? "first" : "", run->method->name);
    ang_text_put_markup(out, run == base ? "nothing" : run->switched);
    fputs("</td>", out);
    put_ms(out, run);
    double ratio = base ? run->median_ms / base->median_ms : (double)NAN;
    if (isfinite(ratio))
        fprintf(out, "<td>%.2f</td>", ratio);
    else
        fputs("<td>&ndash;</td>", out);
    put_levels(out, run->error.max, false);
    put_levels(out, run->error.p999, false);
    put_levels(out, run->error.rms, false);
    fprintf(out, "<td>%.1f</td><td>%zu</td></tr>\n", run->samples_per_pixel, run->compared);
}

void ang_report_put_switches_table(FILE *out, const ang_report *report) {
    fputs(
        "<table><thead><tr><th>method</th><th class=\"words\">switched</th><th>time<br>ms</th><th>times as<br>long</th>"
        "<th>max<br>levels</th><th>99.9 %<br>levels</th><th>RMS<br>levels</th><th>samples<br>a pixel</th>"
        "<th>pixels<br>compared</th></tr></thead><tbody>\n",
        out);
    for (size_t m = 0; m < report->order_count; m++) {
        const ang_method *method = report->order[m].method;
        const ang_report_run *base = ang_report_find(report, method, ANG_REPORT_STEPS, ang_report_switch_step, false);
        if (base && base->drawn) put_switch(out, base, base);
        for (size_t i = 0; i < report->run_count; i++) {
            const ang_report_run *run = &report->run[i];
            if (run->method == method && run->group == ANG_REPORT_SWITCHES && run->drawn) put_switch(out, run, base);
        }
    }
    fputs("</tbody></table>\n", out);
}

/* What a fitted order says beside the expected one. */
static const char *verdict(const ang_order *fit, const ang_expected_order *expected) {
    if (isnan(fit->order)) return "too few errors above rounding to tell";
    /* Whether by chance: two standard errors, and a quarter for the few pixels there are. */
    double doubt = fmax(0.25, isfinite(fit->spread) ? 2 * fit->spread : 0);
    if (fit->order < expected->least - doubt) return "lower than expected";
    if (fit->order > expected->most + doubt) return "higher than expected";
    return "as expected";
}

void ang_report_put_orders_table(FILE *out, const ang_report *report) {
    fputs("<table><thead><tr><th>method</th>", out);
    for (int i = 0; i < ANG_REPORT_STEP_COUNT; i++) {
        char step[16];
        fprintf(out, "<th>RMS at<br>%s</th>", ang_report_step_text(ang_report_steps[i], step));
    }
    fputs("<th>fitted<br>order</th><th>fitted<br>from, to</th><th class=\"words\">beside the expected</th></tr>"
          "</thead><tbody>\n",
          out);
    for (size_t m = 0; m < report->order_count; m++) {
        const ang_report_order *order = &report->order[m];
        fprintf(out, "<tr><th>%s</th>", order->method->name);
        for (int i = 0; i < ANG_REPORT_STEP_COUNT; i++) put_levels(out, order->rms[i], false);
        if (isnan(order->fit.order)) {
            fputs("<td>&ndash;</td><td></td>", out);
        } else {
            char from[16], to[16];
            fprintf(out, "<td>%.2f", order->fit.order);
            if (isfinite(order->fit.spread)) fprintf(out, " &plusmn; %.2f", order->fit.spread);
            fprintf(out, "</td><td>%s, %s</td>", ang_report_step_text(order->fit.coarsest, from),
                    ang_report_step_text(order->fit.finest, to));
        }
        fprintf(out, "<td class=\"words\">%s</td></tr>\n", verdict(&order->fit, &report->expected));
    }
    fputs("</tbody></table>\n", out);
}

static void put_left_out(FILE *out, const ang_report_run *run) {
    char step[16];
    fprintf(out, "<li>%s, step %s%s%s%s: ", run->method->name, ang_report_step_text(run->options.step_voxels, step),
            run->switched[0] ? ", " : "", run->switched, run->subset ? ", subset" : "");
    ang_text_put_markup(out, run->drawn ? "not timed, the time limit leaves no time for it" : run->left_out);
    fputs("</li>\n", out);
}

void ang_report_put_left_out(FILE *out, const ang_report *report) {
    size_t count = 0;
    for (size_t i = 0; i < report->run_count; i++) {
        const ang_report_run *run = &report->run[i];
        if (run->drawn && (run->frames > 0 || !ang_report_is_timed(run))) continue;
        if (count++ == 0) fputs("<ul>\n", out);
        put_left_out(out, run);
    }
    fputs(count ? "</ul>\n" : "<p>Nothing: all that was planned was measured.</p>\n", out);
}

static void fact(FILE *out, const char *name, const char *value) {
    fprintf(out, "<tr><th>%s</th><td class=\"words\">", name);
    ang_text_put_markup(out, value);
    fputs("</td></tr>\n", out);
}

static void put_picture_facts(FILE *out, const ang_report *report) {
    char text[512], name[32];
    const ang_scene *scene = &report->picture.scene;
    const ang_volume *volume = report->volume;
    ang_load_report_name(&report->input, name);
    snprintf(text, sizeof text, "%s: %d x %d x %d voxels of %.4g x %.4g x %.4g mm", name, volume->dims[0],
             volume->dims[1], volume->dims[2], ang_volume_spacing(volume, 0), ang_volume_spacing(volume, 1),
             ang_volume_spacing(volume, 2));
    fact(out, "input", text);
    bool shaded = scene->mode == ANG_MODE_DVR;
    snprintf(text, sizeof text, "preset %s, mode %s%s%s, %s projection", report->picture.preset->name,
             ang_mode_name(scene->mode), shaded ? ", shading " : "", shaded ? ang_shading_name(scene->shading) : "",
             ang_projection_name(scene->camera.projection));
    fact(out, "picture", text);
    const ang_view *view = &report->picture.view;
    snprintf(text, sizeof text, "azimuth %.4g, elevation %.4g, roll %.4g degrees; zoom %.4g; %d x %d pixels",
             view->azimuth_deg, view->elevation_deg, view->roll_deg, view->zoom, scene->width, scene->height);
    fact(out, "view", text);
}

static void put_machine_facts(FILE *out, const ang_report *report) {
    char text[512];
    snprintf(text, sizeof text, "%s, %d thread%s", report->processor, report->threads, ang_plural(report->threads));
    fact(out, "processor", text);
    if (!report->gl) {
        fact(out, "OpenGL", "none");
        return;
    }
    snprintf(text, sizeof text, "%s; %s; %s", ang_gl_renderer(report->gl), ang_gl_version(report->gl),
             ang_gl_backend(report->gl));
    fact(out, "OpenGL", text);
    if (report->filter_bits > 0)
        snprintf(text, sizeof text, "%s%d fractional bits measured between two texels (farthest from a line: %.2g)",
                 report->filter_bits >= 16 ? "at least " : "", report->filter_bits, report->filter_deviation);
    else
        snprintf(text, sizeof text, "not measured");
    fact(out, "texture filter", text);
}

void ang_report_put_facts(FILE *out, const ang_report *report) {
    fputs("<table class=\"facts\"><tbody>\n", out);
    put_picture_facts(out, report);
    put_machine_facts(out, report);
    fact(out, "program", "angioscope " ANG_VERSION);
    fputs("</tbody></table>\n", out);
}
