/* What a method leaves out must not show: empty space, bricks, rays that end early. */
#include "core/selfcheck/cases.h"

#include <string.h>

static bool transparent(ang_stage *stage, ang_error *err) {
    const ang_method *method = stage->bench->method;
    if (!ang_stage_medium(stage, 0, err)) return false;
    stage->scene.shading = ANG_SHADING_PHONG;
    ang_stage_look(stage, "10,10", ANG_PERSPECTIVE);
    if (!ang_stage_draw(stage, err)) return false;
    static const double nothing[4] = {0}, background[4] = {0.1, 0.7, 0.3, 1};
    ang_bench_error(stage->bench, ang_stage_constant(stage, nothing), 0, "of the picture before the background");
    float over[4 * ANG_BENCH_WIDTH * ANG_BENCH_HEIGHT];
    ang_image_over(&stage->image, background, over);
    int wrong = 0;
    for (int i = 0; i < 4 * ang_stage_pixels(stage); i++) wrong += over[i] != (float)background[i % 4];
    ang_bench_error(stage->bench, wrong, 0, "values that differ from the background");
    if (method->takes & ANG_TAKES_NO_SKIP) {
        ang_bench_error(stage->bench, (double)stage->stats.samples, 0, "samples taken of nothing");
        ang_bench_error(stage->bench, (double)stage->stats.fragments, 0, "fragments drawn of nothing");
    }
    return true;
}

bool ang_case_transparent(ang_bench *bench, ang_error *err) {
    ang_stage stage;
    bool done = ang_stage_open(&stage, bench, ang_bench_sheared(err), err) && transparent(&stage, err);
    ang_stage_close(&stage);
    return done;
}

/* A picture of nothing would pass any comparison. */
static void check_seen(ang_bench *bench, const ang_image *image) {
    float most = 0;
    for (int i = 3; i < 4 * image->width * image->height; i += 4) most = fmaxf(most, image->rgba[i]);
    ang_bench_error(bench, !(most > 0.1F), 0, "nothing is seen");
}

static bool compare_bricks(ang_stage *stage, const ang_image *whole, ang_error *err) {
    /* The last: leaves of mixed size. */
    static const int bricks[][3] = {{1, 1, 1}, {2, 2, 1}, {3, 5, 2}, {8, 7, 6}, {64, 64, 64}, {0, 0, 0}};
    double change;
    check_seen(stage->bench, whole);
    for (size_t b = 0; b < sizeof bricks / sizeof *bricks; b++) {
        memcpy(stage->options.bricks, bricks[b], sizeof stage->options.bricks);
        stage->options.no_skip = false;
        if (!ang_stage_change(stage, whole, &change, err)) return false;
        if (bricks[b][0])
            ang_bench_error(stage->bench, change, 1e-6, "change by %d x %d x %d bricks", bricks[b][0], bricks[b][1],
                            bricks[b][2]);
        else
            ang_bench_error(stage->bench, change, 1e-6, "change by leaves of mixed size");
    }
    for (int proxy = 0; ang_proxy_name((ang_proxy)proxy) && stage->bench->method->takes & ANG_TAKES_PROXY; proxy++) {
        stage->options.proxy = (ang_proxy)proxy;
        memcpy(stage->options.bricks, bricks[2], sizeof stage->options.bricks);
        if (!ang_stage_change(stage, whole, &change, err)) return false;
        ang_bench_error(stage->bench, change, 1e-6, "change by proxy %s", ang_proxy_name((ang_proxy)proxy));
    }
    return true;
}

/* Structures in one corner of 64^3 cells, so that few of as many bricks are drawn. */
static double sparse_corner(int x, int y, int z) {
    return x > 34 && y < 33 && z > 40 ? ang_field_sparse(x, y, z) : -50;
}

