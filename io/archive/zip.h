/* The module that reads zip archives with libzip, which brings libraries for encryption and four ways of packing.
 * Private to io/archive/. */
#ifndef ANG_ARCHIVE_ZIP_H
#define ANG_ARCHIVE_ZIP_H

#include "core/base/error.h"
#include "core/base/notes.h"
#include "core/base/progress.h"

/* Writes the files of the archive `path`, called `label` in errors, below `folder`, which exists, under their names.
 * Names that lead out of it are left out with a warning, links become files. As ang_unpack. */
typedef bool ang_unzip(const char *path, const char *label, const char *folder, ang_notes *warnings,
                       const ang_progress *progress, ang_error *err);

ang_unzip ang_zip_unpack;

/* What the module exports: a pointer to such a function. */
#define ANG_ZIP_MODULE "angioscope-zip.so"
#define ANG_ZIP_SYMBOL "ang_zip_module"
typedef struct ang_zip_functions {
    ang_unzip *unzip;
} ang_zip_functions;

#endif
