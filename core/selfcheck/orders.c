/* Refinement of grid, pixels and step, each alone [Etiene et al. 2013, 2014]. */
#include "core/selfcheck/cases.h"

#include "core/cpu/reference.h"
#include "core/error/metrics.h"
#include "core/volume/phantom.h"

/* A smooth field over a square of `extent` mm, the same at every height. */
static const double extent = 32;
static double smooth_field(double x, double y) {
    return 30000 + 25000 * sin(2 * M_PI * 1.25 * x / extent + 0.3) * cos(2 * M_PI * y / extent);
}

/* Linear from 0 to 60000 HU, so that nothing but the field bends. */
static const ang_transfer_point linear_points[] = {{.hu = 0, .colour = {0, 1, 0.2}, .opacity = 0},
                                                   {.hu = 60000, .colour = {1, 0.2, 0.6}, .opacity = 0.12}};

static ang_volume *sampled_field(int n, ang_error *err) {
    ang_volume *volume = ang_volume_create((const int[3]){n, n, 2}, err);
    if (!volume) return NULL;
    double spacing = extent / (n - 1);
    for (int axis = 0; axis < 3; axis++) volume->affine.m[axis][axis] = axis < 2 ? spacing : extent;
    for (int z = 0, i = 0; z < 2; z++)
        for (int y = 0; y < n; y++)
            for (int x = 0; x < n; x++) volume->data[i++] = (uint16_t)lround(smooth_field(x * spacing, y * spacing));
    ang_volume_update_range(volume, 1);
    return volume;
}

/* The analytic field along a pixel's ray, by a march in double so fine that its error is below 1e-7. */
static void integrate_field(const ang_stage *stage, int pixel, double rgba[4]) {
    enum { steps = 4096 };
    for (int c = 0; c < 4; c++) rgba[c] = 0;
    ang_ray_frame frame;
    if (!ang_ray_frame_make(stage->volume, &stage->scene, &frame, NULL)) return;
    ang_ray ray = ang_ray_through(&frame, pixel % stage->scene.width + 0.5, pixel / stage->scene.width + 0.5);
    double h = fmax(ray.leave - ray.enter, 0) / steps;
    for (int i = 0; i < steps; i++) {
        ang_vec3 at = ang_vec3_add(frame.centre, ang_vec3_along(ray.origin, ray.direction, ray.enter + (i + 0.5) * h));
        ang_vec3 mm = ang_mat4_point(&stage->volume->affine, at);
        double hu = smooth_field(mm.x, mm.y), colour[3];
        double opacity = -expm1(-h * ang_transfer_extinction(stage->transfer, hu)) * (1 - rgba[3]);
        ang_transfer_colour(stage->transfer, hu, colour);
        for (int c = 0; c < 3; c++) rgba[c] += opacity * colour[c];
        rgba[3] += opacity;
    }
}

static bool grid_error(ang_bench *bench, int n, double *rms, ang_error *err) {
    ang_stage stage;
    bool done = ang_stage_open(&stage, bench, sampled_field(n, err), err) &&
                ang_stage_points(&stage, linear_points, 2, true, err);
    if (done) {
        ang_stage_look(&stage, "30,0", ANG_PARALLEL);
        stage.scene.width = 24;
        stage.scene.height = 2;
        stage.scene.camera.half_height = 1.5;
        /* A quarter of the finest voxel on every grid, so that the grid alone is refined. */
        stage.options.step_voxels = 0.25 * (n - 1) / 255;
        done = ang_stage_draw(&stage, err);
    }
    double sum = 0;
    for (int i = 0; done && i < ang_stage_pixels(&stage); i++) {
        double expected[4];
        integrate_field(&stage, i, expected);
        for (int c = 0; c < 4; c++) sum += pow((double)stage.image.rgba[4 * i + c] - expected[c], 2);
    }
    if (done) *rms = sqrt(sum / (4 * ang_stage_pixels(&stage)));
    ang_stage_close(&stage);
    return done;
}

