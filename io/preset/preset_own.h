/* The user's own presets: a folder of files, looked at before the installed ones. */
#ifndef ANG_IO_PRESET_OWN_H
#define ANG_IO_PRESET_OWN_H

#include "core/base/error.h"

#include <stdbool.h>
#include <stddef.h>

enum { ANG_PRESET_NAME_LENGTH = 63 }; /* bytes */

/* $XDG_CONFIG_HOME/angioscope/presets, else ~/.config/angioscope/presets; it need not exist. NULL where neither is
 * known. Read from the environment at the first call; valid until the program ends. Not thread safe at that call. */
const char *ang_preset_own_folder(void);

/* Whether a preset can be saved by this name, which becomes its file's: 1 to ANG_PRESET_NAME_LENGTH bytes of UTF-8
 * without control characters and slashes; neither begins nor ends with a space or a dot, nor begins with a hyphen,
 * nor ends in ".json". False with ANG_USAGE and a sentence that says why. */
bool ang_preset_name_check(const char *name, ang_error *err);

/* Whether there is such a file. */
bool ang_preset_own_exists(const char *name);
/* Writes the text of a preset, over one of the same name, and gives the file's path. False with ANG_USAGE (the name),
 * ANG_OUTPUT. */
bool ang_preset_own_save(const char *name, const char *text, char *path, size_t size, ang_error *err);
/* False with ANG_USAGE (the name), ANG_OUTPUT. */
bool ang_preset_own_delete(const char *name, ang_error *err);

#endif
