/* Where the slices of one series lie: order, spacing, gaps, tilt and the affine (dicom-rules 2 to 5 and 7). Pure
 * functions over slice records. */
#ifndef ANG_DICOM_GEOMETRY_H
#define ANG_DICOM_GEOMETRY_H

#include "core/base/error.h"
#include "core/base/notes.h"
#include "io/dicom/slice.h"
#include "io/load.h"

/* The grid that the slices make. Owns its arrays; free with ang_dicom_grid_clear. */
typedef struct ang_dicom_grid {
    size_t planes;     /* of the volume; at least the number of slices unless resampled */
    size_t *below;     /* per plane: the slice (in order) at or below it */
    float *weight;     /* per plane: share of the next slice, 0 where the plane is slice `below` itself */
    bool interpolates; /* some plane is not a slice */
    bool resampled;    /* irregular: planes lie at equal distances, slices need not be planes */
    ang_mat4 affine;   /* voxel index to LPS mm */
    double tilt_deg;   /* angle between the normal and the line from the first to the last slice */
    ang_gap *gaps;     /* gaps that differ from the median */
    size_t gap_count;
    int missing;                    /* slices missing in gaps of a multiple of the median */
    double median, least, greatest; /* of the gaps, mm; 0 for one slice */
} ang_dicom_grid;

void ang_dicom_grid_clear(ang_dicom_grid *grid);

/* The slice with what geometry takes where the header leaves it out: axial directions, pixels of 1 mm. */
ang_dicom_slice ang_dicom_with_defaults(const ang_dicom_slice *slice);

/* row x column, of unit length; zero where the directions are degenerate. */
ang_vec3 ang_dicom_normal(const ang_dicom_slice *slice);

/* Position of a slice along `normal` in mm. */
double ang_dicom_along(const ang_dicom_slice *slice, ang_vec3 normal);

/* Sorts `order`, indices into `slices`, by position along the normal of the first; by instance number where positions
 * are missing (a line in `assumptions`, which may be NULL). Slices at one position are in order of instance number. */
void ang_dicom_sort(const ang_dicom_slice *slices, size_t *order, size_t count, ang_notes *assumptions);

/* The grid of sorted slices that all differ in position. ANG_GEOMETRY where no grid can be made of them, ANG_LIMIT
 * where it would have more planes than memory or sense allow. */
bool ang_dicom_geometry(const ang_dicom_slice *slices, const size_t *order, size_t count, ang_dicom_grid *grid,
                        ang_notes *assumptions, ang_notes *warnings, ang_error *err);

#endif
