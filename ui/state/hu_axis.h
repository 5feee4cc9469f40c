/* The range of HU that an editor shows: zooming and moving within limits, round numbers to write on it, and the bars of
 * a histogram over it. Pure: no window. */
#ifndef ANG_UI_HU_AXIS_H
#define ANG_UI_HU_AXIS_H

#include "core/volume/histogram.h"
#include "ui/state/document.h"

/* An interval of HU, low < high. */
typedef struct ang_hu_range {
    double low, high;
} ang_hu_range;

/* All that there is to see: the volume's values and the document's points, with a margin. */
ang_hu_range ang_hu_range_all(const ang_volume *volume, const ang_document *document);
/* Widens by `factor` (< 1: narrows) about a value, which stays where it is where the limits allow: not narrower than
 * `least` and within `all`. */
ang_hu_range ang_hu_range_zoom(ang_hu_range shown, double about, double factor, double least, ang_hu_range all);
/* Moves by `by` HU within `all`. */
ang_hu_range ang_hu_range_slide(ang_hu_range shown, double by, ang_hu_range all);
/* Widened or moved as little as shows a value, with a margin. */
ang_hu_range ang_hu_range_with(ang_hu_range shown, double hu);

/* Round values: first, first + step, ... up to the range's end. `step` is 1, 2 or 5 times a power of ten. */
typedef struct ang_hu_ticks {
    double first, step;
    int count;    /* at most 64 */
    int decimals; /* that tell them apart */
} ang_hu_ticks;
/* As many as fit where `most` (> 0) of them have room, at least one where the range has a round value. */
ang_hu_ticks ang_hu_ticks_make(ang_hu_range range, double most);

/* The values of a volume that lie in a range of HU, its ends included. */
typedef struct ang_hu_share {
    int first, last;  /* stored values; first > last: none */
    double low, high; /* HU of these */
    uint64_t voxels;
    double share; /* of all voxels that are no padding, 0..1 */
    double ml;
} ang_hu_share;
ang_hu_share ang_hu_share_of(const ang_volume *volume, const ang_histogram *histogram, ang_hu_range range);

/* The heights, 0..1, of `count` bars over the range: logarithmic, of the voxels in each bar or, where bars are narrower
 * than one value's share of the axis, of that value's. Bars share the values that they cut, so that the same values
 * give the same heights wherever bars begin. */
void ang_hu_bars(const ang_volume *volume, const ang_histogram *histogram, ang_hu_range range, int count,
                 double *heights);

#endif
