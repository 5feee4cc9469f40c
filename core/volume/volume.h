/* The volume: 16-bit stored values on a grid, the map to Hounsfield units and the map to the patient. */
#ifndef ANG_VOLUME_VOLUME_H
#define ANG_VOLUME_VOLUME_H

#include "core/base/error.h"
#include "core/math/vec.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Owns `data` and `padding`. Read-only once loaded, then safe to share between threads. */
typedef struct ang_volume {
    int dims[3];          /* voxels along x (fastest), y, z; each >= 1 */
    uint16_t *data;       /* dims[0]*dims[1]*dims[2] stored values */
    double slope;         /* HU = slope * stored + intercept; slope > 0 */
    double intercept;     /* HU */
    ang_mat4 affine;      /* voxel index (centre of voxel 0,0,0 = 0,0,0) to LPS mm; may shear (gantry tilt) */
    uint64_t *padding;    /* one bit a voxel (x fastest, bit i%64 of word i/64), set where padding was; NULL: none */
    size_t padding_count; /* bits set */
    uint16_t minimum;     /* least and greatest stored value, padding left out */
    uint16_t maximum;
} ang_volume;

/* A volume of zeros with slope 1, intercept 0 and the identity affine; NULL with ANG_LIMIT or, for a dimension < 1,
 * ANG_INPUT. Free with ang_volume_free. */
ang_volume *ang_volume_create(const int dims[3], ang_error *err);
void ang_volume_free(ang_volume *volume);

/* Number of voxels. */
size_t ang_volume_count(const ang_volume *volume);
/* Millimetres between voxel centres along an index axis (length of the affine's column). */
double ang_volume_spacing(const ang_volume *volume, int axis);
/* Millimetres between neighbouring slice planes along their normal (dicom-rules 4): less than ang_volume_spacing along
 * z where the affine shears. */
double ang_volume_slice_distance(const ang_volume *volume);
/* The least of the three spacings, in mm: the unit of --step. */
double ang_volume_smallest_spacing(const ang_volume *volume);
/* Lower and upper corner of the box in voxel index space: first to last voxel centre; an axis of one voxel spans -0.5
 * to 0.5 (DESIGN.md, "Box"). */
void ang_volume_box(const ang_volume *volume, ang_vec3 *lower, ang_vec3 *upper);
/* Half the longest diagonal of the box in mm. */
double ang_volume_half_diagonal(const ang_volume *volume);
/* The box's centre in LPS mm. */
ang_vec3 ang_volume_centre(const ang_volume *volume);

static inline double ang_volume_hu(const ang_volume *volume, double stored) {
    return volume->slope * stored + volume->intercept;
}
/* The stored value (not rounded, not clamped) of a HU value. */
static inline double ang_volume_stored(const ang_volume *volume, double hu) {
    return (hu - volume->intercept) / volume->slope;
}
static inline bool ang_volume_is_padding(const ang_volume *volume, size_t index) {
    return volume->padding && (volume->padding[index / 64] >> (index % 64) & 1);
}

/* The stored value that padding is given: the nearest to -1000 HU. */
uint16_t ang_volume_padding_value(const ang_volume *volume);
/* Marks every voxel whose stored value is `padding_value` as padding and sets it to the stored value nearest to -1000
 * HU (dicom-rules 10). */
bool ang_volume_mark_padding(ang_volume *volume, uint16_t padding_value, ang_error *err);
/* Recomputes minimum and maximum, in parallel; call after the data have changed. */
void ang_volume_update_range(ang_volume *volume, int threads);
/* The stored value of padding that is not declared: a constant below -1024 HU that fills the corners of the slices,
 * that is, at least 3 of 4 corner pixels of at least 3 of 4 slices hold it. False where there is none (dicom-rules 10).
 */
bool ang_volume_find_padding(const ang_volume *volume, uint16_t *padding_value);

/* Trilinear interpolation of the stored values at a point in voxel index space, clamped to the box. */
double ang_volume_sample(const ang_volume *volume, ang_vec3 index);
/* The gradient in HU per mm, LPS: central differences of ang_volume_sample one voxel to each side along the index axes,
 * clamped at the box, halved, taken to mm by the inverse transpose of the affine (DESIGN.md, "Gradient"). `to_index` is
 * the inverse of the affine. */
ang_vec3 ang_volume_gradient(const ang_volume *volume, const ang_mat4 *to_index, ang_vec3 index);

#endif
