#include "core/volume/octree.h"

#include "core/base/memory.h"
#include "core/base/parallel.h"
#include "core/base/simd.h"

#include <stdlib.h>

typedef struct build_job {
    const ang_volume *volume;
    ang_octree *octree;
    int level;        /* to build, for parents */
    ang_minmax *rows; /* scratch: for each worker row_room() running minima and maxima of a row of leaves */
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

/* Voxels of a row and what lies behind it for the last leaf. */
static size_t row_room(const ang_octree *octree, const ang_volume *volume) {
    return (size_t)volume->dims[0] + (size_t)octree->leaf[0] + 1;
}

/* Rows of voxels whose extremes are taken together: those of a leaf of 4 cells in one slice. */
enum { ROWS = 5 };

/* Takes ROWS rows into the running minima and maxima: a long loop that the compiler turns into SIMD. */
static inline void take_rows(const uint16_t *const row[ROWS], size_t count, uint16_t *restrict low,
                             uint16_t *restrict high) {
    const uint16_t *a = row[0], *b = row[1], *c = row[2], *d = row[3], *e = row[4];
    for (size_t x = 0; x < count; x++) {
        uint16_t ab = a[x] < b[x] ? a[x] : b[x], cd = c[x] < d[x] ? c[x] : d[x], el = e[x] < low[x] ? e[x] : low[x];
        uint16_t AB = a[x] < b[x] ? b[x] : a[x], CD = c[x] < d[x] ? d[x] : c[x], EH = e[x] < high[x] ? high[x] : e[x];
        ab = ab < cd ? ab : cd;
        AB = AB < CD ? CD : AB;
        low[x] = ab < el ? ab : el;
        high[x] = AB < EH ? EH : AB;
    }
}

/* Makes of a row of extremes those of 2, 4, ... voxels from each on, as many as fit into a leaf: how many. Behind the
 * row's end lies what changes nothing. */
static inline int widen(uint16_t *low, uint16_t *high, size_t count, int cells) {
    size_t wide = 1;
    for (; 2 * wide <= (size_t)cells + 1; wide *= 2)
        for (size_t x = 0; x < count; x++) {
            low[x] = low[x + wide] < low[x] ? low[x + wide] : low[x];
            high[x] = high[x + wide] > high[x] ? high[x + wide] : high[x];
        }
    return (int)wide;
}

/* One row of leaves along x: first the extremes over the rows of voxels in y and z, then over each leaf's stretch of x.
 */
ANG_SIMD static void build_leaf_rows(void *context, size_t begin, size_t end, int worker) {
    build_job *job = context;
    const ang_volume *volume = job->volume;
    ang_octree_level *leaves = &job->octree->level[0];
    size_t nx = (size_t)volume->dims[0], ny = (size_t)volume->dims[1];
    size_t room = row_room(job->octree, volume);
    uint16_t *low = (uint16_t *)(job->rows + (size_t)worker * room), *high = low + room;
    for (size_t row = begin; row < end; row++) {
        int y0, y1, z0, z1;
        voxel_range(job->octree, volume, 1, (int)(row % (size_t)leaves->dims[1]), &y0, &y1);
        voxel_range(job->octree, volume, 2, (int)(row / (size_t)leaves->dims[1]), &z0, &z1);
        for (size_t x = 0; x < room; x++) {
            low[x] = UINT16_MAX;
            high[x] = 0;
        }
        for (int z = z0; z <= z1; z++)
            for (int y = y0; y <= y1; y += ROWS) {
                const uint16_t *rows[ROWS];
                for (int i = 0; i < ROWS; i++)
                    rows[i] = volume->data + nx * ((size_t)min_int(y + i, y1) + ny * (size_t)z);
                /* The next slice's, while this one's are looked at. */
                for (size_t x = 0; z < z1 && x < (size_t)min_int(ROWS, y1 - y + 1) * nx; x += 32)
                    __builtin_prefetch(rows[0] + nx * ny + x, 0, 2);
                take_rows(rows, nx, low, high);
            }
        int wide = widen(low, high, nx, job->octree->leaf[0]);
        ang_minmax *out = leaves->nodes + row * (size_t)leaves->dims[0];
        for (int i = 0; i < leaves->dims[0]; i++) {
            int x0, x1;
            voxel_range(job->octree, volume, 0, i, &x0, &x1);
            ang_minmax range = {low[x0], high[x0]};
            for (int x = x0 + wide; x <= x1; x += wide) {
                int at = min_int(x, x1 - wide + 1);
                range.min = low[at] < range.min ? low[at] : range.min;
                range.max = high[at] > range.max ? high[at] : range.max;
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
    job.rows = ang_alloc((size_t)workers * row_room(octree, volume), sizeof *job.rows, "octree", err);
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
