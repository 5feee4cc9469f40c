/* The picture of a slice: its values, greys and texture. A slab of many samples is coarse while it moves. */
#ifndef ANG_UI_SLICE_PICTURE_H
#define ANG_UI_SLICE_PICTURE_H

#include "core/scene/image.h"
#include "ui/panes/slice_mark.h"
#include "ui/state/slice_geometry.h"

typedef struct ang_viewer ang_viewer;

/* Kept until what it shows changes. */
struct ang_slice_picture {
    ang_reslice_plane plane; /* of `hu` */
    double centre, width;    /* of the texture */
    float *hu;
    uint8_t *rgba;
    size_t room; /* pixels */
    bool filled;
    bool coarse;            /* `hu` is interpolated between fewer pixels, */
    bool due;               /* which is over with the next frame */
    double changed_seconds; /* when `hu` was last made */
    unsigned version;       /* counts what `hu` has been */
    ang_paint_texture texture;
    ang_slice_mark mark;
};

/* Brings values, greys and texture up to date, each only where it has to be. */
bool ang_slice_picture_fill(ang_viewer *viewer, ang_slice_picture *picture, const ang_reslice_plane *plane,
                            ang_error *err);
void ang_slice_picture_clear(ang_viewer *viewer, ang_slice_picture *picture);
/* The slice as a picture to be written. */
bool ang_slice_image(ang_viewer *viewer, ang_orientation orientation, ang_image *image, ang_error *err);

/* Seconds until slices that are coarse should be refined; infinite where none is. */
double ang_slices_refine_in(const ang_viewer *viewer);
/* Lets the next frame refine them. */
void ang_slices_refine(ang_viewer *viewer);

#endif
