/* The planes of view-aligned slicing (DESIGN.md, "Samples"). */
#ifndef ANG_PLAN_PLANES_H
#define ANG_PLAN_PLANES_H

#include "core/scene/scene.h"

/* Plane k lies at depth first + k * distance, 0 <= k < count. Depths are mm along the view axis from the plane of p
 * (see ang_ray_frame), so that they are small near the volume. One set of planes serves all boxes of a picture: boxes
 * with planes of their own would double or lose opacity at their seams (numerics.md). */
typedef struct ang_slice_planes {
    double first, distance;
    int count;
    ang_vec3 gradient; /* depth of an index-space point p about the box's centre: gradient . p + offset */
    double offset;
    double rounding; /* mm: what depths in float may be off by */
} ang_slice_planes;

/* Planes `step_mm` apart through the clip box beyond the near plane, the first half a step behind the nearest point,
 * the last at most half a step behind the farthest. A box that is thinner than a step gets one plane through its
 * middle. The distance is raised where there would be more than ANG_SLICE_MOST_PLANES. None where the box lies before
 * the near plane. */
ang_slice_planes ang_slice_planes_make(const ang_ray_frame *frame, double step_mm);
enum { ANG_SLICE_MOST_PLANES = 1 << 20 };

/* Least and greatest depth of the box from `lower` to `upper` (index space about the box's centre). */
void ang_slice_depths(const ang_slice_planes *planes, ang_vec3 lower, ang_vec3 upper, double *least, double *greatest);

/* The planes [*begin, *end) that meet depths least..greatest, one more on a side where rounding leaves it open. */
void ang_slice_range(const ang_slice_planes *planes, double least, double greatest, int *begin, int *end);

/* How many groups of `group` planes, counted from plane 0, the planes [begin, end) lie in. */
static inline int ang_slice_groups(int begin, int end, int group) {
    return end > begin ? (end - 1) / group - begin / group + 1 : 0;
}

#endif
