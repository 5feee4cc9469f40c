/* Attributes that stand in the header of one slice or in the functional groups of many. */
#ifndef ANG_DICOM_ATTRIBUTES_H
#define ANG_DICOM_ATTRIBUTES_H

#include "io/dicom/parse.h"
#include "io/dicom/slice.h"

/* Takes an element over into the record where it says where the pixels lie, or is passed over. */
void ang_dicom_take_geometry(ang_dicom_reader *r, const ang_dicom_element *e, ang_dicom_slice *s);
/* The same where it says what the values mean: rescale and window. */
void ang_dicom_take_map(ang_dicom_reader *r, const ang_dicom_element *e, ang_dicom_slice *s);

#endif
