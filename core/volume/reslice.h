/* Planes and slabs through the volume at any place and angle (multiplanar reformation). */
#ifndef ANG_VOLUME_RESLICE_H
#define ANG_VOLUME_RESLICE_H

#include "core/volume/volume.h"

/* What of a slab's thickness a pixel shows. */
typedef enum ang_slab { ANG_SLAB_MEAN, ANG_SLAB_MIP, ANG_SLAB_MINIP } ang_slab;
/* "mean", "mip", "minip"; NULL or -1 where there is no such value. */
const char *ang_slab_name(ang_slab slab);
int ang_slab_from_name(const char *name);

/* Pixel (i, j) lies at origin + i step_x + j step_y, LPS mm. */
typedef struct ang_reslice_plane {
    ang_vec3 origin, step_x, step_y; /* mm; the steps need be neither orthogonal nor of one length, but not parallel */
    int width, height;               /* pixels, >= 1 */
    double thickness_mm;             /* of the slab, half to each side of the plane, along its normal; 0: the plane */
    ang_slab slab;                   /* where thickness_mm > 0 */
    bool nearest;                    /* the nearest voxel's value, not interpolated */
} ang_reslice_plane;

/* The most planes that a slab is sampled by. */
enum { ANG_RESLICE_MOST_PLANES = 1024 };

/* The number of planes that stand for the slab: 1 without thickness. For the mean at least one for each voxel that its
 * thickness crosses, each in the middle of an equal share; for the extremes at most half a voxel apart, from face to
 * face, so that a slab of whole voxels about a voxel's centre meets the centres of its neighbours. */
int ang_reslice_planes(const ang_volume *volume, const ang_reslice_plane *plane);

/* Writes HU, rows of `width` floats, to `hu`: trilinear interpolation between voxel centres, so exact for a field that
 * is linear between them, or with `nearest` the value of the voxel in whose cell the place lies; NAN outside the box
 * (DESIGN.md, "Box"). In a slab what lies outside is left out. In parallel, independent of `threads` (0: all). False
 * with ANG_USAGE (parallel steps, no pixels) and ANG_GEOMETRY (a singular affine). Thread safe. */
bool ang_reslice(const ang_volume *volume, const ang_reslice_plane *plane, int threads, float *hu, ang_error *err);

#endif
