/* angioscope report: error against run time of every method, for one picture. */
#include "app/report/report.h"

#include "app/picture_state.h"
#include "app/verbs.h"
#include "core/base/clock.h"
#include "core/base/parallel.h"
#include "core/render/filtering.h"
#include "io/machine.h"
#include "io/replace.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static const char *const files[] = {"report.html", "report.csv", "report.json"};

/* DIR/file; false with ANG_USAGE where the path is too long. */
static bool path_of(const ang_options *options, const char *file, char *path, size_t size, ang_error *err) {
    int length = snprintf(path, size, "%s/%s", options->output, file);
    return (length > 0 && (size_t)length < size) || ang_fail(err, ANG_USAGE, "-o: the folder's path is too long");
}

static bool check_output(const ang_options *options, const char *file, ang_error *err) {
    char path[4096];
    if (!path_of(options, file, path, sizeof path, err) || !ang_file_replaceable(path, err)) return false;
    return !ang_load_reads(options->arguments[0], path) ||
           ang_fail(err, ANG_USAGE, "-o %s: %s in it is read as input; give another folder", options->output, file);
}

static bool check_outputs(const ang_options *options, ang_error *err) {
    if (strlen(options->output) > 4000) return ang_fail(err, ANG_USAGE, "-o: the folder's path is too long");
    if (!ang_folder_make(options->output, err)) return false;
    for (size_t i = 0; i < sizeof files / sizeof *files; i++)
        if (!check_output(options, files[i], err)) return false;
    for (int kind = 0; kind < ANG_REPORT_PLOTS; kind++)
        if (!check_output(options, ang_report_plot_file((ang_report_plot_kind)kind), err)) return false;
    return true;
}

static bool open_machine(ang_report *report, ang_error *err) {
    const ang_options *options = report->options;
    ang_backend backend = (ang_backend)ang_backend_from_name(options->backend);
    report->threads = ang_thread_count(options->threads);
    ang_machine_processor(report->processor, sizeof report->processor);
    if (backend == ANG_BACKEND_NONE) return true;
    report->gl = ang_gl_create(backend, err);
    if (!report->gl) return false;
    ang_error failure = {0};
    report->filter_bits = ang_gl_filter_bits(report->gl, &report->filter_deviation, &failure);
    if (report->filter_bits == 0)
        ang_notes_add(&report->notes, "how finely the texture unit interpolates is not known: %s", failure.message);
    return true;
}

static bool prepare(ang_report *report, ang_error *err) {
    if (!ang_picture_open(report->options, report->progress, &report->volume, &report->input, &report->picture,
                          &report->load_ms, err))
        return false;
    ang_state_matches(report->state, &report->input, &report->notes);
    if (!open_machine(report, err) || !ang_report_plan(report, err)) return false;
    if (report->run_count == 0)
        return ang_fail(err, ANG_USAGE, "--method %s: is what others are compared with; choose another",
                        report->options->method);
    report->cache = ang_report_cache_open(report, err);
    return report->cache != NULL;
}

/* What was measured beside other work is so for good, until it is measured again. */
static void note_load(ang_report *report) {
    const cJSON *before = ang_report_cache_get(report->cache, "load");
    if (cJSON_IsNumber(before)) report->load = fmax(report->load, before->valuedouble);
    if (isfinite(report->load)) ang_report_cache_put(report->cache, "load", cJSON_CreateNumber(report->load));
    if (report->load > 0.5 * report->threads)
        ang_notes_add(
            &report->notes,
            "The machine was busy with other work before anything was measured (load %.1f on %d processor%s): "
            "times may be too long and scatter.",
            report->load, report->threads, ang_plural(report->threads));
}

/* Whatever happens, what was measured is not to be measured again. */
static bool measure(ang_report *report, ang_error *err) {
    ang_error failure = {0};
    bool done = ang_report_find_truth(report, &failure) && ang_report_measure(report, &failure);
    bool saved = ang_report_cache_save(report->cache, true, done ? err : NULL);
    if (!done) *err = failure;
    return done && saved;
}

