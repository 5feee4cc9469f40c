/* A pane with a slice: its picture, and what the hands do on it. */
#ifndef ANG_UI_SLICE_PANE_H
#define ANG_UI_SLICE_PANE_H

#include "ui/panes/slice_picture.h"
#include "ui/state/layout.h"
#include "ui/state/slice_geometry.h"

typedef struct ang_viewer ang_viewer;

void ang_slice_pane(ang_viewer *viewer, ang_pane pane, ang_rect rect);
void ang_slice_scroll(ang_viewer *viewer, ang_orientation orientation, int slices);
/* Where a slice pane's pixels lie while it is at `rect`. */
ang_slice_frame ang_slice_frame_of(const ang_viewer *viewer, ang_orientation orientation, ang_rect rect);
/* 100: a pixel of the screen for each of the volume's smallest voxel spacing. */
double ang_slice_zoom_percent(const ang_viewer *viewer, ang_pane pane);

#endif
