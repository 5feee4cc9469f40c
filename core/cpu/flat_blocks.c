#include "core/cpu/flat_blocks.h"

#include "core/base/memory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* The table's intervals, and beside them the first and the last record for what lies below and above it. */
typedef struct record {
    const float *left, *right; /* colour and extinction at its ends */
} record;

static record record_of(const ang_transfer_tables *tables, int index) {
    const float *entries = tables->entries;
    int last = tables->intervals;
    if (index == 0) return (record){entries, entries};
    if (index > last) return (record){entries + 8 * (size_t)last - 4, entries + 8 * (size_t)last - 4};
    return (record){entries + 8 * (size_t)(index - 1), entries + 8 * (size_t)(index - 1) + 4};
}

static bool same(const float *a, const float *b) { return memcmp(a, b, 4 * sizeof *a) == 0; }

/* Of each record the last one up to which nothing changes, or -1 where something does in itself or nothing shows. */
static void find_runs(const ang_transfer_tables *tables, int *run) {
    int last = tables->intervals + 1;
    for (int i = last; i >= 0; i--) {
        record here = record_of(tables, i);
        bool flat = same(here.left, here.right) && here.left[3] > 0;
        bool joins = flat && i < last && run[i + 1] >= 0 && same(here.right, record_of(tables, i + 1).left);
        run[i] = !flat ? -1 : joins ? run[i + 1] : i;
    }
}

/* Of each stored value in `range` the greatest up to which nothing changes, or -1; whether there is one. */
static bool find_reach(const ang_transfer_tables *tables, ang_minmax range, const int *run, int32_t *reach) {
    int last = tables->intervals + 1;
    bool any = false;
    for (int v = range.min; v <= range.max; v++) {
        double x = (v - tables->first) * tables->per_value;
        int end = run[(int)fmax(0, fmin(floor(x) + 1, last))];
        double value = end == last ? UINT16_MAX : floor(tables->first + end / tables->per_value);
        reach[v] = end < 0 ? -1 : (int32_t)fmin(fmax(value, v), UINT16_MAX);
        any = any || reach[v] >= 0;
    }
    return any;
}

bool ang_flat_blocks_find(ang_flat_blocks *blocks, const ang_transfer_tables *tables, const ang_octree *octree,
                          ang_error *err) {
    const ang_octree_level *leaves = &octree->level[0];
    const ang_minmax range = octree->level[octree->levels - 1].nodes[0];
    size_t count = (size_t)leaves->dims[0] * (size_t)leaves->dims[1] * (size_t)leaves->dims[2];
    *blocks = (ang_flat_blocks){0};
    int *run = ang_alloc((size_t)tables->intervals + 2, sizeof *run, "intervals of a transfer function", err);
    int32_t *reach = run ? ang_alloc(UINT16_MAX + 1, sizeof *reach, "stored values", err) : NULL;
    bool ok = reach != NULL;
    if (ok) find_runs(tables, run);
    if (ok && find_reach(tables, range, run, reach)) {
        blocks->flat = ang_alloc(count, 1, "blocks of one colour", err);
        ok = blocks->flat != NULL;
        for (size_t i = 0; i < count && ok; i++) {
            blocks->flat[i] = leaves->nodes[i].max <= reach[leaves->nodes[i].min];
            blocks->count += blocks->flat[i];
        }
    }
    free(run);
    free(reach);
    if (blocks->count == 0) ang_flat_blocks_clear(blocks);
    return ok;
}

void ang_flat_blocks_clear(ang_flat_blocks *blocks) {
    free(blocks->flat);
    *blocks = (ang_flat_blocks){0};
}
