/* A box of index space made ready to be cut by planes of constant depth: what every proxy starts from. All functions
 * are pure and thread safe. */
#ifndef ANG_PROXY_SLICER_H
#define ANG_PROXY_SLICER_H

#include "core/math/vec.h"

/* Corner c lies at the upper end in x where bit 0 is set, in y where bit 1 is, in z where bit 2 is. */
typedef struct ang_slicer {
    ang_vec3 lower, size; /* voxel index units; size >= 0 */
    ang_vec3 corner[8];
    double depth[8]; /* of the corners, in the gradient's units */
    double rise[3];  /* >= 0: what crossing the box along each axis, away from the front, adds to the depth */
    int front;       /* the corner of least depth; its opposite, front ^ 7, has the greatest */
} ang_slicer;

/* The box from `lower` to `upper` (lower <= upper) under depth(p) = gradient . p; all numbers finite. The gradient may
 * have any length and zeros: with mm per voxel depths are mm. A box without extent in depth is cut by no plane.
 *
 * Corner depths are the front corner's plus the axes' rises, always added in the order x, y, z. Rounding preserves
 * order and no rise is negative, so that on every path of edges from the front corner depths never fall, whatever the
 * scale: the corners deeper than any plane are closed under steps away from the front, as they are in exact arithmetic,
 * and their border on the box is always exactly one loop. This is what lets the proxies go without tolerances; an order
 * of summation that changed from corner to corner would lose it. */
void ang_slicer_make(ang_slicer *slicer, ang_vec3 lower, ang_vec3 upper, ang_vec3 gradient);

/* Where between corners a (0) and b (1) the depth is reached; within 0..1 because it needs, and every caller has,
 * depth[a] <= depth < depth[b]. */
static inline double ang_slicer_fraction(const ang_slicer *slicer, int a, int b, double depth) {
    return (depth - slicer->depth[a]) / (slicer->depth[b] - slicer->depth[a]);
}

/* The point of that depth between two corners, under the same condition. As a is always the shallower end, polygons and
 * tetrahedra that share an edge get the same bits for it. */
static inline ang_vec3 ang_slicer_point(const ang_slicer *slicer, int a, int b, double depth) {
    ang_vec3 from = slicer->corner[a];
    return ang_vec3_along(from, ang_vec3_sub(slicer->corner[b], from), ang_slicer_fraction(slicer, a, b, depth));
}

#endif
