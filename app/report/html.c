/* The page: what a clinician needs on the first screen, all else below. */
#include "app/report/report.h"

#include "io/replace.h"
#include "io/text.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const char style[] =
    "body{font:16px/1.5 system-ui,-apple-system,'Segoe UI',Roboto,'DejaVu Sans',sans-serif;color:#1c2430;"
    "background:#fff;margin:0 auto;max-width:1120px;padding:24px}\n"
    "h1{font-size:26px;line-height:1.25;margin:0 0 4px}h2{font-size:20px;margin:44px 0 8px;padding-top:14px;"
    "border-top:1px solid #d5dae1}h3{font-size:16px;margin:24px 0 6px}\n"
    "p{margin:8px 0}p,li{max-width:75ch}.under{color:#5b6675;margin:0 0 20px}code{font:14px/1.4 ui-monospace,"
    "'DejaVu Sans Mono',monospace;background:#f1f3f6;padding:1px 5px;border-radius:3px;overflow-wrap:anywhere}\n"
    ".hero{display:flex;gap:32px;align-items:flex-start}.hero figure{flex:0 0 46%}.hero>div{flex:1}\n"
    ".verdict{font-size:21px;line-height:1.4;margin:0 0 14px}.note{color:#5b6675;font-size:14px}\n"
    "figure{margin:0}figcaption{color:#5b6675;font-size:13px;line-height:1.35;margin-top:4px}\n"
    "img,svg{display:block;width:100%;height:auto}img{background:#000}img.pixels{image-rendering:pixelated}\n"
    ".plots{display:flex;flex-wrap:wrap;gap:16px 24px}.plots figure{width:calc(50% - 12px)}\n"
    ".row{display:flex;flex-wrap:wrap;gap:14px 12px}.row figure{width:calc(20% - 10px)}\n"
    ".pairs figure{width:calc(25% - 9px)}\n"
    "table{border-collapse:collapse;font-size:14px;line-height:1.35;margin:10px 0;font-variant-numeric:tabular-nums}"
    "td,th{padding:3px 10px;text-align:right;vertical-align:top}thead th{border-bottom:1px solid #9aa5b3;"
    "font-weight:600;vertical-align:bottom}tbody th{font-weight:600;text-align:left}th:first-child,.words{"
    "text-align:left}tr.first>*{border-top:1px solid #d5dae1}tr.chosen>*{background:#e8f2fb}"
    "td.front{font-weight:700;color:#00518a}.facts th{white-space:nowrap}\n"
    ".choice{font-size:15px;width:100%}.choice td,.choice th{padding:6px 8px}\n"
    ".scale{width:360px;margin:6px 0 14px}.scale img{height:14px}.scale div{display:flex;"
    "justify-content:space-between;font-size:12px;color:#5b6675}\n"
    "@media screen and (max-width:760px){.hero{display:block}.hero figure{margin-bottom:16px}.plots figure{width:100%}"
    ".row figure{width:calc(33% - 10px)}.wide{overflow-x:auto}}\n"
    "@page{margin:14mm}@media print{body{font-size:11pt;max-width:none;padding:0;-webkit-print-color-adjust:exact;"
    "print-color-adjust:exact}h2{break-after:avoid;margin-top:26px}figure,tr,.hero{break-inside:avoid}"
    "thead{display:table-header-group}.hero{gap:20px}table{font-size:9pt}td,th{padding:2px "
    "6px}.verdict{font-size:15pt}}\n";

static void put_style(FILE *out) {
    fputs("<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">"
          "<meta name=\"viewport\" content=\"width=device-width,initial-scale=1\">"
          "<title>Error against run time</title>\n<style>\n",
          out);
    fputs(style, out);
    fputs("</style></head><body>\n", out);
}

/* "<b>envelope</b> with a step of <b>1/2 voxel</b>". */
static void put_setting(FILE *out, const ang_report_run *run) {
    char step[16];
    ang_report_step_text(run->options.step_voxels, step);
    fprintf(out, "<b>%s</b> with a step of <b>%s voxel%s</b>", run->method->name, step,
            run->options.step_voxels > 1 ? "s" : "");
}

