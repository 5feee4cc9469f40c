/* What it costs that slices are shown while they are read: loading_speed PATH [RUNS]. Loads by turns without and with
 * the window's previews, which are taken as soon as they are there, and prints both medians and their ratio. */
#include "core/base/clock.h"
#include "core/base/median.h"
#include "io/load.h"
#include "ui/host/loading.h"

#include <stdio.h>
#include <stdlib.h>
#include <time.h>

enum { MOST_RUNS = 101 };

static bool load(void *context, const ang_source *source, const ang_slice_sink *slices, ang_study *study,
                 const ang_progress *progress, ang_error *err) {
    ang_load_report report;
    const bool *shown = context;
    ang_load_options options = {0};
    if (*shown) options.slices = *slices;
    study->volume = ang_load(source->paths[0], &options, &report, progress, err);
    ang_load_report_clear(&report);
    return study->volume != NULL;
}

/* Milliseconds; negative where it failed. */
static double run(const char *path, bool shown, ang_preview *preview, int *previews) {
    ang_viewer_host host = {.context = &shown, .load = load};
    ang_loading loading = {0};
    ang_source source = ang_source_make(&path, 1, 0);
    ang_study study = {0};
    ang_error err = {0};
    struct timespec pause = {0, 500000};
    bool done = false;
    double start = ang_now_ms();
    if (!ang_loading_start(&loading, &host, &source, &err)) return -1;
    while (!ang_loading_take(&loading, &done, &source, &study, &err)) {
        size_t index, count;
        *previews += ang_loading_preview(&loading, preview, &index, &count);
        nanosleep(&pause, NULL);
    }
    double milliseconds = ang_now_ms() - start;
    if (!done) fprintf(stderr, "%s\n", err.message);
    ang_volume_free(study.volume);
    ang_source_clear(&source);
    return done ? milliseconds : -1;
}

int main(int count, char **arguments) {
    int runs = count > 2 ? atoi(arguments[2]) : 5, previews = 0;
    ang_preview *preview = malloc(sizeof *preview);
    double without[MOST_RUNS], with[MOST_RUNS];
    if (count < 2 || runs < 1 || runs > MOST_RUNS || !preview) return 2;
    run(arguments[1], false, preview, &previews); /* files into memory */
    for (int i = 0; i < runs; i++) {
        without[i] = run(arguments[1], false, preview, &previews);
        with[i] = run(arguments[1], true, preview, &previews);
        if (without[i] < 0 || with[i] < 0) return 3;
    }
    double plain = ang_median(without, (size_t)runs), shown = ang_median(with, (size_t)runs);
    printf("without previews %.1f ms, with %.1f ms (%d pictures a run), ratio %.3f\n", plain, shown, previews / runs,
           shown / plain);
    free(preview);
    return 0;
}
