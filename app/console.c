/* What all verbs share: progress on stderr, messages, small parsers, the clock, where presets lie. */
#include "app/verbs.h"
#include "core/base/clock.h"
#include "io/place.h"
#include "io/preset/preset_own.h"
#include "io/text.h"

#include <limits.h>
#include <math.h>
#include <pthread.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

struct ang_app_progress {
    ang_progress sink;
    pthread_mutex_t lock;
    bool quiet, terminal, open_line;
    char what[64];
    int shown;       /* last percentage shown for `what` */
    double begun_ms; /* when `what` began */
};

/* Set by the signal handler alone: there is no other way to hear of a signal. */
static volatile sig_atomic_t interrupted;

static void on_signal(int number) {
    /* A second signal ends the program at once. */
    signal(number, SIG_DFL);
    interrupted = 1;
}

/* ", about 3 min left": what the time so far says, once it says anything. */
static void remaining_text(double elapsed_ms, double fraction, char text[48]) {
    text[0] = '\0';
    if (elapsed_ms < 4000 || fraction < 0.02 || fraction >= 1) return;
    double seconds = elapsed_ms / 1000 * (1 - fraction) / fraction;
    if (seconds < 90)
        snprintf(text, 48, ", about %.0f s left", ceil(seconds));
    else
        snprintf(text, 48, ", about %.0f min left", ceil(seconds / 60));
}

static bool update(void *context, const char *what, double fraction) {
    ang_app_progress *progress = context;
    if (progress->quiet) return !interrupted;
    pthread_mutex_lock(&progress->lock);
    if (strcmp(progress->what, what) != 0) {
        if (progress->open_line) fputc('\n', stderr);
        progress->open_line = false;
        snprintf(progress->what, sizeof progress->what, "%s", what);
        progress->shown = -1;
        progress->begun_ms = ang_now_ms();
    }
    int percent = (int)(100 * fmin(fmax(fraction, 0), 1));
    int step = progress->terminal ? 1 : 10;
    if (percent / step > progress->shown / step || progress->shown < 0) {
        bool first = progress->shown < 0;
        progress->shown = percent;
        char left[48];
        remaining_text(ang_now_ms() - progress->begun_ms, fraction, left);
        if (progress->terminal) {
            fprintf(stderr, "\r%-28s [%-40.*s] %3d %%%-22s", what, percent * 40 / 100,
                    "########################################", percent, left);
            progress->open_line = true;
        } else if (percent >= 10 || first) {
            fprintf(stderr, "%s: %d %%%s\n", what, percent / 10 * 10, left);
        }
    }
    pthread_mutex_unlock(&progress->lock);
    return !interrupted;
}

ang_app_progress *ang_app_progress_start(bool quiet) {
    ang_app_progress *progress = calloc(1, sizeof *progress);
    if (!progress) return NULL;
    progress->sink = (ang_progress){update, progress};
    progress->quiet = quiet;
    progress->terminal = isatty(STDERR_FILENO);
    progress->shown = -1;
    pthread_mutex_init(&progress->lock, NULL);
    struct sigaction action = {.sa_handler = on_signal};
    sigaction(SIGINT, &action, NULL);
    sigaction(SIGTERM, &action, NULL);
    return progress;
}

const ang_progress *ang_app_progress_sink(const ang_app_progress *progress) {
    return progress ? &progress->sink : NULL;
}

void ang_app_progress_end(ang_app_progress *progress) {
    if (!progress) return;
    if (progress->open_line) fputc('\n', stderr);
    pthread_mutex_destroy(&progress->lock);
    free(progress);
}

void ang_app_say(const ang_notes *notes, const char *prefix, const ang_error *err) {
    for (size_t i = 0; i < notes->count; i++) {
        if (err && strstr(err->message, notes->text[i])) continue;
        char line[ANG_NOTES_LINE];
        ang_notes_line(notes, i, true, line, sizeof line);
        ang_text_clean(line);
        fprintf(stderr, "%s%s\n", prefix, line);
    }
}

bool ang_app_arguments(const ang_options *options, int count, const char *wanted, ang_error *err) {
    if (options->argument_count == count) return true;
    /* What `render --json` takes, another verb reads as one more argument. */
    if (options->json_flag && options->argument_count == count + 1)
        return ang_fail(err, ANG_USAGE, "%s; --json takes no value here: it prints to standard output", wanted);
    return ang_fail(err, ANG_USAGE, "%s", wanted);
}

bool ang_app_parse_dims(const char *option, const char *text, int count, int most, int *out, ang_error *err) {
    const char *rest = text;
    for (int i = 0; i < count; i++) {
        char *end;
        long value = strtol(rest, &end, 10);
        if (end == rest || value < 1 || value > most || *end != (i + 1 < count ? 'x' : '\0'))
            return ang_fail(err, ANG_USAGE, "--%s %s: must be %s, each from 1 to %d", option, text,
                            count == 2 ? "WxH" : "XxYxZ", most);
        out[i] = (int)value;
        rest = end + 1;
    }
    return true;
}

bool ang_app_parse_numbers(const char *option, const char *text, int least, int most, double *out, int *count,
                           ang_error *err) {
    const char *rest = text;
    *count = 0;
    while (*count < most) {
        char *end;
        double value = strtod(rest, &end);
        if (end == rest || !isfinite(value)) break;
        out[(*count)++] = value;
        rest = end;
        if (*rest != ',') break;
        rest++;
    }
    if (*count >= least && *rest == '\0') return true;
    if (least == most)
        return ang_fail(err, ANG_USAGE, "--%s %s: must be %d numbers separated by commas", option, text, most);
    return ang_fail(err, ANG_USAGE, "--%s %s: must be %d to %d numbers separated by commas", option, text, least, most);
}

/* The user's own hide those that come with the program, which lie below the prefix of the installation or, for a
 * program that was built but not installed, beside it. */
static const char *preset_folders[3];

static void find_preset_folders(void) {
    static const char *const places[] = {"../share/angioscope/presets", "presets"};
    static char path[PATH_MAX];
    int count = 0;
    if (ang_preset_own_folder()) preset_folders[count++] = ang_preset_own_folder();
    for (size_t i = 0; i < sizeof places / sizeof *places; i++) {
        if (!ang_place_beside_program(places[i], path, sizeof path)) continue;
        preset_folders[count] = path;
        break;
    }
}

const char *const *ang_app_preset_folders(void) {
    static pthread_once_t once = PTHREAD_ONCE_INIT;
    pthread_once(&once, find_preset_folders);
    return preset_folders;
}

ang_load_options ang_app_load_options(const ang_options *options) {
    return (ang_load_options){.series = options->series,
                              .phase = options->phase,
                              .raw_dims = options->raw_dims,
                              .raw_type = options->raw_type,
                              .raw_spacing = options->raw_spacing,
                              .series_remembered = options->series_remembered,
                              .phase_remembered = options->phase_remembered,
                              .raw_remembered = options->raw_remembered,
                              .threads = options->threads,
                              .strict = options->strict,
                              .no_sandbox = options->no_sandbox};
}
