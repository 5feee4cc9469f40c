/* The transfer function as the ray caster on the processor reads it: its tables and, where steps are classified as a
 * whole, its prefix integrals. Kept until another transfer function comes. */
#ifndef ANG_CPU_CLASSIFIER_H
#define ANG_CPU_CLASSIFIER_H

#include "core/plan/classification.h"
#include "core/transfer/prefix.h"
#include "core/transfer/table_cache.h"

/* Zero-initialise; owns all. */
typedef struct ang_classifier {
    ang_table_cache table;
    ang_stiffness stiffness; /* of the transfer function in the volume, where `measured` */
    bool measured;
    ang_neighbours neighbours;         /* of the volume, taken when first asked for */
    ang_classification classification; /* of the last ang_classifier_choose */
    ang_prefix *prefix;                /* with `steps`: made when first used, else NULL */
    float *steps; /* (intervals + 3) * 4: of interval i - 1, where the first and those behind the last stand for what
                     lies outside the table: extinction at its left and right end, and the integral of extinction up to
                     the left end as the upper and lower part of a pair of floats (ang_prefix) */
} ang_classifier;

/* Makes the tables for this volume where `transfer` is not what they were made from, and says so in *made. False, the
 * classifier as it was, with ANG_LIMIT or ANG_USAGE. */
bool ang_classifier_update(ang_classifier *classifier, const ang_transfer *transfer, const ang_volume *volume,
                           bool *made, ang_error *err);
/* Chooses how steps of `step` mm are classified, after ang_classifier_update with the same transfer function and
 * volume, and makes what that takes. Without `wants_warning` it is not found out whether mid-points that were asked for
 * may miss a peak. False with ANG_LIMIT. */
bool ang_classifier_choose(ang_classifier *classifier, const ang_transfer *transfer, const ang_volume *volume,
                           ang_classify wanted, double step, bool wants_warning, ang_error *err);
/* The greatest extinction per mm that a step can have. */
double ang_classifier_greatest(const ang_classifier *classifier);
/* Frees what it holds and makes it empty. */
void ang_classifier_clear(ang_classifier *classifier);

#endif
