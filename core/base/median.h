/* The middle of measurements that scatter. */
#ifndef ANG_BASE_MEDIAN_H
#define ANG_BASE_MEDIAN_H

#include <stddef.h>

/* Sorts `values` ascending and returns the middle one, of an even count the mean of the middle two; NaN for none.
 * Values that are not numbers must not be among them. */
double ang_median(double *values, size_t count);

#endif