static void put_verdict(FILE *out, const ang_report *report) {
    const ang_report_run *run = report->recommended;
    char time[32], most[32], worst[32];
    fputs("<p class=\"verdict\">", out);
    if (!run) {
        fputs("No setting could be drawn and timed as a whole picture, so that none can be recommended; why is at the "
              "end.</p>\n",
              out);
        return;
    }
    ang_report_time_text(run->median_ms, time);
    ang_report_levels_text(run->error.p999, most);
    ang_report_levels_text(run->error.max, worst);
    if (report->good) {
        fputs("Use ", out);
        put_setting(out, run);
        fprintf(out,
                ": a picture takes <b>%s%s</b> here, and 99.9 %% of its pixels are within <b>%s of 255</b> levels of "
                "brightness of the exact picture, too little for a screen to show.",
                run->estimated ? "about " : "", time, most);
    } else {
        fputs("No setting measured here shows this picture to within what a screen can show. The most exact is ", out);
        put_setting(out, run);
        fprintf(out,
                ": a picture takes <b>%s</b>, and 99.9 %% of its pixels are within <b>%s of 255</b> levels of "
                "brightness of the exact one.",
                time, most);
    }
    const char *compared = report->truth.whole.rgba && !run->subset ? "" : " compared";
    if (run->error.max > ang_report_quick_levels)
        fprintf(
            out,
            " One pixel in a thousand may differ more, mostly at edges, where a surface is met or missed: the worst "
            "pixel%s is off by %s.",
            compared, worst);
    else
        fprintf(out, " The worst pixel%s is off by %s.", compared, worst);
    if (report->truth.whole_timed && report->truth.whole_ms <= run->median_ms)
        fprintf(out, " The exact method itself takes only %s here: <b>%s</b> is the better choice.",
                ang_report_time_text(report->truth.whole_ms, time), ang_method_reference.name);
    fprintf(out, "</p>\n<p>In a render command: <code>--method %s --step %g</code></p>\n", run->method->name,
            run->options.step_voxels);
}

static void put_choice(FILE *out, const char *what, const ang_report_run *run) {
    char step[16], time[32], most[32], worst[32];
    if (!run) return;
    fprintf(out, "<tr><th>%s</th><td class=\"words\">%s, %s</td><td>%s%s</td><td>%s</td><td>%s</td></tr>\n", what,
            run->method->name, ang_report_step_text(run->options.step_voxels, step), run->estimated ? "&asymp; " : "",
            ang_report_time_text(run->median_ms, time), ang_report_levels_text(run->error.p999, most),
            ang_report_levels_text(run->error.max, worst));
}

static void put_choices(FILE *out, const ang_report *report) {
    fputs("<table class=\"choice\"><thead><tr><th></th><th class=\"words\">method, step</th><th>time</th>"
          "<th>99.9 %<br>within</th><th>worst<br>pixel</th></tr></thead><tbody>\n",
          out);
    if (report->quick != report->recommended) put_choice(out, "to look around", report->quick);
    if (report->good) put_choice(out, "to keep", report->recommended);
    if (report->exact != report->recommended || !report->good) put_choice(out, "most exact", report->exact);
    fputs("</tbody></table>\n<p class=\"note\">Errors are in levels: 1/255 of the brightest. Differences below 1 level "
          "are lost when a picture is shown or saved in 8 bits; 8 levels can be seen where two pictures are "
          "compared.</p>\n",
          out);
}

