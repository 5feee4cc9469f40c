/* Where points of index space lie in a picture, as the linear forms of OpenGL's clip coordinates. */
#ifndef ANG_SCENE_CLIP_SPACE_H
#define ANG_SCENE_CLIP_SPACE_H

#include "core/scene/scene.h"

/* Of p in index space about the box's centre. x / w and y / w are -1 at the picture's left and top edge and 1 at its
 * right and bottom edge: row j of GL's picture is row j from the top. w is the depth from the eye in mm in perspective,
 * 1 in parallel projection. */
typedef struct ang_clip_space {
    ang_linear_form x, y, w;
} ang_clip_space;

/* For the scene's picture of width x height pixels that `frame` was made for. Pure. */
ang_clip_space ang_clip_space_make(const ang_ray_frame *frame, int width, int height);

/* Whether all of the box lies well before the eye: nearer than a thousandth of its farthest point is nothing. Else
 * OpenGL clips faces where they meet the eye's plane, and may leave their edges apart. */
bool ang_clip_space_ahead(const ang_clip_space *space, ang_vec3 lower, ang_vec3 upper);

/* Whether all of the box lies beyond one edge of the picture, or behind the eye: then no pixel shows it. */
bool ang_clip_space_outside(const ang_clip_space *space, ang_vec3 lower, ang_vec3 upper);

#endif
