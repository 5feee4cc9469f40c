/* What a ray of the 3D picture meets: the first place that shows, and how much of a place can be seen. */
#ifndef ANG_UI_VOLUME_RAY_H
#define ANG_UI_VOLUME_RAY_H

#include "core/scene/scene.h"

typedef struct ang_viewer ang_viewer;

/* The first place along a pixel's ray that shows; false where there is none. */
bool ang_volume_pick(ang_viewer *viewer, double x, double y, ang_vec3 *mm);

/* From where places are looked at: the picture's scene. Borrows from the viewer's picture; for one frame. */
typedef struct ang_sight {
    const ang_volume *volume;
    ang_scene scene;
    ang_ray_frame frame;
    double step, slack; /* mm: of samples; what lies so close before a place hides nothing of it */
} ang_sight;
/* Of a pane of this size. False where there is no picture yet. */
bool ang_sight_make(const ang_viewer *viewer, int width, int height, ang_sight *sight);
/* Where the picture shows a place (LPS mm), and the share 0..1 of its light that what lies before it lets through: all
 * in modes without depth. Negative where the place lies beside the picture's field or behind the eye. Pure. */
double ang_sight_share(const ang_sight *sight, ang_vec3 mm, double *x, double *y);

#endif
