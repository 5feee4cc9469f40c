/* What drawing a picture costs: a linear model of its time, fitted to measured pictures. Pure; no GL. */
#ifndef ANG_PLAN_COST_H
#define ANG_PLAN_COST_H

#include <stdbool.h>
#include <stddef.h>

/* What was done, or will be, for one picture. */
typedef struct ang_cost_work {
    double rays, samples, shaded; /* shaded: those of the samples whose gradient is looked up */
    double polygons;
} ang_cost_work;

enum { ANG_COST_TERMS = 5 };

/* ms = term[0] + term[1] rays + term[2] samples + term[3] shaded + term[4] polygons; none is negative. */
typedef struct ang_cost_model {
    double term[ANG_COST_TERMS];
    double spread; /* median of |predicted / measured - 1| over the pictures that it was fitted to */
} ang_cost_model;

typedef struct ang_cost_measured {
    ang_cost_work work;
    double ms;
} ang_cost_measured;

/* Least squares of relative errors with no negative term. False, and a model of zeros, where nothing was measured or no
 * time is positive. Thread safe. */
bool ang_cost_fit(const ang_cost_measured *measured, size_t count, ang_cost_model *model);

/* ms. */
double ang_cost_predict(const ang_cost_model *model, const ang_cost_work *work);

/* What a picture takes, judged by one of some of its pixels: `pixels` times as many, of which every ray takes `samples`
 * times as many samples. */
ang_cost_work ang_cost_scale(const ang_cost_work *work, double pixels, double samples, bool slices);

#endif
