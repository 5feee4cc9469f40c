/* The crosshair of a slice pane: lines where the other two planes cut it, and handles on them that turn those planes.
 */
#ifndef ANG_UI_CROSSHAIR_H
#define ANG_UI_CROSSHAIR_H

#include "ui/gui.h"
#include "ui/state/layout.h"
#include "ui/state/slice_geometry.h"

typedef struct ang_viewer ang_viewer;

/* Whether there is a handle at a place of the pane. */
bool ang_crosshair_handle_at(const ang_viewer *viewer, ang_pane pane, const ang_slice_frame *frame, double x, double y);
/* Turns the planes as the hand goes round the crosshair; Shift: ten times finer. Without it they snap to the patient's
 * axes within a degree, in a pane that lies along these. */
void ang_crosshair_turn(ang_viewer *viewer, ang_pane pane, const ang_slice_frame *frame, const ang_canvas *canvas);
void ang_crosshair_draw(ang_viewer *viewer, ang_pane pane, ang_rect rect, const ang_slice_frame *frame,
                        const ang_canvas *canvas);

#endif
