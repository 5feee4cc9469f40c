/* Prefix integrals of a transfer function, from which a step of a ray takes what lies between the values at its ends
 * (numerics.md): exact for any transfer function where the field is linear over the step. */
#ifndef ANG_TRANSFER_PREFIX_H
#define ANG_TRANSFER_PREFIX_H

#include "core/transfer/tables.h"

/* Over the intervals of ang_transfer_tables, whose entries say what lies inside one of them. */
typedef struct ang_prefix {
    int intervals;   /* as in the tables */
    float *sums;     /* (intervals + 1) * 8: at the left end of interval i int r kappa, int g kappa, int b kappa and
                        int kappa from the left end of the table, in 1/mm * intervals, as four upper parts of pairs of
                        floats and the four lower parts. Plateaus at opacity 1 add nothing */
    float *plateaus; /* ang_plateaus_find */
    double greatest; /* mean extinction per mm of any interval that is no plateau */
} ang_prefix;

/* `tables` are those of this transfer function, slope and intercept. NULL with ANG_LIMIT. Free with ang_prefix_free. */
ang_prefix *ang_prefix_create(const ang_transfer_tables *tables, const ang_transfer *transfer, double slope,
                              double intercept, ang_error *err);
void ang_prefix_free(ang_prefix *prefix);

/* Whether an interval is of a plateau at opacity 1. */
bool ang_plateaus_has(const ang_transfer_tables *tables, int interval);
/* (intervals + 2) * 2 numbers: of interval i - 1, where the first and the last stand for what lies outside the table:
 * the nearest interval of a plateau at or above it and that at or below it; beyond 2^30 where there is none. NULL
 * without any plateau. Free with free(). False with ANG_LIMIT. */
bool ang_plateaus_find(const ang_transfer_tables *tables, float **plateaus, ang_error *err);

#endif
