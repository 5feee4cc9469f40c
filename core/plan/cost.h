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

/* Least squares of relative errors with no negative term and, where there were rays or samples, a positive one for
 * either. False, and a model of zeros, where nothing was measured, a time is not positive or no such model fits. Thread
 * safe. */
bool ang_cost_fit(const ang_cost_measured *measured, size_t count, ang_cost_model *model);
/* The same without what a picture and a polygon cost: the whole time grows with the picture. For measurements that no
 * model with a fixed part fits, which such a part must not hide. */
bool ang_cost_fit_proportional(const ang_cost_measured *measured, size_t count, ang_cost_model *model);

/* By which factor, >= 1, a prediction is off, above or below; infinite where either is not positive. */
double ang_cost_miss(double predicted, double measured);
/* The greatest of these over some pictures. */
double ang_cost_worst(const ang_cost_model *model, const ang_cost_measured *measured, size_t count);
/* Whether more rays or more samples cost more, as in every model that was fitted to any. */
bool ang_cost_grows(const ang_cost_model *model);

/* ms. */
double ang_cost_predict(const ang_cost_model *model, const ang_cost_work *work);

/* What a picture takes, judged by one of some of its pixels: `pixels` times as many, of which every ray takes `samples`
 * times as many samples. */
ang_cost_work ang_cost_scale(const ang_cost_work *work, double pixels, double samples, bool slices);

#endif
