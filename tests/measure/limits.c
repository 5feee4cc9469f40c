/* The machine's limits beside what the ray caster reaches on a dense scene (every block shows, no ray ends early): how
 * fast memory is read, how fast the eight voxels around each sample are fetched along the same rays, and what two
 * threads do better than one. The least of several. Usage: measure_limits VOLUME [RUNS] */
#include "core/base/parallel.h"
#include "core/cpu/lanes.h"
#include "core/cpu/method_cpu.h"
#include "io/load.h"

#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

enum { SIDE = 512, PIECE = 1 << 20 /* words of 8 bytes */, PIECES = 32 };

static double clock_ms(clockid_t clock) {
    struct timespec t;
    clock_gettime(clock, &t);
    return 1e3 * (double)t.tv_sec + 1e-6 * (double)t.tv_nsec;
}

/* The least time of all threads together and the least until the last is done, ms. */
typedef struct took {
    double processor, wall;
} took;

static took least_of(int runs, void (*run)(void *), void *context) {
    took least = {1e30, 1e30};
    for (int i = 0; i < runs; i++) {
        double processor = clock_ms(CLOCK_PROCESS_CPUTIME_ID), wall = clock_ms(CLOCK_MONOTONIC);
        run(context);
        processor = clock_ms(CLOCK_PROCESS_CPUTIME_ID) - processor;
        wall = clock_ms(CLOCK_MONOTONIC) - wall;
        least.processor = processor < least.processor ? processor : least.processor;
        least.wall = wall < least.wall ? wall : least.wall;
    }
    return least;
}

typedef struct reading {
    const uint64_t *words;
    int threads;
    _Atomic uint64_t sum; /* so that nothing is left out */
} reading;

static void read_words(void *context, size_t begin, size_t end, int worker) {
    (void)worker;
    reading *job = context;
    uint64_t sum = 0;
    for (size_t i = begin * PIECE; i < end * PIECE; i++) sum ^= job->words[i];
    atomic_fetch_add(&job->sum, sum);
}

static void read_all(void *context) {
    reading *job = context;
    ang_parallel_for(PIECES, 1, job->threads, read_words, job);
}

/* A dense scene and what follows its rays. */
typedef struct walk {
    const ang_volume *volume;
    ang_scene scene;
    ang_ray_frame frame;
    ang_render_options options;
    ang_renderer *renderer;
    ang_image image;
    double samples; /* that were fetched */
    lanes_int seen; /* so that nothing is left out */
} walk;

/* LANES rays side by side, each sample's four pairs of neighbours as the ray caster loads them. */
static void fetch_packet(walk *w, int x, int y, double step) {
    const ang_volume *volume = w->volume;
    const int row = volume->dims[0], slice = volume->dims[0] * volume->dims[1];
    const uint16_t *const base[4] = {volume->data, volume->data + row, volume->data + slice,
                                     volume->data + row + slice};
    const ang_vec3 centre = w->frame.centre;
    lanes place[3], move[3], top[3];
    lanes_int left = lanes_all_int(0);
    int most = 0;
    for (int l = 0; l < LANES; l++) {
        ang_ray ray = ang_ray_through(&w->frame, x + l + 0.5, y + 0.5);
        double first = ray.enter + 0.5 * step;
        for (int axis = 0; axis < 3; axis++) {
            double from = ang_vec3_at(ray.origin, axis), along = ang_vec3_at(ray.direction, axis);
            place[axis][l] = (float)(from + first * along + ang_vec3_at(centre, axis));
            move[axis][l] = (float)(step * along);
        }
        left[l] = ray.leave > ray.enter ? (int)((ray.leave - ray.enter) / step) : 0;
        most = left[l] > most ? left[l] : most;
        w->samples += left[l];
    }
    for (int axis = 0; axis < 3; axis++) top[axis] = lanes_all((float)volume->dims[axis] - 1.001F);
    for (int i = 0; i < most; i++) {
        lanes_int cell[3], word[4];
        for (int axis = 0; axis < 3; axis++) {
            cell[axis] = lanes_truncate(lanes_max(lanes_min(place[axis], top[axis]), lanes_all(0)));
            place[axis] += move[axis];
        }
        int at[LANES];
        lanes_store_int(at, cell[0] + cell[1] * row + cell[2] * slice);
        LANES_IN_MEMORY(at);
        lanes_words(base, at, word);
        w->seen ^= word[0] ^ word[1] ^ word[2] ^ word[3];
    }
}

