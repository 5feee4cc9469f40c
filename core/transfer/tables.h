/* What the renderers look up: the transfer function of one volume as tables over its stored values. */
#ifndef ANG_TRANSFER_TABLES_H
#define ANG_TRANSFER_TABLES_H

#include "core/transfer/transfer.h"
#include "core/volume/volume.h"

#include <stdint.h>

/* Extinction in tables from here on means "opaque at once": opacity 1 for any step. */
#define ANG_TABLE_OPAQUE 1e30f

/* The table cuts the stored values [first, first + intervals / per_value] into `intervals` equal intervals. Entry 2i
 * holds the limit from the right at interval i's left end, entry 2i+1 the limit from the left at its right end, so that
 * steps at interval ends stay steps; inside, both are linear. Four floats an entry: r, g, b (0..1), extinction per mm.
 * Below and above, the end values hold. Next to an isolated peak at opacity 1 the entry is finite and chosen so that
 * the linear interpolant has the exact integral. */
typedef struct ang_transfer_tables {
    double first;           /* stored value at the left end */
    double per_value;       /* intervals in one stored value, a power of two or its inverse */
    int intervals;          /* >= 1 */
    float *entries;         /* 2 * intervals * 4 */
    uint32_t *visible;      /* 65537 counts for ang_tables_visible */
    uint8_t *point_visible; /* 65536 flags: extinction > 0 exactly at the stored value */
} ang_transfer_tables;

/* The most intervals in one stored value. */
#define ANG_TABLE_MOST_PER_VALUE 128

/* Tables for volumes with this rescale and range of stored values [minimum, maximum]; at most `limit` intervals
 * (default 32768 where 0). Where the limit allows, one stored value has as many intervals as it takes for the points to
 * fall on interval ends and for the linear interpolant to follow the extinction to a hundredth of a level. A step or
 * the end of a plateau inside an interval moves to the interval's nearer end (but never onto a stored value, where it
 * would change what voxels show), but a plateau keeps at least one interval; where several points share an interval its
 * entries have the exact integral. `minimum` and `maximum` should include the value of padding where interpolation
 * meets it. Range in use: from the first to the last stored value of the range at which colour or extinction still
 * changes. NULL with ANG_LIMIT, or ANG_USAGE for a slope <= 0. Free with ang_tables_free. */
ang_transfer_tables *ang_tables_create(const ang_transfer *transfer, double slope, double intercept, uint16_t minimum,
                                       uint16_t maximum, int limit, ang_error *err);
void ang_tables_free(ang_transfer_tables *tables);
/* Exact and O(1): whether any value in the closed interval [min, max] of stored values has extinction > 0. */
bool ang_tables_visible(const ang_transfer_tables *tables, uint16_t min, uint16_t max);
/* The same of what the table's interpolant shows, which spreads to the ends of intervals wider than a stored value:
 * what renderers that look up the table must ask before they skip. */
bool ang_tables_shows(const ang_transfer_tables *tables, uint16_t min, uint16_t max);
/* Moves the ends of a range so far that ang_tables_visible of it is ang_tables_shows; each end moves by itself. */
void ang_tables_widen(const ang_transfer_tables *tables, uint16_t *min, uint16_t *max);

#endif
