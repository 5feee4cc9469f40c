/* A slice record for tests of the loading rules. */
#ifndef ANG_TESTS_IO_SLICE_RECORD_H
#define ANG_TESTS_IO_SLICE_RECORD_H

#include "io/dicom/slice.h"

/* An axial CT slice at `z` mm. */
static inline ang_dicom_slice slice_at(double z, int instance) {
    ang_dicom_slice s = {.image = true,
                         .modality = "CT",
                         .series_uid = "1.2.3",
                         .image_type = "ORIGINAL\\PRIMARY\\AXIAL",
                         .samples = 1,
                         .frames = 1,
                         .rows = 4,
                         .columns = 6,
                         .bits_allocated = 16,
                         .bits_stored = 12,
                         .high_bit = 11,
                         .has_position = true,
                         .has_orientation = true,
                         .has_spacing = true,
                         .has_instance_number = true,
                         .instance_number = instance,
                         .position = {-10, -20, z},
                         .row = {1, 0, 0},
                         .column = {0, 1, 0},
                         .row_spacing = 0.5,
                         .column_spacing = 0.25,
                         .has_slope = true,
                         .has_intercept = true,
                         .slope = 1,
                         .intercept = -1024};
    return s;
}

#endif
