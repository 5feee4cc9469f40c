/* A picture within an error or a time: method, step and pixels are chosen from the cost models of this machine and from
 * pictures of some of the scene's pixels. */
#ifndef ANG_RENDER_PLANNER_H
#define ANG_RENDER_PLANNER_H

#include "core/error/estimate.h"
#include "core/plan/budget.h"
#include "core/render/calibrate.h"

/* What was chosen. Owns `renderer`, which whoever asked takes over. */
typedef struct ang_planned {
    const ang_method *method;
    ang_renderer *renderer;
    double step_voxels;           /* 0: the method knows none */
    int stride;                   /* every so many pixels along each axis; 1: all */
    double termination;           /* as in ang_render_options */
    double ms, error;             /* predicted; levels, NaN: not known */
    ang_error_estimate estimate;  /* of the choice, where an error was asked for: what `error` is then made from */
    ang_metrics between;          /* that pixels between those drawn are off, where looked at; 0: all are drawn */
    bool keeps_error, keeps_time; /* as predicted */
    size_t candidates;
    int refinements;    /* other steps after the first, whose estimate was too great */
    double planning_ms; /* that all this took */
    char missed[256];   /* why the budget cannot be kept, one sentence; empty: it can */
} ang_planned;

/* Plans for `asked` alone or, where NULL, for all methods that the scene allows. `options` are those of the picture, of
 * which the plan changes step and termination. False with what methods give. */
bool ang_planner_plan(ang_gl *gl, const ang_volume *volume, const ang_scene *scene, const ang_render_options *options,
                      const ang_method *asked, const ang_budget *budget, const ang_costs *costs, ang_planned *planned,
                      const ang_progress *progress, ang_error *err);

#endif
