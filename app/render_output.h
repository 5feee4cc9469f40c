/* Where the pictures of render go: files of their own, a film, DICOM secondary captures. */
#ifndef ANG_APP_RENDER_OUTPUT_H
#define ANG_APP_RENDER_OUTPUT_H

#include "app/options.h"
#include "core/base/notes.h"
#include "core/scene/image.h"
#include "core/scene/scene.h"
#include "io/dicom/capture.h"
#include "io/load.h"
#include "io/movie/movie.h"

/* Zero-initialise; clear with ang_render_output_clear. Borrows `options` and, for captures, the report. */
typedef struct ang_render_output {
    const ang_options *options;
    ang_movie *movie;
    bool captures; /* DICOM */
    ang_capture capture;
} ang_render_output;

/* Refuses outputs that cannot be written as things stand, or would overwrite one another or what is read. False with
 * ANG_USAGE, ANG_OUTPUT. To be asked before long work. */
bool ang_render_output_check(const ang_options *options, ang_error *err);

/* Whether `path` ends as a DICOM secondary capture does. */
bool ang_render_output_is_capture(const char *path);

/* Opens what is for all frames. Sentences about what was left out go to `warnings`. False with what is wrong. */
bool ang_render_output_start(ang_render_output *output, const ang_options *options, const ang_load_report *report,
                             ang_notes *warnings, ang_error *err);
/* What goes beside the pixels of a frame. */
typedef struct ang_render_words {
    const char *state;       /* text for .png and .exr */
    const char *description; /* how it was made, for DICOM */
    const ang_scene *scene;  /* background and directions */
} ang_render_words;
/* Writes frame `frame` (from 0) of options->frames. */
bool ang_render_output_add(ang_render_output *output, int frame, const ang_image *image, const ang_render_words *words,
                           ang_error *err);
/* After the last frame. */
bool ang_render_output_finish(ang_render_output *output, ang_error *err);
/* Lets go; a film that is not finished is removed. */
void ang_render_output_clear(ang_render_output *output);

/* What writing rounds by at most, in levels; NaN: a film with loss. */
double ang_render_output_rounding(const ang_options *options, const double background[4]);

#endif