static void put_hero(FILE *out, const ang_report *report, bool pictures) {
    ang_image image = {0};
    fputs("<h1>How exact is this picture, and how long does it take?</h1>\n<p class=\"under\">Preset ", out);
    ang_text_put_markup(out, report->picture.preset->name);
    fprintf(out, ", mode %s, %d x %d pixels, every method measured on this machine against an exact computation. ",
            ang_mode_name(report->picture.scene.mode), report->picture.scene.width, report->picture.scene.height);
    fputs("Not a medical device; not for diagnosis.</p>\n<div class=\"hero\">", out);
    bool drawn = pictures && ang_report_picture(report, report->recommended, &image);
    if (pictures && (drawn || ang_report_picture(report, report->exact, &image))) {
        fputs("<figure>", out);
        ang_report_put_picture(out, &image, report->picture.scene.background, "the picture", "picture");
        fprintf(out, "<figcaption>Drawn with %s.</figcaption></figure>\n",
                drawn ? "the setting named beside it" : "the most exact of the settings that were drawn as a whole");
        ang_image_clear(&image);
    }
    fputs("<div>\n", out);
    put_verdict(out, report);
    put_choices(out, report);
    for (size_t i = 0; i < report->notes.count; i++) {
        fputs("<p class=\"note\">", out);
        ang_text_put_markup(out, report->notes.text[i]);
        fputs("</p>\n", out);
    }
    fputs("</div></div>\n", out);
}

/* The drawing alone, without what only a file of its own needs; names of its parts are made its own, as a page has
 * several. */
static void put_svg(FILE *out, const char *svg, int number) {
    const char *at = strstr(svg, "<svg");
    for (; at && *at; at++) {
        if (strncmp(at, " xmlns", 6) == 0) {
            const char *quote = strpbrk(at, "\"'"), *end = quote ? strchr(quote + 1, *quote) : NULL;
            if (end) at = end + 1;
        }
        if (strncmp(at, "'gp", 3) == 0 || strncmp(at, "#gp", 3) == 0 || strncmp(at, "\"gp", 3) == 0) {
            fprintf(out, "%cp%d", *at, number);
            continue;
        }
        if (strncmp(at, "<title>", 7) == 0) {
            const char *end = strstr(at, "</title>");
            if (end) at = end + 8;
        }
        if (*at) fputc(*at, out);
    }
}

static void put_plot(FILE *out, char *const plots[], ang_report_plot_kind kind, const char *caption) {
    if (!plots[kind]) return;
    fputs("<figure>", out);
    put_svg(out, plots[kind], (int)kind);
    fprintf(out, "<figcaption>%s</figcaption></figure>\n", caption);
}

static void put_fronts(FILE *out, const ang_report *report) {
    static const char *const names[] = {"largest error", "99.9 %", "RMS"};
    for (int kind = 0; kind < ANG_REPORT_KINDS; kind++) {
        int count = 0;
        fprintf(out, "<li>by %s: ", names[kind]);
        /* From the fastest on: there are few. */
        double after = -INFINITY;
        for (;;) {
            const ang_report_run *next = NULL;
            for (size_t i = 0; i < report->run_count; i++) {
                const ang_report_run *run = &report->run[i];
                if (run->front[kind] && run->median_ms > after && (!next || run->median_ms < next->median_ms))
                    next = run;
            }
            if (!next) break;
            char step[16];
            fprintf(out, "%s%s %s", count++ ? ", " : "", next->method->name,
                    ang_report_step_text(next->options.step_voxels, step));
            after = next->median_ms;
        }
        fputs(count ? "</li>\n" : "none was timed</li>\n", out);
    }
}

static void put_times(FILE *out, const ang_report *report, char *const plots[]) {
    fputs("<h2>Error against run time</h2>\n<p>Down and to the left is better. A setting is on the Pareto front where "
          "no other is both faster and more exact (by over 1 %); filled points were timed, open ones are derived from "
          "a subset of "
          "pixels. Figures at the front are steps in voxels.</p>\n<div class=\"plots\">\n",
          out);
    put_plot(out, plots, ANG_REPORT_PLOT_MAX,
             "The worst pixel. Spread by single pixels; no bound for pictures of "
             "other scenes.");
    put_plot(out, plots, ANG_REPORT_PLOT_P999, "What 99.9 % of the pixels keep within: what is recommended by.");
    put_plot(out, plots, ANG_REPORT_PLOT_RMS, "The root of the mean squared error over pixels.");
    put_plot(out, plots, ANG_REPORT_PLOT_SAMPLES, "Samples a pixel: what a method skips and ends early.");
    fputs("</div>\n<p>The fronts, fastest first:</p>\n<ul>\n", out);
    put_fronts(out, report);
    fputs("</ul>\n<h3>All settings</h3>\n<p>Bold: on the front. Shaded: recommended. &asymp;: derived.</p>\n"
          "<div class=\"wide\">",
          out);
    ang_report_put_settings_table(out, report);
    fputs("</div>\n", out);
}

