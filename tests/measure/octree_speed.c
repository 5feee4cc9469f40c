/* Octree build against memcpy, both over a 512^3 volume in one run: GB/s of volume data, medians of nine. */
#include "core/volume/octree.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

static double now(void) {
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static int ascending(const void *a, const void *b) {
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

int main(void) {
    enum { runs = 9 };
    const int dims[3] = {512, 512, 512};
    ang_volume *volume = ang_volume_create(dims, NULL);
    if (!volume) return 6;
    size_t count = ang_volume_count(volume), bytes = count * sizeof *volume->data;
    for (size_t i = 0; i < count; i++) volume->data[i] = (uint16_t)(i * 2654435761u >> 13);
    uint16_t *copy = calloc(count, sizeof *copy);
    if (!copy) return 6;
    double build[runs], move[runs];
    for (int i = 0; i < runs; i++) {
        double start = now();
        memcpy(copy, volume->data, bytes);
        move[i] = now() - start;
        start = now();
        ang_octree *octree = ang_octree_build(volume, NULL, 1, 0, NULL);
        build[i] = now() - start;
        ang_octree_free(octree);
    }
    qsort(build, runs, sizeof *build, ascending);
    qsort(move, runs, sizeof *move, ascending);
    printf("memcpy (1 thread) %.2f GB/s, octree %.2f GB/s (%.1f ms), check %u\n", (double)bytes / move[runs / 2] / 1e9,
           (double)bytes / build[runs / 2] / 1e9, build[runs / 2] * 1e3, copy[count / 2]);
    free(copy);
    ang_volume_free(volume);
    return 0;
}
