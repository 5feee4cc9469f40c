/* One slice as a file holds it, before it is part of a volume: what is shown while the others are being read. */
#ifndef ANG_VOLUME_RAW_SLICE_H
#define ANG_VOLUME_RAW_SLICE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Borrows `values`. */
typedef struct ang_raw_slice {
    const uint16_t *values; /* width x height, rows from the top */
    int width, height;
    double slope, intercept; /* value = slope * stored + intercept; HU where `hounsfield` */
    bool hounsfield;
    double window_centre, window_width; /* the file's; NaN where it has none */
    double pixel_aspect;                /* a pixel's height over its width; > 0 */
    size_t index, count;                /* which (from 0, in order of position) of how many */
} ang_raw_slice;

/* Is given slices as they are read, in any order, from any thread; thread safe. The reader waits for it. */
typedef struct ang_slice_sink {
    void (*take)(void *context, const ang_raw_slice *slice); /* NULL: nobody wants them */
    void *context;
} ang_slice_sink;

enum { ANG_PREVIEW_SIDE = 256 }; /* the most pixels of a preview's longer side */

/* A small picture in greys. Plain value. */
typedef struct ang_preview {
    int width, height; /* 0: none */
    uint8_t grey[ANG_PREVIEW_SIDE * ANG_PREVIEW_SIDE];
} ang_preview;

/* Fills `preview` with the slice under its window (where the file has none: 400 wide about 40 HU, or from the least to
 * the greatest value where these are no HU), at most `side` pixels long (1 to ANG_PREVIEW_SIDE), never larger than the
 * slice, with square pixels. Each pixel is the mean over its area, in stored values. Thread safe. */
void ang_preview_make(const ang_raw_slice *slice, int side, ang_preview *preview);

#endif
