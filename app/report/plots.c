/* The plots of a report, made by gnuplot. */
#include "app/report/report.h"

#include "io/gnuplot.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

/* Colours that the colour-blind can tell apart (Okabe & Ito 2008), and gnuplot's points, filled and open. */
static const char *const colours[] = {"#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#000000"};
static const int filled[] = {7, 5, 9, 13, 11, 15}, open_points[] = {6, 4, 8, 12, 10, 14};
enum { COLOURS = sizeof colours / sizeof *colours, POINTS = sizeof filled / sizeof *filled };

const char *ang_report_plot_file(ang_report_plot_kind kind) {
    static const char *const names[] = {"error-max.svg", "error-p999.svg", "error-rms.svg", "orders.svg",
                                        "samples.svg"};
    return names[kind];
}

/* More methods than this would fill no plot that anybody could read. */
enum { MOST_METHODS = 32 };
static size_t method_count(const ang_report *report) {
    return report->order_count < MOST_METHODS ? report->order_count : MOST_METHODS;
}

static void begin(FILE *out, const char *x, const char *y) {
    fprintf(out,
            "set terminal svg size 620,430 dynamic noenhanced font 'sans-serif,13' linewidth 1.3 background '#ffffff'\n"
            "set encoding utf8\nset border 3 linecolor '#555555'\nset tics nomirror textcolor '#333333'\n"
            "set grid linecolor '#e2e2e2' linetype 1 linewidth 0.6\nset key top right Left reverse samplen 2\n"
            "set logscale xy\nset format y '%%g'\nset format x '%%g'\nset xlabel '%s'\nset ylabel '%s'\n",
            x, y);
}

/* A block of data with a row for each run of a method for which `take` gives x > 0 and y > 0. The number of rows. */
typedef bool take_point(const ang_report *report, const ang_report_run *run, int kind, double *x, double *y);

static int put_points(FILE *out, const ang_report *report, const ang_method *method, int kind, take_point *take,
                      const char *name, int which) {
    int rows = 0;
    fprintf(out, "$%s << END\n", name);
    for (size_t i = 0; i < report->run_count; i++) {
        const ang_report_run *run = &report->run[i];
        double x, y;
        if ((method && run->method != method) || !ang_report_is_point(run) || !take(report, run, kind, &x, &y))
            continue;
        if (!(isfinite(x) && x > 0 && isfinite(y) && y > 0)) continue;
        if (which >= 0 && run->estimated != (which == 1)) continue;
        char step[16];
        fprintf(out, "%.9g %.9g %s\n", x, y, ang_report_step_text(run->options.step_voxels, step));
        rows++;
    }
    fputs("END\n", out);
    return rows;
}

static bool error_over_time(const ang_report *report, const ang_report_run *run, int kind, double *x, double *y) {
    (void)report;
    *x = run->median_ms;
    *y = ang_report_error(run, (ang_report_kind)kind);
    return true;
}

static bool front_only(const ang_report *report, const ang_report_run *run, int kind, double *x, double *y) {
    return run->front[kind] && error_over_time(report, run, kind, x, y);
}

static bool samples_over_step(const ang_report *report, const ang_report_run *run, int kind, double *x, double *y) {
    (void)report, (void)kind;
    *x = run->options.step_voxels;
    *y = run->samples_per_pixel;
    return true;
}

/* Each method's line, then its timed points and those that are derived. */
static bool put_methods(FILE *out, const ang_report *report, int kind, take_point *take, int rows[][3]) {
    bool any = false;
    for (size_t m = 0; m < method_count(report); m++)
        for (int which = -1; which < 2; which++) {
            char name[32];
            snprintf(name, sizeof name, "m%zu_%d", m, which + 1);
            rows[m][which + 1] = put_points(out, report, report->order[m].method, kind, take, name, which);
            any = any || rows[m][which + 1] > 0;
        }
    return any;
}

static void plot_methods(FILE *out, const ang_report *report, int rows[][3], bool labels) {
    for (size_t m = 0; m < method_count(report); m++) {
        const char *colour = colours[m % COLOURS];
        if (rows[m][0] > 0) fprintf(out, ", $m%zu_0 using 1:2 with lines linecolor '%s' notitle", m, colour);
        if (rows[m][1] > 0)
            fprintf(out, ", $m%zu_1 using 1:2 with points pointtype %d pointsize 0.8 linecolor '%s' title '%s'", m,
                    filled[m % POINTS], colour, report->order[m].method->name);
        if (rows[m][2] > 0)
            fprintf(out, ", $m%zu_2 using 1:2 with points pointtype %d pointsize 0.8 linecolor '%s' %s%s%s", m,
                    open_points[m % POINTS], colour, rows[m][1] > 0 ? "notitle" : "title '",
                    rows[m][1] > 0 ? "" : report->order[m].method->name, rows[m][1] > 0 ? "" : "'");
    }
    if (labels) fputs(", $front using 1:2:3 with labels left offset 0.7,0.5 textcolor '#333333' notitle", out);
    fputc('\n', out);
}

