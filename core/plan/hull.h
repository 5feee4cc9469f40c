/* Cells of blocks that show something, and the faces between them and the rest: the bounding geometry of Haferburg
 * ("Object order empty space skipping in OpenGL 4"), counted before any of it is made. */
#ifndef ANG_PLAN_HULL_H
#define ANG_PLAN_HULL_H

#include "core/base/error.h"
#include "core/math/vec.h"

#include <stddef.h>
#include <stdint.h>

/* Cells of `side` blocks along each axis. Zero-initialise; free with ang_hull_cells_clear. */
typedef struct ang_hull_cells {
    int side, dims[3];
    uint8_t *active; /* 1 where a block of the cell shows; x fastest */
    size_t faces;    /* between active cells and what is not */
} ang_hull_cells;

/* The finest cells, of 1, 2, 4, ... blocks a side, with no more than `budget` faces and coordinates of 9 bits. Blocks
 * outside [first, end), those of the clip box, count as invisible. `faces` is 0 where nothing shows, and `side` is 0
 * where even one cell alone has too many. False with ANG_LIMIT. */
bool ang_hull_cells_make(ang_hull_cells *cells, const int dims[3], const uint8_t *visible, const int first[3],
                         const int end[3], size_t budget, ang_error *err);
void ang_hull_cells_clear(ang_hull_cells *cells);

/* Whether cell (x,y,z) is active; false outside. */
bool ang_hull_active(const ang_hull_cells *cells, int x, int y, int z);

#endif
