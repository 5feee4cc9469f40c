/* The axes of a NRRD header: which are the volume's, which tells phases, and where they lie in the patient. Private to
 * io/voxels/. */
#ifndef ANG_VOXELS_NRRD_AXES_H
#define ANG_VOXELS_NRRD_AXES_H

#include "io/voxels/header_text.h"
#include "io/voxels/volume_header.h"

enum { ANG_NRRD_AXES = 16 };

/* NaN, 0 or "" where the header does not say. */
typedef struct ang_nrrd_axis {
    double size, spacing, thickness, least, most;
    double direction[3]; /* of a sample, in space */
    bool has_direction;
    bool node; /* samples at both ends of [least, most] */
    char kind[32], unit[32];
} ang_nrrd_axis;

typedef struct ang_nrrd_axes {
    int dimension; /* 0: not said yet */
    ang_nrrd_axis axis[ANG_NRRD_AXES];
    char space[64];
    int space_dimension; /* 0: the header has no space */
    double origin[3], unit_mm[3];
    bool has_origin;
} ang_nrrd_axes;

void ang_nrrd_axes_start(ang_nrrd_axes *axes);
/* Takes the field where it is about axes or space, else leaves `*known` false. False with ANG_INPUT. */
bool ang_nrrd_axes_field(ang_nrrd_axes *axes, const char *label, const char *field, const char *value, bool *known,
                         ang_error *err);
/* Dimensions, phases and affine of the header. False with ANG_INPUT, ANG_GEOMETRY. */
bool ang_nrrd_axes_use(const ang_nrrd_axes *axes, const char *label, ang_volume_header *header, ang_error *err);

#endif
