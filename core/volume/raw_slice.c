#include "core/volume/raw_slice.h"

#include <math.h>

/* Centre and width of the window in stored values. */
static void stored_window(const ang_raw_slice *slice, double *centre, double *width) {
    double slope = slice->slope, c = slice->window_centre, w = slice->window_width;
    bool given = isfinite(c) && w > 0 && slope != 0;
    if (!given && slice->hounsfield && slope != 0) {
        c = 40;
        w = 400;
        given = true;
    }
    if (given) {
        *centre = (c - slice->intercept) / slope;
        *width = w / slope; /* < 0: dark and bright change places */
        return;
    }
    size_t count = (size_t)slice->width * (size_t)slice->height;
    uint16_t least = UINT16_MAX, greatest = 0;
    for (size_t i = 0; i < count; i++) {
        if (slice->values[i] < least) least = slice->values[i];
        if (slice->values[i] > greatest) greatest = slice->values[i];
    }
    double range = greatest > least ? greatest - least : 1; /* a slice of one value is black */
    *centre = least + range / 2;
    *width = slope < 0 ? -range : range;
}

static int pixels(double length) { return length < 1 ? 1 : (int)lround(length); }

/* Where pixel i of `count` begins among `from` pixels. */
static int edge(int i, int count, int from) { return (int)((int64_t)i * from / count); }

/* Adds a row of the slice to the sums of the areas of a row of the preview. */
static void add_row(const uint16_t *row, const int *edges, int width, uint64_t *sums) {
    for (int i = 0; i < width; i++) {
        uint32_t sum = 0; /* of fewer than 65536 values */
        for (int x = edges[i]; x < edges[i + 1]; x++) sum += row[x];
        sums[i] += sum;
    }
}

void ang_preview_make(const ang_raw_slice *slice, int side, ang_preview *preview) {
    double across = slice->width, down = slice->height * slice->pixel_aspect;
    double scale = fmin(fmin(side / fmax(across, down), 1), fmin(1, slice->height / down));
    int width = pixels(across * scale), height = pixels(down * scale);
    preview->width = width = width > slice->width ? slice->width : width;
    preview->height = height = height > slice->height ? slice->height : height;
    double centre, wide;
    stored_window(slice, &centre, &wide);
    int edges[ANG_PREVIEW_SIDE + 1];
    for (int i = 0; i <= width; i++) edges[i] = edge(i, width, slice->width);
    for (int j = 0; j < height; j++) {
        uint64_t sums[ANG_PREVIEW_SIDE] = {0};
        int y0 = edge(j, height, slice->height), y1 = edge(j + 1, height, slice->height);
        for (int y = y0; y < y1; y++) add_row(slice->values + (size_t)y * (size_t)slice->width, edges, width, sums);
        for (int i = 0; i < width; i++) {
            double mean = (double)sums[i] / ((double)(edges[i + 1] - edges[i]) * (y1 - y0));
            double grey = 255 * ((mean - centre) / wide + 0.5);
            preview->grey[j * width + i] = grey <= 0 ? 0 : grey >= 255 ? 255 : (uint8_t)(grey + 0.5);
        }
    }
}
