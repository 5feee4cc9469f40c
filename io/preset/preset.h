/* Presets as JSON files (form version 1, and the simple form with "unit_mm" and points as arrays). */
#ifndef ANG_IO_PRESET_H
#define ANG_IO_PRESET_H

#include "core/base/error.h"
#include "core/transfer/preset.h"

#include <cjson/cJSON.h>
#include <stdbool.h>
#include <stddef.h>

/* Form version 1, everything but "points" optional:
 *   {"name": "...", "version": 1, "modality": "CT", "description": "...", "mode": "dvr|mip|minip|mean|iso",
 *    "shading": "none|phong", "phong": {"ambient", "diffuse", "specular", "power", "g0"}, "unit_distance": mm,
 *    "window": {"centre": HU, "width": HU}, "iso_hu": HU,
 *    "points": [{"hu": HU, "colour": [r, g, b], "opacity": 0..1 per unit_distance | "extinction": per mm}, ...]}
 * Points rise in HU, two at one HU make a step, and all give opacity or all extinction. A point may also be the array
 * [HU, r, g, b, opacity]; "unit_mm" stands for "unit_distance" and "comment" for "description"; control characters in
 * texts become blanks or '?'. Defaults: the file's name, CT, dvr, no shading, ang_phong_default, 1 mm, window 40/400,
 * no iso_hu.
 *
 * NULL with ANG_USAGE where the file cannot be read or is broken: one sentence with file, line and field; ANG_LIMIT.
 * Free with ang_preset_free. Thread safe. */
ang_preset *ang_preset_load(const char *path, ang_error *err);
/* The same from text in memory; `file` labels errors and gives the default name. */
ang_preset *ang_preset_parse(const char *file, const char *text, ang_error *err);

/* Whether --preset means a file by this and not a name: it has a '/' or is an existing file that ends in ".json". */
bool ang_preset_is_path(const char *name_or_path);
/* `name_or_path` is a path where ang_preset_is_path says so; else it is the name of NAME.json in the first of `folders`
 * (NULL-terminated, missing folders are passed over) that has it. An unknown name gives ANG_USAGE with the nearest name
 * and all of them; so does a file of io/preset/slicer/property.h, which has to be imported first. */
ang_preset *ang_preset_find(const char *name_or_path, const char *const *folders, ang_error *err);

/* The presets of some folders, by name; of equal names the first folder's. */
typedef struct ang_preset_names {
    char **names; /* count, and NULL after the last */
    char **paths; /* count, and NULL after the last */
    size_t count;
} ang_preset_names;

/* Fills `names`; false with ANG_LIMIT. Missing folders are passed over. Free with ang_preset_names_clear. */
bool ang_preset_list(const char *const *folders, ang_preset_names *names, ang_error *err);
void ang_preset_names_clear(ang_preset_names *names);

/* The preset as an object of form version 1 to be printed (its numbers are ang_json_exact's). NULL with ANG_LIMIT. Free
 * with cJSON_Delete. */
cJSON *ang_preset_json(const ang_preset *preset, ang_error *err);
/* The preset as JSON text of form version 1, every number exact. NULL with ANG_LIMIT. Free with free(). */
char *ang_preset_print(const ang_preset *preset, ang_error *err);

#endif
