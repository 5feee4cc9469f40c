/* angioscope selfcheck: what this machine's OpenGL makes of stiff and extreme scenes, by every method. */
#include "core/selfcheck/selfcheck.h"
#include "app/verbs.h"
#include "io/json.h"
#include "io/replace.h"

#include <cjson/cJSON.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_CASES = 64, MOST_COLUMNS = 16 };

/* "3.1e-07 <= 1e-06", "1.98 in 1.9..2.1", "2.7 >= 2". */
static void describe_measure(const ang_measure *m, char *text, size_t size) {
    bool holds = ang_measure_holds(m);
    if (!m->what[0])
        snprintf(text, size, "nothing measured");
    else if (m->low == 0)
        snprintf(text, size, "%.2g %s %.3g", m->value, holds ? "<=" : ">", m->high);
    else if (isinf(m->high))
        snprintf(text, size, "%.3g %s %.3g", m->value, holds ? ">=" : "<", m->low);
    else
        snprintf(text, size, "%.3g %sin %.3g..%.3g", m->value, holds ? "" : "not ", m->low, m->high);
}

static void print_cell(const ang_selfcheck_result *result, FILE *out) {
    char measure[64], cell[80];
    describe_measure(&result->worst, measure, sizeof measure);
    if (result->verdict == ANG_VERDICT_NOT_APPLICABLE)
        snprintf(cell, sizeof cell, "-");
    else
        snprintf(cell, sizeof cell, "%s %s", result->verdict == ANG_VERDICT_OK ? "ok" : "RED", measure);
    fprintf(out, "  %-22s", cell);
}

static const char *column_name(const ang_method *method) { return method ? method->name : "(no method)"; }

/* The methods that have results at a place, in their order. */
static int find_columns(const ang_selfcheck_report *report, int place, const ang_method *columns[MOST_COLUMNS]) {
    int count = 0;
    for (int r = 0; r < report->count; r++) {
        if (report->results[r].place != place) continue;
        int c = 0;
        while (c < count && columns[c] != report->results[r].method) c++;
        if (c == count && count < MOST_COLUMNS) columns[count++] = report->results[r].method;
    }
    return count;
}

static const ang_selfcheck_result *find_result(const ang_selfcheck_report *report, int place,
                                               const ang_selfcheck_case *which, const ang_method *method) {
    for (int r = 0; r < report->count; r++) {
        const ang_selfcheck_result *result = &report->results[r];
        if (result->place == place && result->which == which && result->method == method) return result;
    }
    return NULL;
}

static void print_place(const ang_selfcheck_report *report, int place, FILE *out) {
    const ang_selfcheck_place *at = &report->places[place];
    if (!at->here) {
        fprintf(out, "%s: not here (%s)\n\n", ang_backend_name(at->backend), at->words);
        return;
    }
    fprintf(out, "%s%s%s%s%s\n", at->words, at->renderer[0] ? ": " : "", at->renderer, at->version[0] ? ", GL " : "",
            at->version);
    const ang_method *columns[MOST_COLUMNS];
    int count, column_count = find_columns(report, place, columns);
    const ang_selfcheck_case *cases = ang_selfcheck_cases(&count);
    fprintf(out, "%3s %-40s", "#", "case");
    for (int c = 0; c < column_count; c++) fprintf(out, "  %-22s", column_name(columns[c]));
    fputc('\n', out);
    for (int k = 0; k < count; k++) {
        bool any = false;
        for (int c = 0; c < column_count; c++) any = any || find_result(report, place, &cases[k], columns[c]);
        if (!any) continue;
        fprintf(out, "%3d %-40s", cases[k].number, cases[k].name);
        for (int c = 0; c < column_count; c++) {
            const ang_selfcheck_result *result = find_result(report, place, &cases[k], columns[c]);
            if (result)
                print_cell(result, out);
            else
                fprintf(out, "  %-22s", "");
        }
        fputc('\n', out);
    }
    fputc('\n', out);
}

