/* The stages of Kniss et al. as Benassarou et al. 2005 (section 3) tell them: intersect all twelve edges, average the
 * points, sort them by angle about that centre, make a fan.
 *
 * Angles are taken in the unit cube whose corner 0 is the box's front corner, seen along the axis in which depth rises
 * most. Such a map keeps the order of points round a convex outline, and there a box of 1:1:1000 or a grazing plane
 * loses no digits. Only points that coincide to rounding may change places, which moves the outline by rounding. */
#include "core/proxy/proxy_private.h"

typedef struct crossing {
    ang_vec3 point;
    double at[3]; /* in the unit cube */
    double angle;
} crossing;

enum { most_crossings = 6 };

/* A number that grows with the angle of (u, v), 0..4 for a full turn; costs one division. */
static double angle_of(double u, double v) {
    double sum = fabs(u) + fabs(v);
    if (sum == 0) return 0;
    return v < 0 ? 3 + u / sum : 1 - u / sum;
}

static int find_crossings(const ang_slicer *slicer, double depth, crossing found[most_crossings]) {
    int count = 0;
    for (int step = 0; step < 7; step++)
        for (int axis = 0; axis < 3; axis++) {
            int a = slicer->front ^ step, b = a ^ 1 << axis;
            if (step >> axis & 1 || !(slicer->depth[a] <= depth && depth < slicer->depth[b])) continue;
            crossing *c = &found[count++];
            c->point = ang_slicer_point(slicer, a, b, depth);
            for (int i = 0; i < 3; i++) c->at[i] = step >> i & 1;
            c->at[axis] = ang_slicer_fraction(slicer, a, b, depth);
        }
    return count;
}

int ang_convex_hull_slice(const ang_slicer *slicer, double depth, ang_vec3 (*triangles)[3]) {
    crossing found[most_crossings];
    int count = find_crossings(slicer, depth, found);
    const double *rise = slicer->rise;
    int along = rise[0] >= rise[1] && rise[0] >= rise[2] ? 0 : rise[1] >= rise[2] ? 1 : 2;
    /* The shallow side looks along `along` and so sees the other two axes in reverse order, unless the front corner has
     * mirrored them already. */
    bool mirrored = ang_proxy_mirrored(slicer->front);
    int u = (along + (mirrored ? 1 : 2)) % 3, v = (along + (mirrored ? 2 : 1)) % 3;
    double centre[3] = {0};
    for (int i = 0; i < count; i++)
        for (int axis = 0; axis < 3; axis++) centre[axis] += found[i].at[axis] / count;
    ang_vec3 outline[most_crossings];
    for (int i = 0; i < count; i++) {
        found[i].angle = angle_of(found[i].at[u] - centre[u], found[i].at[v] - centre[v]);
        crossing one = found[i];
        int place = i;
        for (; place > 0 && found[place - 1].angle > one.angle; place--) found[place] = found[place - 1];
        found[place] = one;
    }
    for (int i = 0; i < count; i++) outline[i] = found[i].point;
    return ang_proxy_fan(outline, count, triangles);
}
