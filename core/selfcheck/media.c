/* Homogeneous media: 1 - exp(-kappa L) at every step, extinction and thickness. */
#include "core/selfcheck/cases.h"

/* float32 leaves 1e-6; the first and last slab of slices are clipped, which adds a rounding (numerics.md, case 1). */
static double homogeneous_tolerance(const ang_method *method) { return method->takes & ANG_TAKES_PROXY ? 2e-6 : 1e-6; }

static bool any_step(ang_stage *stage, ang_error *err) {
    static const struct {
        const char *name;
        ang_projection projection;
    } views[] = {{"30,20", ANG_PERSPECTIVE}, {"-140,-35,10", ANG_PARALLEL}, {"anterior", ANG_PARALLEL}};
    static const double steps[] = {0.07, 0.5, 1, 1.3, 100};
    if (!ang_stage_medium(stage, 0.05, err)) return false;
    for (size_t v = 0; v < sizeof views / sizeof *views; v++) {
        ang_stage_look(stage, views[v].name, views[v].projection);
        for (size_t s = 0; s < sizeof steps / sizeof *steps; s++) {
            stage->options.step_voxels = steps[s];
            if (!ang_stage_draw(stage, err)) return false;
            ang_bench_error(stage->bench, ang_stage_homogeneous(stage), homogeneous_tolerance(stage->bench->method),
                            "error at step %g voxels, view %s", steps[s], views[v].name);
        }
    }
    return true;
}

bool ang_case_any_step(ang_bench *bench, ang_error *err) {
    ang_stage stage;
    bool done = ang_stage_open(&stage, bench, ang_bench_volume(16, 20, 12, ang_bench_unit, ang_field_flat, err), err) &&
                any_step(&stage, err);
    ang_stage_close(&stage);
    return done;
}

static bool any_extinction(ang_stage *stage, ang_error *err) {
    for (int power = -6; power <= 6; power++) {
        double kappa = pow(10, power);
        if (!ang_stage_medium(stage, kappa, err)) return false;
        /* So near that every ray crosses two opposite faces: where rays cut an edge, kappa times the rounding of the
         * edge's place is in the expected value itself. */
        ang_stage_look(stage, "12,9", power % 2 ? ANG_PARALLEL : ANG_PERSPECTIVE);
        stage->scene.camera.fov_deg = 12;
        stage->scene.camera.half_height = 4;
        static const double steps[] = {0.5, 1.3};
        for (size_t s = 0; s < sizeof steps / sizeof *steps; s++) {
            stage->options.step_voxels = steps[s];
            if (!ang_stage_draw(stage, err)) return false;
            ang_bench_error(stage->bench, ang_stage_homogeneous(stage), 1e-6,
                            "error at extinction %g/mm, step %g voxels", kappa, steps[s]);
        }
        /* From farther away with edges: numbers only. */
        ang_stage_look(stage, "40,25", ANG_PERSPECTIVE);
        if (!ang_stage_draw(stage, err)) return false;
    }
    return true;
}

bool ang_case_any_extinction(ang_bench *bench, ang_error *err) {
    ang_stage stage;
    bool done = ang_stage_open(&stage, bench, ang_bench_volume(16, 20, 16, ang_bench_unit, ang_field_flat, err), err) &&
                any_extinction(&stage, err);
    ang_stage_close(&stage);
    return done;
}

static bool thin_volume(ang_stage *stage, const int shape[3], ang_error *err) {
    if (!ang_stage_medium(stage, 0.3, err)) return false;
    for (int v = 0; v < 3; v++) {
        ang_stage_look(stage,
                       v == 0   ? "40,25"
                       : v == 1 ? "anterior"
                                : "-70,-50,15",
                       v == 0 ? ANG_PERSPECTIVE : ANG_PARALLEL);
        stage->scene.shading =
            v == 2 ? ANG_SHADING_PHONG : ANG_SHADING_NONE; /* without a gradient it changes nothing */
        if (!ang_stage_draw(stage, err)) return false;
        ang_bench_error(stage->bench, ang_stage_homogeneous(stage), 1e-6, "error of %d x %d x %d voxels, view %d",
                        shape[0], shape[1], shape[2], v);
    }
    return true;
}

bool ang_case_thin_volumes(ang_bench *bench, ang_error *err) {
    static const int shapes[][3] = {{1, 1, 1}, {1, 8, 8}, {8, 1, 8}, {8, 8, 1}};
    bool done = true;
    for (size_t s = 0; s < sizeof shapes / sizeof *shapes && done; s++) {
        const int *n = shapes[s];
        ang_stage stage;
        done = ang_stage_open(&stage, bench, ang_bench_volume(n[0], n[1], n[2], ang_bench_unit, ang_field_flat, err),
                              err) &&
               thin_volume(&stage, n, err);
        ang_stage_close(&stage);
    }
    return done;
}

static bool extreme_steps(ang_stage *stage, ang_error *err) {
    /* 3 mm of medium: one voxel is 1 mm. */
    static const struct { double step, tolerance; } steps[] = {{7, 1e-6}, {3, 1e-6}, {3e-5, 1e-5}};
    if (!ang_stage_medium(stage, 0.4, err)) return false;
    stage->scene.width = stage->scene.height = 4;
    for (size_t s = 0; s < sizeof steps / sizeof *steps; s++) {
        stage->options.step_voxels = steps[s].step;
        if (!ang_stage_draw(stage, err)) return false;
        ang_bench_error(stage->bench, ang_stage_homogeneous(stage), steps[s].tolerance, "error at step %g of 3 mm",
                        steps[s].step);
    }
    return true;
}

bool ang_case_extreme_steps(ang_bench *bench, ang_error *err) {
    ang_stage stage;
    bool done = ang_stage_open(&stage, bench, ang_bench_volume(4, 4, 4, ang_bench_unit, ang_field_flat, err), err) &&
                extreme_steps(&stage, err);
    ang_stage_close(&stage);
    return done;
}
