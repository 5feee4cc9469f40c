#include "core/transfer/table_cache.h"

#include "core/base/memory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Contents, not the pointer: a transfer function that was freed may have its address taken by the next. */
static bool is_current(const ang_table_cache *cache, const ang_transfer *transfer) {
    return cache->tables && cache->count == transfer->count && cache->unit_distance == transfer->unit_distance &&
           cache->by_extinction == transfer->by_extinction &&
           memcmp(cache->points, transfer->points, transfer->count * sizeof *transfer->points) == 0;
}

/* Whether all intervals in which anything has extinction have one colour; where nothing has, any does. */
static bool find_colour(ang_table_cache *cache) {
    const float *colour = NULL, *entry = cache->tables->entries;
    for (int i = 0; i < cache->tables->intervals; i++, entry += 8) {
        if (!(entry[3] > 0 || entry[7] > 0)) continue;
        if (!colour) colour = entry;
        if (memcmp(colour, entry, 3 * sizeof *entry) != 0 || memcmp(colour, entry + 4, 3 * sizeof *entry) != 0)
            return false;
    }
    for (int k = 0; k < 3; k++) cache->colour[k] = colour ? colour[k] : 0;
    return true;
}

static bool make(ang_table_cache *cache, const ang_transfer *transfer, const ang_volume *volume, int limit,
                 ang_error *err) {
    /* The range of the volume leaves padding out, but its voxels are interpolated and classified like any other. */
    uint16_t padding = volume->padding_count > 0 ? ang_volume_padding_value(volume) : volume->minimum;
    uint16_t minimum = padding < volume->minimum ? padding : volume->minimum;
    uint16_t maximum = padding > volume->maximum ? padding : volume->maximum;
    cache->tables = ang_tables_create(transfer, volume->slope, volume->intercept, minimum, maximum, limit, err);
    if (!cache->tables) return false;
    size_t entries = 2 * (size_t)cache->tables->intervals;
    cache->points = ang_alloc(transfer->count, sizeof *cache->points, "the transfer function's points", err);
    cache->extinctions = ang_alloc(entries, sizeof *cache->extinctions, "table of extinctions", err);
    if (!cache->points || !cache->extinctions) return false;
    memcpy(cache->points, transfer->points, transfer->count * sizeof *cache->points);
    for (size_t i = 0; i < entries; i++) {
        cache->extinctions[i] = cache->tables->entries[4 * i + 3];
        cache->greatest = fmax(cache->greatest, cache->extinctions[i]);
    }
    cache->one_colour = find_colour(cache);
    return true;
}

bool ang_table_cache_update(ang_table_cache *cache, const ang_transfer *transfer, const ang_volume *volume, int limit,
                            bool *made, ang_error *err) {
    *made = !is_current(cache, transfer);
    if (!*made) return true;
    ang_table_cache next = {
        .count = transfer->count, .unit_distance = transfer->unit_distance, .by_extinction = transfer->by_extinction};
    if (make(&next, transfer, volume, limit, err)) {
        ang_table_cache_clear(cache);
        *cache = next;
        return true;
    }
    ang_table_cache_clear(&next);
    return false;
}

void ang_table_cache_clear(ang_table_cache *cache) {
    ang_tables_free(cache->tables);
    free(cache->extinctions);
    free(cache->points);
    *cache = (ang_table_cache){0};
}
