/* MC slicing of Benassarou et al. 2005 (Algorithms 1 and 2): which corners are deeper than the plane picks a row of a
 * table that lists the cut edges in order. The paper prints seven of the 256 rows; the rest are generated here. */
#include "core/proxy/proxy_private.h"

#include <string.h>

enum { edge_count = 12 };

/* The corners that each edge joins, the lower end first. */
static const uint8_t edge_ends[edge_count][2] = {{0, 1}, {4, 5}, {2, 3}, {6, 7}, {0, 2}, {4, 6},
                                                 {1, 3}, {5, 7}, {0, 4}, {2, 6}, {1, 5}, {3, 7}};

static int edge_between(int a, int b) {
    int edge = 0;
    while (edge_ends[edge][0] != (a & b) || edge_ends[edge][1] != (a | b)) edge++;
    return edge;
}

static bool is_deeper(int key, int corner) { return (key >> corner & 1) != 0; }

/* Round each face, counter-clockwise seen from outside, the polygon goes from the edge that enters the deeper corners
 * to the edge that leaves them; that makes it counter-clockwise seen from the shallower side, as the paper's rows are.
 * next[e] becomes the edge after e, -1 where e is not cut. False where a face is entered twice, which no plane does. */
static bool link_edges(int key, int next[edge_count]) {
    memset(next, -1, edge_count * sizeof *next);
    for (int face = 0; face < 6; face++) {
        int axis = face / 2, side = face % 2;
        int u = 1 << (axis + 1) % 3, v = 1 << (axis + 2) % 3, base = side << axis;
        int circuit[4] = {base, base | (side ? u : v), base | u | v, base | (side ? v : u)};
        int enter = -1, leave = -1;
        for (int i = 0; i < 4; i++) {
            int a = circuit[i], b = circuit[(i + 1) % 4];
            if (is_deeper(key, a) == is_deeper(key, b)) continue;
            if (is_deeper(key, a)) {
                leave = edge_between(a, b);
                continue;
            }
            if (enter >= 0) return false;
            enter = edge_between(a, b);
        }
        if (enter >= 0) next[enter] = leave;
    }
    return true;
}

/* The paper gives no rule for the edge that a row starts with. This order of the deeper corners, y = 0 before y = 1,
 * with x before y before z at one corner, finds the last edge of all the rows that it prints. */
static int last_edge(int key, const int next[edge_count]) {
    static const int order[8] = {4, 1, 5, 0, 6, 3, 7, 2};
    for (int i = 0; i < 8; i++)
        for (int bit = 1; bit < 8; bit <<= 1) {
            int edge = edge_between(order[i], order[i] ^ bit);
            if (is_deeper(key, order[i]) && next[edge] >= 0) return edge;
        }
    return -1;
}

void ang_marching_cubes_table(ang_proxy_tables *tables) {
    memset(tables->edges, -1, sizeof tables->edges);
    for (int key = 0; key < 256; key++) {
        int next[edge_count];
        if (!link_edges(key, next)) continue;
        int cut = 0, count = 0;
        for (int edge = 0; edge < edge_count; edge++) cut += next[edge] >= 0;
        if (cut == 0) continue;
        int8_t row[edge_count];
        int last = last_edge(key, next), edge = last;
        do {
            edge = next[edge];
            row[count++] = (int8_t)edge;
        } while (edge != last);
        /* Edges left over belong to a second loop: opposite corners, which no plane parts from the rest. */
        if (count == cut) memcpy(tables->edges[key], row, (size_t)count * sizeof *row);
    }
}

int ang_marching_cubes_slice(const ang_proxy_tables *tables, const ang_slicer *slicer, double depth,
                             ang_vec3 (*triangles)[3]) {
    int key = 0;
    for (int c = 0; c < 8; c++) key |= (slicer->depth[c] > depth) << c;
    const int8_t *row = tables->edges[key];
    ang_vec3 outline[8];
    int count = 0;
    for (; row[count] >= 0; count++) {
        const uint8_t *ends = edge_ends[row[count]];
        int lower_is_deeper = key >> ends[0] & 1;
        outline[count] = ang_slicer_point(slicer, ends[lower_is_deeper], ends[1 - lower_is_deeper], depth);
    }
    return ang_proxy_fan(outline, count, triangles);
}
