/* The ray caster: one picture's rays as plain numbers, and the loops that follow them, one for each width of SIMD. */
#ifndef ANG_CPU_CAST_H
#define ANG_CPU_CAST_H

#include "core/plan/block_grid.h"
#include "core/scene/scene.h"

#include <stddef.h>
#include <stdint.h>

enum { ANG_CAST_TILE = 16 }; /* pixels a side of what is followed at once */

/* How the loops differ. */
typedef enum ang_cast_kind {
    ANG_CAST_LIGHT,       /* dvr */
    ANG_CAST_LIGHT_PHONG, /* dvr with shading */
    ANG_CAST_WHOLE,       /* dvr with steps classified by all values between their ends */
    ANG_CAST_WHOLE_PHONG,
    ANG_CAST_HIGHEST, /* mip */
    ANG_CAST_LOWEST,  /* minip */
    ANG_CAST_MEAN,    /* without padding */
    ANG_CAST_MEAN_WEIGHTED,
    ANG_CAST_SURFACE /* iso */
} ang_cast_kind;

enum { ANG_CAST_LEVELS = 3 };
/* A level of an octree. */
typedef struct ang_cast_ranges {
    const ang_minmax *nodes;
    int dims[3], shift; /* nodes; a cell's node is its index shifted by this */
} ang_cast_ranges;

/* Everything that the loops read; borrows all it points to. Stored values are those of the volume. */
typedef struct ang_cast {
    ang_cast_kind kind;
    /* volume */
    const uint16_t *values, *weights; /* rows of at least two; weights: 65535 where there is no padding */
    int last[3];                      /* index of the last voxel */
    float top[3];   /* the greatest place below it, so that every place has a cell; 0 along an axis of one voxel */
    int row, slice; /* from one row, or slice, to the next; 0 where there is one only */
    /* rays */
    ang_ray_frame frame;
    int width, height;     /* pixels */
    const float *limit_mm; /* of each pixel, or NULL */
    float step;            /* mm */
    /* blocks, where rays skip */
    bool skips;
    const uint8_t *distance; /* ang_block_distances over blocks of ANG_SKIP_BLOCK cells;  */
    int blocks[3];
    ang_cast_ranges ranges[ANG_CAST_LEVELS]; /* of blocks of one, two and four a side; for modes that show an extreme */
    float room;                              /* steps by which a sample counts to both blocks that it lies between */
    /* transfer function */
    const float *entries;     /* ang_transfer_tables */
    const float *extinctions; /* the fourth of every four of them */
    float first, per_value;
    int intervals;
    const float *steps, *integrals, *plateaus; /* for steps as a whole: ang_whole_steps; plateaus may be NULL */
    bool jumps, thin, one_colour;              /* ANG_PART_ROUNDING, not ANG_PART_EXPONENTIAL, not ANG_PART_COLOUR */
    float colour[3];                           /* where one_colour */
    float termination;
    /* rays that go from cell to cell (cast_cells.c); means is NULL where none do */
    const float *means;           /* records of ang_means */
    float mean_unit;              /* 1/mm * intervals in one of their whole numbers */
    float most_bent;              /* by which share of its width a mean may be moved */
    float longest, longest_whole; /* mm: pieces within a cell, and the longest way that is not cut into such */
    const uint8_t *flat;          /* ang_flat_blocks, or NULL */
    /* shading */
    float gradient_to_mm[3][3]; /* halved stored differences to HU per mm */
    float half_slope;           /* halved stored differences to HU */
    float ambient, diffuse, specular, power, g0;
    int whole_power; /* `power` where it is whole and small, else -1 */
    /* modes that show a value, and surfaces */
    float window_lower, window_scale, mean_base, mean_empty;
    float enough; /* an extreme that no better one looks different from: white, or black */
    float iso, iso_colour[3];
    /* results: four floats and the samples of each pixel; counts may be NULL */
    float *rgba, *counts;
} ang_cast;

/* What a part of the picture took. */
typedef struct ang_cast_took {
    uint64_t samples, rays, shown; /* dvr: samples that added light */
} ang_cast_took;

/* The pixels of the tile whose left top is (x, y); adds to *took, from which it guesses what is ahead. Thread safe. */
typedef void ang_cast_tile(const ang_cast *cast, int x, int y, ang_cast_took *took);

typedef struct ang_cast_width {
    const char *name; /* in words: "16 lanes, AVX-512" */
    ang_cast_tile *tile, *cells;
} ang_cast_width;
enum { ANG_CAST_WIDTHS = 3 };

/* Fills `widths` with those that this processor has, the widest first, and returns their number. The pictures of all
 * are the same bits. Thread safe. */
int ang_cast_widths(ang_cast_width widths[ANG_CAST_WIDTHS]);

#endif