static void fetch_all(void *context) {
    walk *w = context;
    double step = w->options.step_voxels * ang_volume_smallest_spacing(w->volume);
    w->samples = 0;
    for (int tile_y = 0; tile_y < SIDE; tile_y += ANG_CAST_TILE)
        for (int tile_x = 0; tile_x < SIDE; tile_x += ANG_CAST_TILE)
            for (int y = 0; y < ANG_CAST_TILE; y++)
                for (int x = 0; x < ANG_CAST_TILE; x += LANES) fetch_packet(w, tile_x + x, tile_y + y, step);
}

static void render_all(void *context) {
    walk *w = context;
    if (!ang_method_cpu.render(w->renderer, &w->scene, &w->options, &w->image, NULL, NULL, NULL)) exit(1);
}

static void measure_memory(int runs) {
    uint64_t *words = malloc((size_t)PIECES * PIECE * sizeof *words);
    if (!words) exit(6);
    for (size_t i = 0; i < (size_t)PIECES * PIECE; i++) words[i] = i;
    for (int threads = 1; threads <= 2; threads++) {
        reading job = {.words = words, .threads = threads};
        took t = least_of(runs, read_all, &job);
        printf("memory read, %d thread%s: %.1f GB/s\n", threads, threads > 1 ? "s" : "",
               (double)PIECES * PIECE * sizeof *words / t.wall / 1e6);
    }
    free(words);
}

static void measure_scene(walk *w, int runs, const char *name) {
    ang_frame_stats stats = {0};
    w->options.threads = 1;
    if (!ang_ray_frame_make(w->volume, &w->scene, &w->frame, NULL)) exit(1);
    if (!ang_method_cpu.render(w->renderer, &w->scene, &w->options, &w->image, &stats, NULL, NULL)) exit(1);
    took one = least_of(runs, render_all, w), fetch = least_of(runs, fetch_all, w);
    w->options.threads = 2;
    took two = least_of(runs, render_all, w);
    double drawn = 1e6 * one.processor / (double)stats.samples, fetched = 1e6 * fetch.processor / w->samples;
    printf("%-8s fetched %.2f ns a sample (%.0f million, %d lanes), drawn %.2f ns (%.0f million): %.0f %%\n", name,
           fetched, w->samples / 1e6, LANES, drawn, (double)stats.samples / 1e6, 100 * fetched / drawn);
    printf("%-8s 1 thread %.1f ms of processor, %.1f ms in all; 2 threads %.1f and %.1f: %.2f times the work, %.2f "
           "times as fast\n",
           name, one.processor, one.wall, two.processor, two.wall, two.processor / one.processor, one.wall / two.wall);
}

int main(int argc, char **argv) {
    if (argc < 2) return 2;
    int runs = argc > 2 ? atoi(argv[2]) : 5;
    ang_error err = {0};
    ang_load_report report = {0};
    walk w = {.options = ang_render_options_default};
    w.volume = ang_load(argv[1], NULL, &report, NULL, &err);
    if (!w.volume) return fprintf(stderr, "%s\n", err.message), 3;
    measure_memory(runs);
    /* Thin fog of one colour, everywhere. */
    const ang_transfer_point fog[2] = {{-2000, {1, 0.9, 0.8}, 1e-4}, {3000, {1, 0.9, 0.8}, 1e-3}};
    ang_transfer *transfer = ang_transfer_create(fog, 2, 1, true, NULL, NULL);
    w.renderer = ang_method_cpu.create(NULL, w.volume, &w.options, &err);
    if (!transfer || !w.renderer || !ang_image_create(&w.image, SIDE, SIDE, &err)) return 6;
    w.options.termination = 1;
    w.scene = ang_scene_default(w.volume);
    w.scene.width = w.scene.height = SIDE;
    w.scene.transfer = transfer;
    ang_view view = ang_view_default;
    view.azimuth_deg = 10;
    view.elevation_deg = 20;
    view.zoom = 1.7;
    w.scene.camera = ang_camera_for(w.volume, &view);
    measure_scene(&w, runs, "fog");
    w.scene.mode = ANG_MODE_MEAN;
    measure_scene(&w, runs, "mean");
    int seen = 0;
    for (int l = 0; l < LANES; l++) seen ^= w.seen[l];
    printf("(%08x)\n", (unsigned)seen);
    ang_method_cpu.destroy(w.renderer);
    ang_image_clear(&w.image);
    ang_transfer_free(transfer);
    ang_load_report_clear(&report);
    return 0;
}
