/* What a header says in words, reduced to words of the standard: what else stands there may name a patient. Pure
 * functions; the strings are static. */
#ifndef ANG_DICOM_TERMS_H
#define ANG_DICOM_TERMS_H

#include <stdbool.h>

/* The defined term of (0008,0060) Modality (PS3.3 C.7.3.1.1.1, retired ones too), else "other". */
const char *ang_dicom_modality(const char *text);

/* The defined term of value 3 of (0008,0008) ImageType (PS3.3 C.8.2.1.1.1 for CT, C.8.3.1.1.1 for MR), else "other". */
const char *ang_dicom_image_kind(const char *text);

/* What an object of this SOP class is (PS3.4 B.5), for the most frequent ones; else "other". */
const char *ang_dicom_class_name(const char *uid);

/* Whether `uid` looks like a transfer syntax of the standard (PS3.6 A): digits only, and too few to say anything else.
 */
bool ang_dicom_is_transfer_syntax(const char *uid);

#endif
