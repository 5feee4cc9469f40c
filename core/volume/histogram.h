/* How often each stored value occurs, padding left out. */
#ifndef ANG_VOLUME_HISTOGRAM_H
#define ANG_VOLUME_HISTOGRAM_H

#include "core/volume/volume.h"

enum { ANG_HISTOGRAM_BINS = 65536 };

/* One bin a stored value. Owns nothing but itself. */
typedef struct ang_histogram {
    uint64_t bin[ANG_HISTOGRAM_BINS];
    uint64_t total; /* voxels counted */
} ang_histogram;

/* Counts in parallel. NULL with ANG_LIMIT. Free with free(). */
ang_histogram *ang_histogram_build(const ang_volume *volume, int threads, ang_error *err);
/* The least stored value below or at which at least `fraction` (0..1) of the voxels lie. */
uint16_t ang_histogram_quantile(const ang_histogram *histogram, double fraction);

#endif
