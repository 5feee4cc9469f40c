/* What the viewer's host reads: studies, surveys of series, folders. */
#ifndef ANG_APP_VIEW_LOAD_H
#define ANG_APP_VIEW_LOAD_H

#include "app/options.h"
#include "io/load.h"
#include "ui/viewer.h"

/* As ang_viewer_host's functions of these names. `how`: to be read, where `source` and `slices` say nothing else;
 * `keep_phi`: the study's report may say what identifies a patient. */
bool ang_view_load(const ang_load_options *how, bool keep_phi, const ang_source *source, const ang_slice_sink *slices,
                   ang_study *study, const ang_progress *progress, ang_error *err);
void ang_view_release(ang_study *study);
bool ang_view_survey(const ang_options *options, const ang_source *source, const ang_series_sink *sink,
                     const ang_progress *progress, ang_error *err);
bool ang_view_list_folder(const char *path, ang_file_list *list, ang_error *err);

#endif
