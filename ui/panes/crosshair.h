/* The crosshair of a slice pane: lines where the other two planes cut it, and handles on them that turn those planes.
 */
#ifndef ANG_UI_CROSSHAIR_H
#define ANG_UI_CROSSHAIR_H

#include "ui/viewer_private.h"

/* Brings slices alone up to date with the document's turn, for what is shown anew. */
void ang_planes_take(ang_viewer *viewer);
/* Brings slices, views and crosshair up to date with the document's turn: what lies under the crosshair stays where it
 * is in each pane. Cheap where nothing has changed. */
void ang_planes_follow(ang_viewer *viewer);

/* Whether there is a handle at a place of the pane. */
bool ang_crosshair_handle_at(const ang_viewer *viewer, ang_pane pane, const ang_slice_frame *frame, double x, double y);
/* Turns the planes as the hand goes round the crosshair; Shift: ten times finer. Without it they snap to the patient's
 * axes within a degree, in a pane that lies along these. */
void ang_crosshair_turn(ang_viewer *viewer, ang_pane pane, const ang_slice_frame *frame, const ang_canvas *canvas);
void ang_crosshair_draw(ang_viewer *viewer, ang_pane pane, ang_rect rect, const ang_slice_frame *frame,
                        const ang_canvas *canvas);

#endif
