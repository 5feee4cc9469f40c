/* Several volumes at the same positions of one series: which slices make each, in which order they come, and what each
 * is (dicom-rules 6). Pure functions over slice records. */
#ifndef ANG_DICOM_PHASES_H
#define ANG_DICOM_PHASES_H

#include "io/dicom/parts.h"

/* Whether two slices at one place say themselves that they belong to different phases: equal pixels are no duplicate
 * then. */
bool ang_dicom_phases_differ(const ang_dicom_slice *a, const ang_dicom_slice *b);

/* Numbers `count` slices, sorted by position, by their phase: 0 to phases - 1, in the order of what tells phases apart,
 * which is returned; ANG_DICOM_KEYS where nothing does: then the n-th InstanceNumber at a place is of the n-th phase.
 * Slices of equal `place` are at one; `phases` is how many are at the fullest. */
ang_dicom_key ang_dicom_number_phases(const ang_dicom_slice *slices, const size_t *order, const size_t *place,
                                      size_t count, int phases, int *phase);

/* What a phase is, in words that identify nobody: "temporal position 2", "acquired 1.5 s after the first". `number`
 * counts from 1; `slice` is one of it, `first` one of the first phase. */
void ang_dicom_phase_words(ang_dicom_key key, const ang_dicom_slice *slice, const ang_dicom_slice *first, int number,
                           char *out, size_t size);

#endif
