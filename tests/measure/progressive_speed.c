/* What a picture that sharpens costs beside one drawn at once, and how soon it stops when asked to. Processor time of
 * one thread, medians over rounds in which both are drawn in turn; stopping also in real time with all threads.
 * Usage: measure_progressive VOLUME PRESET [SIZE [ROUNDS [none|phong]]]. */
#include "core/base/median.h"
#include "core/cpu/method_cpu.h"
#include "core/render/progressive.h"
#include "io/load.h"
#include "io/preset/preset.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { MOST_ROUNDS = 1000 };

static double clock_ms(clockid_t clock) {
    struct timespec t;
    clock_gettime(clock, &t);
    return 1e3 * (double)t.tv_sec + 1e-6 * (double)t.tv_nsec;
}

typedef struct bench {
    ang_renderer *renderer;
    ang_scene scene;
    ang_render_options options;
    ang_image whole;
    ang_progressive levels;
    int rounds, first; /* level */
} bench;

/* Asks for a stop at a time of some clock. */
typedef struct stop {
    clockid_t clock;
    double at_ms;
} stop;

static bool going_on(void *context, const char *what, double fraction) {
    (void)what, (void)fraction;
    const stop *when = context;
    return clock_ms(when->clock) < when->at_ms;
}

static bool step(bench *b, const ang_progress *progress) {
    return ang_progressive_step(&b->levels, &ang_method_cpu, b->renderer, &b->scene, &b->options, progress, NULL);
}

/* Milliseconds of each level and of the whole picture at once. */
static bool measure_levels(bench *b) {
    static double took[ANG_PROGRESSIVE_LEVELS][MOST_ROUNDS], all[MOST_ROUNDS], whole[MOST_ROUNDS], ratio[MOST_ROUNDS];
    for (int round = 0; round < b->rounds; round++) {
        double start = clock_ms(CLOCK_THREAD_CPUTIME_ID);
        if (!ang_method_cpu.render(b->renderer, &b->scene, &b->options, &b->whole, NULL, NULL, NULL)) return false;
        whole[round] = clock_ms(CLOCK_THREAD_CPUTIME_ID) - start;
        if (!ang_progressive_start(&b->levels, &ang_method_cpu, &b->scene, b->first, NULL)) return false;
        all[round] = 0;
        for (int level = b->first - 1; level < ANG_PROGRESSIVE_LEVELS; level++) {
            start = clock_ms(CLOCK_THREAD_CPUTIME_ID);
            if (!step(b, NULL)) return false;
            took[level][round] = clock_ms(CLOCK_THREAD_CPUTIME_ID) - start;
            all[round] += took[level][round];
        }
        ratio[round] = all[round] / whole[round];
    }
    size_t count = 4 * (size_t)b->scene.width * (size_t)b->scene.height, different = 0, rounds = (size_t)b->rounds;
    for (size_t i = 0; i < count; i++)
        different += memcmp(&b->whole.rgba[i], &b->levels.image.rgba[i], sizeof(float)) != 0;
    printf("at once %.1f ms; levels from %d", ang_median(whole, rounds), b->first);
    for (int level = b->first - 1; level < ANG_PROGRESSIVE_LEVELS; level++)
        printf(" %.1f", ang_median(took[level], rounds));
    printf(", together %.1f ms: %.3f times; %zu of %zu numbers differ\n", ang_median(all, rounds),
           ang_median(ratio, rounds), different, count);
    return true;
}

static int compare(const void *a, const void *b) {
    double x = *(const double *)a, y = *(const double *)b;
    return x < y ? -1 : x > y;
}

/* From asking to returning, asked at times spread over the picture. */
static bool measure_stops(bench *b, const char *what, clockid_t clock, int threads) {
    double took[MOST_ROUNDS];
    int count = 0;
    b->options.threads = threads;
    double start = clock_ms(clock);
    if (!ang_progressive_start(&b->levels, &ang_method_cpu, &b->scene, b->first, NULL)) return false;
    while (b->levels.level < ANG_PROGRESSIVE_LEVELS)
        if (!step(b, NULL)) return false;
    double all = clock_ms(clock) - start;
    for (int i = 0; i < 20 * b->rounds && i < MOST_ROUNDS; i++) {
        double part = fmod(0.618033988749895 * (i + 1), 1);
        stop when = {clock, clock_ms(clock) + part * all};
        ang_progress progress = {going_on, &when};
        if (!ang_progressive_start(&b->levels, &ang_method_cpu, &b->scene, b->first, NULL)) return false;
        bool going = true;
        while (going && b->levels.level < ANG_PROGRESSIVE_LEVELS) going = step(b, &progress);
        if (!going) took[count++] = clock_ms(clock) - when.at_ms;
    }
    if (count == 0) return false;
    qsort(took, (size_t)count, sizeof *took, compare);
    printf("stopped %d times, %s: median %.2f, 95th percentile %.2f, at most %.2f ms\n", count, what, took[count / 2],
           took[count * 95 / 100], took[count - 1]);
    return true;
}

int main(int argc, char **argv) {
    if (argc < 3) return 2;
    int size = argc > 3 ? atoi(argv[3]) : 512;
    ang_error err = {0};
    ang_load_report report = {0};
    ang_load_options how = {.threads = 0};
    ang_volume *volume = ang_load(argv[1], &how, &report, NULL, &err);
    ang_preset *preset = volume ? ang_preset_load(argv[2], &err) : NULL;
    bench b = {.options = ang_render_options_default};
    b.renderer = preset ? ang_method_cpu.create(NULL, volume, &b.options, &err) : NULL;
    if (!b.renderer || !ang_image_create(&b.whole, size, size, &err)) return fprintf(stderr, "%s\n", err.message), 3;
    b.rounds = argc > 4 ? atoi(argv[4]) : 5;
    if (b.rounds < 1 || b.rounds > MOST_ROUNDS) return 2;
    b.options.threads = 1;
    b.scene = ang_scene_default(volume);
    b.scene.width = b.scene.height = size;
    b.scene.mode = preset->mode;
    b.scene.shading = argc > 5 ? (ang_shading)ang_shading_from_name(argv[5]) : preset->shading;
    b.scene.phong = preset->phong;
    b.scene.iso_hu = preset->iso_hu;
    b.scene.window_centre = preset->window_centre;
    b.scene.window_width = preset->window_width;
    b.scene.transfer = preset->transfer;
    ang_view view = ang_view_default;
    view.azimuth_deg = 33;
    view.elevation_deg = 21;
    view.zoom = 1.7;
    b.scene.camera = ang_camera_for(volume, &view);
    printf("%s, %s, %d x %d, %s\n", argv[1], preset->name, size, size, ang_shading_name(b.scene.shading));
    bool done = true;
    for (b.first = ANG_PROGRESSIVE_LEVELS; b.first > 0 && done; b.first--) done = measure_levels(&b);
    b.first = 1;
    done = done && measure_stops(&b, "processor time of one thread", CLOCK_THREAD_CPUTIME_ID, 1) &&
           measure_stops(&b, "real time, all threads", CLOCK_MONOTONIC, 0);
    ang_method_cpu.destroy(b.renderer);
    ang_progressive_clear(&b.levels);
    ang_image_clear(&b.whole);
    ang_preset_free(preset);
    ang_volume_free(volume);
    ang_load_report_clear(&report);
    return done ? 0 : 1;
}
