/* What the window saves: each in a new file of the folder of pictures, angioscope-WHAT-NNNN.ENDING. */
#ifndef ANG_APP_VIEW_SAVING_H
#define ANG_APP_VIEW_SAVING_H

#include "app/options.h"
#include "core/scene/image.h"
#include "ui/viewer.h"

#include <stddef.h>

/* As the functions of ang_viewer_host of these names. The number is the least that is free: nothing is written over,
 * whoever else writes there. False with ANG_OUTPUT, ANG_LIMIT. */
bool ang_view_save_picture(const ang_options *options, const char *what, const ang_image *image,
                           const ang_viewer_state *shown, char *path, size_t size, ang_error *err);
bool ang_view_save_capture(const ang_options *options, const char *what, const ang_image *image, const ang_study *study,
                           const char *right, const char *down, char *path, size_t size, ang_error *err);
bool ang_view_save_state(const ang_options *options, const ang_viewer_state *shown, char *path, size_t size,
                         ang_error *err);

#endif
