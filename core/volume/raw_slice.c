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
    *centre = (least + greatest) / 2.0;
    *width = greatest > least ? greatest - least : 1;
    if (slope < 0) *width = -*width;
}

static int pixels(double length) { return length < 1 ? 1 : (int)lround(length); }

/* Where pixel i of `count` begins among `from` pixels. */
static int edge(int i, int count, int from) { return (int)((int64_t)i * from / count); }

static double mean_of(const ang_raw_slice *slice, int x0, int x1, int y0, int y1) {
    uint64_t sum = 0;
    for (int y = y0; y < y1; y++) {
        const uint16_t *row = slice->values + (size_t)y * (size_t)slice->width;
        for (int x = x0; x < x1; x++) sum += row[x];
    }
    return (double)sum / ((double)(x1 - x0) * (y1 - y0));
}

void ang_preview_make(const ang_raw_slice *slice, int side, ang_preview *preview) {
    double across = slice->width, down = slice->height * slice->pixel_aspect;
    double scale = fmin(fmin(side / fmax(across, down), 1), fmin(1, slice->height / down));
    int width = pixels(across * scale), height = pixels(down * scale);
    preview->width = width = width > slice->width ? slice->width : width;
    preview->height = height = height > slice->height ? slice->height : height;
    double centre, wide;
    stored_window(slice, &centre, &wide);
    for (int j = 0; j < height; j++) {
        int y0 = edge(j, height, slice->height), y1 = edge(j + 1, height, slice->height);
        for (int i = 0; i < width; i++) {
            double mean = mean_of(slice, edge(i, width, slice->width), edge(i + 1, width, slice->width), y0, y1);
            double grey = (mean - centre) / wide + 0.5;
            preview->grey[j * width + i] = grey <= 0 ? 0 : grey >= 1 ? 255 : (uint8_t)lround(255 * grey);
        }
    }
}
