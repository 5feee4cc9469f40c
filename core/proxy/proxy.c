#include "core/proxy/proxy_private.h"

#include <string.h>

static const char *const proxy_names[] = {"vertex-program", "marching-cubes", "marching-tetrahedra", "convex-hull"};
enum { proxy_count = sizeof proxy_names / sizeof *proxy_names };

const char *ang_proxy_name(ang_proxy proxy) {
    int index = (int)proxy;
    return index >= 0 && index < proxy_count ? proxy_names[index] : NULL;
}

int ang_proxy_from_name(const char *name) {
    for (int i = 0; i < proxy_count; i++)
        if (strcmp(proxy_names[i], name) == 0) return i;
    return -1;
}

void ang_proxy_tables_make(ang_proxy_tables *tables) {
    ang_vertex_program_tables(tables);
    ang_marching_cubes_table(tables);
}

int ang_proxy_slice(const ang_proxy_tables *tables, ang_proxy proxy, const ang_slicer *slicer, double depth,
                    ang_vec3 triangles[ANG_PROXY_MOST_TRIANGLES][3]) {
    /* Here, once, so that all methods agree on planes that only touch the box. */
    if (!(slicer->depth[slicer->front] <= depth && depth < slicer->depth[slicer->front ^ 7])) return 0;
    switch (proxy) {
    case ANG_PROXY_VERTEX_PROGRAM:
        return ang_vertex_program_slice(tables, slicer, depth, triangles);
    case ANG_PROXY_MARCHING_CUBES:
        return ang_marching_cubes_slice(tables, slicer, depth, triangles);
    case ANG_PROXY_MARCHING_TETRAHEDRA:
        return ang_marching_tetrahedra_slice(slicer, depth, triangles);
    case ANG_PROXY_CONVEX_HULL:
        return ang_convex_hull_slice(slicer, depth, triangles);
    }
    return 0;
}
