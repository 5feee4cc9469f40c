/* From values to colours: transfer functions that bend, step and peak, and all stored values. */
#include "core/selfcheck/cases.h"

#include <stdio.h>
#include <string.h>

/* All rays run from front to back through the ramp, 10 HU/mm along y. */
static bool open_ramp(ang_stage *stage, ang_bench *bench, ang_bench_field *field, ang_error *err) {
    if (!ang_stage_open(stage, bench, ang_bench_volume(9, 33, 9, ang_bench_unit, field, err), err)) return false;
    stage->scene.width = stage->scene.height = 8;
    stage->scene.camera.half_height = 3;
    return true;
}

/* Draws the ramp with each classification that the method has; the words are for what is measured. */
typedef bool draw_ramp(ang_stage *stage, const char *words, ang_error *err);

static bool try_ramp(ang_bench *bench, ang_bench_field *field, draw_ramp *draw, ang_error *err) {
    static const struct {
        ang_classify classification;
        const char *words;
    } ways[] = {{ANG_CLASSIFY_AUTO, ""}, {ANG_CLASSIFY_MIDPOINT, ", mid-point"}, {ANG_CLASSIFY_PREFIX, ", prefix"}};
    size_t count = bench->method->takes & ANG_TAKES_CLASSIFICATION ? sizeof ways / sizeof *ways : 1;
    ang_stage stage;
    bool done = open_ramp(&stage, bench, field, err);
    for (size_t w = 0; w < count && done; w++) {
        stage.options = (ang_render_options){
            .step_voxels = 0.5, .termination = 1, .threads = bench->threads, .classification = ways[w].classification};
        done = draw(&stage, ways[w].words, err);
    }
    ang_stage_close(&stage);
    return done;
}

static bool is_prefix(const ang_stage *stage) { return stage->options.classification == ANG_CLASSIFY_PREFIX; }

static const double ramp_steps[] = {2, 1, 0.5, 0.25};
enum { ramp_step_count = sizeof ramp_steps / sizeof *ramp_steps };

static double constant_error(const ang_stage *stage, const void *rgba) { return ang_stage_constant(stage, rgba); }

/* kappa = a s and c = s / L at depth s: C = int c kappa exp(-a s^2 / 2) ds by parts. */
static bool draw_linear(ang_stage *stage, const char *words, ang_error *err) {
    const double a = 0.004, length = 32;
    const ang_transfer_point points[] = {{.hu = 0, .colour = {0, 0, 0}, .opacity = 0},
                                         {.hu = 10 * length, .colour = {1, 1, 1}, .opacity = a * length}};
    double passed = exp(-a * length * length / 2);
    double colour = sqrt(M_PI / (2 * a)) * erf(length * sqrt(a / 2)) / length - passed;
    const double expected[4] = {colour, colour, colour, 1 - passed};
    char what[64];
    snprintf(what, sizeof what, "a linear ramp%s", words);
    return ang_stage_points(stage, points, 2, true, err) &&
           ang_stage_order(stage, ramp_steps, ramp_step_count, constant_error, expected, 1.9, 2.1, 1e-6, what, err);
}

bool ang_case_ramp(ang_bench *bench, ang_error *err) { return try_ramp(bench, ang_field_ramp, draw_linear, err); }

static double ramp_15(int x, int y, int z) {
    (void)x, (void)z;
    return 15 * y;
}

/* Two slabs that meet at a third of the way, which no step that halves ever falls on. */
static bool draw_slabs(ang_stage *stage, const double back_colour[3], double expected[4], ang_error *err) {
    const double k[2] = {0.05, 0.2}, depth = 32 / 3., length = 32, *c = ang_bench_colour, *d = back_colour;
    const ang_transfer_point points[] = {{.hu = 160, .colour = {c[0], c[1], c[2]}, .opacity = k[0]},
                                         {.hu = 160, .colour = {d[0], d[1], d[2]}, .opacity = k[1]}};
    double front = -expm1(-k[0] * depth), back = -expm1(-k[1] * (length - depth)) * (1 - front);
    for (int i = 0; i < 3; i++) expected[i] = front * c[i] + back * d[i];
    expected[3] = front + back;
    return ang_stage_points(stage, points, 2, true, err);
}

