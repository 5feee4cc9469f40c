/* What an input is: a file of a known format, or a folder that holds one. */
#ifndef ANG_IO_KIND_H
#define ANG_IO_KIND_H

#include "io/load.h"

typedef enum ang_kind {
    ANG_KIND_NONE, /* nothing that is read */
    ANG_KIND_DICOM,
    ANG_KIND_NIFTI,
    ANG_KIND_NRRD,
    ANG_KIND_METAIMAGE,
    ANG_KIND_PICTURES,
    ANG_KIND_RAW,
} ang_kind;

/* What is read of an input. Free with ang_found_clear. */
typedef struct ang_found {
    ang_kind kind;
    char *path;    /* the input's own; that of the file, or of the folder of pictures, within a folder */
    size_t others; /* further volumes in the folder, which are not read */
} ang_found;

/* The format of a file by its first bytes, raw where the options or a sidecar say so. A folder is DICOM where any file
 * at or below it is, else what the first file of another format is, in the order of names, else pictures where a folder
 * holds some. Folders of which nothing is known count as DICOM, whose reader says what is in them. False with ANG_INPUT
 * where there is no such path or it is neither file nor folder, ANG_LIMIT, ANG_INTERRUPTED. */
bool ang_kind_find(const char *path, const ang_load_options *options, const ang_progress *progress, ang_found *found,
                   ang_error *err);
/* The same of the one of several inputs that is read, whose number goes to `*index`: the first that is DICOM, else the
 * first that is known, else the first. */
bool ang_kind_choose(const char *const *paths, size_t count, const ang_load_options *options,
                     const ang_progress *progress, size_t *index, ang_found *found, ang_error *err);
void ang_found_clear(ang_found *found);

#endif
