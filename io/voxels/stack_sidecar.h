/* What a JSON file says of a stack of pictures: docs/formats.md. Private to io/voxels/. */
#ifndef ANG_VOXELS_STACK_SIDECAR_H
#define ANG_VOXELS_STACK_SIDECAR_H

#include "core/base/error.h"

/* Lengths in mm, places in LPS. */
typedef struct ang_stack_form {
    double spacing[3];   /* along rows, down columns, from picture to picture */
    double origin[3];    /* of the centre of the first voxel */
    double direction[9]; /* unit vectors of these three */
    double slope, intercept;
    bool is_signed; /* samples are two's complement */
    bool has_spacing, has_origin, has_directions;
} ang_stack_form;

/* What holds without a file. */
ang_stack_form ang_stack_form_default(void);
/* Reads the file. False with ANG_USAGE, naming file and line, ANG_INPUT, ANG_LIMIT. */
bool ang_stack_form_read(const char *path, ang_stack_form *form, ang_error *err);

#endif
