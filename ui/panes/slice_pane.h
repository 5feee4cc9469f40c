/* A pane with a slice: its picture, and what the hands do on it. */
#ifndef ANG_UI_SLICE_PANE_H
#define ANG_UI_SLICE_PANE_H

#include "core/scene/image.h"
#include "ui/panes/slice_mark.h"
#include "ui/state/layout.h"
#include "ui/state/slice_geometry.h"

typedef struct ang_viewer ang_viewer;

/* A slice's picture, kept until what it shows changes. */
struct ang_slice_picture {
    ang_reslice_plane plane; /* of `hu` */
    double centre, width;    /* of the texture */
    float *hu;
    uint8_t *rgba;
    size_t room; /* pixels */
    bool filled;
    unsigned version; /* counts what `hu` has been */
    ang_paint_texture texture;
    ang_slice_mark mark;
};

void ang_slice_pane(ang_viewer *viewer, ang_pane pane, ang_rect rect);
void ang_slice_scroll(ang_viewer *viewer, ang_orientation orientation, int slices);
void ang_slice_picture_clear(ang_viewer *viewer, ang_slice_picture *picture);
/* Where a slice pane's pixels lie while it is at `rect`. */
ang_slice_frame ang_slice_frame_of(const ang_viewer *viewer, ang_orientation orientation, ang_rect rect);
/* 100: a pixel of the screen for each of the volume's smallest voxel spacing. */
double ang_slice_zoom_percent(const ang_viewer *viewer, ang_pane pane);
/* The slice as a picture to be written. */
bool ang_slice_image(ang_viewer *viewer, ang_orientation orientation, ang_image *image, ang_error *err);

#endif