bool ang_case_bricks(ang_bench *bench, ang_error *err) {
    ang_stage stage;
    ang_image whole = {0};
    bool done = ang_stage_open(&stage, bench, ang_bench_volume(65, 65, 65, ang_bench_unit, sparse_corner, err), err) &&
                ang_stage_vessels(&stage, err);
    if (done) {
        ang_stage_look(&stage, "33,21,10", ANG_PERSPECTIVE);
        memcpy(stage.options.bricks, (const int[3]){1, 1, 1}, sizeof stage.options.bricks);
        stage.options.no_skip = true;
        done = ang_stage_keep(&stage, &whole, err) && compare_bricks(&stage, &whole, err);
    }
    ang_image_clear(&whole);
    ang_stage_close(&stage);
    return done;
}

/* Voxels at the corners where blocks of 2, 4, 8 and 16 cells meet, in the volume's corners and beside its faces. */
static double bright_voxels(int x, int y, int z) {
    bool corner = (x == 8 && y == 8 && z == 8) || (x == 16 && y == 16 && z == 16) || (x == 4 && y == 16 && z == 8) ||
                  (x == 20 && y == 7 && z == 15) || x + y + z == 0 || x + y + z == 72 || (x == 24 && y == 12 && z == 4);
    return corner ? 1000 : 0;
}

static bool compare_skipping(ang_stage *stage, ang_error *err) {
    static const ang_transfer_point points[] = {{.hu = 0, .colour = {1, 1, 1}, .opacity = 0},
                                                {.hu = 1000, .colour = {0.5, 0.75, 1}, .opacity = 0.9}};
    if (!ang_stage_points(stage, points, 2, false, err)) return false;
    stage->scene.width = 48;
    stage->scene.height = 48;
    for (int v = 0; v < 3; v++) {
        ang_stage_look(stage,
                       v == 0   ? "33,21"
                       : v == 1 ? "anterior"
                                : "-130,-48,7",
                       v == 1 ? ANG_PARALLEL : ANG_PERSPECTIVE);
        ang_image brute = {0};
        double change = 0;
        stage->options.no_skip = true;
        bool done = ang_stage_keep(stage, &brute, err);
        stage->options.no_skip = false;
        done = done && ang_stage_change(stage, &brute, &change, err);
        if (done) check_seen(stage->bench, &brute);
        ang_image_clear(&brute);
        if (!done) return false;
        ang_bench_error(stage->bench, change, 0, "change by skipping, view %d", v);
    }
    return true;
}

bool ang_case_bright_voxels(ang_bench *bench, ang_error *err) {
    ang_stage stage;
    bool done = ang_stage_open(&stage, bench, ang_bench_volume(25, 25, 25, ang_bench_unit, bright_voxels, err), err) &&
                compare_skipping(&stage, err);
    ang_stage_close(&stage);
    return done;
}

static bool compare_termination(ang_stage *stage, const ang_image *whole, ang_error *err) {
    static const double thresholds[] = {0.5, 0.95, 0.999};
    for (size_t t = 0; t < sizeof thresholds / sizeof *thresholds; t++) {
        double change;
        stage->options.termination = thresholds[t];
        if (!ang_stage_change(stage, whole, &change, err)) return false;
        ang_bench_error(stage->bench, change, 1 - thresholds[t], "change by ending rays at opacity %g", thresholds[t]);
    }
    return true;
}

bool ang_case_termination(ang_bench *bench, ang_error *err) {
    ang_stage stage;
    ang_image whole = {0};
    bool done = ang_stage_open(&stage, bench, ang_bench_volume(16, 20, 12, ang_bench_unit, ang_field_flat, err), err) &&
                ang_stage_medium(&stage, 2, err);
    if (done) {
        ang_stage_look(&stage, "33,21", ANG_PERSPECTIVE);
        stage.options.step_voxels = 0.1;
        done = ang_stage_keep(&stage, &whole, err) && compare_termination(&stage, &whole, err);
    }
    ang_image_clear(&whole);
    ang_stage_close(&stage);
    return done;
}
