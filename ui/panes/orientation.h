/* The patient's axes in the corner of the 3D pane. */
#ifndef ANG_UI_ORIENTATION_H
#define ANG_UI_ORIENTATION_H

#include "core/scene/scene.h"
#include "ui/toolkit/rect.h"

typedef struct ang_viewer ang_viewer;

/* The patient's axes as the camera sees them, small in the corner. */
void ang_orientation_axes(ang_viewer *viewer, ang_rect rect, const ang_camera *camera);

#endif