bool ang_case_grid_order(ang_bench *bench, ang_error *err) {
    static const int grids[] = {32, 64, 128, 256};
    enum { count = sizeof grids / sizeof *grids };
    double error[count];
    for (int g = 0; g < count; g++)
        if (!grid_error(bench, grids[g], &error[g], err)) return false;
    double order = log(error[0] / error[count - 1]) / log((grids[count - 1] - 1.) / (grids[0] - 1));
    ang_bench_range(bench, order, 2 - 0.15, 2 + 0.15, "order in the grid: error %.2g at 32, %.2g at 256 voxels",
                    error[0], error[count - 1]);
    return true;
}

static double smooth(int x, int y, int z) {
    return 300 + 100 * sin(0.2 * x + 0.3) * cos(0.17 * y) + 80 * sin(0.23 * z);
}

enum { points = 400 };

/* Places of the picture (shares of its sides) and the truth there. */
typedef struct probes {
    double x[points], y[points], rgba[points][4];
} probes;

static bool make_probes(ang_stage *stage, probes *at, ang_error *err) {
    ang_reference *reference = ang_reference_create(stage->volume, &stage->scene, err);
    if (!reference) return false;
    for (int i = 0; i < points; i++) {
        /* Evenly spread, never in step with pixels: additive recurrence of the plastic number. */
        at->x[i] = 0.125 + 0.75 * fmod(0.5 + 0.7548776662466927 * i, 1);
        at->y[i] = 0.125 + 0.75 * fmod(0.5 + 0.5698402909980532 * i, 1);
        ang_reference_pixel(reference, at->x[i] * stage->scene.width, at->y[i] * stage->scene.height, at->rgba[i],
                            NULL);
    }
    ang_reference_free(reference);
    return true;
}

static double channel(const ang_image *image, int x, int y, int c) {
    return (double)image->rgba[4 * (x + image->width * y) + c];
}

/* RMS errors of the picture at the probes, read from the nearest pixel and between four. */
static void probe_errors(const ang_image *image, const probes *at, double *nearest, double *bilinear) {
    double sums[2] = {0};
    for (int i = 0; i < points; i++) {
        double x = at->x[i] * image->width, y = at->y[i] * image->height;
        int left = (int)floor(x - 0.5), top = (int)floor(y - 0.5);
        double u = x - 0.5 - left, v = y - 0.5 - top;
        for (int c = 0; c < 4; c++) {
            double upper = (1 - u) * channel(image, left, top, c) + u * channel(image, left + 1, top, c);
            double lower = (1 - u) * channel(image, left, top + 1, c) + u * channel(image, left + 1, top + 1, c);
            sums[0] += pow(channel(image, (int)x, (int)y, c) - at->rgba[i][c], 2);
            sums[1] += pow((1 - v) * upper + v * lower - at->rgba[i][c], 2);
        }
    }
    *nearest = sqrt(sums[0] / (4 * points));
    *bilinear = sqrt(sums[1] / (4 * points));
}

