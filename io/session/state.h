/* State files: what is needed to show the same picture, or the same session of the viewer, again. */
#ifndef ANG_IO_STATE_H
#define ANG_IO_STATE_H

#include "core/base/error.h"
#include "core/scene/scene.h"
#include "core/transfer/preset.h"
#include "core/volume/measures.h"
#include "core/volume/reslice.h"

#include <cjson/cJSON.h>
#include <stdbool.h>
#include <stddef.h>

enum { ANG_STATE_VERSION = 1, ANG_STATE_SLICES = 3 };

/* A setting of 'angioscope render', as it would be typed after --NAME; a flag has the value "". */
typedef struct ang_state_option {
    char *name, *value;
} ang_state_option;

/* How a slice pane shows its slice: axial, coronal, sagittal. */
typedef struct ang_state_slice {
    double zoom, pan_mm[2];
} ang_state_slice;

/* Everything but the preset may be left open: NULL, NaN or "", which means as suits. Owns what it points to;
 * ang_state_clear frees it. */
typedef struct ang_state {
    char *input_path; /* of the data: usable from the current folder. A folder's name may identify a patient: it is in
                         files that a user saves, never in pictures */
    char *input_name; /* hash of the stored values, numbers of series and phase, as ang_load_report_name gives it */
    char *raw_dims, *raw_type, *raw_spacing; /* where the input is raw: as in ang_load_options */
    ang_preset *preset;                      /* as shown, shifts and edits in it */
    ang_state_option *options;               /* of the 3D picture */
    size_t option_count;

    /* Of the window. */
    bool preset_changed;                /* it is no longer what the file of its name has */
    double shift_hu, stretch;           /* by how much of that a drag has moved and spread it; 0, 1 */
    double window_centre, window_width; /* HU: of the slices, and of 3D in modes of values */
    ang_slab slab;
    double slab_mm;                  /* 0: none */
    ang_vec3 crosshair;              /* LPS mm; all three NaN where open */
    ang_vec3 crop_lower, crop_upper; /* the crop box, also while the picture is not cropped (it is by an option "clip"):
                                        voxel index; all NaN where open */
    ang_state_slice slice[ANG_STATE_SLICES];
    ang_measures measures;
    double planes_turn[9];      /* where the slice planes' L, P and H directions have gone to: three unit vectors */
    bool voxels_shown;          /* slices are not interpolated */
    bool turns_about_crosshair; /* the hand on the 3D picture, else about the volume's centre */
    char maximised[16];         /* the pane that is large; "": none */
    char tool[16];              /* of the left button */
    char method[16];            /* as chosen: "auto" or a name */
    bool corner_text, crosshair_lines; /* shown on the panes */
} ang_state;

/* Nothing given: the slices fit, text and lines are shown. */
extern const ang_state ang_state_default;
void ang_state_clear(ang_state *state);
/* Adds a copy. False with ANG_LIMIT. */
bool ang_state_add_option(ang_state *state, const char *name, const char *value, ang_error *err);
/* The value of an option; NULL: it is not there. */
const char *ang_state_option_value(const ang_state *state, const char *name);
/* Number of the series and of its phase in `input_name`; 0 where it has none. */
int ang_state_series(const ang_state *state);
int ang_state_phase(const ang_state *state);

/* The state as a JSON object: {"angioscope_state": 1, "program", "input": {"path", "name", ...}, "preset": {...}, as
 * in preset.h, "render": {OPTION: VALUE, ...}, "window": {"centre", "width"}, "crosshair_mm", "planes_turn", "axial":
 * {"zoom", "pan_mm"}, ..., "slab": {"mm", "mode"}, "measures": {...}, as in measures.h, ...}. Every number exact.
 * What is open is left out. `file` is where it will be written: a path of the data below its folder becomes relative
 * to that, any other absolute; NULL: no path. With `window` false without what is of the window. NULL with ANG_LIMIT.
 * Free with cJSON_Delete. */
cJSON *ang_state_json(const ang_state *state, const char *program_version, const char *file, bool window,
                      ang_error *err);
/* The picture's part of that, without the path and what is of the window, as text in one line: to go into a picture.
 * NULL with ANG_LIMIT. Free with free(). */
char *ang_state_print(const ang_state *state, const char *program_version, ang_error *err);
/* What a state's `file` holds, as text. NULL with ANG_LIMIT. Free with free(). */
char *ang_state_text(const ang_state *state, const char *program_version, const char *file, ang_error *err);
/* Replaces `file` by that (io/replace.h). */
bool ang_state_write(const char *file, const ang_state *state, const char *program_version, ang_error *err);

/* Reads a state, from JSON or from a picture (.png, .exr) that carries one. Unknown fields are refused but for those in
 * "live", which say what else the window showed. False with ANG_USAGE and one sentence with file, line and field, or
 * ANG_LIMIT. Thread safe. */
bool ang_state_read(const char *file, ang_state *state, ang_error *err);
/* The same from JSON in memory; `file` labels errors, and relative paths are relative to its folder. */
bool ang_state_parse(const char *file, const char *text, ang_state *state, ang_error *err);
/* Whether a file is a state in JSON, by its beginning, or a picture that carries one: to tell it from data. */
bool ang_state_probe(const char *file);

#endif
