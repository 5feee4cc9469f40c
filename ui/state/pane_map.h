/* Where a pane shows places of the patient, for handles that are drawn over pictures and dragged. Pure. */
#ifndef ANG_UI_PANE_MAP_H
#define ANG_UI_PANE_MAP_H

#include "core/scene/scene.h"
#include "ui/state/slice_geometry.h"

/* A place p (LPS mm) appears at middle_x + focal * right . (p - eye) / w pixels from the pane's left edge, and likewise
 * down from its top; w is the depth forward . (p - eye) in perspective and 1 else. */
typedef struct ang_pane_map {
    ang_vec3 eye;                  /* LPS mm; in parallel projection any place on the line of sight of the middle */
    ang_vec3 right, down, forward; /* orthonormal */
    double middle_x, middle_y;     /* pixels */
    double focal;                  /* pixels; without perspective pixels per mm */
    bool perspective;
    double near_mm; /* in perspective: what is nearer does not show */
} ang_pane_map;

ang_pane_map ang_pane_map_of_camera(const ang_camera *camera, int width, int height);
ang_pane_map ang_pane_map_of_slice(const ang_slice_frame *frame);

/* False where the place is beside or behind the eye. */
bool ang_pane_map_point(const ang_pane_map *map, ang_vec3 mm, double *x, double *y);
/* Pixels from where a place appears to (x, y); infinite where it does not show. */
double ang_pane_map_distance(const ang_pane_map *map, ang_vec3 mm, double x, double y);
/* The part of a line that shows, as x, y of both ends; false where there is none. It may leave the pane. */
bool ang_pane_map_line(const ang_pane_map *map, ang_vec3 from, ang_vec3 to, double ends[4]);
/* Cuts a line of pixels down to what is within 0..width and 0..height; false where nothing is. */
bool ang_line_within(double ends[4], double width, double height);
/* Pixels from (x, y) to such a line. */
double ang_line_distance(const double ends[4], double x, double y);

/* Pixels of a millimetre across the line of sight at a place; 0 beside and behind the eye. */
double ang_pane_map_scale(const ang_pane_map *map, ang_vec3 mm);
/* The unit direction in which the eye sees a place. */
ang_vec3 ang_pane_map_sight(const ang_pane_map *map, ang_vec3 mm);
/* The ray of what appears at (x, y): from `origin` along the unit `direction`. */
void ang_pane_map_ray(const ang_pane_map *map, double x, double y, ang_vec3 *origin, ang_vec3 *direction);

/* What the hand wants of a thing at `from` (which shows) that can only go along `along`, when it is to appear at (x,
 * y): the t for which from + t along appears at the foot of (x, y) on the line that it can take; beyond the vanishing
 * point infinite. Where `along` points at the eye or away from it (within 6 degrees) nothing of it would be seen: there
 * up goes away from the eye, as far as it would go across. */
double ang_pane_map_drag(const ang_pane_map *map, ang_vec3 from, ang_vec3 along, double x, double y);

/* The camera's zoom times `factor`, limited to 0.1..100, so that all that appears at pixels (x, y) of a picture of
 * width x height stays there: pans as well. */
void ang_view_zoom(ang_view *view, const ang_volume *volume, int width, int height, double x, double y, double factor);

/* Turns as ang_view_turn, about a place: it stays where it appears, as far from the eye as its way about the volume's
 * centre takes it. One that does not show is not kept. */
void ang_view_turn_about(ang_view *view, const ang_volume *volume, ang_vec3 mm, double right_deg, double down_deg);

#endif
