#include "core/selfcheck/selfcheck.h"

#include "core/base/clock.h"
#include "core/base/memory.h"
#include "core/selfcheck/bench.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char doing[] = "checking";

const char *ang_verdict_name(ang_verdict verdict) {
    static const char *const names[] = {"ok", "red", "not applicable"};
    return names[verdict];
}

/* One run of the battery. */
typedef struct battery {
    const ang_selfcheck_options *options;
    const ang_method *const *methods;
    ang_selfcheck_report *report;
    const ang_progress *sink;
    int planned; /* runs of cases, as far as is known */
    int room;    /* results */
} battery;

static bool is_wanted(const ang_selfcheck_options *options, int number) {
    for (int i = 0; options->cases && i < options->case_count; i++)
        if (options->cases[i] == number) return true;
    return !options->cases;
}

/* Progress within a case only asks whether to go on. */
static bool update_within(void *context, const char *what, double fraction) {
    (void)what, (void)fraction;
    const battery *run = context;
    return ang_progress_update(run->sink, doing, (double)run->report->count / run->planned);
}

/* Runs one case and adds its result. False with ANG_LIMIT or ANG_INTERRUPTED. */
static bool run_case(battery *run, const ang_selfcheck_case *which, ang_gl *gl, const ang_method *method,
                     ang_error *err) {
    ang_selfcheck_report *report = run->report;
    if (report->count == run->room) return ang_fail(err, ANG_LIMIT, "no room for more results");
    if (!ang_progress_update(run->sink, doing, (double)report->count / run->planned))
        return ang_fail(err, ANG_INTERRUPTED, "interrupted while checking");
    ang_selfcheck_result *result = &report->results[report->count];
    *result = (ang_selfcheck_result){.which = which, .method = method, .place = report->place_count - 1};
    const char *unless = method ? ang_selfcheck_unless(which, method) : NULL;
    if (unless) {
        result->verdict = ANG_VERDICT_NOT_APPLICABLE;
        snprintf(result->note, sizeof result->note, "%s", unless);
        report->count++;
        return true;
    }
    ang_progress within = {update_within, run};
    ang_bench bench = {.gl = gl, .method = method, .threads = run->options->threads, .progress = &within};
    ang_error failure = {0};
    double start = ang_now_ms();
    bool done = which->run(&bench, &failure);
    result->ms = ang_now_ms() - start;
    if (!done && failure.code == ANG_INTERRUPTED) return ang_fail(err, ANG_INTERRUPTED, "interrupted while checking");
    if (!done) snprintf(result->note, sizeof result->note, "%s", failure.message);
    result->worst = bench.worst;
    /* A case that measured nothing has shown nothing. */
    bool ok = done && bench.worst.what[0] && ang_measure_holds(&bench.worst);
    result->verdict = ok ? ANG_VERDICT_OK : ANG_VERDICT_RED;
    report->red += !ok;
    report->count++;
    return true;
}

/* Runs all cases that belong to a place; `gl` is NULL without OpenGL. */
static bool run_place(battery *run, ang_gl *gl, ang_error *err) {
    int count;
    const ang_selfcheck_case *cases = ang_selfcheck_cases(&count);
    for (int c = 0; c < count; c++) {
        if (!is_wanted(run->options, cases[c].number)) continue;
        if (cases[c].alone && !gl && !run_case(run, &cases[c], NULL, NULL, err)) return false;
        for (const ang_method *const *method = run->methods; *method && !cases[c].alone; method++)
            if ((*method)->needs_gl == (gl != NULL) && !run_case(run, &cases[c], gl, *method, err)) return false;
    }
    return true;
}

static bool run_backend(battery *run, ang_backend backend, ang_error *err) {
    ang_selfcheck_place *place = &run->report->places[run->report->place_count++];
    *place = (ang_selfcheck_place){.backend = backend, .words = "no OpenGL"};
    if (backend == ANG_BACKEND_NONE) {
        place->here = true;
        return run_place(run, NULL, err);
    }
    ang_error missing = {0};
    ang_gl *gl = ang_gl_create(backend, &missing);
    snprintf(place->words, sizeof place->words, "%s", gl ? ang_gl_backend(gl) : missing.message);
    if (!gl) return true;
    place->here = true;
    snprintf(place->renderer, sizeof place->renderer, "%s", ang_gl_renderer(gl));
    snprintf(place->version, sizeof place->version, "%s", ang_gl_version(gl));
    bool done = run_place(run, gl, err);
    ang_gl_destroy(gl);
    return done;
}

/* How many runs of cases there are at most. */
static int count_runs(const battery *run, int places) {
    int count, planned = 0;
    const ang_selfcheck_case *cases = ang_selfcheck_cases(&count);
    for (int c = 0; c < count; c++) {
        if (!is_wanted(run->options, cases[c].number)) continue;
        planned += cases[c].alone;
        for (const ang_method *const *method = run->methods; *method && !cases[c].alone; method++)
            planned += (*method)->needs_gl ? places : 1;
    }
    return planned;
}

bool ang_selfcheck_run(const ang_selfcheck_options *options, ang_selfcheck_report *report, const ang_progress *progress,
                       ang_error *err) {
    battery run = {.options = options,
                   .methods = options->methods ? options->methods : ang_methods(),
                   .report = report,
                   .sink = progress};
    *report = (ang_selfcheck_report){0};
    /* Every backend there is, so that later ones join. */
    ang_backend backends[ANG_SELFCHECK_PLACES] = {ANG_BACKEND_NONE};
    int places = 1;
    for (int b = ANG_BACKEND_AUTO + 1; b < ANG_BACKEND_NONE && places < ANG_SELFCHECK_PLACES; b++)
        if (options->backend == ANG_BACKEND_AUTO || options->backend == (ang_backend)b)
            backends[places++] = (ang_backend)b;
    run.planned = run.room = count_runs(&run, places - 1);
    report->results = ang_alloc((size_t)run.room + 1, sizeof *report->results, "results", err);
    if (!report->results) return false;
    double start = ang_now_ms();
    bool done = true;
    for (int p = 0; p < places && done; p++) done = run_backend(&run, backends[p], err);
    report->ms = ang_now_ms() - start;
    return done &&
           (ang_progress_update(progress, doing, 1) || ang_fail(err, ANG_INTERRUPTED, "interrupted while checking"));
}

void ang_selfcheck_report_clear(ang_selfcheck_report *report) {
    free(report->results);
    *report = (ang_selfcheck_report){0};
}