static void put_steps_axis(FILE *out) {
    fputs("set logscale x 2\nset xtics (", out);
    for (int i = 0; i < ANG_REPORT_STEP_COUNT; i++) {
        char text[16];
        fprintf(out, "%s'%s' %.9g", i ? ", " : "", ang_report_step_text(ang_report_steps[i], text),
                ang_report_steps[i]);
    }
    fprintf(out, ")\nset xrange [%g:%g]\n", 0.8 * ang_report_steps[ANG_REPORT_STEP_COUNT - 1],
            1.25 * ang_report_steps[0]);
}

/* The front lies under the methods' points as a broad pale band; the steps are written there alone, or they would lie
 * on one another. What an 8-bit picture cannot show lies below a line. */
static bool put_error(FILE *out, const ang_report *report, int kind) {
    static const char *const labels[] = {"largest error of a pixel (levels of 255)",
                                         "error of 99.9 % of the pixels (levels of 255)", "RMS error (levels of 255)"};
    int rows[MOST_METHODS][3];
    begin(out, "median time of a picture (ms)", labels[kind]);
    int on_front = put_points(out, report, NULL, kind, front_only, "front", -1);
    if (!put_methods(out, report, kind, error_over_time, rows)) return false;
    fputs("set yrange [*<0.3:*]\nset arrow from graph 0, first 0.5 to graph 1, first 0.5 nohead dashtype 2 linecolor "
          "'#999999'\nset label 'rounding to 8 bits' at graph 0.01, first 0.5 left offset 0,-0.6 textcolor '#777777'\n"
          "plot ",
          out);
    if (on_front)
        fputs("$front using 1:2 smooth unique with lines linewidth 9 linecolor '#dddddd' title 'Pareto front', ", out);
    fputs("NaN notitle", out);
    plot_methods(out, report, rows, on_front > 0);
    return true;
}

static bool put_samples(FILE *out, const ang_report *report) {
    int rows[MOST_METHODS][3];
    begin(out, "step (voxels)", "samples a pixel");
    put_steps_axis(out);
    if (!put_methods(out, report, 0, samples_over_step, rows)) return false;
    fputs("plot NaN notitle", out);
    plot_methods(out, report, rows, false);
    return true;
}

/* Errors of the subset over steps, with the lines that were fitted and the slopes of orders 1 and 2. */
static bool put_orders(FILE *out, const ang_report *report) {
    double highest = 0;
    begin(out, "step (voxels)", "RMS error on the subset of pixels (levels of 255)");
    put_steps_axis(out);
    fputs("set key bottom right\n", out);
    for (size_t m = 0; m < method_count(report); m++) {
        fprintf(out, "$m%zu << END\n", m);
        for (int i = 0; i < ANG_REPORT_STEP_COUNT; i++) {
            double rms = report->order[m].rms[i];
            if (!(isfinite(rms) && rms > 0)) continue;
            fprintf(out, "%.9g %.9g\n", ang_report_steps[i], rms);
            highest = fmax(highest, rms);
        }
        fputs("END\n", out);
    }
    if (!(highest > 0)) return false;
    double top = ang_report_steps[0];
    fprintf(out,
            "plot %.9g * (x / %g) with lines dashtype 3 linecolor '#888888' title 'order 1', "
            "%.9g * (x / %g) ** 2 with lines dashtype 2 linecolor '#888888' title 'order 2'",
            highest, top, highest, top);
    for (size_t m = 0; m < method_count(report); m++)
        fprintf(out, ", $m%zu using 1:2 with linespoints pointtype %d pointsize 0.8 linecolor '%s' title '%s'", m,
                filled[m % POINTS], colours[m % COLOURS], report->order[m].method->name);
    fputc('\n', out);
    return true;
}

static char *plot(ang_report *report, ang_report_plot_kind kind) {
    char *script = NULL;
    size_t size = 0;
    FILE *out = open_memstream(&script, &size);
    if (!out) return NULL;
    bool any = kind == ANG_REPORT_PLOT_ORDERS    ? put_orders(out, report)
               : kind == ANG_REPORT_PLOT_SAMPLES ? put_samples(out, report)
                                                 : put_error(out, report, (int)kind);
    ang_error err = {0};
    char *svg = NULL;
    if (fclose(out) == 0 && any && script && !ang_gnuplot_run(script, &svg, &err))
        ang_notes_add(&report->notes, "a plot is missing: %s", err.message);
    free(script);
    return svg;
}

void ang_report_plot(ang_report *report, char *plots[ANG_REPORT_PLOTS]) {
    const char *why = NULL;
    bool there = ang_gnuplot_there(&why);
    if (!there) ang_notes_add(&report->notes, "there are no plots: %s", why);
    for (int kind = 0; kind < ANG_REPORT_PLOTS; kind++)
        plots[kind] = there ? plot(report, (ang_report_plot_kind)kind) : NULL;
}
