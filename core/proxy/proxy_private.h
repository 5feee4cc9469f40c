/* What the methods behind ang_proxy_slice share; only files of core/proxy/ include it. */
#ifndef ANG_PROXY_PROXY_PRIVATE_H
#define ANG_PROXY_PROXY_PRIVATE_H

#include "core/proxy/proxy.h"

/* Each method's tables and its polygon; see proxy.h. Slicing needs least depth <= depth < greatest depth, which
 * ang_proxy_slice has seen to. */
void ang_vertex_program_tables(ang_proxy_tables *tables);
int ang_vertex_program_slice(const ang_proxy_tables *tables, const ang_slicer *slicer, double depth,
                             ang_vec3 (*triangles)[3]);
void ang_marching_cubes_table(ang_proxy_tables *tables);
int ang_marching_cubes_slice(const ang_proxy_tables *tables, const ang_slicer *slicer, double depth,
                             ang_vec3 (*triangles)[3]);
int ang_marching_tetrahedra_slice(const ang_slicer *slicer, double depth, ang_vec3 (*triangles)[3]);
int ang_convex_hull_slice(const ang_slicer *slicer, double depth, ang_vec3 (*triangles)[3]);

/* Whether the axes that lead away from corner `front` are left-handed. */
static inline bool ang_proxy_mirrored(int front) { return ((front ^ front >> 1 ^ front >> 2) & 1) != 0; }

/* A convex outline of `count` >= 3 points as a fan about its first; returns the number of triangles. */
static inline int ang_proxy_fan(const ang_vec3 *outline, int count, ang_vec3 (*triangles)[3]) {
    for (int i = 2; i < count; i++) {
        triangles[i - 2][0] = outline[0];
        triangles[i - 2][1] = outline[i - 1];
        triangles[i - 2][2] = outline[i];
    }
    return count - 2;
}

#endif
