/* "Show what this range selects": the voxels of a range of HU, marked in a slice. */
#ifndef ANG_UI_SLICE_MARK_H
#define ANG_UI_SLICE_MARK_H

#include "ui/gui.h"

typedef struct ang_viewer ang_viewer;

/* A picture to lie over the slice. */
typedef struct ang_slice_mark {
    float low, high;  /* HU that it marks */
    unsigned version; /* of the slice; 0: none */
    ang_paint_texture texture;
} ang_slice_mark;

typedef struct ang_slice_picture ang_slice_picture;

/* Draws over the slice's picture what the transfer-function editor selects, and says what it is; where nothing is to be
 * shown it costs nothing. */
void ang_slice_mark_show(ang_viewer *viewer, ang_slice_picture *picture, ang_rect rect);

#endif
