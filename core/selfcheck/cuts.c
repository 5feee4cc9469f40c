/* The oblique clip plane: through corners, along faces, of all and of nothing. */
#include "core/selfcheck/cases.h"

#include <stdio.h>

/* A plane across the diagonal of a box of 16 x 20 x 12 mm: which part of that it leaves. */
static ang_clip_plane across(double nx, double ny, double nz, double part) {
    ang_vec3 normal = ang_vec3_unit((ang_vec3){nx, ny, nz});
    double least = 0, greatest = 0;
    const double size[3] = {16, 20, 12};
    for (int axis = 0; axis < 3; axis++) {
        double along = ang_vec3_at(normal, axis) * size[axis];
        least += fmin(along, 0);
        greatest += fmax(along, 0);
    }
    return (ang_clip_plane){normal, least + part * (greatest - least)};
}

static bool cut_anywhere(ang_stage *stage, ang_error *err) {
    static const char *const views[] = {"30,20", "-140,-35,10", "anterior"};
    static const double steps[] = {0.5, 1.3, 100};
    /* Through the middle; through three corners; along a face; oblique, little left and little gone. */
    const ang_clip_plane planes[] = {across(1, 1, 1, 0.5), across(1 / 16., 1 / 20., 1 / 12., 1 / 3.),
                                     across(0, -1, 0, 0.4), across(3, -1, 2, 0.1), across(-1, 2, 5, 0.95)};
    if (!ang_stage_medium(stage, 0.05, err)) return false;
    for (size_t v = 0; v < sizeof views / sizeof *views; v++)
        for (size_t p = 0; p < sizeof planes / sizeof *planes; p++)
            for (size_t s = 0; s < sizeof steps / sizeof *steps; s++) {
                ang_stage_look(stage, views[v], v == 0 ? ANG_PERSPECTIVE : ANG_PARALLEL);
                stage->scene.clip_plane = planes[p];
                stage->options.step_voxels = steps[s];
                if (!ang_stage_draw(stage, err)) return false;
                ang_bench_error(stage->bench, ang_stage_homogeneous(stage), 2e-6,
                                "error at plane %zu, view %s, step %g voxels", p, views[v], steps[s]);
            }
    return true;
}

/* Along the box's six faces, and oblique: all of the box lies before the plane, then beyond it. */
static bool cut_all_or_nothing(ang_stage *stage, const ang_image *whole, ang_error *err) {
    double change;
    for (int n = 0; n < 7; n++) {
        double sign = n % 2 ? -1 : 1;
        double x = n / 2 == 0 ? sign : 0, y = n / 2 == 1 ? sign : 0, z = n / 2 == 2 ? sign : 0;
        stage->scene.clip_plane = n == 6 ? across(1, -2, 3, 1) : across(x, y, z, 1);
        if (!ang_stage_change(stage, whole, &change, err)) return false;
        ang_bench_error(stage->bench, change, 0, "change by plane %d, which cuts nothing", n);
        stage->scene.clip_plane = n == 6 ? across(1, -2, 3, 0) : across(x, y, z, 0);
        if (!ang_stage_draw(stage, err)) return false;
        float most = 0;
        for (int i = 0; i < 4 * ang_stage_pixels(stage); i++) most = fmaxf(most, fabsf(stage->image.rgba[i]));
        ang_bench_error(stage->bench, (double)most, 0, "what is left by plane %d, which cuts all", n);
    }
    return true;
}

bool ang_case_clip_plane(ang_bench *bench, ang_error *err) {
    ang_stage stage;
    ang_image whole = {0};
    bool done = ang_stage_open(&stage, bench, ang_bench_volume(17, 21, 13, ang_bench_unit, ang_field_flat, err), err) &&
                cut_anywhere(&stage, err);
    if (done) {
        stage.scene.clip_plane = (ang_clip_plane){{0}, 0};
        ang_stage_look(&stage, "30,20", ANG_PERSPECTIVE);
        done = ang_stage_keep(&stage, &whole, err) && cut_all_or_nothing(&stage, &whole, err);
    }
    ang_image_clear(&whole);
    ang_stage_close(&stage);
    return done;
}
