#include "core/volume/histogram.h"

#include "core/base/memory.h"
#include "core/base/parallel.h"

#include <stdlib.h>

/* Voxels beside one another often have one value: counted in turn in different histograms, none waits for the last to
 * be stored. */
enum { SIDE = 4, COUNTERS = SIDE * ANG_HISTOGRAM_BINS };

typedef struct histogram_job {
    const ang_volume *volume;
    uint64_t *bins; /* SIDE histograms a worker: no two threads share a counter */
} histogram_job;

static void count_all(uint64_t *bin, const uint16_t *value, size_t count) {
    size_t i = 0;
    for (; i + SIDE <= count; i += SIDE)
        for (size_t k = 0; k < SIDE; k++) bin[k * ANG_HISTOGRAM_BINS + value[i + k]]++;
    for (; i < count; i++) bin[value[i]]++;
}

/* Padding lies in large parts: 64 voxels are looked at at once. `begin` is a multiple of 64. */
static void count_voxels(void *context, size_t begin, size_t end, int worker) {
    histogram_job *job = context;
    const ang_volume *volume = job->volume;
    uint64_t *bin = job->bins + (size_t)worker * COUNTERS;
    if (!volume->padding) {
        count_all(bin, volume->data + begin, end - begin);
        return;
    }
    for (size_t i = begin; i < end; i += 64) {
        size_t count = end - i < 64 ? end - i : 64;
        uint64_t padding = volume->padding[i / 64];
        if (padding == 0)
            count_all(bin, volume->data + i, count);
        else
            for (size_t k = 0; k < count && padding != UINT64_MAX; k++) bin[volume->data[i + k]] += !(padding >> k & 1);
    }
}

ang_histogram *ang_histogram_build(const ang_volume *volume, int threads, ang_error *err) {
    int workers = ang_thread_count(threads);
    ang_histogram *histogram = ang_alloc(1, sizeof *histogram, "histogram", err);
    uint64_t *bins = ang_alloc((size_t)workers * COUNTERS, sizeof *bins, "histogram", err);
    if (!histogram || !bins) {
        free(histogram);
        free(bins);
        return NULL;
    }
    histogram_job job = {volume, bins};
    ang_parallel_for(ang_volume_count(volume), 1 << 18, workers, count_voxels, &job);
    for (size_t k = 0; k < (size_t)workers * SIDE; k++)
        for (size_t i = 0; i < ANG_HISTOGRAM_BINS; i++) histogram->bin[i] += bins[k * ANG_HISTOGRAM_BINS + i];
    for (int i = 0; i < ANG_HISTOGRAM_BINS; i++) histogram->total += histogram->bin[i];
    free(bins);
    return histogram;
}

uint16_t ang_histogram_quantile(const ang_histogram *histogram, double fraction) {
    double wanted = fraction * (double)histogram->total;
    uint64_t seen = 0;
    for (int i = 0; i < ANG_HISTOGRAM_BINS; i++) {
        seen += histogram->bin[i];
        if (seen > 0 && (double)seen >= wanted) return (uint16_t)i;
    }
    return ANG_HISTOGRAM_BINS - 1;
}
