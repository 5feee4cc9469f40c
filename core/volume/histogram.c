#include "core/volume/histogram.h"

#include "core/base/memory.h"
#include "core/base/parallel.h"

#include <stdlib.h>

typedef struct histogram_job {
    const ang_volume *volume;
    uint64_t *bins; /* one histogram a worker: no two threads share a counter */
} histogram_job;

static void count_voxels(void *context, size_t begin, size_t end, int worker) {
    histogram_job *job = context;
    uint64_t *bin = job->bins + (size_t)worker * ANG_HISTOGRAM_BINS;
    for (size_t i = begin; i < end; i++)
        if (!ang_volume_is_padding(job->volume, i)) bin[job->volume->data[i]]++;
}

ang_histogram *ang_histogram_build(const ang_volume *volume, int threads, ang_error *err) {
    int workers = ang_thread_count(threads);
    ang_histogram *histogram = ang_alloc(1, sizeof *histogram, "histogram", err);
    uint64_t *bins = ang_alloc((size_t)workers * ANG_HISTOGRAM_BINS, sizeof *bins, "histogram", err);
    if (!histogram || !bins) {
        free(histogram);
        free(bins);
        return NULL;
    }
    histogram_job job = {volume, bins};
    ang_parallel_for(ang_volume_count(volume), 1 << 18, workers, count_voxels, &job);
    for (int worker = 0; worker < workers; worker++)
        for (int i = 0; i < ANG_HISTOGRAM_BINS; i++) {
            uint64_t voxels = bins[(size_t)worker * ANG_HISTOGRAM_BINS + (size_t)i];
            histogram->bin[i] += voxels;
            histogram->total += voxels;
        }
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
