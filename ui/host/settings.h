/* What the viewer keeps from one run to the next; the host reads and writes it. */
#ifndef ANG_UI_SETTINGS_H
#define ANG_UI_SETTINGS_H

#include "ui/state/layout.h"
#include "ui/state/recent.h"

#include <stdbool.h>

typedef struct ang_viewer ang_viewer;

typedef struct ang_viewer_settings {
    bool light_theme;
    ang_layout layout;
    bool corner_text, crosshair;
    int width, height; /* of the window, pixels; 0: as suits the screen */
    ang_recent recent;
} ang_viewer_settings;

/* Takes over those of the host, where it has any; a layout that cannot be used is replaced. */
void ang_settings_take(ang_viewer *viewer);
/* Tells the host where they have changed since; `all`: the window's size too, which is not worth a file at each step of
 * a drag. */
void ang_settings_remember(ang_viewer *viewer, bool all);
/* A file or folder has been opened. */
void ang_settings_opened(ang_viewer *viewer, const char *path);

#endif
