/* Gradients, padding and a sphere. */
#include "core/selfcheck/cases.h"

#include <stdlib.h>
#include <string.h>

/* A constant gradient: Phong's closed form, the same in every sample. */
static void check_phong(ang_stage *stage, ang_vec3 gradient, double kappa, const char *what) {
    const ang_scene *scene = &stage->scene;
    double squared = ang_vec3_dot(gradient, gradient), greatest = 0;
    double facing = fabs(ang_vec3_dot(gradient, scene->camera.forward)) / sqrt(squared),
           weight = squared / (squared + 1);
    for (int i = 0; i < ang_stage_pixels(stage); i++) {
        double alpha = -expm1(-kappa * ang_stage_length(stage, i % scene->width + 0.5, i / scene->width + 0.5));
        for (int c = 0; c < 3; c++) {
            double colour = ang_bench_colour[c];
            double shaded = colour * (0.3 + 0.6 * facing) + 0.3 * pow(facing, 20);
            double expected = alpha * (colour + weight * (shaded - colour));
            greatest = fmax(greatest, fabs((double)stage->image.rgba[4 * i + c] - expected));
        }
    }
    ang_bench_error(stage->bench, greatest, 1e-4, "error of Phong's shading, %s", what);
}

static bool draw_phong(ang_stage *stage, ang_error *err) {
    static const char *const views[] = {"30,20", "-100,50"};
    const double kappa = 0.2;
    ang_mat4 to_index;
    if (!ang_mat4_inverse(&stage->volume->affine, &to_index)) return true;
    ang_vec3 gradient = ang_mat4_transposed_direction(&to_index, (ang_vec3){0, 10, 0});
    if (!ang_stage_medium(stage, kappa, err)) return false;
    ang_scene *scene = &stage->scene;
    scene->shading = ANG_SHADING_PHONG;
    scene->clip_lower = (ang_vec3){2, 2, 2}; /* at the faces differences are clamped */
    scene->clip_upper = (ang_vec3){13, 13, 13};
    bool both = stage->bench->method->takes & ANG_TAKES_GRADIENTS;
    for (size_t v = 0; v < sizeof views / sizeof *views; v++) {
        ang_stage_look(stage, views[v], ANG_PARALLEL);
        for (int kind = both ? ANG_GRADIENTS_LOOKUPS : ANG_GRADIENTS_AUTO; kind <= ANG_GRADIENTS_TEXTURE; kind++) {
            if (!both && kind > 0) break;
            stage->options.gradients = (ang_gradients)kind;
            if (!ang_stage_draw(stage, err)) return false;
            check_phong(stage, gradient, kappa, kind == ANG_GRADIENTS_TEXTURE ? "from a texture" : views[v]);
        }
    }
    return true;
}

bool ang_case_phong(ang_bench *bench, ang_error *err) {
    static const double spacing[3] = {0.5, 0.8, 2};
    ang_stage stage;
    ang_volume *volume = ang_bench_volume(16, 16, 16, spacing, ang_field_ramp, err);
    if (volume) volume->affine.m[1][2] = 0.9;
    bool done = ang_stage_open(&stage, bench, volume, err) && draw_phong(&stage, err);
    ang_stage_close(&stage);
    return done;
}

static bool draw_flat(ang_stage *stage, ang_error *err) {
    ang_image plain = {0};
    double change = 0;
    if (!ang_stage_medium(stage, 0.2, err)) return false;
    ang_stage_look(stage, "30,20", ANG_PERSPECTIVE);
    bool done = ang_stage_keep(stage, &plain, err);
    stage->scene.shading = ANG_SHADING_PHONG;
    done = done && ang_stage_change(stage, &plain, &change, err);
    ang_image_clear(&plain);
    /* No NaN, and no light but for the rounding of sums in another order. */
    if (done) ang_bench_error(stage->bench, change, 1e-6, "change of a flat region by shading");
    return done;
}

/* Tissue of 60 HU in a ball, and around it what is air in one volume and padding in the other. */
static double tissue_in_air(int x, int y, int z) {
    double r = sqrt((x - 9.3) * (x - 9.3) + (y - 8.1) * (y - 8.1) + (z - 7.7) * (z - 7.7));
    return r < 6.5 ? 60 + x : -1000;
}

