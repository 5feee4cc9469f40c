#include "core/selfcheck/bench.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>

const double ang_bench_unit[3] = {1, 1, 1};
const double ang_bench_colour[3] = {0.25, 0.5, 1};

bool ang_measure_holds(const ang_measure *measure) {
    return measure->value >= measure->low && measure->value <= measure->high;
}

/* 0 in the middle of what is allowed, 1 at its ends, above beyond. */
static double badness(const ang_measure *m) {
    if (isnan(m->value)) return INFINITY;
    if (m->low == 0) return m->value <= 0 ? 0 : m->value / m->high;
    if (isinf(m->high)) return m->value > 0 ? m->low / m->value : INFINITY;
    double middle = 0.5 * (m->low + m->high);
    return fabs(m->value - middle) / (m->high - middle);
}

void ang_bench_range(ang_bench *bench, double value, double low, double high, const char *format, ...) {
    ang_measure measure = {.value = value, .low = low, .high = high};
    double now = badness(&measure), before = badness(&bench->worst);
    /* Among values that are equally good the last one says most: what every picture is asked comes first. */
    if (bench->worst.what[0] && !(now > before || (now >= before && now <= 1))) return;
    va_list args;
    va_start(args, format);
    vsnprintf(measure.what, sizeof measure.what, format, args);
    va_end(args);
    bench->worst = measure;
}

ang_volume *ang_bench_volume(int nx, int ny, int nz, const double spacing[3], ang_bench_field *hu, ang_error *err) {
    ang_volume *volume = ang_volume_create((const int[3]){nx, ny, nz}, err);
    if (!volume) return NULL;
    volume->intercept = -1024;
    for (int axis = 0; axis < 3; axis++) volume->affine.m[axis][axis] = spacing[axis];
    size_t i = 0;
    for (int z = 0; z < nz; z++)
        for (int y = 0; y < ny; y++)
            for (int x = 0; x < nx; x++) volume->data[i++] = (uint16_t)lround(hu(x, y, z) + 1024);
    ang_volume_update_range(volume, 1);
    return volume;
}

double ang_field_flat(int x, int y, int z) {
    (void)x, (void)y, (void)z;
    return 100;
}

double ang_field_ramp(int x, int y, int z) {
    (void)x, (void)z;
    return 10 * y;
}

double ang_field_sparse(int x, int y, int z) {
    double wave = sin(0.35 * x + 0.5 * sin(0.2 * z)) * cos(0.31 * y) * sin(0.23 * z + 0.4);
    return wave > 0.2 ? 100 + 500 * wave : -50 + 3 * ((x + 2 * y + 3 * z) % 7);
}

ang_volume *ang_bench_sheared(ang_error *err) {
    static const double spacing[3] = {0.8, 0.9, 1.4};
    ang_volume *volume = ang_bench_volume(34, 31, 27, spacing, ang_field_sparse, err);
    if (volume) volume->affine.m[1][2] = 0.5;
    return volume;
}

bool ang_stage_open(ang_stage *stage, ang_bench *bench, ang_volume *volume, ang_error *err) {
    *stage = (ang_stage){.bench = bench, .volume = volume, .options = ang_render_options_default};
    if (!volume) return false;
    stage->options.termination = 1;
    stage->options.threads = bench->threads;
    stage->scene = ang_scene_default(volume);
    stage->scene.width = ANG_BENCH_WIDTH;
    stage->scene.height = ANG_BENCH_HEIGHT;
    ang_stage_look(stage, "anterior", ANG_PARALLEL);
    stage->renderer = bench->method->create(bench->gl, volume, &stage->options, err);
    return stage->renderer != NULL;
}

void ang_stage_close(ang_stage *stage) {
    if (stage->renderer) stage->bench->method->destroy(stage->renderer);
    ang_transfer_free(stage->transfer);
    ang_image_clear(&stage->image);
    ang_volume_free(stage->volume);
    *stage = (ang_stage){0};
}

bool ang_stage_points(ang_stage *stage, const ang_transfer_point *points, size_t count, bool by_extinction,
                      ang_error *err) {
    ang_transfer_free(stage->transfer);
    stage->scene.transfer = stage->transfer = ang_transfer_create(points, count, 1, by_extinction, NULL, err);
    return stage->transfer != NULL;
}

bool ang_stage_medium(ang_stage *stage, double extinction, ang_error *err) {
    const double *c = ang_bench_colour;
    ang_transfer_point point = {.colour = {c[0], c[1], c[2]}, .opacity = extinction};
    return ang_stage_points(stage, &point, 1, true, err);
}

