/* What is written on the panes, their frames, and the status line. */
#ifndef ANG_UI_OVERLAY_H
#define ANG_UI_OVERLAY_H

#include "core/math/vec.h"
#include "ui/gui.h"
#include "ui/state/layout.h"

typedef struct ang_viewer ang_viewer;

ang_ink ang_pane_ink(ang_pane pane, unsigned alpha);

void ang_pane_letters(ang_viewer *viewer, ang_rect rect, ang_vec3 right, ang_vec3 down);
void ang_pane_bar(ang_viewer *viewer, ang_rect rect, double mm_per_pixel, bool at_centre);
void ang_pane_corner(ang_viewer *viewer, ang_rect rect, int right, int bottom, int line, const char *text);
/* The pane's border, with its letter. */
void ang_pane_frame(ang_viewer *viewer, ang_rect rect, ang_pane pane);
void ang_status_line(ang_viewer *viewer, ang_rect rect);

#endif
