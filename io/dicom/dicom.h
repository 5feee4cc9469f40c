/* A DICOM file or folder becomes a volume. */
#ifndef ANG_DICOM_DICOM_H
#define ANG_DICOM_DICOM_H

#include "io/load.h"

/* As ang_load, for a folder or a DICOM file. */
ang_volume *ang_dicom_load(const char *path, const ang_load_options *options, ang_load_report *report,
                           const ang_progress *progress, ang_error *err);

/* Whether the file is DICOM, with or without preamble. */
bool ang_dicom_probe(const char *path);

#endif
