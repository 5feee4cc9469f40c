/* Means of light and extinction between two values: what a piece of a ray takes along which the field is linear. */
#ifndef ANG_TRANSFER_MEANS_H
#define ANG_TRANSFER_MEANS_H

#include "core/transfer/prefix.h"

enum { ANG_MEANS_RECORD = 12 };

/* Over the intervals of ang_transfer_tables; light is colour times extinction, per mm; channels are r, g, b light and
 * extinction. Record i + 1 is of interval i, the first and the last stand for all below and above the table. A record
 * has, by channel: the integral from the left end of the table to its left end, as a whole number (int32) of `unit`s;
 * the value at its left end; half of what it rises to its right end. So at the share f of an interval the value is
 * left + 2 f half, and the integral within it f (left + f half). Light, a product of two lines, is stood for by the
 * line with its integral over the interval. Integrals are in 1/mm * intervals. Plateaus at opacity 1 add nothing to
 * them; in place of light their records have colours, and no extinction. */
typedef struct ang_means {
    int intervals;
    float *records; /* (intervals + 2) * ANG_MEANS_RECORD */
    double unit;
    float *plateaus; /* ang_plateaus_find */
} ang_means;

/* NULL with ANG_LIMIT. Free with ang_means_free. */
ang_means *ang_means_create(const ang_transfer_tables *tables, ang_error *err);
void ang_means_free(ang_means *means);

#endif
