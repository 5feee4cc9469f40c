#include "ui/state/hu_axis.h"

#include "core/scene/annotation.h"

#include <math.h>

enum { most_ticks = 64 };
static const double margin = 0.03;

ang_hu_range ang_hu_range_all(const ang_volume *volume, const ang_document *document) {
    double low = ang_volume_hu(volume, volume->minimum), high = ang_volume_hu(volume, volume->maximum);
    if (document->count > 0) {
        low = fmin(low, document->points[0].hu);
        high = fmax(high, document->points[document->count - 1].hu);
    }
    double room = fmax((high - low) * margin, volume->slope);
    return (ang_hu_range){low - room, high + room};
}

/* Moved, and narrowed where it has to be, so that it lies within `all`. */
static ang_hu_range within(ang_hu_range range, ang_hu_range all) {
    double width = fmin(range.high - range.low, all.high - all.low);
    double low = fmax(fmin(range.low, all.high - width), all.low);
    return (ang_hu_range){low, low + width};
}

ang_hu_range ang_hu_range_zoom(ang_hu_range shown, double about, double factor, double least, ang_hu_range all) {
    double width = shown.high - shown.low;
    double wanted = fmin(fmax(width * factor, fmin(least, all.high - all.low)), all.high - all.low);
    double low = about - (about - shown.low) * wanted / width;
    return within((ang_hu_range){low, low + wanted}, all);
}

ang_hu_range ang_hu_range_slide(ang_hu_range shown, double by, ang_hu_range all) {
    return within((ang_hu_range){shown.low + by, shown.high + by}, all);
}

ang_hu_range ang_hu_range_with(ang_hu_range shown, double hu) {
    double room = margin * (shown.high - shown.low);
    if (hu - room < shown.low) shown = (ang_hu_range){hu - room, shown.high + (hu - room - shown.low)};
    if (hu + room > shown.high) shown = (ang_hu_range){shown.low + (hu + room - shown.high), hu + room};
    return shown;
}

ang_hu_ticks ang_hu_ticks_make(ang_hu_range range, double most) {
    ang_hu_ticks ticks = {0};
    double width = range.high - range.low;
    if (!(width > 0) || !isfinite(width) || !(most > 0)) return ticks;
    /* The least round step that is at least width / most: 10 over the greatest that is at most 10 most / width. */
    ticks.step = 10 / ang_round_length(10 * fmin(most, most_ticks - 1) / width);
    ticks.first = ceil(range.low / ticks.step - 1e-9) * ticks.step;
    while (ticks.count < most_ticks && ticks.first + ticks.count * ticks.step <= range.high + 1e-9 * ticks.step)
        ticks.count++;
    ticks.decimals = (int)fmax(ceil(-log10(ticks.step) - 1e-9), 0);
    return ticks;
}

/* Cubic millimetres of a voxel. */
static double voxel_mm3(const ang_volume *volume) {
    ang_vec3 x = ang_mat4_column(&volume->affine, 0), y = ang_mat4_column(&volume->affine, 1);
    return fabs(ang_vec3_dot(ang_vec3_cross(x, y), ang_mat4_column(&volume->affine, 2)));
}

ang_hu_share ang_hu_share_of(const ang_volume *volume, const ang_histogram *histogram, ang_hu_range range) {
    const double slack = 1e-9; /* of a value: HU to stored values and back is not exact */
    double low = ceil(ang_volume_stored(volume, range.low) - slack);
    double high = floor(ang_volume_stored(volume, range.high) + slack);
    ang_hu_share share = {.first = (int)fmin(fmax(low, 0), ANG_HISTOGRAM_BINS),
                          .last = (int)fmin(fmax(high, -1), ANG_HISTOGRAM_BINS - 1)};
    for (int i = share.first; i <= share.last; i++) share.voxels += histogram->bin[i];
    share.low = ang_volume_hu(volume, share.first);
    share.high = ang_volume_hu(volume, share.last);
    if (histogram->total > 0) share.share = (double)share.voxels / (double)histogram->total;
    share.ml = (double)share.voxels * voxel_mm3(volume) / 1000;
    return share;
}

/* Voxels between two places on the axis of stored values, on which value v takes v .. v + 1. */
static double voxels_between(const ang_histogram *histogram, double from, double to) {
    from = fmax(from, 0);
    to = fmin(to, ANG_HISTOGRAM_BINS);
    double sum = 0;
    for (int i = (int)floor(from); i < to; i++) sum += (double)histogram->bin[i] * (fmin(to, i + 1) - fmax(from, i));
    return sum;
}

void ang_hu_bars(const ang_volume *volume, const ang_histogram *histogram, ang_hu_range range, int count,
                 double *heights) {
    double start = ang_volume_stored(volume, range.low) + 0.5;
    double each = (range.high - range.low) / volume->slope / count, highest = 0;
    for (int i = 0; i < count; i++) {
        double voxels = voxels_between(histogram, start + i * each, start + (i + 1) * each);
        heights[i] = log1p(each < 1 ? voxels / each : voxels);
        highest = fmax(highest, heights[i]);
    }
    for (int i = 0; i < count && highest > 0; i++) heights[i] /= highest;
}
