/* The tables of the transfer function that was drawn last, kept until another one comes. */
#ifndef ANG_TRANSFER_TABLE_CACHE_H
#define ANG_TRANSFER_TABLE_CACHE_H

#include "core/transfer/tables.h"

/* Zero-initialise; owns all. */
typedef struct ang_table_cache {
    ang_transfer_tables *tables; /* NULL before the first update */
    float *extinctions;          /* of the tables' entries, alone */
    double greatest;             /* extinction per mm of any entry */
    bool one_colour;             /* whatever has extinction has the same colour... */
    double colour[3];            /* ... which is this */
    ang_transfer_point *points;  /* what they were made from */
    size_t count;
    double unit_distance;
    bool by_extinction;
} ang_table_cache;

/* Makes the tables for this volume where `transfer` is not what they were made from, and says so in *made. `limit`: as
 * ang_tables_create. False, the cache as it was, with ANG_LIMIT or ANG_USAGE. */
bool ang_table_cache_update(ang_table_cache *cache, const ang_transfer *transfer, const ang_volume *volume, int limit,
                            bool *made, ang_error *err);
/* Frees what it holds and makes it empty. */
void ang_table_cache_clear(ang_table_cache *cache);

#endif
