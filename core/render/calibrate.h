/* What pictures cost on this machine with this OpenGL: cost models fitted to small pictures of a small phantom. */
#ifndef ANG_RENDER_CALIBRATE_H
#define ANG_RENDER_CALIBRATE_H

#include "core/plan/cost.h"
#include "core/render/method.h"

enum { ANG_COSTS_MOST = 8 };

/* One model a method. Plain value. */
typedef struct ang_costs {
    struct {
        char method[24];
        ang_cost_model model;
    } of[ANG_COSTS_MOST];
    size_t count;
    double ms; /* that measuring took, of all of them together */
} ang_costs;

/* The model of a method, NULL where there is none. */
const ang_cost_model *ang_costs_of(const ang_costs *costs, const char *method);

/* What drawing the scene did, as the model counts it. */
ang_cost_work ang_cost_work_of(const ang_scene *scene, const ang_frame_stats *stats);

/* Draws and fits for all methods that `gl` (may be NULL) allows and that `costs` does not hold yet; takes seconds. A
 * model that misses its own pictures by more than a factor of 2 is measured once more and, where that does not help,
 * one without a fixed part. A method that fails is left out. False with ANG_LIMIT or ANG_INTERRUPTED. */
bool ang_costs_measure(ang_gl *gl, ang_costs *costs, const ang_progress *progress, ang_error *err);

#endif
