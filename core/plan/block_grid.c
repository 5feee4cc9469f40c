#include "core/plan/block_grid.h"

#include "core/base/clock.h"
#include "core/base/memory.h"
#include "core/base/parallel.h"
#include "core/plan/distance.h"

#include <stdatomic.h>
#include <stdlib.h>

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
    const ang_visibility *visibility;
    bool rounding;
    atomic_bool changed;
    atomic_size_t shown;
    struct {
        _Alignas(64) ang_block_box box;
    } worker[ANG_MAX_THREADS];
} update_job;

static bool shows(const update_job *job, ang_minmax range) {
    if (ang_visibility_of(job->visibility, range)) return true;
    if (!job->rounding || range.min == range.max) return false;
    range.min = (uint16_t)(range.min > 0 ? range.min - 1 : 0);
    range.max = (uint16_t)(range.max < UINT16_MAX ? range.max + 1 : UINT16_MAX);
    return ang_visibility_of(job->visibility, range);
}

static void update_blocks(void *context, size_t begin, size_t end, int worker) {
    update_job *job = context;
    ang_block_grid *grid = job->grid;
    bool changed = false;
    size_t shown = 0;
    for (size_t i = begin; i < end; i++) {
        uint8_t now = shows(job, grid->octree->level[0].nodes[i]);
        changed = changed || now != grid->visible[i];
        grid->visible[i] = now;
        shown += now;
        if (now) ang_block_box_add(&job->worker[worker].box, grid->octree, i);
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

void ang_block_grid_update(ang_block_grid *grid, const ang_visibility *visibility, bool rounding, int threads,
                           bool *changed) {
    update_job job = {.grid = grid, .visibility = visibility, .rounding = rounding};
    int workers = ang_thread_count(threads);
    for (int i = 0; i < workers; i++) job.worker[i].box = ang_block_box_none();
    ang_parallel_for(grid->blocks, BLOCKS_PER_PIECE, workers, update_blocks, &job);
    grid->visible_blocks = job.shown;
    grid->box = ang_block_box_none();
    for (int i = 0; i < workers; i++) join(&grid->box, &job.worker[i].box);
    *changed = grid->changes == 0 || job.changed;
    if (!*changed) return;
    ang_block_distances(grid->octree->level[0].dims, grid->visible, grid->distance);
    grid->changes++;
}

void ang_block_grid_clear(ang_block_grid *grid) {
    ang_octree_free(grid->octree);
    free(grid->visible);
    free(grid->distance);
    *grid = (ang_block_grid){0};
}
