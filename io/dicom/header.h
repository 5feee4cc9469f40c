/* A DICOM file's header becomes a slice record. */
#ifndef ANG_DICOM_HEADER_H
#define ANG_DICOM_HEADER_H

#include "io/dicom/parse.h"
#include "io/dicom/slice.h"

/* Reads the header of `path` up to the pixel data (`label` names it in errors) into `slice`. ANG_DICOM_BROKEN where it
 * is DICOM but lacks what an image needs or claims more than the file holds: `err` names file and tag. Objects without
 * pixels and images that no volume can hold are found, with `refusal` set. A multi-frame image becomes slice->frames
 * records at `*frames`, to be freed; NULL for others. `reader` is scratch. Thread safe. */
ang_dicom_found ang_dicom_header(const char *path, const char *label, ang_dicom_reader *reader, ang_dicom_slice *slice,
                                 ang_dicom_slice **frames, ang_error *err);

#endif
