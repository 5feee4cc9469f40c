/* How far the 3D pane's refined picture may be off, found out while the hands rest. */
#ifndef ANG_UI_PICTURE_ERROR_H
#define ANG_UI_PICTURE_ERROR_H

#include <stddef.h>

typedef struct ang_viewer ang_viewer;

/* How far a picture may be off, in levels of 255 (core/error/estimate.h); NAN: not known. */
typedef struct ang_picture_error {
    unsigned version; /* of the picture; of another one it says nothing */
    double levels, rms;
    double not_before; /* seconds: when to try again after an interruption */
} ang_picture_error;

/* Seconds until the error of the picture that is shown should be estimated; infinite where there is nothing to do. */
double ang_picture_error_in(const ang_viewer *viewer);
/* Estimates it, until input comes. */
void ang_picture_error_find(ang_viewer *viewer);
/* For the status line; empty where there is no fine picture. */
void ang_picture_error_text(const ang_viewer *viewer, char *text, size_t size);

#endif
