/* The series among files and folders: their headers read, grouped and described. */
#ifndef ANG_DICOM_LISTING_H
#define ANG_DICOM_LISTING_H

#include "io/dicom/folder.h"
#include "io/dicom/series.h"
#include "io/load.h"
#include "io/sandbox/sandbox.h"

/* Owns everything; free with ang_dicom_listing_clear. */
typedef struct ang_dicom_listing {
    ang_dicom_folder folder;
    ang_dicom_groups groups;
    ang_sandbox *sandbox; /* for what is decoded of them; NULL with options->no_sandbox */
} ang_dicom_listing;

/* Reads the headers of all files at and below the paths, groups them and describes the groups in report->series. Files
 * that cannot be read or are no DICOM go to the report's notes. False with ANG_INPUT where there is no image,
 * ANG_LIMIT, ANG_INTERRUPTED. */
bool ang_dicom_list(const char *const *paths, size_t count, const ang_load_options *options, ang_load_report *report,
                    const ang_progress *progress, ang_dicom_listing *listing, ang_error *err);
void ang_dicom_listing_clear(ang_dicom_listing *listing);

/* Distance in mm of the slices of a sorted group along their normal (rule 4); their thickness where positions do not
 * say. */
double ang_dicom_slice_distance(const ang_dicom_slice *slices, const ang_dicom_group *group);

#endif