static bool refine_pixels(ang_stage *stage, ang_error *err) {
    static const int sides[] = {8, 16, 32, 64};
    enum { count = sizeof sides / sizeof *sides };
    static const ang_transfer_point linear[] = {{.hu = 100, .colour = {0, 1, 0.2}, .opacity = 0},
                                                {.hu = 500, .colour = {1, 0.2, 0.6}, .opacity = 0.1}};
    if (!ang_stage_points(stage, linear, 2, true, err)) return false;
    ang_stage_look(stage, "21,13", ANG_PARALLEL);
    stage->scene.camera.half_height = 6;
    stage->options.step_voxels = 0.03;
    stage->scene.width = stage->scene.height = sides[0];
    probes at;
    double nearest[count], bilinear[count];
    if (!make_probes(stage, &at, err)) return false;
    for (int s = 0; s < count; s++) {
        stage->scene.width = stage->scene.height = sides[s];
        if (!ang_stage_draw(stage, err)) return false;
        probe_errors(&stage->image, &at, &nearest[s], &bilinear[s]);
    }
    ang_bench_range(stage->bench, log2(nearest[0] / nearest[count - 1]) / (count - 1), 1 - 0.2, 1 + 0.2,
                    "order in the pixels, nearest: error %.2g at 8, %.2g at 64 pixels", nearest[0], nearest[count - 1]);
    ang_bench_range(stage->bench, log2(bilinear[0] / bilinear[count - 1]) / (count - 1), 2 - 0.2, 2 + 0.2,
                    "order in the pixels, bilinear: error %.2g at 8, %.2g at 64 pixels", bilinear[0],
                    bilinear[count - 1]);
    return true;
}

bool ang_case_pixel_order(ang_bench *bench, ang_error *err) {
    ang_stage stage;
    bool done = ang_stage_open(&stage, bench, ang_bench_volume(24, 24, 24, ang_bench_unit, smooth, err), err) &&
                refine_pixels(&stage, err);
    ang_stage_close(&stage);
    return done;
}

/* Levels that the step must have come down to at the finest, and what each halving must divide the error by: kinks of
 * the transfer function take the order from 2 to 1.8 (numerics.md), of which a maximum over few pixels may lose some.
 */
static const double stated_floor = 0.1, stated_ratio = 2;

static bool refine_steps(ang_stage *stage, const ang_image *truth, const char *what, ang_error *err) {
    static const double steps[] = {1, 0.5, 0.25, 0.125, 0.0625};
    double before = 0;
    ang_metrics metrics;
    for (size_t s = 0; s < sizeof steps / sizeof *steps; s++) {
        stage->options.step_voxels = steps[s];
        if (!ang_stage_draw(stage, err) || !ang_metrics_compute(&stage->image, truth, false, &metrics, err))
            return false;
        if (s > 0 && before > stated_floor)
            ang_bench_range(stage->bench, before / metrics.rms, stated_ratio, INFINITY,
                            "%s: RMS error %.3g levels at step %g, %.3g at %g", what, before, steps[s - 1], metrics.rms,
                            steps[s]);
        before = metrics.rms;
    }
    ang_bench_error(stage->bench, before, stated_floor, "%s: RMS error in levels at step 1/16", what);
    return true;
}

static bool draw_phantom(ang_stage *stage, ang_error *err) {
    static const char *const names[] = {"unshaded", "Phong"};
    const ang_method *truth = &ang_method_reference;
    ang_renderer *renderer = truth->create(NULL, stage->volume, &stage->options, err);
    if (!renderer || !ang_stage_vessels(stage, err)) return false;
    ang_stage_look(stage, "30,35", ANG_PERSPECTIVE);
    bool done = true;
    for (int shading = ANG_SHADING_NONE; shading <= ANG_SHADING_PHONG && done; shading++) {
        ang_image exact = {0};
        stage->scene.shading = (ang_shading)shading;
        done = ang_image_create(&exact, stage->scene.width, stage->scene.height, err) &&
               truth->render(renderer, &stage->scene, &stage->options, &exact, NULL, stage->bench->progress, err) &&
               refine_steps(stage, &exact, names[shading], err);
        ang_image_clear(&exact);
    }
    truth->destroy(renderer);
    return done;
}

bool ang_case_against_reference(ang_bench *bench, ang_error *err) {
    ang_phantom_params params = ang_phantom_params_default;
    params.dims[0] = params.dims[1] = 48;
    params.dims[2] = 32;
    ang_stage stage;
    bool done = ang_stage_open(&stage, bench, ang_phantom_make(&params, bench->threads, NULL, NULL, err), err) &&
                draw_phantom(&stage, err);
    ang_stage_close(&stage);
    return done;
}