bool ang_stage_vessels(ang_stage *stage, ang_error *err) {
    static const ang_transfer_point points[] = {{.hu = 150, .colour = {0.6, 0.1, 0.05}, .opacity = 0},
                                                {.hu = 300, .colour = {0.9, 0.4, 0.2}, .opacity = 0.15},
                                                {.hu = 600, .colour = {1, 0.95, 0.9}, .opacity = 0.6}};
    return ang_stage_points(stage, points, 3, false, err);
}

void ang_stage_look(ang_stage *stage, const char *name, ang_projection projection) {
    ang_view view = ang_view_default;
    ang_view_parse(name, &view, NULL);
    view.projection = projection;
    stage->scene.camera = ang_camera_for(stage->volume, &view);
}

bool ang_stage_draw(ang_stage *stage, ang_error *err) {
    const ang_bench *bench = stage->bench;
    const ang_scene *scene = &stage->scene;
    ang_image *image = &stage->image;
    if (image->width != scene->width || image->height != scene->height) {
        ang_image_clear(image);
        if (!ang_image_create(image, scene->width, scene->height, err)) return false;
    }
    stage->stats = (ang_frame_stats){0};
    if (!bench->method->render(stage->renderer, scene, &stage->options, image, &stage->stats, bench->progress, err) ||
        (bench->gl && !ang_gl_check(bench->gl, err)))
        return false;
    int bad = 0;
    for (int i = 0; i < 4 * ang_stage_pixels(stage); i++) bad += !(isfinite(image->rgba[i]) && image->rgba[i] >= 0);
    ang_bench_error(stage->bench, bad, 0, "values that are not finite or negative");
    return true;
}

bool ang_stage_keep(ang_stage *stage, ang_image *image, ang_error *err) {
    if (!ang_stage_draw(stage, err)) return false;
    *image = stage->image;
    stage->image = (ang_image){0};
    return true;
}

bool ang_stage_change(ang_stage *stage, const ang_image *image, double *change, ang_error *err) {
    if (!ang_stage_draw(stage, err)) return false;
    *change = ang_image_difference(&stage->image, image);
    return true;
}

double ang_stage_length(const ang_stage *stage, double x, double y) {
    ang_ray_frame frame;
    if (!ang_ray_frame_make(stage->volume, &stage->scene, &frame, NULL)) return NAN;
    ang_ray ray = ang_ray_through(&frame, x, y);
    return fmax(ray.leave - ray.enter, 0);
}

/* The greater one; NaN is greater than any number, so that it is not lost. */
static double worse(double a, double b) { return isnan(a) || a > b ? a : b; }

double ang_stage_homogeneous(const ang_stage *stage) {
    double kappa = ang_transfer_extinction(stage->transfer, 0), greatest = 0;
    for (int i = 0; i < ang_stage_pixels(stage); i++) {
        int width = stage->scene.width;
        double alpha = -expm1(-kappa * ang_stage_length(stage, i % width + 0.5, i / width + 0.5));
        for (int c = 0; c < 4; c++) {
            double expected = c < 3 ? alpha * ang_bench_colour[c] : alpha;
            greatest = worse(fabs((double)stage->image.rgba[4 * i + c] - expected), greatest);
        }
    }
    return greatest;
}

double ang_stage_constant(const ang_stage *stage, const double rgba[4]) {
    double greatest = 0;
    for (int i = 0; i < ang_stage_pixels(stage); i++) {
        int width = stage->scene.width;
        if (!(ang_stage_length(stage, i % width + 0.5, i / width + 0.5) > 0)) continue;
        for (int c = 0; c < 4; c++) greatest = worse(fabs((double)stage->image.rgba[4 * i + c] - rgba[c]), greatest);
    }
    return greatest;
}

double ang_image_difference(const ang_image *a, const ang_image *b) {
    if (a->width != b->width || a->height != b->height) return INFINITY;
    double greatest = 0;
    for (int i = 0; i < 4 * a->width * a->height; i++)
        greatest = worse(fabs((double)a->rgba[i] - (double)b->rgba[i]), greatest);
    return greatest;
}

bool ang_stage_order(ang_stage *stage, const double *steps, int count, ang_stage_error *error, const void *context,
                     double low, double high, double exact, const char *what, ang_error *err) {
    double first = 0, from = 0, last = 0, to = 0;
    for (int i = 0; i < count; i++) {
        stage->options.step_voxels = steps[i];
        if (!ang_stage_draw(stage, err)) return false;
        last = error(stage, context);
        to = stage->stats.step_mm;
        if (i > 0) continue;
        first = last;
        from = to;
        if (!(to > 0) || first <= exact) {
            ang_bench_error(stage->bench, first, exact, "error of %s, exact", what);
            return true;
        }
    }
    ang_bench_range(stage->bench, log(first / last) / log(from / to), low, high,
                    "order of %s: error %.2g at step %g, %.2g at step %g", what, first, steps[0], last,
                    steps[count - 1]);
    return true;
}
