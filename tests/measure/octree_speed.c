/* What is prepared of a volume before the first ray: octrees, histogram, and which blocks show with their distances
 * (for a threshold in the middle of the range, and back). Processor time of one thread, and what two take together and
 * until both are done; the least of nine. Usage: measure_octree [VOLUME]; without one, 512x512x512 of noise. */
#include "core/plan/block_grid.h"
#include "core/volume/histogram.h"
#include "io/load.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

static double clock_ms(clockid_t clock) {
    struct timespec t;
    clock_gettime(clock, &t);
    return 1e3 * (double)t.tv_sec + 1e-6 * (double)t.tv_nsec;
}

typedef struct work {
    const ang_volume *volume;
    int threads;
    ang_block_grid grid;
    uint16_t *copy;
} work;

static void build_octree(work *w, int side) {
    const int leaf[3] = {side, side, side};
    ang_octree_free(ang_octree_build(w->volume, leaf, 1, w->threads, NULL));
}
static void build_blocks(work *w) { build_octree(w, ANG_SKIP_BLOCK); }
static void build_leaves(work *w) { build_octree(w, ANG_OCTREE_LEAF); }
static void build_histogram(work *w) { free(ang_histogram_build(w->volume, w->threads, NULL)); }
static void copy_all(work *w) { memcpy(w->copy, w->volume->data, ang_volume_count(w->volume) * sizeof *w->copy); }
static void update_grid(work *w) {
    double middle = 0.5 * ((double)w->volume->minimum + w->volume->maximum);
    bool changed;
    for (int i = 0; i < 2; i++) {
        ang_visibility visibility = {.mode = ANG_MODE_ISO, .threshold = i ? w->volume->maximum : middle};
        if (!ang_block_grid_update(&w->grid, &visibility, true, w->threads, &changed, NULL)) exit(6);
    }
}

static void measure(work *w, const char *name, void (*run)(work *), double times) {
    double processor[3] = {0, 1e30, 1e30}, wall[3] = {0, 1e30, 1e30};
    for (w->threads = 1; w->threads <= 2; w->threads++)
        for (int i = 0; i < 9; i++) {
            double p = clock_ms(CLOCK_PROCESS_CPUTIME_ID), t = clock_ms(CLOCK_MONOTONIC);
            run(w);
            p = (clock_ms(CLOCK_PROCESS_CPUTIME_ID) - p) / times;
            t = (clock_ms(CLOCK_MONOTONIC) - t) / times;
            processor[w->threads] = p < processor[w->threads] ? p : processor[w->threads];
            wall[w->threads] = t < wall[w->threads] ? t : wall[w->threads];
        }
    double bytes = (double)ang_volume_count(w->volume) * sizeof *w->volume->data;
    printf("%-22s %7.2f ms, %5.1f GB/s; two threads %7.2f ms together, %7.2f in all\n", name, processor[1],
           bytes / processor[1] / 1e6, processor[2], wall[2]);
}

int main(int argc, char **argv) {
    const int dims[3] = {512, 512, 512};
    ang_error err = {0};
    ang_load_report report = {0};
    ang_volume *volume = argc > 1 ? ang_load(argv[1], NULL, &report, NULL, &err) : ang_volume_create(dims, &err);
    if (!volume) return fprintf(stderr, "%s\n", err.message), 3;
    size_t count = ang_volume_count(volume);
    for (size_t i = 0; i < count && argc < 2; i++) volume->data[i] = (uint16_t)(i * 2654435761u >> 13);
    if (argc < 2) ang_volume_update_range(volume, 0);
    work w = {.volume = volume, .copy = malloc(count * sizeof *w.copy)};
    if (!w.copy || !ang_block_grid_start(&w.grid, volume, NULL, 0, &err)) return 6;
    measure(&w, "memcpy", copy_all, 1);
    measure(&w, "octree, leaves of 4", build_blocks, 1);
    measure(&w, "octree, leaves of 8", build_leaves, 1);
    measure(&w, "histogram", build_histogram, 1);
    measure(&w, "blocks and distances", update_grid, 2);
    printf("(%u)\n", w.copy[count / 2]);
    ang_block_grid_clear(&w.grid);
    free(w.copy);
    ang_volume_free(volume);
    ang_load_report_clear(&report);
    return 0;
}
