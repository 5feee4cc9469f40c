/* The actions of the verb presets, a file each. */
#ifndef ANG_APP_PRESETS_H
#define ANG_APP_PRESETS_H

#include "app/options.h"
#include "core/base/notes.h"
#include "core/transfer/preset.h"
#include "io/preset/slicer/property.h"

#include <stdio.h>

/* Exit codes. `options->arguments` begins with the action. */
int ang_app_presets_import(const ang_options *options, ang_error *err);
int ang_app_presets_export(const ang_options *options, ang_error *err);
int ang_app_presets_sheet(const ang_options *options, ang_error *err);

/* A preset of a property that `file` (for errors) holds, called as its own file may be. What is lost goes to `notes`.
 * False with what ang_property_to_preset or ang_preset_name_check give. Free with ang_preset_free. */
bool ang_app_preset_import(const char *file, const ang_property *property, ang_preset **preset, ang_notes *notes,
                           ang_error *err);

/* How many colours the terminal behind `out` shows, as far as its environment says so: 1 << 24, 256, or 0, where it is
 * no terminal or colours are not wanted (NO_COLOR, TERM=dumb). */
int ang_app_colours(FILE *out);
enum { ANG_SWATCH_CELLS = 16 };
/* Prints ANG_SWATCH_CELLS coloured blanks: the preset's colours over the HU in which something shows, the fainter the
 * less opaque; for modes of values, greys. */
void ang_app_swatch(const ang_preset *preset, int colours, FILE *out);

#endif
