/* What the viewer remembers between runs: $XDG_CONFIG_HOME/angioscope/viewer.json, or ~/.config/angioscope/viewer.json.
 * Nothing in it is of a study but the places of the last files opened. */
#ifndef ANG_IO_PREFERENCES_H
#define ANG_IO_PREFERENCES_H

#include "core/base/error.h"

#include <stdbool.h>
#include <stddef.h>

enum { ANG_RECENT_FILES = 10, ANG_RECENT_PATH = 1024 };

/* A plain value. */
typedef struct ang_preferences {
    bool light_theme;
    double split_across, split_down; /* shares, 0..1 */
    double panel_width;              /* at scale 1, pixels */
    bool panel_hidden;
    bool corner_text, crosshair;
    int window_width, window_height; /* pixels; 0: as suits the screen */
    int recent_count;
    char recent[ANG_RECENT_FILES][ANG_RECENT_PATH]; /* absolute paths, the last one first */
} ang_preferences;
extern const ang_preferences ang_preferences_default;

/* Where they are kept; false where neither variable names an absolute folder. */
bool ang_preferences_path(char *path, size_t size);

/* Reads them from `path`; defaults where there is no such file. False, with defaults and one sentence for a warning,
 * where the file is damaged or cannot be read. A single number out of range or of another type is replaced by its
 * default without a word, since a later version may have written it. */
bool ang_preferences_read(const char *path, ang_preferences *preferences, ang_error *err);

/* Writes them whole or not at all; makes the folder. False with ANG_OUTPUT. */
bool ang_preferences_write(const char *path, const ang_preferences *preferences, ang_error *err);

#endif
