/* How large a volume goes into a picture. */
#ifndef ANG_SCENE_FIT_H
#define ANG_SCENE_FIT_H

#include "core/scene/scene.h"

/* The box of what is no air, above -500 HU and no padding, in voxel index space; all of the volume's where nothing is.
 * Reads every voxel once. Pure. */
void ang_volume_body_box(const ang_volume *volume, ang_vec3 *lower, ang_vec3 *upper);

/* The zoom at which all of a box (voxel index space), seen as `view` stands, just goes into a picture of `width` x
 * `height` pixels; view->zoom and view->pan_mm do not count. Pure. */
double ang_view_fitting_zoom(const ang_volume *volume, ang_vec3 lower, ang_vec3 upper, const ang_view *view, int width,
                             int height);

#endif
