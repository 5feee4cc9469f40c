#include "core/volume/octree.h"

#include "core/base/memory.h"
#include "core/base/parallel.h"
#include "core/base/simd.h"

#include <stdlib.h>

typedef struct build_job {
    const ang_volume *volume;
    ang_octree *octree;
    int level;        /* to build, for parents */
    ang_minmax *rows; /* scratch: for each worker dims[0] running minima and maxima of a row of leaves */
} build_job;

static int min_int(int a, int b) { return a < b ? a : b; }
static int max_int(int a, int b) { return a > b ? a : b; }

/* The voxels first..last along an axis that leaf `index` covers. */
static void voxel_range(const ang_octree *octree, const ang_volume *volume, int axis, int index, int *first,
                        int *last) {
    int cells = octree->leaf[axis], more = octree->apron - 1;
    *first = max_int(index * cells - more, 0);
    *last = min_int(index * cells + cells + more, volume->dims[axis] - 1);
}

/* One row of leaves along x: first the extremes over the rows of voxels in y and z, a long loop that the compiler turns
 * into SIMD minima; then over each leaf's stretch of x. */
ANG_SIMD static void build_leaf_rows(void *context, size_t begin, size_t end, int worker) {
    build_job *job = context;
    const ang_volume *volume = job->volume;
    ang_octree_level *leaves = &job->octree->level[0];
    size_t nx = (size_t)volume->dims[0], ny = (size_t)volume->dims[1];
    uint16_t *low = (uint16_t *)(job->rows + (size_t)worker * nx), *high = low + nx;
    for (size_t row = begin; row < end; row++) {
        int y0, y1, z0, z1;
        voxel_range(job->octree, volume, 1, (int)(row % (size_t)leaves->dims[1]), &y0, &y1);
        voxel_range(job->octree, volume, 2, (int)(row / (size_t)leaves->dims[1]), &z0, &z1);
        for (size_t x = 0; x < nx; x++) {
            low[x] = UINT16_MAX;
            high[x] = 0;
        }
        for (int z = z0; z <= z1; z++)
            for (int y = y0; y <= y1; y++) {
                const uint16_t *voxels = volume->data + nx * ((size_t)y + ny * (size_t)z);
                if (z < z1)
                    for (size_t x = 0; x < nx; x += 32) __builtin_prefetch(voxels + nx * ny + x, 0, 2);
                for (size_t x = 0; x < nx; x++) {
                    uint16_t value = voxels[x];
                    low[x] = value < low[x] ? value : low[x];
                    high[x] = value > high[x] ? value : high[x];
                }
            }
        ang_minmax *out = leaves->nodes + row * (size_t)leaves->dims[0];
        for (int i = 0; i < leaves->dims[0]; i++) {
            int x0, x1;
            voxel_range(job->octree, volume, 0, i, &x0, &x1);
            ang_minmax range = {low[x0], high[x0]};
            for (int x = x0 + 1; x <= x1; x++) {
                range.min = low[x] < range.min ? low[x] : range.min;
                range.max = high[x] > range.max ? high[x] : range.max;
            }
            out[i] = range;
        }
    }
}

static void build_parents(void *context, size_t begin, size_t end, int worker) {
    (void)worker;
    build_job *job = context;
    const ang_octree_level *below = &job->octree->level[job->level - 1];
    ang_octree_level *level = &job->octree->level[job->level];
    for (size_t node = begin; node < end; node++) {
        int i = (int)(node % (size_t)level->dims[0]), rest = (int)(node / (size_t)level->dims[0]);
        int j = rest % level->dims[1], k = rest / level->dims[1];
        ang_minmax range = {UINT16_MAX, 0};
        for (int z = 2 * k; z < min_int(2 * k + 2, below->dims[2]); z++)
            for (int y = 2 * j; y < min_int(2 * j + 2, below->dims[1]); y++)
                for (int x = 2 * i; x < min_int(2 * i + 2, below->dims[0]); x++) {
                    size_t child =
                        (size_t)x + (size_t)below->dims[0] * ((size_t)y + (size_t)below->dims[1] * (size_t)z);
                    ang_minmax part = below->nodes[child];
                    range.min = part.min < range.min ? part.min : range.min;
                    range.max = part.max > range.max ? part.max : range.max;
                }
        level->nodes[node] = range;
    }
}

static size_t node_count(const ang_octree_level *level) {
    return (size_t)level->dims[0] * (size_t)level->dims[1] * (size_t)level->dims[2];
}

ang_octree *ang_octree_allocate(const ang_volume *volume, const int leaf[3], int apron, ang_error *err) {
    ang_octree *octree = ang_alloc(1, sizeof *octree, "octree", err);
    if (!octree) return NULL;
    octree->apron = apron;
    /* Cells, not voxels, are shared out among leaves; an axis of one voxel has one cell. */
    for (int axis = 0; axis < 3; axis++) {
        int cells = max_int(volume->dims[axis] - 1, 1);
        octree->cells[axis] = cells;
        octree->leaf[axis] = leaf ? min_int(leaf[axis], cells) : ANG_OCTREE_LEAF;
        octree->level[0].dims[axis] = (cells + octree->leaf[axis] - 1) / octree->leaf[axis];
    }
    for (;;) {
        ang_octree_level *level = &octree->level[octree->levels];
        level->nodes = ang_alloc(node_count(level), sizeof *level->nodes, "octree", err);
        if (!level->nodes) {
            ang_octree_free(octree);
            return NULL;
        }
        octree->levels++;
        if (node_count(level) == 1) break;
        for (int axis = 0; axis < 3; axis++) level[1].dims[axis] = (level->dims[axis] + 1) / 2;
    }
    return octree;
}

void ang_octree_finish(ang_octree *octree, int threads) {
    build_job job = {.octree = octree};
    for (job.level = 1; job.level < octree->levels; job.level++)
        ang_parallel_for(node_count(&octree->level[job.level]), 4096, threads, build_parents, &job);
}

ang_octree *ang_octree_build(const ang_volume *volume, const int leaf[3], int apron, int threads, ang_error *err) {
    ang_octree *octree = ang_octree_allocate(volume, leaf, apron, err);
    if (!octree) return NULL;
    int workers = ang_thread_count(threads);
    build_job job = {.volume = volume, .octree = octree};
    job.rows = ang_alloc((size_t)workers * (size_t)volume->dims[0], sizeof *job.rows, "octree", err);
    if (!job.rows) {
        ang_octree_free(octree);
        return NULL;
    }
    const ang_octree_level *leaves = &octree->level[0];
    ang_parallel_for((size_t)leaves->dims[1] * (size_t)leaves->dims[2], 4, workers, build_leaf_rows, &job);
    ang_octree_finish(octree, workers);
    free(job.rows);
    return octree;
}

void ang_octree_free(ang_octree *octree) {
    if (!octree) return;
    for (int level = 0; level < octree->levels; level++) free(octree->level[level].nodes);
    free(octree);
}

void ang_octree_cells(const ang_octree *octree, int level, const int node[3], int first[3], int end[3]) {
    for (int axis = 0; axis < 3; axis++) {
        /* In 64 bits: the last level may reach far beyond the volume. */
        int64_t side = (int64_t)octree->leaf[axis] << level, cells = octree->cells[axis];
        int64_t from = node[axis] * side, to = from + side;
        first[axis] = (int)(from < cells ? from : cells);
        end[axis] = (int)(to < cells ? to : cells);
    }
}
