/* Files with presets of other programs, opened like any other. */
#ifndef ANG_UI_PRESET_FILES_H
#define ANG_UI_PRESET_FILES_H

#include <stdbool.h>

typedef struct ang_viewer ang_viewer;

/* Where `path` is such a file its presets become the user's own, through the host, and the first is shown; what was
 * lost or went wrong is said. False where it is none. */
bool ang_preset_file_take(ang_viewer *viewer, const char *path);

#endif
