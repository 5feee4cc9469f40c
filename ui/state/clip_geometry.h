/* The oblique clip plane: how it is set, turned and moved by hand, and where slices show it. Pure. */
#ifndef ANG_UI_CLIP_GEOMETRY_H
#define ANG_UI_CLIP_GEOMETRY_H

#include "core/scene/scene.h"
#include "ui/state/pane_map.h"

/* The plane through a place that cuts away what lies on the side to which `normal` (any length but 0) points. */
ang_clip_plane ang_clip_plane_through(ang_vec3 mm, ang_vec3 normal);
/* The same plane with the other side cut away. */
ang_clip_plane ang_clip_plane_flip(const ang_clip_plane *plane);
/* The nearest place of the plane. */
ang_vec3 ang_clip_plane_foot(const ang_clip_plane *plane, ang_vec3 mm);

/* Where the normal points to, as for a camera that stands there: azimuth 0 in front of the patient, +90 at the
 * patient's left, elevation up; degrees. And the plane turned about a place to such angles. */
void ang_clip_plane_angles(const ang_clip_plane *plane, double *azimuth_deg, double *elevation_deg);
ang_clip_plane ang_clip_plane_turned(ang_vec3 about, double azimuth_deg, double elevation_deg);
/* The plane moved along its normal, as far as it still meets the volume's box. */
ang_clip_plane ang_clip_plane_moved(const ang_clip_plane *plane, const ang_volume *volume, double mm);
/* Mm from the volume's centre to the plane, along its normal. */
double ang_clip_offset(const ang_clip_plane *plane, const ang_volume *volume);

/* The normal whose tip, `length` mm from `pivot`, appears at (x, y) or as near to it as it can: on the half of the
 * sphere that is towards the eye, or on the other. Unit. */
ang_vec3 ang_clip_normal_at(const ang_pane_map *map, ang_vec3 pivot, double length, bool towards_eye, double x,
                            double y);
/* Whether a tip is on the half towards the eye. */
bool ang_clip_tip_towards_eye(const ang_pane_map *map, ang_vec3 pivot, ang_vec3 tip);

/* The line in which the plane cuts a slice, within its pane: x, y of both ends in pixels; what is cut away is on the
 * left of the way from the first to the second as they are seen. False where it is parallel or outside. */
bool ang_clip_line(const ang_clip_plane *plane, const ang_slice_frame *frame, double ends[4]);

#endif