/* Why cases do not apply, once for each method, whatever the places. */
static void print_reasons(const ang_selfcheck_report *report, FILE *out) {
    for (int r = 0; r < report->count; r++) {
        const ang_selfcheck_result *result = &report->results[r];
        if (result->verdict != ANG_VERDICT_NOT_APPLICABLE) continue;
        bool said = false;
        for (int s = 0; s < r; s++)
            said = said || (report->results[s].which == result->which && report->results[s].method == result->method);
        if (!said)
            fprintf(out, "  - case %d does not apply to %s: %s\n", result->which->number, column_name(result->method),
                    result->note);
    }
}

static void print_reds(const ang_selfcheck_report *report, FILE *out) {
    for (int r = 0; r < report->count; r++) {
        const ang_selfcheck_result *result = &report->results[r];
        if (result->verdict != ANG_VERDICT_RED) continue;
        char measure[64];
        describe_measure(&result->worst, measure, sizeof measure);
        fprintf(out, "RED case %d, %s, %s, %s: ", result->which->number, result->which->name,
                column_name(result->method), report->places[result->place].words);
        if (result->note[0])
            fprintf(out, "%s.", result->note);
        else
            fprintf(out, "%s (%s).", measure, result->worst.what);
        fprintf(out, " %s\n", result->which->means);
    }
}

static int count_verdicts(const ang_selfcheck_report *report, ang_verdict verdict) {
    int count = 0;
    for (int r = 0; r < report->count; r++) count += report->results[r].verdict == verdict;
    return count;
}

static void print_text(const ang_selfcheck_report *report, FILE *out) {
    for (int place = 0; place < report->place_count; place++) print_place(report, place, out);
    print_reasons(report, out);
    print_reds(report, out);
    fprintf(out, "%d ok, %d red, %d do not apply; %.1f s\n", count_verdicts(report, ANG_VERDICT_OK), report->red,
            count_verdicts(report, ANG_VERDICT_NOT_APPLICABLE), report->ms / 1000);
}

static cJSON *place_json(const ang_selfcheck_place *place) {
    cJSON *out = cJSON_CreateObject();
    cJSON_AddStringToObject(out, "backend", ang_backend_name(place->backend));
    cJSON_AddBoolToObject(out, "here", place->here);
    cJSON_AddStringToObject(out, place->here ? "words" : "why", place->words);
    if (place->renderer[0]) {
        cJSON_AddStringToObject(out, "gl_renderer", place->renderer);
        cJSON_AddStringToObject(out, "gl_version", place->version);
    }
    return out;
}

static cJSON *result_json(const ang_selfcheck_report *report, const ang_selfcheck_result *result) {
    cJSON *out = cJSON_CreateObject();
    cJSON_AddStringToObject(out, "backend", ang_backend_name(report->places[result->place].backend));
    cJSON_AddItemToObject(out, "method",
                          result->method ? cJSON_CreateString(result->method->name) : cJSON_CreateNull());
    cJSON_AddStringToObject(out, "verdict", ang_verdict_name(result->verdict));
    if (result->worst.what[0]) {
        ang_json_add_number(out, "measured", result->worst.value);
        ang_json_add_number(out, "low", result->worst.low);
        ang_json_add_number(out, "high", result->worst.high);
        cJSON_AddStringToObject(out, "what", result->worst.what);
    }
    if (result->note[0]) cJSON_AddStringToObject(out, "note", result->note);
    ang_json_add_number(out, "time_ms", result->ms);
    return out;
}

static cJSON *case_json(const ang_selfcheck_report *report, const ang_selfcheck_case *which) {
    cJSON *out = cJSON_CreateObject();
    cJSON_AddNumberToObject(out, "number", which->number);
    cJSON_AddStringToObject(out, "name", which->name);
    cJSON_AddStringToObject(out, "expected", which->expected);
    cJSON_AddStringToObject(out, "tolerance", which->allowed);
    cJSON_AddStringToObject(out, "red_means", which->means);
    cJSON *results = cJSON_AddArrayToObject(out, "results");
    for (int r = 0; r < report->count; r++)
        if (report->results[r].which == which) cJSON_AddItemToArray(results, result_json(report, &report->results[r]));
    return out;
}

