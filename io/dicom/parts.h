/* The volumes within one series: what tells them apart (dicom-rules 1 and 6). Pure functions over slice records. */
#ifndef ANG_DICOM_PARTS_H
#define ANG_DICOM_PARTS_H

#include "io/dicom/slice.h"

/* Values that tell volumes apart, best first. */
typedef enum ang_dicom_key {
    ANG_DICOM_BY_IMAGE_TYPE, /* all of its values */
    ANG_DICOM_BY_TEMPORAL_POSITION,
    ANG_DICOM_BY_TRIGGER_TIME,
    ANG_DICOM_BY_CARDIAC_PHASE,
    ANG_DICOM_BY_DIMENSIONS,
    ANG_DICOM_BY_ACQUISITION_NUMBER,
    ANG_DICOM_BY_OBJECT, /* the multi-frame file or concatenation */
    ANG_DICOM_BY_ACQUISITION_TIME,
    ANG_DICOM_BY_CONTENT_TIME,
    ANG_DICOM_KEYS,
} ang_dicom_key;

enum { ang_dicom_most_parts = 512 };

/* Writes the slice's value of a key; false where it has none. */
bool ang_dicom_key_text(const ang_dicom_slice *slice, ang_dicom_key key, char *out, size_t size);

/* Numbers the `count` slices of `order` by their value of `key`, from 0 in order of appearance, in `part`. Returns how
 * many values there are; 0 where a slice has none or there are more than ang_dicom_most_parts. */
int ang_dicom_parts_by_key(const ang_dicom_slice *slices, const size_t *order, size_t count, ang_dicom_key key,
                           int *part);

/* Why a series is several volumes. */
typedef enum ang_dicom_parting {
    ANG_DICOM_ONE_VOLUME,
    ANG_DICOM_ACQUISITIONS, /* regular stacks of different acquisitions that do not continue one another */
    ANG_DICOM_FAR_STACKS,   /* between them more slices are missing than there are */
} ang_dicom_parting;

/* How slices with positions that all differ, sorted by them along `normal`, part into volumes: their numbers go to
 * `part`, from 0 in order of position, how many there are to *parts. `scratch` has room for `count`. */
ang_dicom_parting ang_dicom_part_volumes(const ang_dicom_slice *slices, const size_t *order, size_t count,
                                         ang_vec3 normal, int *part, int *parts, double *scratch);

#endif
