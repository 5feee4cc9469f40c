/* How errors fall with the step, and which settings no other beats. Pure functions, thread safe. */
#ifndef ANG_ERROR_CONVERGENCE_H
#define ANG_ERROR_CONVERGENCE_H

#include "core/scene/scene.h"

#include <stdbool.h>
#include <stddef.h>

/* error = factor * step^order, fitted. */
typedef struct ang_order {
    double order;            /* NaN where fewer than two errors can be used */
    double factor;           /* the error at step 1 */
    double spread;           /* standard error of the order; NaN below three errors */
    double coarsest, finest; /* the steps whose errors were used */
    int used;                /* how many */
} ang_order;

/* Fits a line to log(error) over log(step) by least squares (Etiene et al., IEEE TVCG 20(1), 2014, section 4). The
 * steps descend. Errors that are not finite or not above `floor`, where rounding and not the step decides, are left
 * out; so are the finest as long as the error does not fall from one step to the next by at least two fifths of what
 * the slope of those before it would give: they lie on a floor of their own. */
ang_order ang_order_fit(const double *step, const double *error, size_t count, double floor);

/* The order to expect of the RMS error (numerics.md), and why. */
typedef struct ang_expected_order {
    double least, most;
    const char *why; /* static */
} ang_expected_order;

/* For a scene over values from `low` to `high` HU: knots of the transfer function outside that do not count. `prefix`:
 * steps are classified by integrals over the transfer function (mode dvr). */
ang_expected_order ang_order_expected(const ang_scene *scene, double low, double high, bool prefix);

/* Sets front[i] where no other setting is both as cheap and as exact as setting i and better in one of the two (Pareto,
 * 1906). An error is as good as another where it is at most `slack` (a share) greater: chance decides between such.
 * Settings whose cost or error is not finite are never on the front; equals are on it together. */
void ang_pareto_front(const double *cost, const double *error, size_t count, double slack, bool *front);

#endif