static bool draw_padded(ang_bench *bench, bool padded, ang_image *image, ang_error *err) {
    static const ang_transfer_point points[] = {{.hu = -1000, .colour = {0, 0, 0.2}, .opacity = 0},
                                                {.hu = -500, .colour = {0.2, 0.4, 0.6}, .opacity = 0.1},
                                                {.hu = 80, .colour = {0.9, 0.6, 0.5}, .opacity = 0.4}};
    ang_volume *volume = ang_bench_volume(20, 18, 16, ang_bench_unit, tissue_in_air, err);
    if (volume && padded) {
        const uint16_t declared = 65535;
        for (size_t i = 0; i < ang_volume_count(volume); i++)
            if (volume->data[i] == 24) volume->data[i] = declared; /* -1000 HU */
        if (!ang_volume_mark_padding(volume, declared, err)) {
            ang_volume_free(volume);
            return false;
        }
        ang_volume_update_range(volume, 1);
    }
    ang_stage stage;
    bool done = ang_stage_open(&stage, bench, volume, err) && ang_stage_points(&stage, points, 3, false, err);
    if (done) {
        ang_stage_look(&stage, "-25,35", ANG_PERSPECTIVE);
        stage.scene.shading = ANG_SHADING_PHONG;
        done = ang_stage_keep(&stage, image, err);
    }
    ang_stage_close(&stage);
    return done;
}

bool ang_case_flat_and_padding(ang_bench *bench, ang_error *err) {
    ang_stage stage;
    bool done = ang_stage_open(&stage, bench, ang_bench_volume(12, 14, 10, ang_bench_unit, ang_field_flat, err), err) &&
                draw_flat(&stage, err);
    ang_stage_close(&stage);
    if (!done) return false;
    ang_image air = {0}, padding = {0};
    done = draw_padded(bench, false, &air, err) && draw_padded(bench, true, &padding, err);
    if (done) ang_bench_error(bench, ang_image_difference(&air, &padding), 0, "difference of padding to air");
    ang_image_clear(&air);
    ang_image_clear(&padding);
    return done;
}

enum { ball_side = 32 };
static const double ball_radius = 10.3, ball_centre = (ball_side - 1) / 2.;

static double distance_from_centre(int x, int y, int z) {
    double a = x - ball_centre, b = y - ball_centre, c = z - ball_centre;
    return sqrt(a * a + b * b + c * c);
}

/* Falls by 1000 HU a voxel from the centre; the centre lies in a cell whose eight corners have one value, the
 * greatest. */
static double ball(int x, int y, int z) { return 30000 - 1000 * distance_from_centre(x, y, z); }

static bool draw_ball(ang_stage *stage, ang_error *err) {
    static const ang_transfer_point point = {.colour = {1, 1, 1}, .opacity = 1};
    if (!ang_stage_points(stage, &point, 1, true, err)) return false;
    ang_scene *scene = &stage->scene;
    scene->width = scene->height = 64;
    scene->camera.half_height = 16;
    scene->mode = ANG_MODE_ISO;
    scene->iso_hu = 30000 - 1000 * ball_radius;
    if (!ang_stage_draw(stage, err)) return false;
    double greatest = 0;
    for (int i = 0; i < ang_stage_pixels(stage); i++) {
        double x = (i % 64 + 0.5 - 32) / 2, y = (i / 64 + 0.5 - 32) / 2, r = sqrt(x * x + y * y); /* 2 pixels a voxel */
        bool shown = stage->image.rgba[4 * i + 3] > 0;
        if (shown != (r < ball_radius)) greatest = fmax(greatest, fabs(r - ball_radius));
    }
    ang_bench_error(stage->bench, greatest, 0.5, "voxels that the silhouette of a sphere is off");

    scene->mode = ANG_MODE_MIP;
    scene->window_centre = 65535 / 2. - 1024;
    scene->window_width = 65535;
    if (!ang_stage_draw(stage, err)) return false;
    float most = 0;
    for (int i = 0; i < 4 * ang_stage_pixels(stage); i += 4) most = fmaxf(most, stage->image.rgba[i]);
    ang_bench_error(stage->bench, fabs(round(65535 * (double)most) - stage->volume->maximum), 0,
                    "stored values between the brightest pixel of a MIP and the maximum");
    return true;
}

bool ang_case_sphere(ang_bench *bench, ang_error *err) {
    ang_stage stage;
    bool done = ang_stage_open(&stage, bench,
                               ang_bench_volume(ball_side, ball_side, ball_side, ang_bench_unit, ball, err), err) &&
                draw_ball(&stage, err);
    ang_stage_close(&stage);
    return done;
}
