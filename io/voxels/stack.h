/* Stacks of grey pictures: a folder of numbered PNG or TIFF files, or a TIFF of many pages. Private to io/. */
#ifndef ANG_VOXELS_STACK_H
#define ANG_VOXELS_STACK_H

#include "io/load.h"

/* Whether the file begins like PNG or TIFF. */
bool ang_stack_probe(const char *path);
/* The geometry's file: stack.json in a folder, NAME.json beside a file. NULL where there is none. To be freed. */
char *ang_stack_sidecar(const char *path);
/* As ang_load, for such a folder or file. */
ang_volume *ang_stack_load(const char *path, const ang_load_options *options, ang_load_report *report,
                           const ang_progress *progress, ang_error *err);

#endif
