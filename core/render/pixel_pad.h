/* How far polygons are widened so that rounding never loses a pixel at their rims; fragments decide what is theirs.
 * Include only within core/render/ and its tests. */
#ifndef ANG_RENDER_PIXEL_PAD_H
#define ANG_RENDER_PIXEL_PAD_H

#include "core/scene/scene.h"

/* An eighth of a pixel, many times what a rasteriser's grid of sub-pixels is off by, and by far more than positions in
 * float are. What is pushed out across a face of the box is pushed out at least as far within the picture. */
typedef struct ang_pixel_pad {
    double pixel;    /* mm on the plane of p */
    double rounding; /* mm for positions in float */
    double growth;   /* mm more for each mm of depth; 0 in parallel projection */
    ang_vec3 index;  /* index units in one mm across the faces of the box */
} ang_pixel_pad;

ang_pixel_pad ang_pixel_pad_make(const ang_ray_frame *frame);

#endif