static bool write_json(const char *path, const ang_selfcheck_report *report, ang_error *err) {
    cJSON *root = cJSON_CreateObject();
    cJSON_AddStringToObject(root, "version", ANG_VERSION);
    cJSON *backends = cJSON_AddArrayToObject(root, "backends");
    for (int p = 0; p < report->place_count; p++) cJSON_AddItemToArray(backends, place_json(&report->places[p]));
    cJSON *list = cJSON_AddArrayToObject(root, "cases");
    int count;
    const ang_selfcheck_case *cases = ang_selfcheck_cases(&count);
    for (int c = 0; c < count; c++) {
        cJSON *entry = case_json(report, &cases[c]);
        if (cJSON_GetArraySize(cJSON_GetObjectItem(entry, "results")) > 0)
            cJSON_AddItemToArray(list, entry);
        else
            cJSON_Delete(entry);
    }
    cJSON_AddNumberToObject(root, "ok", count_verdicts(report, ANG_VERDICT_OK));
    cJSON_AddNumberToObject(root, "red", report->red);
    ang_json_add_number(root, "time_ms", report->ms);
    char *text = cJSON_Print(root);
    cJSON_Delete(root);
    if (!text) return ang_fail(err, ANG_LIMIT, "no memory for the JSON");
    bool done = strcmp(path, "-") == 0
                    ? puts(text) >= 0 || ang_fail(err, ANG_OUTPUT, "standard output cannot be written")
                    : ang_file_replace(path, text, strlen(text), err);
    free(text);
    return done;
}

/* --cases into numbers that exist; all where it is not given. */
static bool read_cases(const ang_options *options, int numbers[MOST_CASES], ang_selfcheck_options *how,
                       ang_error *err) {
    double given[MOST_CASES];
    int count, known;
    if (!options->cases) return true;
    if (!ang_app_parse_numbers("cases", options->cases, 1, MOST_CASES, given, &count, err)) return false;
    const ang_selfcheck_case *cases = ang_selfcheck_cases(&known);
    for (int i = 0; i < count; i++) {
        int c = 0;
        while (c < known && !(fabs(given[i] - cases[c].number) <= 0)) c++;
        if (c == known)
            return ang_fail(err, ANG_USAGE, "--cases %s: there is no case %g; they are numbered %d to %d",
                            options->cases, given[i], cases[0].number, cases[known - 1].number);
        numbers[i] = cases[c].number;
    }
    how->cases = numbers;
    how->case_count = count;
    return true;
}

/* Whether the OpenGL that was asked for is there. */
static bool check_places(const ang_selfcheck_report *report, ang_error *err) {
    bool asked = false, here = false;
    const char *why = "";
    for (int p = 0; p < report->place_count; p++) {
        const ang_selfcheck_place *place = &report->places[p];
        if (place->backend == ANG_BACKEND_NONE) continue;
        asked = true;
        here = here || place->here;
        if (!place->here) why = place->words;
    }
    return !asked || here || ang_fail(err, ANG_GL, "%s", why);
}

int ang_app_selfcheck(const ang_options *options, ang_error *err) {
    int numbers[MOST_CASES];
    ang_selfcheck_options how = {.backend = (ang_backend)ang_backend_from_name(options->backend),
                                 .threads = options->threads};
    bool to_stdout = options->json && strcmp(options->json, "-") == 0;
    if (!ang_app_arguments(options, 0, "selfcheck takes no files: it makes its own volumes", err) ||
        !read_cases(options, numbers, &how, err) ||
        (options->json && !to_stdout && !ang_file_replaceable(options->json, err)))
        return (int)err->code;
    ang_selfcheck_report report = {0};
    ang_app_progress *progress = ang_app_progress_start(options->quiet);
    bool done = ang_selfcheck_run(&how, &report, ang_app_progress_sink(progress), err);
    ang_app_progress_end(progress);
    if (done && !to_stdout) print_text(&report, stdout);
    done = done && (!options->json || write_json(options->json, &report, err)) && check_places(&report, err);
    if (done && report.red > 0) {
        fflush(stdout); /* the table before the error */
        if (to_stdout) print_reds(&report, stderr);
        done =
            ang_fail(err, ANG_CHECK_FAILED, "selfcheck: %d check%s red", report.red, report.red == 1 ? " is" : "s are");
    }
    ang_selfcheck_report_clear(&report);
    return done ? ANG_OK : (int)err->code;
}
