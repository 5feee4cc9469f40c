/* Measures in state files. */
#ifndef ANG_IO_MEASURES_H
#define ANG_IO_MEASURES_H

#include "core/volume/measures.h"
#include "io/json.h"

/* {"hidden": false, "list": [{"kind": "length", "points_mm": [[x, y, z], ...], "label_mm": [x, y]}, ...]}; a region has
 * "right" and "down" as well. To be printed: its numbers are ang_json_exact's. NULL where memory is out. Free with
 * cJSON_Delete. */
cJSON *ang_measures_json(const ang_measures *measures);
/* The other way, from what stands at "measures" in the root; left alone where nothing does. False with ANG_USAGE. */
bool ang_measures_read(const ang_json *json, ang_measures *measures, ang_error *err);

#endif
