#include "core/plan/hull.h"

#include "core/base/memory.h"

#include <stdlib.h>

enum { MOST_CELLS = 511 }; /* along an axis: corners take 9 bits */

bool ang_hull_active(const ang_hull_cells *cells, int x, int y, int z) {
    const int *n = cells->dims;
    if (x < 0 || y < 0 || z < 0 || x >= n[0] || y >= n[1] || z >= n[2]) return false;
    return cells->active[(size_t)x + (size_t)n[0] * ((size_t)y + (size_t)n[1] * (size_t)z)];
}

static size_t count_faces(const ang_hull_cells *cells) {
    size_t faces = 0;
    for (int z = 0; z < cells->dims[2]; z++)
        for (int y = 0; y < cells->dims[1]; y++)
            for (int x = 0; x < cells->dims[0]; x++) {
                if (!ang_hull_active(cells, x, y, z)) continue;
                faces += !ang_hull_active(cells, x - 1, y, z) + !ang_hull_active(cells, x + 1, y, z);
                faces += !ang_hull_active(cells, x, y - 1, z) + !ang_hull_active(cells, x, y + 1, z);
                faces += !ang_hull_active(cells, x, y, z - 1) + !ang_hull_active(cells, x, y, z + 1);
            }
    return faces;
}

static bool gather(ang_hull_cells *cells, const int dims[3], const uint8_t *visible, const int first[3],
                   const int end[3], ang_error *err) {
    size_t count = 1;
    for (int axis = 0; axis < 3; axis++) {
        cells->dims[axis] = (dims[axis] + cells->side - 1) / cells->side;
        count *= (size_t)cells->dims[axis];
    }
    free(cells->active);
    cells->active = ang_alloc(count, 1, "cells of the envelope", err);
    if (!cells->active) return false;
    for (int z = first[2]; z < end[2]; z++)
        for (int y = first[1]; y < end[1]; y++) {
            const uint8_t *row = visible + (size_t)dims[0] * ((size_t)y + (size_t)dims[1] * (size_t)z);
            uint8_t *cell =
                cells->active + (size_t)cells->dims[0] *
                                    ((size_t)(y / cells->side) + (size_t)cells->dims[1] * (size_t)(z / cells->side));
            for (int x = first[0]; x < end[0]; x++) cell[x / cells->side] |= row[x] != 0;
        }
    return true;
}

bool ang_hull_cells_make(ang_hull_cells *cells, const int dims[3], const uint8_t *visible, const int first[3],
                         const int end[3], size_t budget, ang_error *err) {
    for (int side = 1;; side *= 2) {
        cells->side = side;
        if (!gather(cells, dims, visible, first, end, err)) return false;
        bool one = true, fits = true;
        for (int axis = 0; axis < 3; axis++) {
            one = one && cells->dims[axis] == 1;
            fits = fits && cells->dims[axis] <= MOST_CELLS;
        }
        cells->faces = count_faces(cells);
        if (fits && cells->faces <= budget) return true;
        if (!one) continue;
        cells->side = 0;
        return true;
    }
}

void ang_hull_cells_clear(ang_hull_cells *cells) {
    free(cells->active);
    *cells = (ang_hull_cells){0};
}
