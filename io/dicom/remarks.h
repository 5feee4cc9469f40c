/* What is to be said of a series' values before they are read. */
#ifndef ANG_DICOM_REMARKS_H
#define ANG_DICOM_REMARKS_H

#include "io/dicom/series.h"

/* Adds what the headers of the group's slices say of the values and the volume does not follow, or leave open. */
void ang_dicom_note_values(const ang_dicom_slice *slices, const ang_dicom_group *group, ang_notes *assumptions,
                           ang_notes *warnings);

#endif
