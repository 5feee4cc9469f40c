/* The polygons of slicing: their area where planes pass through corners, edges and faces. No OpenGL. */
#include "core/selfcheck/cases.h"

#include "core/proxy/proxy.h"

/* Area of the section of a box at `depth` above its least depth: |g| V p, p the density of a U + b V + c W at the depth
 * for uniform U, V, W, where the box rises by a, b, c along its axes. Half-open, as ang_proxy_slice is. */
static double section_area(const double rise[3], double gradient, double volume, double depth) {
    double positive[3], sum = 0, product = 1;
    int count = 0;
    for (int axis = 0; axis < 3; axis++)
        if (rise[axis] > 0) positive[count++] = rise[axis];
    for (int i = 0; i < count; i++) product *= positive[i];
    /* Each axis spreads the density over its rise: (-1)^|S| (depth - sum of S)_+^(count-1) / (count-1)! over all S. */
    for (int subset = 0; subset < 1 << count; subset++) {
        double left = depth, sign = 1;
        for (int i = 0; i < count; i++)
            if (subset >> i & 1) {
                left -= positive[i];
                sign = -sign;
            }
        if (left < 0) continue;
        sum += sign * (count == 1 ? 1 : count == 2 ? left : left * left / 2);
    }
    return gradient * volume * sum / product;
}

static double triangles_area(ang_vec3 (*triangles)[3], int count) {
    double area = 0;
    for (int t = 0; t < count; t++) {
        ang_vec3 a = ang_vec3_sub(triangles[t][1], triangles[t][0]), b = ang_vec3_sub(triangles[t][2], triangles[t][0]);
        area += ang_vec3_length(ang_vec3_cross(a, b)) / 2;
    }
    return area;
}

static void check_plane(ang_bench *bench, const ang_proxy_tables *tables, const ang_slicer *slicer, ang_vec3 gradient,
                        double depth) {
    ang_vec3 size = slicer->size;
    double volume = size.x * size.y * size.z, above = depth - slicer->depth[slicer->front];
    double expected = section_area(slicer->rise, ang_vec3_length(gradient), volume, above);
    for (int proxy = 0; ang_proxy_name((ang_proxy)proxy); proxy++) {
        ang_vec3 triangles[ANG_PROXY_MOST_TRIANGLES][3];
        int count = ang_proxy_slice(tables, (ang_proxy)proxy, slicer, depth, triangles);
        ang_bench_error(bench, fabs(triangles_area(triangles, count) - expected), 1e-5,
                        "error of an area of %.3g, %s, gradient %g,%g,%g, depth %g", expected,
                        ang_proxy_name((ang_proxy)proxy), gradient.x, gradient.y, gradient.z, depth);
    }
}

bool ang_case_polygons(ang_bench *bench, ang_error *err) {
    (void)err;
    /* Small whole numbers: corner depths are exact, so that planes lie in corners, edges and faces to the bit. */
    static const ang_vec3 gradients[] = {{0, 0, 1},  {-1, 0, 0}, {0, 1, 0},  {1, 1, 0}, {0, -1, 2},
                                         {1, 0, 1},  {1, 1, 1},  {1, -1, 1}, {1, 2, 3}, {2, 1, 1},
                                         {-3, 1, 2}, {1, 1, 2},  {-1, -1, 4}};
    static const ang_vec3 boxes[][2] = {{{0, 0, 0}, {1, 1, 1}}, {{-4, 0, 3}, {-2, 1, 7}}, {{8, 16, 24}, {16, 24, 32}}};
    ang_proxy_tables tables;
    ang_proxy_tables_make(&tables);
    for (size_t b = 0; b < sizeof boxes / sizeof *boxes; b++)
        for (size_t g = 0; g < sizeof gradients / sizeof *gradients; g++) {
            ang_slicer slicer;
            ang_slicer_make(&slicer, boxes[b][0], boxes[b][1], gradients[g]);
            double least = slicer.depth[slicer.front], greatest = slicer.depth[slicer.front ^ 7];
            for (int corner = 0; corner < 8; corner++)
                check_plane(bench, &tables, &slicer, gradients[g], slicer.depth[corner]);
            for (int k = 0; k <= 16; k++)
                check_plane(bench, &tables, &slicer, gradients[g], least + (greatest - least) * (k + 0.37) / 17);
        }
    return true;
}
