/* Allocation that checks sizes and reports what it could not get. */
#ifndef ANG_BASE_MEMORY_H
#define ANG_BASE_MEMORY_H

#include "core/base/error.h"

#include <stddef.h>

/* `count` zeroed elements of `size` bytes for `what` (named in the error), or NULL with ANG_LIMIT where the product
 * overflows or the system refuses. The caller frees with free(). Thread safe. */
void *ang_alloc(size_t count, size_t size, const char *what, ang_error *err);

/* a * b * c, or 0 where a factor is 0 or the product overflows. */
size_t ang_product3(size_t a, size_t b, size_t c);

#endif
