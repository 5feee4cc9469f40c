#include "core/plan/distance.h"

#include "core/base/simd.h"

#include <stdbool.h>
#include <stddef.h>
#include <string.h>

enum {
    FARTHEST = 255,
    PIECE = 128 /* blocks of a row that are worked on at once: loops of one fixed length become SIMD without rests */
};

static inline uint8_t nearer(uint8_t a, uint8_t b) { return a < b ? a : b; }
static inline uint8_t farther(uint8_t distance, int by) {
    return (uint8_t)(nearer(distance, (uint8_t)(FARTHEST - by)) + by);
}

/* Blocks of a row that the sweep has passed or asks, in the buffer's middle, with what stands for no block around. */
typedef struct piece {
    uint8_t block[3 * PIECE];
} piece;

/* What the three rows of the plane before and the row before have to say, the nearest of each place, from the block
 * before the piece to the one behind it. */
static inline void gather(const uint8_t *const rows[4], int count, int first, int width, uint8_t near[PIECE + 2]) {
    int begin = first > 0 ? first - 1 : 0, end = first + PIECE + 1 < width ? first + PIECE + 1 : width;
    memset(near, FARTHEST, PIECE + 2);
    for (int i = 0; i < count; i++) {
        uint8_t other[PIECE + 2];
        memset(other, FARTHEST, sizeof other);
        memcpy(other + begin - (first - 1), rows[i] + begin, (size_t)(end - begin));
        for (int x = 0; x < PIECE + 2; x++) near[x] = nearer(near[x], other[x]);
    }
}

/* Whether no block of the piece is farther than the block before it says; and, in steps of 1, 2, 4, ..., until so. */
static inline bool is_settled(const uint8_t *restrict at, const uint8_t *restrict from) {
    uint8_t late = 0;
    for (int x = 0; x < PIECE; x++) late |= at[x] > farther(from[x], 1);
    return !late;
}

static inline void settle(piece *row, int step) {
    uint8_t *at = row->block + PIECE;
    for (int by = 1; by < PIECE && !is_settled(at, at - step); by *= 2) {
        uint8_t next[PIECE];
        const uint8_t *from = at - step * by;
        for (int x = 0; x < PIECE; x++) next[x] = nearer(at[x], farther(from[x], by));
        memcpy(at, next, PIECE);
    }
}

/* A row that asks `count` others and then itself, in direction `step`. */
ANG_SIMD static void ask(uint8_t *row, const uint8_t *const rows[4], int count, int width, int step) {
    int pieces = (width + PIECE - 1) / PIECE;
    piece here;
    memset(&here, FARTHEST, sizeof here);
    uint8_t *at = here.block + PIECE, before = FARTHEST;
    for (int k = 0; k < pieces; k++) {
        int first = (step > 0 ? k : pieces - 1 - k) * PIECE, length = width - first < PIECE ? width - first : PIECE;
        memset(at, FARTHEST, PIECE);
        memcpy(at, row + first, (size_t)length);
        if (count > 0) {
            uint8_t near[PIECE + 2];
            gather(rows, count, first, width, near);
            for (int x = 0; x < PIECE; x++)
                at[x] = nearer(at[x], farther(nearer(nearer(near[x], near[x + 1]), near[x + 2]), 1));
        }
        int entry = step > 0 ? 0 : length - 1, exit = step > 0 ? length - 1 : 0;
        at[entry] = nearer(at[entry], farther(before, 1));
        /* Behind the row's end there is nothing to bring up to date, nor to ask. */
        if (length < PIECE) memset(at + length, step > 0 ? 0 : FARTHEST, (size_t)(PIECE - length));
        settle(&here, step);
        before = at[exit];
        memcpy(row + first, at, (size_t)length);
    }
}

/* One sweep, in direction `step` (1 or -1): each block asks the neighbours that the sweep has passed already, which are
 * the three rows of the plane before, the row before, and the block before in its own row. */
static void sweep(const int dims[3], uint8_t *distance, int step) {
    ptrdiff_t width = dims[0], plane = width * dims[1];
    for (int k = 0; k < dims[2]; k++)
        for (int j = 0; j < dims[1]; j++) {
            int y = step > 0 ? j : dims[1] - 1 - j, z = step > 0 ? k : dims[2] - 1 - k, count = 0;
            uint8_t *row = distance + y * width + z * plane;
            const uint8_t *rows[4];
            if (j > 0) rows[count++] = row - step * width;
            for (int dy = -1; dy <= 1 && k > 0; dy++)
                if (y + dy >= 0 && y + dy < dims[1]) rows[count++] = row + dy * width - step * plane;
            ask(row, rows, count, dims[0], step);
        }
}

void ang_block_distances(const int dims[3], const uint8_t *visible, uint8_t *distance) {
    size_t count = (size_t)dims[0] * (size_t)dims[1] * (size_t)dims[2];
    for (size_t i = 0; i < count; i++) distance[i] = visible[i] ? 0 : FARTHEST;
    sweep(dims, distance, 1);
    sweep(dims, distance, -1);
}