static void note_limits(ang_report *report) {
    size_t left = 0;
    for (size_t i = 0; i < report->run_count; i++) {
        const ang_report_run *run = &report->run[i];
        left += !run->drawn || (ang_report_is_timed(run) && run->frames == 0);
    }
    if (left)
        ang_notes_add(&report->notes,
                      "%zu of %zu settings were left out or not timed; they are listed at the end with the reasons. "
                      "The same command again takes over what there is and goes on.",
                      left, report->run_count);
    if (!report->truth.whole.rgba)
        ang_notes_add(&report->notes,
                      "Errors are those of a subset of %d pixels: the exact computation of all would take too long.",
                      report->truth.subset.width * report->truth.subset.height);
}

/* `svg` NULL: there is no plot. */
static bool write_plot(const ang_report *report, int kind, const char *svg, ang_error *err) {
    char path[4096];
    if (!path_of(report->options, ang_report_plot_file((ang_report_plot_kind)kind), path, sizeof path, err))
        return false;
    if (svg) return ang_file_replace(path, svg, strlen(svg), err);
    unlink(path); /* that of another report */
    return true;
}

static bool write_all(ang_report *report, ang_error *err) {
    char path[sizeof files / sizeof *files][4096], *plots[ANG_REPORT_PLOTS] = {0};
    bool good = true;
    for (size_t i = 0; i < sizeof files / sizeof *files; i++)
        good = good && path_of(report->options, files[i], path[i], sizeof path[i], err);
    if (!good) return false;
    ang_report_plot(report, plots);
    for (int kind = 0; kind < ANG_REPORT_PLOTS; kind++) good = good && write_plot(report, kind, plots[kind], err);
    good = good && ang_report_write_csv(report, path[1], err) && ang_report_write_json(report, path[2], err) &&
           ang_report_write_html(report, plots, path[0], err);
    for (int kind = 0; kind < ANG_REPORT_PLOTS; kind++) free(plots[kind]);
    if (!good) return false;
    ang_report_cache_prune(report->cache);
    if (!ang_report_cache_save(report->cache, true, err)) return false;
    if (!report->options->quiet) fprintf(stderr, "%s\n", path[0]);
    return true;
}

static bool run_all(ang_report *report, ang_error *err) {
    const ang_options *options = report->options;
    if (options->mode && strcmp(options->mode, "lookups") == 0)
        return ang_fail(err, ANG_USAGE, "--mode lookups: a report is about pictures; it counts samples by itself");
    if (!check_outputs(options, err) || !prepare(report, err) || !measure(report, err) ||
        !ang_report_judge(report, err))
        return false;
    note_load(report);
    note_limits(report);
    return write_all(report, err);
}

/* The state that --state names, if any, says what the command line leaves open. */
static bool run_stated(ang_report *report, ang_stated *stated, ang_error *err) {
    if (!ang_stated_open(ANG_VERB_REPORT, report->options, stated, err)) return false;
    report->options = &stated->options;
    if (!ang_app_arguments(report->options, 1, "report: give one file or folder to read", err)) return false;
    report->state = &stated->state;
    ang_stated_hand_preset(stated, &report->picture);
    return run_all(report, err);
}

int ang_app_report(const ang_options *options, ang_error *err) {
    if (!options->output) {
        ang_fail(err, ANG_USAGE, "report: give a folder to write with -o DIR");
        return ANG_USAGE;
    }
    ang_stated stated;
    ang_report report = {.options = options,
                         .progress = ang_app_progress_start(options->quiet),
                         .begun_ms = ang_now_ms(),
                         .limit_ms = options->time_limit * 60e3,
                         .load = ang_machine_load()};
    bool done = run_stated(&report, &stated, err);
    ang_app_progress_end(report.progress);
    if (!options->quiet) {
        ang_app_say(&report.input.warnings, "warning: ", done ? NULL : err);
        if (done) ang_app_say(&report.notes, "note: ", NULL);
        if (options->verbose) ang_app_say(&report.input.assumptions, "note: ", NULL);
    }
    if (report.gl) ang_gl_destroy(report.gl);
    ang_report_cache_close(report.cache);
    ang_report_truth_clear(&report.truth);
    ang_picture_clear(&report.picture);
    ang_load_report_clear(&report.input);
    ang_notes_clear(&report.notes);
    ang_volume_free(report.volume);
    ang_stated_clear(&stated);
    free(report.order);
    free(report.run);
    return done ? ANG_OK : (int)err->code;
}