static bool draw_step(ang_stage *stage, const char *words, ang_error *err) {
    double expected[4];
    char what[64];
    snprintf(what, sizeof what, "a step in the transfer function%s", words);
    if (!draw_slabs(stage, (const double[3]){1, 0.25, 0}, expected, err) ||
        !ang_stage_order(stage, ramp_steps, ramp_step_count, constant_error, expected, 0.9, INFINITY, 1e-5, what, err))
        return false;
    /* Within a step the prefixes of two colours do not say which comes first; those of one colour are exact. */
    if (!is_prefix(stage)) return true;
    if (!draw_slabs(stage, ang_bench_colour, expected, err)) return false;
    for (int s = 0; s < ramp_step_count; s++) {
        stage->options.step_voxels = ramp_steps[s];
        if (!ang_stage_draw(stage, err)) return false;
        ang_bench_error(stage->bench, ang_stage_constant(stage, expected), 1e-5, "error of %s, step %g voxels", what,
                        ramp_steps[s]);
    }
    return true;
}

bool ang_case_step_transfer(ang_bench *bench, ang_error *err) { return try_ramp(bench, ramp_15, draw_step, err); }

static double ramp_all(int x, int y, int z) {
    (void)x, (void)z;
    return round(65535 / 32. * y) - 1024;
}

/* A triangle two stored values wide, of area 1 per mm * HU: the ramp crosses it once, between voxels. */
static bool draw_spike(ang_stage *stage, const char *words, ang_error *err) {
    const double hu = 20000, per_mm = ramp_all(0, 11, 0) - ramp_all(0, 10, 0), area = per_mm;
    const ang_transfer_point points[] = {{.hu = hu - 1, .colour = {1, 1, 1}, .opacity = 0},
                                         {.hu = hu, .colour = {1, 1, 1}, .opacity = area},
                                         {.hu = hu + 1, .colour = {1, 1, 1}, .opacity = 0}};
    if (!ang_stage_points(stage, points, 3, true, err) || !ang_stage_draw(stage, err)) return false;
    double alpha = -expm1(-area / per_mm);
    const double expected[4] = {alpha, alpha, alpha, alpha};
    double error = ang_stage_constant(stage, expected);
    bool warned = stage->stats.note && strstr(stage->stats.note, "missed");
    if (error > 1e-4 && warned && !is_prefix(stage))
        ang_bench_error(stage->bench, 0, 1e-4, "a spike missed by %.2g, but it is said%s", error, words);
    else
        ang_bench_error(stage->bench, error, 1e-4, "error of a spike of 1 in 65536 values%s", words);
    return true;
}

bool ang_case_spike(ang_bench *bench, ang_error *err) { return try_ramp(bench, ramp_all, draw_spike, err); }

/* Air, then a slab at 100 HU, then one at 200 HU behind it. */
static double slabs(int x, int y, int z) {
    (void)x, (void)z;
    return y < 12 ? 0 : y < 20 ? 100 : 200;
}

static bool draw_opaque(ang_stage *stage, const char *words, ang_error *err) {
    /* Opaque at 100 HU and at 200 HU, nothing between: interpolation from 0 to 100 HU must not reach the first early.
     */
    static const ang_transfer_point points[] = {
        {.hu = 100, .colour = {0.25, 0.5, 0.75}, .opacity = 0}, {.hu = 100, .colour = {0.25, 0.5, 0.75}, .opacity = 1},
        {.hu = 101, .colour = {0.25, 0.5, 0.75}, .opacity = 1}, {.hu = 101, .colour = {0.25, 0.5, 0.75}, .opacity = 0},
        {.hu = 200, .colour = {1, 0, 0}, .opacity = 0},         {.hu = 200, .colour = {1, 0, 0}, .opacity = 1}};
    static const double expected[4] = {0.25, 0.5, 0.75, 1}, steps[] = {0.01, 0.5, 3};
    if (!ang_stage_points(stage, points, 6, false, err)) return false;
    for (size_t s = 0; s < sizeof steps / sizeof *steps; s++) {
        stage->options.step_voxels = steps[s];
        if (!ang_stage_draw(stage, err)) return false;
        ang_bench_error(stage->bench, ang_stage_constant(stage, expected), 0,
                        "error of the first hit, step %g voxels%s", steps[s], words);
    }
    return true;
}

bool ang_case_opaque(ang_bench *bench, ang_error *err) { return try_ramp(bench, slabs, draw_opaque, err); }

