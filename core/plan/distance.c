#include "core/plan/distance.h"

#include "core/base/simd.h"

#include <stddef.h>

enum { FARTHEST = 255 };

/* Brings a row up to date with the three neighbours of each block in another. Loops without branches, which the
 * compiler turns into SIMD. */
ANG_SIMD static void ask_row(uint8_t *restrict row, const uint8_t *restrict other, int width) {
    for (int x = 0; x < width; x++) {
        uint8_t next = (uint8_t)(other[x] + (other[x] < FARTHEST));
        row[x] = next < row[x] ? next : row[x];
    }
    for (int x = 1; x < width; x++) {
        uint8_t next = (uint8_t)(other[x - 1] + (other[x - 1] < FARTHEST));
        row[x] = next < row[x] ? next : row[x];
    }
    for (int x = 0; x < width - 1; x++) {
        uint8_t next = (uint8_t)(other[x + 1] + (other[x + 1] < FARTHEST));
        row[x] = next < row[x] ? next : row[x];
    }
}

/* One sweep, in direction `step` (1 or -1): each block asks the neighbours that the sweep has passed already, which are
 * the three rows of the plane before, the row before, and the block before in its own row. */
static void sweep(const int dims[3], uint8_t *distance, int step) {
    ptrdiff_t width = dims[0], plane = width * dims[1];
    for (int k = 0; k < dims[2]; k++)
        for (int j = 0; j < dims[1]; j++) {
            int y = step > 0 ? j : dims[1] - 1 - j, z = step > 0 ? k : dims[2] - 1 - k;
            uint8_t *row = distance + y * width + z * plane;
            if (j > 0) ask_row(row, row - step * width, dims[0]);
            for (int dy = -1; dy <= 1 && k > 0; dy++)
                if (y + dy >= 0 && y + dy < dims[1]) ask_row(row, row + dy * width - step * plane, dims[0]);
            int before = FARTHEST;
            for (int i = 0; i < dims[0]; i++) {
                int x = step > 0 ? i : dims[0] - 1 - i;
                before = before + 1 < row[x] ? before + 1 : row[x];
                row[x] = (uint8_t)before;
            }
        }
}

void ang_block_distances(const int dims[3], const uint8_t *visible, uint8_t *distance) {
    size_t count = (size_t)dims[0] * (size_t)dims[1] * (size_t)dims[2];
    for (size_t i = 0; i < count; i++) distance[i] = visible[i] ? 0 : FARTHEST;
    sweep(dims, distance, 1);
    sweep(dims, distance, -1);
}
