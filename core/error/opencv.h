/* What OpenCV does for picture comparison, as C functions. Only in builds with ANG_WITH_OPENCV. */
#ifndef ANG_ERROR_OPENCV_H
#define ANG_ERROR_OPENCV_H

#include <stdbool.h>

/* Mean structural similarity of two pictures of one channel, width * height floats in levels of 255, rows from the top
 * (metrics.h states the variant). NAN below 11x11 pixels or where OpenCV fails. Thread safe. */
double ang_opencv_ssim(const float *a, const float *b, int width, int height);

/* Colours values in 0..1 (width * height) by the map "inferno" into RGB triples of bytes; 0 becomes pure black. False
 * where OpenCV fails. Thread safe. */
bool ang_opencv_heat(const float *values, int width, int height, unsigned char *rgb);

#endif
