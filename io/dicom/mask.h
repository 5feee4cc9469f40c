/* Fast loops over values that are padding. Pure functions; thread safe also where two threads share a word of a mask.
 */
#ifndef ANG_DICOM_MASK_H
#define ANG_DICOM_MASK_H

#include <stddef.h>
#include <stdint.h>

/* Values first to last, both included, are padding and become `fill`. */
typedef struct ang_mask_range {
    uint16_t first, last, fill;
} ang_mask_range;

/* How many are padding, and least and greatest of the others (least > greatest where there are none). */
typedef struct ang_mask_result {
    size_t count;
    uint16_t least, greatest;
} ang_mask_result;

/* Least and greatest of `count` values; least > greatest where there are none. */
void ang_mask_extent(const uint16_t *data, size_t count, uint16_t *least, uint16_t *greatest);

/* Counts padding among `count` values and finds the range of the others. */
size_t ang_mask_count(const uint16_t *data, size_t count, ang_mask_range range, uint16_t *least, uint16_t *greatest);

/* Replaces padding and sets its bits in `mask`, where data[0] has bit `base`. */
ang_mask_result ang_mask_mark(uint16_t *data, size_t count, size_t base, ang_mask_range range, uint64_t *mask);

/* Sets bit `index`. */
void ang_mask_set(uint64_t *mask, size_t index);

#endif
