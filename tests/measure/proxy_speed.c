/* Benassarou et al. 2005, figure 4, without texturing: the polygons of one box cut on the CPU, frames a second at 1 to
 * 16 planes a voxel, in turns in one run; medians of nine. The vertex program's twin runs on the CPU here too. */
#include "core/base/clock.h"
#include "core/proxy/proxy.h"

#include <stdio.h>
#include <stdlib.h>

enum { runs = 9, proxies = ANG_PROXY_CONVEX_HULL + 1 };

static int ascending(const void *a, const void *b) {
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

int main(void) {
    ang_proxy_tables tables;
    ang_proxy_tables_make(&tables);
    ang_slicer slicer;
    /* 512x512x106 cells of 0.45x0.45x1 mm seen obliquely; depths in mm. */
    ang_slicer_make(&slicer, (ang_vec3){-256, -256, -53}, (ang_vec3){256, 256, 53},
                    (ang_vec3){0.45 * 0.47, 0.45 * 0.81, 0.34});
    double first = slicer.depth[slicer.front], extent = slicer.depth[slicer.front ^ 7] - first;
    printf("| rate | planes |");
    for (int p = 0; p < proxies; p++) printf(" %s |", ang_proxy_name((ang_proxy)p));
    printf("\n|---|---|---|---|---|---|\n");
    ang_vec3(*out)[3] = malloc(200000 * ANG_PROXY_MOST_TRIANGLES * sizeof *out);
    if (!out) return 6;
    for (int rate = 1; rate <= 16; rate *= 2) {
        int planes = (int)(extent / 0.45 * rate);
        printf("| %dx | %d |", rate, planes);
        for (int p = 0; p < proxies; p++) {
            double ms[runs];
            for (int r = 0; r < runs; r++) {
                double start = ang_now_ms();
                ang_vec3(*to)[3] = out;
                for (int k = 0; k < planes; k++)
                    to += ang_proxy_slice(&tables, (ang_proxy)p, &slicer, first + (k + 0.5) * extent / planes, to);
                ms[r] = ang_now_ms() - start;
            }
            qsort(ms, runs, sizeof *ms, ascending);
            printf(" %.0f |", 1e3 / ms[runs / 2]);
        }
        printf("\n");
    }
    free(out);
    return 0;
}
