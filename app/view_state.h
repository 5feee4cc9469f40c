/* What the viewer shows, as JSON: for tests, and with it 'render' repeats the picture of the 3D pane. */
#ifndef ANG_APP_VIEW_STATE_H
#define ANG_APP_VIEW_STATE_H

#include "ui/viewer.h"

/* The state as text: mm, HU, degrees, pixels; every number exact. "render" has what to give to 'angioscope render' for
 * the 3D pane's picture, with "preset" saved to a file. Nothing that may identify a patient. NULL where memory is out.
 * Free with free(). */
char *ang_view_state_print(const ang_viewer_state *state);
/* What is shown as the text of a preset's file. NULL with ANG_LIMIT. Free with free(). */
char *ang_view_preset_print(const ang_document *document, ang_error *err);

#endif
