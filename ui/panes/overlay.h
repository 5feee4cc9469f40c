/* What is written on the panes, their frames, and the status line. */
#ifndef ANG_UI_OVERLAY_H
#define ANG_UI_OVERLAY_H

#include "core/math/vec.h"
#include "ui/gui.h"
#include "ui/state/layout.h"

typedef struct ang_viewer ang_viewer;

ang_ink ang_pane_ink(ang_pane pane, unsigned alpha);

/* Small text as far as it fits into `room` pixels, with an ellipsis where something is left out: `text`, or what is
 * then written to `fitted`. */
const char *ang_text_fitted(const ang_gui *gui, const char *text, double room, char *fitted, size_t size);

void ang_pane_letters(ang_viewer *viewer, ang_rect rect, ang_vec3 right, ang_vec3 down);
void ang_pane_bar(ang_viewer *viewer, ang_rect rect, double mm_per_pixel, bool at_centre);
void ang_pane_corner(ang_viewer *viewer, ang_rect rect, int right, int bottom, int line, const char *text);
/* The pane's border, with its letter. */
void ang_pane_frame(ang_viewer *viewer, ang_rect rect, ang_pane pane);
void ang_status_line(ang_viewer *viewer, ang_rect rect);

#endif
