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

/* One volume, or a folder of pictures. */
typedef struct ang_found_volume {
    ang_kind kind;
    char *path;
} ang_found_volume;

/* What is read of an input. Free with ang_found_clear. */
typedef struct ang_found {
    ang_found_volume *volume; /* more than one: series of the same number, from 1 */
    size_t count;             /* >= 1 */
} ang_found;

/* The format of a file by its first bytes, raw where the options or a sidecar say so. A folder is DICOM where any file
 * at or below it is, else all volumes in it, in the order of names, and behind them its folders of pictures. Folders of
 * which nothing is known count as DICOM, whose reader says what is in them. Of several paths the volumes follow one
 * another; where one is DICOM, that is all of it, with the first path, and where none is anything, it is the first path
 * with ANG_KIND_NONE. False with ANG_INPUT where there is no such path or it is neither file nor folder, ANG_LIMIT,
 * ANG_INTERRUPTED. */
bool ang_kind_find(const char *const *paths, size_t count, const ang_load_options *options,
                   const ang_progress *progress, ang_found *found, ang_error *err);
void ang_found_clear(ang_found *found);

#endif
