/* The panel at the side: presets, rendering, slices. */
#ifndef ANG_UI_PANEL_H
#define ANG_UI_PANEL_H

#include "ui/toolkit/rect.h"

typedef struct ang_viewer ang_viewer;

void ang_panel(ang_viewer *viewer, ang_rect rect);

#endif
