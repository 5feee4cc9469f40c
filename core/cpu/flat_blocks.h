/* Blocks through which light is taken in one exact step: where colour and extinction are the same for all values in a
 * block's range. */
#ifndef ANG_CPU_FLAT_BLOCKS_H
#define ANG_CPU_FLAT_BLOCKS_H

#include "core/transfer/tables.h"
#include "core/volume/octree.h"

#include <stdint.h>

/* Zero-initialise; owns `flat`. */
typedef struct ang_flat_blocks {
    uint8_t *flat; /* of each leaf 1 or 0; NULL where there is none that is 1 */
    size_t count;  /* of those that are 1 */
} ang_flat_blocks;

/* Finds them among the leaves of an octree whose ranges hold every interpolated value. False with ANG_LIMIT, `blocks`
 * empty. */
bool ang_flat_blocks_find(ang_flat_blocks *blocks, const ang_transfer_tables *tables, const ang_octree *octree,
                          ang_error *err);
void ang_flat_blocks_clear(ang_flat_blocks *blocks);

#endif
