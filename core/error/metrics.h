/* How far two pictures lie apart (DESIGN.md, "Error"). */
#ifndef ANG_ERROR_METRICS_H
#define ANG_ERROR_METRICS_H

#include "core/base/error.h"
#include "core/scene/image.h"

/* A level is 1/255 of a channel. A pixel's difference is that of its channel (of premultiplied R, G, B, A, each clipped
 * to 0..1) which differs most, in levels. A value that is not a number differs by 255. */
typedef struct ang_metrics {
    double max;     /* levels: largest difference of a pixel */
    double rms;     /* levels: root of the mean over pixels of the squared difference of a pixel (not over channels) */
    double p999;    /* levels: least difference that at least 99.9 % of the pixels do not exceed */
    double psnr;    /* dB: 10 log10(255^2 / mean squared difference over pixels and all four channels); INFINITY where
                       equal: null in JSON */
    double ssim;    /* -1..1: mean structural similarity of the luma; NAN without OpenCV or below 11x11 pixels: null */
    double flipped; /* 0..1: share of pixels that differ by more than 16 levels */
} ang_metrics;

/* Compares two pictures of equal size. `quantised` rounds both to 8 bits first, as `check` wants it of pictures that
 * come from 8-bit files. Luma is 0.299 R + 0.587 G + 0.114 B (ITU-R BT.601) of the premultiplied colour, in levels;
 * SSIM after Wang, Bovik, Sheikh & Simoncelli, IEEE Trans. Image Processing 13(4), 2004, sections III.B-C: Gaussian
 * window of 11x11, sigma 1.5, K1 0.01, K2 0.03, L 255, mean over the windows that lie within the picture. False with
 * ANG_USAGE where the sizes differ, ANG_LIMIT where memory is out. Thread safe. */
bool ang_metrics_compute(const ang_image *a, const ang_image *b, bool quantised, ang_metrics *out, ang_error *err);

/* Each pixel's difference in levels, of the unrounded values, into `out` (width * height). False with ANG_USAGE where
 * the sizes differ. Thread safe. */
bool ang_metrics_map(const ang_image *a, const ang_image *b, float *out, ang_error *err);

/* A heat map of width x height values: black at 0, then OpenCV's "inferno" up to yellow at `scale`. False with
 * ANG_LIMIT, and with ANG_USAGE in a build without OpenCV. Free `out` with ang_image_clear. Thread safe. */
bool ang_heat_image(const float *values, double scale, int width, int height, ang_image *out, ang_error *err);

/* A heat map of the pixels' differences into a new opaque picture: black where equal, then OpenCV's "inferno" up to
 * yellow for the largest, whose height in levels goes to `scale` (may be NULL); `quantised` as above. Free `out` with
 * ang_image_clear. False as above, and with ANG_USAGE in a build without OpenCV. Thread safe. */
bool ang_metrics_heat(const ang_image *a, const ang_image *b, bool quantised, ang_image *out, double *scale,
                      ang_error *err);

#endif
