/* The viewer's settings in the user's folder of configuration. */
#ifndef ANG_APP_VIEW_PREFERENCES_H
#define ANG_APP_VIEW_PREFERENCES_H

#include "ui/host/settings.h"

/* As they were left, else the defaults; a damaged file is told on stderr and replaced when next written. */
void ang_view_preferences_read(ang_viewer_settings *settings);
/* Where nothing can be written the viewer does without. */
void ang_view_preferences_write(const ang_viewer_settings *settings);

#endif
