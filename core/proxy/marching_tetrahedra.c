/* Marching tetrahedra as Benassarou et al. 2005 compare with (section 5): the box as six tetrahedra, each cut in a
 * triangle or a quad.
 *
 * The six share the diagonal from the front corner to the back corner: each is one way of crossing the box along the
 * three axes in turn. Its four corners then come in order of depth, and as every plane that reaches this file leaves
 * the front corner on its shallow side and the back corner on its deep side, three of the sixteen cases are left and
 * all six tetrahedra are cut. */
#include "core/proxy/proxy_private.h"

/* The second and third corner of each tetrahedron, as steps from the front corner: first the three whose axes are
 * taken in left-handed order, then the right-handed ones. */
static const int steps[6][2] = {{1, 5}, {4, 6}, {2, 3}, {1, 3}, {2, 6}, {4, 5}};

static void put(ang_vec3 triangle[3], ang_vec3 a, ang_vec3 b, ang_vec3 c, bool reversed) {
    triangle[0] = a;
    triangle[1] = reversed ? c : b;
    triangle[2] = reversed ? b : c;
}

int ang_marching_tetrahedra_slice(const ang_slicer *slicer, double depth, ang_vec3 (*triangles)[3]) {
    int front = slicer->front, back = front ^ 7, count = 0;
    ang_vec3 on_diagonal = ang_slicer_point(slicer, front, back, depth);
    for (int t = 0; t < 6; t++) {
        int second = front ^ steps[t][0], third = front ^ steps[t][1];
        bool reversed = (t >= 3) != ang_proxy_mirrored(front);
        if (depth < slicer->depth[second]) {
            ang_vec3 a = ang_slicer_point(slicer, front, second, depth);
            ang_vec3 b = ang_slicer_point(slicer, front, third, depth);
            put(triangles[count++], a, b, on_diagonal, reversed);
        } else if (depth < slicer->depth[third]) {
            ang_vec3 a = ang_slicer_point(slicer, front, third, depth);
            ang_vec3 b = ang_slicer_point(slicer, second, back, depth);
            ang_vec3 c = ang_slicer_point(slicer, second, third, depth);
            put(triangles[count++], on_diagonal, b, c, reversed);
            put(triangles[count++], on_diagonal, c, a, reversed);
        } else {
            ang_vec3 a = ang_slicer_point(slicer, second, back, depth);
            ang_vec3 b = ang_slicer_point(slicer, third, back, depth);
            put(triangles[count++], on_diagonal, a, b, reversed);
        }
    }
    return count;
}
