/* Where a slice pane's pixels lie in the patient: pure geometry, no window. Radiological display: axial seen from the
 * feet, coronal from the front, sagittal from the left. */
#ifndef ANG_UI_SLICE_GEOMETRY_H
#define ANG_UI_SLICE_GEOMETRY_H

#include "core/volume/reslice.h"
#include "core/volume/volume.h"
#include "ui/state/turn.h"

typedef enum ang_orientation { ANG_AXIAL, ANG_CORONAL, ANG_SAGITTAL, ANG_ORIENTATIONS } ang_orientation;

const char *ang_orientation_name(ang_orientation orientation); /* "axial", ... */

/* The patient's directions (LPS, unit) to the right of, down and into the picture. */
typedef struct ang_slice_axes {
    ang_vec3 right, down, inward;
} ang_slice_axes;
/* Those of a pane whose plane is turned: the standard ones, turned the shortest way to the plane. So a plane that turns
 * in itself keeps its picture, and pictures stay as upright as they can. */
ang_slice_axes ang_slice_axes_of(const ang_turn *turn, ang_orientation orientation);
/* Degrees by which a pane's plane leans against the patient's (0..180), and by which the two other planes are turned in
 * it, to the right, against its picture's directions (-180..180). */
double ang_slice_lean(const ang_turn *turn, ang_orientation orientation);
double ang_slice_turned(const ang_turn *turn, ang_orientation orientation);

/* The slices that scrolling goes through: places along the axis `normal` (+x, +y or +z of LPS, turned), in mm, from one
 * side of the box to the other. A step is as long as it takes to go on by one voxel along the index axis on which that
 * is soonest: for a volume whose axes are the patient's, slices pass through its voxels' centres. */
typedef struct ang_slice_range {
    ang_vec3 normal;
    double first, last, step; /* mm; step > 0 */
    int count;                /* >= 1 */
    bool whole; /* only slices 0, 1, ... are shown: the normal is a patient's axis; else all between too */
} ang_slice_range;
ang_slice_range ang_slice_range_of(const ang_volume *volume, const ang_turn *turn, ang_orientation orientation);
/* The slice (0, 1, ...) nearest to a point, limited to the range; and the point moved along the normal to slice i. */
int ang_slice_index(const ang_slice_range *range, ang_vec3 mm);
ang_vec3 ang_slice_place(const ang_slice_range *range, ang_vec3 mm, int index);
/* The point moved along the normal by `slices` steps, to a slice that is shown. */
ang_vec3 ang_slice_move(const ang_slice_range *range, ang_vec3 mm, int slices);

/* How a pane shows its slice. */
typedef struct ang_slice_view {
    double zoom;      /* > 0; 1: the whole slice fits where it is not turned */
    double pan_mm[2]; /* of the pane's middle from that of the volume, to the right and down */
} ang_slice_view;
extern const ang_slice_view ang_slice_view_default;

/* A pane's pixels: i to the right, j down, of size mm_per_pixel whatever the voxels' spacing. */
typedef struct ang_slice_frame {
    ang_slice_axes axes;
    ang_vec3 corner; /* LPS mm of the left top corner of the pane, in the plane through the crosshair */
    double mm_per_pixel;
    int width, height;
} ang_slice_frame;
ang_slice_frame ang_slice_frame_make(const ang_volume *volume, const ang_turn *turn, ang_orientation orientation,
                                     const ang_slice_view *view, ang_vec3 crosshair, int width, int height);
/* The place under pane coordinates (pixel (i, j) has its centre at i + 0.5, j + 0.5), and back. */
ang_vec3 ang_slice_at(const ang_slice_frame *frame, double x, double y);
void ang_slice_locate(const ang_slice_frame *frame, ang_vec3 mm, double *x, double *y);
/* The direction in the pane (unit, to the right and down) in which another pane's plane cuts it. */
void ang_slice_cut(const ang_slice_frame *frame, const ang_turn *turn, ang_orientation other, double direction[2]);
/* What ang_reslice makes the pane's picture of. */
ang_reslice_plane ang_slice_plane(const ang_slice_frame *frame, double thickness_mm, ang_slab slab);

/* Magnifies by `factor` so that what is under (x, y) stays there. */
void ang_slice_zoom(ang_slice_view *view, const ang_slice_frame *frame, double x, double y, double factor);
/* Keeps the pane's middle within the volume, so that no pan or zoom loses the picture. */
void ang_slice_keep_inside(ang_slice_view *view, const ang_volume *volume, const ang_slice_axes *axes);
/* Shifts the view so that `mm` stays where it is in the pane when the axes change. */
void ang_slice_keep_place(ang_slice_view *view, const ang_volume *volume, ang_vec3 mm, const ang_slice_axes *before,
                          const ang_slice_axes *after);

#endif