static void put_orders(FILE *out, const ang_report *report, char *const plots[]) {
    const ang_expected_order *expected = &report->expected;
    fputs("<h2>How errors fall with the step</h2>\n<p>Halving the step divides an error of order <i>p</i> by "
          "2<sup><i>p</i></sup>. Expected here: ",
          out);
    if (expected->least < expected->most)
        fprintf(out, "%g to %g, as %s.", expected->least, expected->most, expected->why);
    else
        fprintf(out, "%g, as %s.", expected->least, expected->why);
    fputs(" Fitted by least squares to RMS errors on the subset of pixels, at steps of 1 voxel and below", out);
    fputs(report->picture.scene.mode == ANG_MODE_DVR ? ", with every ray followed to its end.</p>\n" : ".</p>\n", out);
    fputs("<div class=\"plots\">", out);
    put_plot(out, plots, ANG_REPORT_PLOT_ORDERS, "Parallel to a dashed line: of that order.");
    fputs("</div>\n<div class=\"wide\">", out);
    ang_report_put_orders_table(out, report);
    fputs("</div>\n", out);
}

static void put_switches(FILE *out, const ang_report *report) {
    fputs("<h2>One thing switched, at a step of 1/2 voxel</h2>\n<p>What each part of a method costs and what it does "
          "to the picture. With another shading it is another picture, compared with its own exact one.</p>\n"
          "<div class=\"wide\">",
          out);
    ang_report_put_switches_table(out, report);
    fputs("</div>\n", out);
}

static void put_heat(FILE *out, const ang_report *report, const ang_image *image) {
    const ang_report_truth *truth = &report->truth;
    if (truth->whole.rgba) {
        ang_report_put_heat(out, image, &truth->whole, "error heat map");
        return;
    }
    ang_image part = {0};
    if (!ang_report_take_subset(image, truth->stride, truth->first_x, truth->first_y, &part, NULL)) return;
    ang_report_put_heat(out, &part, &truth->subset, "error heat map");
    ang_image_clear(&part);
}

static void put_errors(FILE *out, const ang_report_run *run, const char *name) {
    char most[32], rms[32], worst[32];
    fprintf(out, "<figcaption>%s: 99.9 %% within %s, RMS %s, worst %s</figcaption></figure>\n", name,
            ang_report_levels_text(run->error.p999, most), ang_report_levels_text(run->error.rms, rms),
            ang_report_levels_text(run->error.max, worst));
}

static void put_heat_scale(FILE *out) {
    fputs("<div class=\"scale\">", out);
    if (ang_report_put_heat_scale(out))
        fprintf(out, "<div><span>%g</span><span>0.1</span><span>1</span><span>10</span><span>%g levels</span></div>",
                ang_report_heat_least, ang_report_heat_most);
    fputs("</div>\n", out);
}

