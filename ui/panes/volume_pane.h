/* The pane with the volume rendering, and what the hands do on it. */
#ifndef ANG_UI_VOLUME_PANE_H
#define ANG_UI_VOLUME_PANE_H

#include "ui/toolkit/rect.h"

typedef struct ang_viewer ang_viewer;

void ang_volume_pane(ang_viewer *viewer, ang_rect rect);
/* As in slices: 100 % is a pixel of the screen for each smallest spacing, here at the depth of the volume's centre. */
double ang_volume_zoom_percent(const ang_viewer *viewer);
/* About the pane's middle; by pixels. */
void ang_volume_zoom(ang_viewer *viewer, double factor);
void ang_volume_pan(ang_viewer *viewer, double right, double down);

#endif
