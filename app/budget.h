/* --max-error and --max-time: how the picture is planned, what came of it, and what is said about that. */
#ifndef ANG_APP_BUDGET_H
#define ANG_APP_BUDGET_H

#include "app/picture.h"
#include "core/render/planner.h"
#include "io/costs.h"

#include <cjson/cJSON.h>

/* Zero-initialise. Its planned.renderer is the caller's. */
typedef struct ang_app_budget {
    bool given; /* there is a limit */
    ang_budget budget;
    int pictures; /* that differ; the first is planned for and checked */
    ang_costs costs;
    ang_costs_origin origin;
    ang_planned planned;
    double measured_ms;         /* of a frame, once all is built; NaN: no time was asked for */
    bool forgotten;             /* the cost model was so far off that it was dropped */
    bool error_kept, time_kept; /* afterwards; true where nothing was asked for */
} ang_app_budget;

/* Whether the command line gives a limit. */
bool ang_app_budget_given(const ang_options *options);
/* Plans for `asked`, or for all methods where it is NULL, and sets step and termination of the picture. False with what
 * methods give. */
bool ang_app_budget_plan(ang_app_budget *budget, const ang_options *options, ang_gl *gl, const ang_volume *volume,
                         ang_picture *picture, const ang_method *asked, const ang_progress *progress, ang_error *err);
/* Adds the choice, the prediction and the model behind it to the plan. */
void ang_app_budget_explain(const ang_app_budget *budget, ang_plan *plan);
/* Compares with what a frame took, NaN where it was not measured, and warns of what was missed. */
void ang_app_budget_check(ang_app_budget *budget, double measured_ms, ang_notes *warnings);
cJSON *ang_app_budget_json(const ang_app_budget *budget);

#endif