static void put_pictures(FILE *out, const ang_report *report) {
    fputs(
        "<h2>Where the errors are</h2>\n<p>Differences from the exact picture, in one logarithmic scale of colours for "
        "all; black is below its least.</p>\n",
        out);
    put_heat_scale(out);
    const ang_method *method = report->recommended ? report->recommended->method : NULL;
    if (method) fprintf(out, "<h3>%s over the steps</h3>\n<div class=\"row\">\n", method->name);
    for (int i = 0; method && i < ANG_REPORT_STEP_COUNT; i++) {
        const ang_report_run *run = ang_report_find(report, method, ANG_REPORT_STEPS, ang_report_steps[i], false);
        ang_image image = {0};
        if (!ang_report_picture(report, run, &image)) continue;
        char step[16], name[32];
        snprintf(name, sizeof name, "step %s", ang_report_step_text(ang_report_steps[i], step));
        fputs("<figure>", out);
        put_heat(out, report, &image);
        put_errors(out, run, name);
        ang_image_clear(&image);
    }
    fputs(method ? "</div>\n" : "", out);
    fputs("<h3>Every method at a step of 1/2 voxel</h3>\n<div class=\"row pairs\">\n", out);
    for (size_t m = 0; m < report->order_count; m++) {
        const ang_report_run *run =
            ang_report_find(report, report->order[m].method, ANG_REPORT_STEPS, ang_report_switch_step, false);
        ang_image image = {0};
        if (!ang_report_picture(report, run, &image)) continue;
        fputs("<figure>", out);
        ang_report_put_picture(out, &image, report->picture.scene.background, "the picture", "picture");
        fprintf(out, "<figcaption>%s</figcaption></figure>\n<figure>", run->method->name);
        put_heat(out, report, &image);
        put_errors(out, run, run->method->name);
        ang_image_clear(&image);
    }
    fputs("</div>\n", out);
}

static void put_method(FILE *out, const ang_report *report) {
    const ang_report_truth *truth = &report->truth;
    char time[32];
    fputs("<h2>How it was measured</h2>\n<ul>\n", out);
    fprintf(out,
            "<li>The exact picture is that of method <i>%s</i>: double precision, every cell and every knot of the "
            "transfer function integrated on its own. ",
            ang_method_reference.name);
    if (truth->whole.rgba)
        fputs("All pixels were computed.</li>\n", out);
    else
        fprintf(out,
                "All of its pixels would take about %s, so errors are those of a subset: %d of the pixels, one in %d "
                "along each axis. So &ldquo;99.9 %%&rdquo; and &ldquo;worst&rdquo; say less.</li>\n",
                ang_report_time_text(truth->whole_ms, time), truth->subset.width * truth->subset.height, truth->stride);
    fprintf(out,
            "<li>The subset, for steps below 1/8 voxel and for orders: %d x %d pixels, every %d%s along each axis from "
            "pixel (%d, %d) on, drawn by lot with seed 1. Times of such pictures (&asymp;) are those of the whole "
            "picture at 1/8 times the ratio of the subset's times, and so are their samples.</li>\n",
            truth->subset.width, truth->subset.height, truth->stride,
            truth->stride == 1   ? "st"
            : truth->stride == 2 ? "nd"
            : truth->stride == 3 ? "rd"
                                 : "th",
            truth->first_x, truth->first_y);
    fprintf(out,
            "<li>Times are medians of up to %d frames after one to warm up, with the reading of the picture from "
            "OpenGL; the methods took turns.</li>\n",
            ANG_REPORT_FRAMES);
    fprintf(out, "<li>Rays end at an opacity of %g where nothing else is said.</li>\n",
            report->picture.render.termination);
    fputs("<li>Errors are those of the premultiplied float picture before the background, of the channel that differs "
          "most; PSNR is over all four channels, SSIM of the luma (Wang et al. 2004).</li>\n</ul>\n"
          "<h3>The picture and the machine</h3>\n",
          out);
    ang_report_put_facts(out, report);
    fputs("<h3>Left out</h3>\n", out);
    ang_report_put_left_out(out, report);
}

bool ang_report_write_html(ang_report *report, char *const plots[ANG_REPORT_PLOTS], const char *path, ang_error *err) {
    char *text = NULL;
    size_t size = 0;
    bool pictures, heat;
    FILE *out = open_memstream(&text, &size);
    if (!out) return ang_fail(err, ANG_LIMIT, "no memory for %s", path);
    ang_report_can_picture(report, &pictures, &heat);
    put_style(out);
    put_hero(out, report, pictures);
    put_times(out, report, plots);
    put_orders(out, report, plots);
    put_switches(out, report);
    if (heat) put_pictures(out, report);
    put_method(out, report);
    fputs("</body></html>\n", out);
    bool whole = fclose(out) == 0 && text;
    bool done = whole ? ang_file_replace(path, text, size, err) : ang_fail(err, ANG_LIMIT, "no memory for %s", path);
    free(text);
    return done;
}
