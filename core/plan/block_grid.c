#include "core/plan/block_grid.h"

#include "core/base/clock.h"
#include "core/base/memory.h"
#include "core/base/parallel.h"
#include "core/plan/distance.h"

#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

enum { BLOCKS_PER_PIECE = 16384 };

static const int leaf[3] = {ANG_SKIP_BLOCK, ANG_SKIP_BLOCK, ANG_SKIP_BLOCK};

ang_octree *ang_block_grid_octree(const ang_volume *volume, ang_error *err) {
    return ang_octree_allocate(volume, leaf, 1, err);
}

bool ang_block_grid_start(ang_block_grid *grid, const ang_volume *volume, ang_octree *octree, int threads,
                          ang_error *err) {
    double start = ang_now_ms();
    grid->octree = octree ? octree : ang_octree_build(volume, leaf, 1, threads, err);
    if (!grid->octree) return false;
    const int *dims = grid->octree->level[0].dims;
    grid->blocks = (size_t)dims[0] * (size_t)dims[1] * (size_t)dims[2];
    grid->visible = ang_alloc(grid->blocks, 1, "grid of visible blocks", err);
    grid->distance = ang_alloc(grid->blocks, 1, "grid of distances", err);
    grid->build_ms = ang_now_ms() - start;
    return grid->visible && grid->distance;
}

typedef struct update_job {
    ang_block_grid *grid;
    ang_visibility_lookup lookup;
    atomic_bool changed;
    atomic_size_t shown;
    struct {
        _Alignas(64) ang_block_box box; /* no two threads write to one line of the cache */
    } worker[ANG_MAX_THREADS];
} update_job;

/* Which of a row of blocks show, and how many. */
static unsigned update_row(const ang_visibility_lookup *lookup, const ang_minmax *nodes, int width, uint8_t *visible,
                           bool *changed) {
    const uint32_t *lower = lookup->lower, *upper = lookup->upper;
    unsigned shown = 0, differs = 0;
    for (int x = 0; x < width; x++) {
        unsigned min = (unsigned)nodes[x].min - lookup->first, max = (unsigned)nodes[x].max - lookup->first;
        uint8_t now = min < max ? upper[max] > lower[min] : lookup->single[min];
        differs |= (unsigned)(now ^ visible[x]);
        visible[x] = now;
        shown += now;
    }
    *changed = *changed || differs;
    return shown;
}

static void update_rows(void *context, size_t begin, size_t end, int worker) {
    update_job *job = context;
    ang_block_grid *grid = job->grid;
    const ang_octree_level *leaves = &grid->octree->level[0];
    size_t width = (size_t)leaves->dims[0], shown = 0;
    bool changed = false;
    for (size_t row = begin; row < end; row++) {
        uint8_t *visible = grid->visible + row * width;
        unsigned here = update_row(&job->lookup, leaves->nodes + row * width, leaves->dims[0], visible, &changed);
        shown += here;
        if (here == 0) continue;
        const uint8_t *first = memchr(visible, 1, width), *last = memrchr(visible, 1, width);
        ang_block_box_add(&job->worker[worker].box, grid->octree, row * width + (size_t)(first - visible));
        ang_block_box_add(&job->worker[worker].box, grid->octree, row * width + (size_t)(last - visible));
    }
    atomic_fetch_add(&job->shown, shown);
    if (changed) atomic_store(&job->changed, true);
}

static void join(ang_block_box *box, const ang_block_box *more) {
    for (int axis = 0; axis < 3; axis++) {
        if (more->first[axis] < box->first[axis]) box->first[axis] = more->first[axis];
        if (more->end[axis] > box->end[axis]) box->end[axis] = more->end[axis];
    }
}

bool ang_block_grid_update(ang_block_grid *grid, const ang_visibility *visibility, bool rounding, int threads,
                           bool *changed, ang_error *err) {
    update_job job = {.grid = grid};
    const ang_octree *octree = grid->octree;
    const int *dims = octree->level[0].dims;
    if (!ang_visibility_lookup_make(visibility, octree->level[octree->levels - 1].nodes[0], rounding, &job.lookup, err))
        return false;
    int workers = ang_thread_count(threads);
    for (int i = 0; i < workers; i++) job.worker[i].box = ang_block_box_none();
    ang_parallel_for((size_t)dims[1] * (size_t)dims[2], 1 + BLOCKS_PER_PIECE / (size_t)dims[0], workers, update_rows,
                     &job);
    ang_visibility_lookup_clear(&job.lookup);
    grid->visible_blocks = job.shown;
    grid->box = ang_block_box_none();
    for (int i = 0; i < workers; i++) join(&grid->box, &job.worker[i].box);
    *changed = grid->changes == 0 || job.changed;
    if (!*changed) return true;
    ang_block_distances(dims, grid->visible, grid->distance);
    grid->changes++;
    return true;
}

void ang_block_grid_clear(ang_block_grid *grid) {
    ang_octree_free(grid->octree);
    free(grid->visible);
    free(grid->distance);
    *grid = (ang_block_grid){0};
}
