/* A DICOM file or folder becomes a volume. */
#ifndef ANG_DICOM_DICOM_H
#define ANG_DICOM_DICOM_H

#include "io/survey.h"

/* As ang_load, for folders and DICOM files. */
ang_volume *ang_dicom_load(const char *const *paths, size_t count, const ang_load_options *options,
                           ang_load_report *report, const ang_progress *progress, ang_error *err);
/* As ang_survey, for the same. */
bool ang_dicom_survey(const char *const *paths, size_t count, const ang_load_options *options, ang_load_report *report,
                      const ang_survey_sink *sink, const ang_progress *progress, ang_error *err);

/* Whether the file is DICOM, with or without preamble, or has the name of a DICOMDIR. */
bool ang_dicom_probe(const char *path);

#endif
