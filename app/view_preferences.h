/* The viewer's settings in the user's folder of configuration. */
#ifndef ANG_APP_VIEW_PREFERENCES_H
#define ANG_APP_VIEW_PREFERENCES_H

#include "core/base/error.h"
#include "ui/host/settings.h"

/* As they were left, else the defaults; a damaged file is told on stderr and replaced when next written. */
void ang_view_preferences_read(ang_viewer_settings *settings);
/* False with ANG_OUTPUT; the viewer does without. */
bool ang_view_preferences_write(const ang_viewer_settings *settings, ang_error *err);

#endif
