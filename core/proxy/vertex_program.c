/* The vertex program of Rezk-Salama & Kolb 2005, run on the CPU. Three paths of three edges each lead from the front
 * corner V0 to the back corner V7, and each meets the plane once: the points 0, 2 and 4. A dotted edge joins each path
 * to the next; where the plane cuts it too, that is the point between, else the path's own point again. */
#include "core/proxy/proxy_private.h"

#include <string.h>

enum { outline_points = 6, tries = 4 };

/* The paper's listing names these arrays; the text of section 4 gives their contents. A path of three edges fills four
 * tries with its last edge twice. */
static const int edge_from[outline_points * tries] = {0, 1, 4, 4, 1, 0, 1, 4, 0, 2, 5, 5,
                                                      2, 0, 2, 5, 0, 3, 6, 6, 3, 0, 3, 6};
static const int edge_to[outline_points * tries] = {1, 4, 7, 7, 5, 1, 4, 7, 2, 5, 7, 7,
                                                    6, 2, 5, 7, 3, 6, 7, 7, 4, 3, 6, 7};

void ang_vertex_program_tables(ang_proxy_tables *tables) {
    /* V0..V7 for the front corner 0: path V0 V1 V4 V7 goes along x, y, z, the other two along z, x, y and y, z, x. From
     * a front corner whose axes are mirrored, y and z change places so that the paths stay right-handed. */
    static const int right_handed[8] = {0, 1, 4, 2, 3, 5, 6, 7};
    static const int mirrored[8] = {0, 1, 2, 4, 5, 3, 6, 7};
    for (int front = 0; front < 8; front++)
        for (int i = 0; i < 8; i++)
            tables->sequence[front][i] = front ^ (ang_proxy_mirrored(front) ? mirrored : right_handed)[i];
    memcpy(tables->v1, edge_from, sizeof edge_from);
    memcpy(tables->v2, edge_to, sizeof edge_to);
}

int ang_vertex_program_slice(const ang_proxy_tables *tables, const ang_slicer *slicer, double depth,
                             ang_vec3 (*triangles)[3]) {
    const int *sequence = tables->sequence[slicer->front];
    ang_vec3 outline[outline_points];
    for (int point = 0; point < outline_points; point++) {
        const int *from = tables->v1 + tries * point, *to = tables->v2 + tries * point;
        int a, b, e = 0;
        /* The paper accepts an edge by its own lambda, and a plane through a corner may then find none: rounding puts
         * it beyond the end of one edge and before the start of the next. Depths that edges share leave no such gap,
         * and the last edge needs no test. The shader, which must place its points even where the plane misses the
         * box, clamps lambda besides. */
        for (;; e++) {
            a = sequence[from[e]];
            b = sequence[to[e]];
            if (e == tries - 1 || (slicer->depth[a] <= depth && depth < slicer->depth[b])) break;
        }
        outline[point] = ang_slicer_point(slicer, a, b, depth);
    }
    return ang_proxy_fan(outline, outline_points, triangles);
}
