/* A picture in floating point, as every method makes it. */
#ifndef ANG_SCENE_IMAGE_H
#define ANG_SCENE_IMAGE_H

#include "core/base/error.h"

#include <stdint.h>

/* Premultiplied RGBA before the background, rows from the top, 4 floats a pixel. Owns `rgba`. */
typedef struct ang_image {
    int width, height;
    float *rgba;
} ang_image;

/* Allocates width * height * 4 zeros; false with ANG_LIMIT, or ANG_USAGE for a size
 * below 1. Free with ang_image_clear. */
bool ang_image_create(ang_image *image, int width, int height, ang_error *err);
void ang_image_clear(ang_image *image);
/* Fills `image` from `drawn`, whose pixel (i, j) is the image's (first + i * stride, first + j * stride), bilinearly;
 * beyond the outermost of these with their values. */
void ang_image_enlarge(const ang_image *drawn, int stride, int first, ang_image *image);
/* Composites over background (r, g, b, a; not premultiplied) into unassociated RGBA floats in 0..1 (`out`: 4 per
 * pixel). */
void ang_image_over(const ang_image *image, const double background[4], float *out);

#endif
