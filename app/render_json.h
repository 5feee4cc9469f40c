/* What `render --json` says: input, picture, plan, error, cost. */
#ifndef ANG_APP_RENDER_JSON_H
#define ANG_APP_RENDER_JSON_H

#include "app/budget.h"
#include "app/picture.h"
#include "core/error/estimate.h"

#include <cjson/cJSON.h>

/* Costs of one call. Times in ms; NaN or 0 where not measured. Borrows the gl strings; owns
 * `plan` and `warnings`. */
typedef struct ang_render_summary {
    double load_ms, upload_ms, first_frame_ms;
    int timed_frames; /* frames behind the three below */
    double median_ms, min_ms, max_ms;
    ang_frame_stats stats;    /* of the first picture */
    bool estimated;           /* whether the next is there */
    ang_error_estimate error; /* of the first picture */
    double quantisation;      /* levels: what writing it rounds by at most */
    ang_plan plan;
    const char *gl_backend, *gl_renderer, *gl_version; /* NULL without GL */
    ang_app_budget budget;                             /* where it is given */
    ang_notes warnings;
} ang_render_summary;

/* Sorts `milliseconds` and fills the frame times. */
void ang_render_summary_times(ang_render_summary *summary, double *milliseconds, int count);

/* What the options made of the picture, so that it can be made again. A preset is called by the name it gives itself:
 * its path may say more. Free with cJSON_Delete. */
cJSON *ang_picture_json(const ang_picture *picture);

/* Writes the JSON to a file (atomically) or, for "-", to stdout. Its "picture" is in HU, degrees, pixels and, for the
 * clip box, voxel indices; with several frames its view is that of the first. False with ANG_OUTPUT, ANG_LIMIT. */
bool ang_render_json_write(const char *path, const ang_volume *volume, const ang_load_report *report,
                           const ang_picture *picture, const ang_method *method, const ang_render_summary *summary,
                           bool keep_phi, ang_error *err);

#endif
