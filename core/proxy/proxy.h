/* Proxy geometry of slicing: the polygon in which a plane of constant depth cuts a box, by four methods that agree. All
 * functions are pure and thread safe. */
#ifndef ANG_PROXY_PROXY_H
#define ANG_PROXY_PROXY_H

#include "core/proxy/slicer.h"

#include <stdint.h>

typedef enum ang_proxy {
    ANG_PROXY_VERTEX_PROGRAM,      /* Rezk-Salama & Kolb 2005, sections 4 and 5; this is the GPU's twin on the CPU */
    ANG_PROXY_MARCHING_CUBES,      /* Benassarou et al. 2005, section 4 */
    ANG_PROXY_MARCHING_TETRAHEDRA, /* Benassarou et al. 2005, section 5 */
    ANG_PROXY_CONVEX_HULL          /* Kniss et al., as told by Benassarou et al. 2005, section 3 */
} ang_proxy;

/* Names as on the command line; NULL or -1 where there is no such value. */
const char *ang_proxy_name(ang_proxy proxy);
int ang_proxy_from_name(const char *name);

/* Marching cubes: row `key` lists the edges that the plane cuts, in order round the polygon, then -1; bit c of the key
 * is set where corner c is deeper than the plane. Rows are empty where nothing is cut, and for keys whose cut edges are
 * not one loop, which no plane makes. Edge e runs along axis e / 4: edges 0..3 along x at (y, z) = (0, 0), (0, 1),
 * (1, 0), (1, 1); 4..7 along y at such (x, z); 8..11 along z at such (x, y).
 *
 * Vertex program: corner sequence[front][i] is the vertex V_i of the paper's Figure 3; outline point p looks for the
 * plane on the edges v1[4p + e] -> v2[4p + e] of that numbering, e = 0..3 in turn. Ints, to be uploaded as they are. */
typedef struct ang_proxy_tables {
    int8_t edges[256][8];
    int sequence[8][8];
    int v1[24], v2[24];
} ang_proxy_tables;

void ang_proxy_tables_make(ang_proxy_tables *tables);

enum { ANG_PROXY_MOST_TRIANGLES = 12 };

/* The triangles of the polygon at `depth` (the slicer's units) in voxel index space; returns how many. They turn
 * counter-clockwise seen from the shallower side (in a right-handed index space) and cover the polygon once; their
 * points lie on the box's edges, the tetrahedra's on its diagonals too. Triangles with coinciding points are kept: a
 * rasteriser drops them for nothing.
 *
 * For all methods alike the plane parts the corners that are deeper (depth[c] > depth) from the others. So the box is
 * half-open: at exactly its least depth a face in the plane is drawn whole (an edge or a corner without area), at its
 * greatest depth nothing is. 0 there, where the plane misses the box, and where `depth` is not a number. */
int ang_proxy_slice(const ang_proxy_tables *tables, ang_proxy proxy, const ang_slicer *slicer, double depth,
                    ang_vec3 triangles[ANG_PROXY_MOST_TRIANGLES][3]);

#endif