enum { side = 256 };

/* Every stored value once, within a margin that repeats its border. */
static double every_value(int x, int y, int z) {
    (void)y;
    int column = x < 1 ? 0 : x > side ? side - 1 : x - 1, row = z < 1 ? 0 : z > side ? side - 1 : z - 1;
    return column + side * row - 1024;
}

static bool read_back(ang_stage *stage, ang_error *err) {
    ang_scene *scene = &stage->scene;
    scene->width = scene->height = side;
    scene->camera.half_height = side / 2.; /* pixels of 1 mm through the voxels */
    scene->mode = ANG_MODE_MIP;
    scene->window_centre = 65535 / 2. - 1024;
    scene->window_width = 65535;
    if (!ang_stage_draw(stage, err)) return false;
    int wrong = 0;
    for (int j = 0; j < side; j++)
        for (int i = 0; i < side; i++) {
            double grey = (double)stage->image.rgba[4 * (i + side * j)];
            /* Superior, the greatest z, is the top row; the patient's right, the least x, is on the left. */
            wrong += round(65535 * grey) != every_value(i + 1, 0, side - j) + 1024;
        }
    ang_bench_error(stage->bench, wrong, 0, "of 65536 values not read back");
    return true;
}

bool ang_case_all_values(ang_bench *bench, ang_error *err) {
    ang_stage stage;
    bool done =
        ang_stage_open(&stage, bench, ang_bench_volume(side + 2, 2, side + 2, ang_bench_unit, every_value, err), err) &&
        read_back(&stage, err);
    ang_stage_close(&stage);
    return done;
}

static const ang_transfer_point bad_points[][4] = {
    {{.hu = 0}, {.hu = NAN, .opacity = 1}},
    {{.hu = 0}, {.hu = 100, .opacity = NAN}},
    {{.hu = 0, .colour = {NAN, 0, 0}}, {.hu = 100, .opacity = 1}},
    {{.hu = 0}, {.hu = INFINITY, .opacity = 1}},
    {{.hu = 0}, {.hu = 100, .opacity = INFINITY}},
    {{.hu = 0}, {.hu = 100, .opacity = -0.1}},
    {{.hu = 0}, {.hu = 100, .colour = {-1, 0, 0}}},
    {{.hu = 0}, {.hu = 100, .opacity = 1.5}},
};

/* Points in no order, or three at one HU: the function of the sorted ones, and a warning. */
static void check_sorted(ang_bench *bench, const ang_transfer_point *points, size_t count, double left, double right,
                         const char *what) {
    ang_notes warnings = {0};
    ang_transfer *transfer = ang_transfer_create(points, count, 1, false, &warnings, NULL);
    bool right_values = transfer && fabs(ang_transfer_opacity(transfer, 50) - left) <= 0 &&
                        fabs(ang_transfer_opacity(transfer, 100) - right) <= 0;
    ang_bench_error(bench, !right_values, 0, "%s: sorted wrongly", what);
    ang_bench_error(bench, warnings.count == 0, 0, "%s: no warning", what);
    ang_transfer_free(transfer);
    ang_notes_clear(&warnings);
}

bool ang_case_bad_points(ang_bench *bench, ang_error *err) {
    (void)err;
    for (size_t i = 0; i < sizeof bad_points / sizeof *bad_points; i++) {
        ang_error refusal = {0};
        ang_transfer *transfer = ang_transfer_create(bad_points[i], 2, 1, false, NULL, &refusal);
        ang_bench_error(bench, transfer != NULL, 0, "bad points %zu: accepted", i);
        ang_bench_error(bench, refusal.code != ANG_USAGE || !strstr(refusal.message, "point"), 0,
                        "bad points %zu: refused without naming the point", i);
        ang_transfer_free(transfer);
    }
    const ang_transfer_point unordered[] = {{.hu = 100, .opacity = 0.5}, {.hu = 0, .opacity = 0.25}},
                             three[] = {{.hu = 0, .opacity = 0.25},
                                        {.hu = 100, .opacity = 0.75},
                                        {.hu = 100, .opacity = 0.125},
                                        {.hu = 100, .opacity = 0.5}};
    check_sorted(bench, unordered, 2, 0.375, 0.5, "unordered points");
    check_sorted(bench, three, 4, 0.5, 0.5, "three points at one HU");
    return true;
}
