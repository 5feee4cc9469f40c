#include "core/error/metrics.h"

#include "core/base/memory.h"
#ifdef ANG_WITH_OPENCV
#include "core/error/opencv.h"
#endif

#include <math.h>
#include <stddef.h>
#include <stdlib.h>

static const double flipped_above = 16; /* levels */

static bool same_size(const ang_image *a, const ang_image *b, ang_error *err) {
    if (a->width == b->width && a->height == b->height && a->width > 0 && a->height > 0) return true;
    return ang_fail(err, ANG_USAGE, "pictures of %dx%d and %dx%d pixels cannot be compared; render them at one --size",
                    a->width, a->height, b->width, b->height);
}

/* Levels, clipped; NaN stays. */
static double level(float value, bool quantised) {
    double x = value < 0 ? 0 : value > 1 ? 255 : 255 * (double)value;
    return quantised ? round(x) : x;
}

static double channel_difference(float a, float b, bool quantised) {
    if (isnan(a) || isnan(b)) return 255;
    return fabs(level(a, quantised) - level(b, quantised));
}

/* The value that would stand at `rank` if `values` were sorted (Hoare's FIND, CACM 4(7), 1961); reorders them. */
static float select_rank(float *values, ptrdiff_t count, ptrdiff_t rank) {
    ptrdiff_t low = 0, high = count - 1;
    while (low < high) {
        float pivot = values[rank];
        ptrdiff_t i = low, j = high;
        do {
            while (values[i] < pivot) i++;
            while (pivot < values[j]) j--;
            if (i <= j) {
                float swapped = values[i];
                values[i++] = values[j];
                values[j--] = swapped;
            }
        } while (i <= j);
        if (j < rank) low = i;
        if (rank < i) high = j;
    }
    return values[rank];
}

/* Fills each pixel's difference in levels; returns the sum of squares over all channels. */
static double differences(const ang_image *a, const ang_image *b, bool quantised, float *out) {
    size_t count = (size_t)a->width * (size_t)a->height;
    double sum = 0;
    for (size_t i = 0; i < count; i++) {
        double largest = 0;
        for (size_t c = 0; c < 4; c++) {
            double difference = channel_difference(a->rgba[4 * i + c], b->rgba[4 * i + c], quantised);
            sum += difference * difference;
            largest = fmax(largest, difference);
        }
        out[i] = (float)largest;
    }
    return sum;
}

#ifdef ANG_WITH_OPENCV
static float *luma(const ang_image *image, bool quantised, ang_error *err) {
    size_t count = (size_t)image->width * (size_t)image->height;
    float *out = ang_alloc(count, sizeof *out, "picture comparison", err);
    for (size_t i = 0; out && i < count; i++) {
        const float *p = image->rgba + 4 * i;
        double y = 0.299 * level(p[0], quantised) + 0.587 * level(p[1], quantised) + 0.114 * level(p[2], quantised);
        out[i] = isnan(y) ? 0 : (float)y;
    }
    return out;
}
#endif

static bool similarity(const ang_image *a, const ang_image *b, bool quantised, double *ssim, ang_error *err) {
    *ssim = NAN;
#ifdef ANG_WITH_OPENCV
    float *x = luma(a, quantised, err), *y = x ? luma(b, quantised, err) : NULL;
    if (y) *ssim = ang_opencv_ssim(x, y, a->width, a->height);
    free(x);
    free(y);
    return y != NULL;
#else
    (void)a, (void)b, (void)quantised, (void)err;
    return true;
#endif
}

bool ang_metrics_compute(const ang_image *a, const ang_image *b, bool quantised, ang_metrics *out, ang_error *err) {
    if (!same_size(a, b, err)) return false;
    size_t count = (size_t)a->width * (size_t)a->height;
    float *difference = ang_alloc(count, sizeof *difference, "picture comparison", err);
    if (!difference) return false;

    double channels = differences(a, b, quantised, difference), pixels = 0;
    size_t flipped = 0;
    *out = (ang_metrics){0};
    for (size_t i = 0; i < count; i++) {
        double d = difference[i];
        out->max = fmax(out->max, d);
        pixels += d * d;
        flipped += d > flipped_above;
    }
    out->rms = sqrt(pixels / (double)count);
    out->flipped = (double)flipped / (double)count;
    /* Nearest rank in whole numbers: 99.9 % of the count in floating point may land above a whole number. */
    size_t rank = (count * 999 + 999) / 1000;
    out->p999 = select_rank(difference, (ptrdiff_t)count, (ptrdiff_t)rank - 1);
    double mean = channels / (4 * (double)count);
    out->psnr = mean > 0 ? 10 * log10(255.0 * 255.0 / mean) : INFINITY;
    free(difference);
    return similarity(a, b, quantised, &out->ssim, err);
}

bool ang_metrics_map(const ang_image *a, const ang_image *b, float *out, ang_error *err) {
    if (!same_size(a, b, err)) return false;
    differences(a, b, false, out);
    return true;
}

bool ang_heat_image(const float *values, double scale, int width, int height, ang_image *out, ang_error *err) {
    *out = (ang_image){0};
#ifdef ANG_WITH_OPENCV
    size_t count = (size_t)width * (size_t)height;
    if (!ang_image_create(out, width, height, err)) return false;
    float *shares = ang_alloc(count, sizeof *shares, "heat map", err);
    unsigned char *rgb = shares ? ang_alloc(3 * count, 1, "heat map", err) : NULL;
    bool good = rgb != NULL;
    if (good) {
        for (size_t i = 0; i < count; i++) shares[i] = scale > 0 ? (float)(values[i] / scale) : 0;
        good = ang_opencv_heat(shares, width, height, rgb) || ang_fail(err, ANG_LIMIT, "OpenCV made no heat map");
    }
    for (size_t i = 0; good && i < count; i++) {
        for (size_t c = 0; c < 3; c++) out->rgba[4 * i + c] = (float)rgb[3 * i + c] / 255;
        out->rgba[4 * i + 3] = 1;
    }
    free(shares);
    free(rgb);
    if (!good) ang_image_clear(out);
    return good;
#else
    (void)values, (void)scale, (void)width, (void)height;
    return ang_fail(err, ANG_USAGE, "this build has no OpenCV (ANG_WITH_OPENCV), which colours the heat map");
#endif
}

bool ang_metrics_heat(const ang_image *a, const ang_image *b, bool quantised, ang_image *out, double *scale,
                      ang_error *err) {
    *out = (ang_image){0};
    if (!same_size(a, b, err)) return false;
    size_t count = (size_t)a->width * (size_t)a->height;
    float *values = ang_alloc(count, sizeof *values, "heat map", err);
    if (!values) return false;
    differences(a, b, quantised, values);
    float largest = 0;
    for (size_t i = 0; i < count; i++) largest = fmaxf(largest, values[i]);
    if (scale) *scale = largest;
    bool good = ang_heat_image(values, largest, a->width, a->height, out, err);
    free(values);
    return good;
}
