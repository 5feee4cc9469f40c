/* Measures as they are drawn: lines, handles and labels on slices, labels on the volume. */
#ifndef ANG_UI_MEASURE_DRAWING_H
#define ANG_UI_MEASURE_DRAWING_H

#include "core/scene/scene.h"
#include "ui/gui.h"
#include "ui/state/layout.h"
#include "ui/state/slice_geometry.h"

typedef struct ang_viewer ang_viewer;

void ang_measures_draw_slice(ang_viewer *viewer, ang_pane pane, ang_rect rect, const ang_canvas *canvas,
                             const ang_slice_frame *frame);
/* `scene`: of the pane's size. */
void ang_measures_draw_volume(ang_viewer *viewer, ang_rect rect, ang_scene scene);

#endif
