/* Between what the viewer shows and states (io/session/state.h). */
#ifndef ANG_APP_VIEW_STATE_H
#define ANG_APP_VIEW_STATE_H

#include "io/load.h"
#include "io/session/state.h"
#include "ui/viewer.h"

/* What is shown of a study as a state to be saved; its 3D picture is what 'angioscope render --state' draws.
 * `data_options` says how raw data were read. False with ANG_LIMIT. Clear with ang_state_clear. */
bool ang_view_state_of(const ang_viewer_state *shown, const ang_load_options *data_options, ang_state *state,
                       ang_error *err);
/* The other way, for the study that was loaded: `file` names the state in errors. False with ANG_USAGE, ANG_LIMIT. */
bool ang_view_session_of(const ang_state *state, const char *file, const ang_study *study, ang_session *session,
                         ang_error *err);

/* The state with a field "live" beside it of what else the window shows (mm, HU, degrees, pixels; "panes" and
 * "editor.plot" are x, y, width, height in the window), as text: for tests. Without the path of the data: nothing that
 * may identify a patient. NULL where memory is out. Free with free(). */
char *ang_view_state_print(const ang_viewer_state *shown, const ang_load_options *data_options);
/* What is shown as the text of a preset's file. NULL with ANG_LIMIT. Free with free(). */
char *ang_view_preset_print(const ang_document *document, const char *name, const char *description, ang_error *err);

#endif
