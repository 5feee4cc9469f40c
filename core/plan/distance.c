#include "core/plan/distance.h"

#include <stddef.h>
#include <stdlib.h>

enum { FARTHEST = 255 };

/* The least of the neighbours that a sweep in direction `step` (1 or -1) has passed already: the nine of the plane
 * before, three of the row before, and the one before in the row. */
static int least_passed(const int dims[3], const uint8_t *distance, const int at[3], int step) {
    int least = FARTHEST;
    for (int dz = 0; dz <= 1; dz++)
        for (int dy = dz ? -1 : 0; dy <= 1; dy++)
            for (int dx = dz || dy > 0 ? -1 : 1; dx <= 1; dx++) {
                if (dz == 0 && dy < 0) continue;
                int x = at[0] - step * dx, y = at[1] - step * dy, z = at[2] - step * dz;
                if (x < 0 || y < 0 || z < 0 || x >= dims[0] || y >= dims[1] || z >= dims[2]) continue;
                int value = distance[(size_t)x + (size_t)dims[0] * ((size_t)y + (size_t)dims[1] * (size_t)z)];
                least = value < least ? value : least;
            }
    return least;
}

static void sweep(const int dims[3], uint8_t *distance, int step) {
    size_t count = (size_t)dims[0] * (size_t)dims[1] * (size_t)dims[2];
    for (size_t k = 0; k < count; k++) {
        size_t i = step > 0 ? k : count - 1 - k;
        if (distance[i] == 0) continue;
        size_t row = i / (size_t)dims[0];
        int at[3] = {(int)(i % (size_t)dims[0]), (int)(row % (size_t)dims[1]), (int)(row / (size_t)dims[1])};
        int least = least_passed(dims, distance, at, step);
        if (least + 1 < distance[i]) distance[i] = (uint8_t)(least + 1);
    }
}

void ang_block_distances(const int dims[3], const uint8_t *visible, uint8_t *distance) {
    size_t count = (size_t)dims[0] * (size_t)dims[1] * (size_t)dims[2];
    for (size_t i = 0; i < count; i++) distance[i] = visible[i] ? 0 : FARTHEST;
    sweep(dims, distance, 1);
    sweep(dims, distance, -1);
}
