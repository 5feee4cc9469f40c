/* The files below a folder and the DICOM headers among them. */
#ifndef ANG_DICOM_FOLDER_H
#define ANG_DICOM_FOLDER_H

#include "core/base/error.h"
#include "core/base/notes.h"
#include "core/base/progress.h"
#include "io/dicom/slice.h"

/* Files and the slices found in them. Owns everything; free with ang_dicom_folder_clear. */
typedef struct ang_dicom_folder {
    char **paths;        /* sorted */
    const char **labels; /* base name of each, for messages */
    size_t count;
    ang_dicom_slice *slices; /* of the pictures in the DICOM files that can be read, in order of path */
    size_t slice_count;
    size_t indexed; /* of the files: found through a DICOMDIR alone */
    size_t foreign; /* files that are no DICOM */
    size_t broken;  /* DICOM files that cannot be read */
    char first_error[512];
} ang_dicom_folder;

/* Reads the headers of all regular files at, in and below `count` >= 1 paths, on `threads` threads. A DICOMDIR stands
 * for the files that it names; where it is damaged or names files that are not there, for its folder, with a warning.
 * Files that are no DICOM are counted, DICOM files that cannot be read cost a line in `warnings` each. False with
 * ANG_INPUT where a path cannot be read, ANG_LIMIT, ANG_INTERRUPTED. */
bool ang_dicom_read_folder(const char *const *paths, size_t count, int threads, ang_dicom_folder *folder,
                           ang_notes *warnings, const ang_progress *progress, ang_error *err);
void ang_dicom_folder_clear(ang_dicom_folder *folder);

/* Adds `message` about the file `label` to `notes`; errors begin with "LABEL: ", which the note leaves out. */
void ang_dicom_warn_file(ang_notes *notes, const char *label, const char *message);

#endif
