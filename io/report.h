/* What the loader found, for people and for programs. */
#ifndef ANG_IO_REPORT_H
#define ANG_IO_REPORT_H

#include "core/base/facts.h"
#include "io/load.h"

#include <cjson/cJSON.h>
#include <stdio.h>

/* Prints the report as a table to `out`. `volume` may be NULL where loading failed: what was found is printed. Without
 * `keep_phi` nothing that may identify a patient: no description, UID or file name. */
void ang_load_report_print(FILE *out, const ang_volume *volume, const ang_load_report *report, bool keep_phi);

/* Adds geometry and values of a volume that has been loaded: nothing that may identify a patient. */
void ang_load_report_facts(const ang_volume *volume, const ang_load_report *report, ang_facts *facts);

/* The object "input" of the program's JSON (DESIGN.md, "Command line"), in mm, degrees and HU; null where a value is
 * not known or, with `volume` NULL, nothing of the volume. Valid UTF-8. Free with cJSON_Delete. NULL where memory is
 * out. */
cJSON *ang_load_report_json(const ang_volume *volume, const ang_load_report *report, bool keep_phi);

/* A name for the input that identifies nobody: hash of the stored values and number of the series, with that of the
 * phase where there are several: "0a1b2c3d-2.5". */
void ang_load_report_name(const ang_load_report *report, char name[32]);

#endif
