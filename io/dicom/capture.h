/* A picture as a DICOM Secondary Capture Image (PS3.3 A.8.1): what a PACS keeps beside the study. */
#ifndef ANG_DICOM_CAPTURE_H
#define ANG_DICOM_CAPTURE_H

#include "core/base/error.h"
#include "core/base/notes.h"
#include "io/dicom/identity.h"

#include <stdbool.h>
#include <stddef.h>

/* What all pictures of one series have: patient and study. Plain value that borrows `source`. */
typedef struct ang_capture {
    bool identified;            /* patient and study are the source's */
    const ang_identity *source; /* NULL: none */
    char pseudonym[64];         /* without them, the patient's id and a part of his name */
    char study_uid[65], series_uid[65];
    char date[9], time[7]; /* of this capture */
    char program[64];      /* name and version */
} ang_capture;

/* Begins a series. With `keep_phi` patient and study are those of the DICOM file `source` (NULL: the input is none)
 * with its character set, and the new series lies in its study; what cannot be had is left empty and said in
 * `warnings`. Without, all that PS3.15 table E.1-1 (Basic Application Level Confidentiality Profile) removes or
 * replaces is absent, empty or made up: the study is a new one, patient's name and id are `pseudonym`, there are no
 * dates, and the file says by which profile. False with ANG_OUTPUT (no random numbers). Thread safe but for
 * the time zone. */
bool ang_capture_begin(ang_capture *capture, const ang_identity *source, bool keep_phi, const char *pseudonym,
                       const char *program, ang_notes *warnings, ang_error *err);

/* One picture. */
typedef struct ang_capture_picture {
    int width, height;        /* pixels, at most 65535 */
    const unsigned char *rgb; /* rows from the top, 3 bytes a pixel */
    int number;               /* InstanceNumber, from 1 */
    const char *right, *down; /* letters of the patient's direction (PatientOrientation); "": unknown */
    const char *description;  /* how it was made; characters that are not ASCII become '?' */
} ang_capture_picture;

/* The bytes of a file, into *out (free with free()). False with ANG_LIMIT, also for pictures that are too large, or
 * ANG_OUTPUT. */
bool ang_capture_encode(const ang_capture *capture, const ang_capture_picture *picture, unsigned char **out,
                        size_t *size, ang_error *err);

#endif
