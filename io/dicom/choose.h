/* Which series is loaded. Pure functions over slice records. */
#ifndef ANG_DICOM_CHOOSE_H
#define ANG_DICOM_CHOOSE_H

#include "io/dicom/series.h"

/* The group to load, of the series' first phase: series number `series` (1, 2, ...) or the one whose SeriesInstanceUID
 * ends in it; NULL: the largest CT volume, else the largest of another modality; of equal ones the first without lossy
 * compression, else the first. ANG_INPUT where there is none that can be loaded. */
bool ang_dicom_choose(const ang_dicom_slice *slices, const ang_dicom_groups *groups, const char *series, size_t *chosen,
                      ang_error *err);

#endif
