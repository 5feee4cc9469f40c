/* Every method against the reference: the same scene is the same picture, and the error falls with the step. */
#include "tests/core/fixtures.h"

#include "core/error/metrics.h"
#include "core/render/context.h"
#include "core/render/method.h"

#include <string.h>

enum { size = 48 };

/* A smooth field, so that orders can be measured; a sheared, anisotropic grid. */
static double smooth_value(int x, int y, int z) {
    return 300 + 250 * sin(0.31 * x + 0.2) * cos(0.27 * y) + 150 * sin(0.4 * z + 0.13 * x);
}

static ang_volume *sheared_volume(void) {
    double spacing[3] = {0.8, 0.9, 1.4};
    ang_volume *volume = make_volume(24, 28, 18, spacing, smooth_value);
    volume->affine.m[1][2] = 0.5;
    volume->affine.m[0][3] = -1e4;
    return volume;
}

static ang_transfer *vessels(void) {
    static const ang_transfer_point points[] = {{.hu = 150, .colour = {0.6, 0.1, 0.05}, .opacity = 0},
                                                {.hu = 350, .colour = {0.9, 0.4, 0.2}, .opacity = 0.15},
                                                {.hu = 700, .colour = {1, 0.95, 0.9}, .opacity = 0.4}};
    return ang_transfer_create(points, 3, 1, false, NULL, NULL);
}

typedef struct bench {
    ang_gl *gl;
    const ang_method *method;
    ang_volume *volume;
    ang_renderer *renderer, *truth;
} bench;

static void render(const bench *on, ang_renderer *renderer, const ang_method *method, const ang_scene *scene,
                   double step, ang_image *image) {
    ang_error err = {0};
    ang_render_options options = ang_render_options_default;
    options.step_voxels = step;
    options.termination = 1;
    assert_true(ang_image_create(image, scene->width, scene->height, &err));
    if (!method->render(renderer, scene, &options, image, NULL, NULL, &err))
        fail_msg("%s: %s", method->name, err.message);
    if (method->needs_gl && !ang_gl_check(on->gl, &err)) fail_msg("%s", err.message);
    for (size_t i = 0; i < (size_t)scene->width * (size_t)scene->height * 4; i++) assert_true(isfinite(image->rgba[i]));
}

static ang_metrics compare(const bench *on, const ang_scene *scene, double step) {
    ang_image picture, truth;
    render(on, on->renderer, on->method, scene, step, &picture);
    render(on, on->truth, &ang_method_reference, scene, 1, &truth);
    ang_metrics metrics;
    assert_true(ang_metrics_compute(&picture, &truth, false, &metrics, NULL));
    ang_image_clear(&picture);
    ang_image_clear(&truth);
    return metrics;
}

/* dvr: the maximum falls with about order 2 down to what float and filtering leave. */
static void check_dvr(const bench *on, ang_scene *scene, const char *what) {
    ang_metrics coarse = compare(on, scene, 0.5), fine = compare(on, scene, 0.0625);
    double order = log2(coarse.rms / fine.rms) / 3;
    print_message("%-10s %-34s rms %.3g -> %.3g, max %.3g -> %.3g, order %.2f\n", on->method->name, what, coarse.rms,
                  fine.rms, coarse.max, fine.max, order);
    assert_true(fine.max < 0.25);
    assert_true(fine.rms < 0.03);
    assert_true(order > 1.5 || fine.rms < 2e-3);
}

/* Values and surfaces: silhouettes may flip a pixel; the rest agrees. */
static void check_values(const bench *on, ang_scene *scene, const char *what) {
    ang_metrics coarse = compare(on, scene, 0.5), fine = compare(on, scene, 0.0625);
    print_message("%-10s %-34s rms %.3g -> %.3g, p99.9 %.3g -> %.3g, flipped %.2g\n", on->method->name, what,
                  coarse.rms, fine.rms, coarse.p999, fine.p999, fine.flipped);
    assert_true(fine.rms < 0.3);
    assert_true(fine.rms <= coarse.rms + 1e-4);
    assert_true(fine.flipped < 0.002);
}

static void check_scene(const bench *on, ang_scene *scene, const char *where) {
    char what[64];
    for (int mode = ANG_MODE_DVR; mode <= ANG_MODE_ISO; mode++)
        for (int shading = 0; shading < (mode == ANG_MODE_DVR ? 2 : 1); shading++) {
            scene->mode = (ang_mode)mode;
            scene->shading = (ang_shading)shading;
            snprintf(what, sizeof what, "%s %s %s", where, ang_mode_name(scene->mode),
                     ang_shading_name(scene->shading));
            if (mode == ANG_MODE_DVR)
                check_dvr(on, scene, what);
            else
                check_values(on, scene, what);
        }
}

static void check_method(const bench *on) {
    ang_transfer *transfer = vessels();
    ang_scene scene = ang_scene_default(on->volume);
    scene.width = size + 5;
    scene.height = size;
    scene.transfer = transfer;
    scene.iso_hu = 420;
    scene.window_centre = 300;
    scene.window_width = 800;

    ang_view view = ang_view_default;
    assert_true(ang_view_parse("33,21,10", &view, NULL));
    scene.camera = ang_camera_for(on->volume, &view);
    check_scene(on, &scene, "perspective");

    ang_scene parallel = scene;
    view.projection = ANG_PARALLEL;
    assert_true(ang_view_parse("left", &view, NULL));
    parallel.camera = ang_camera_for(on->volume, &view);
    check_scene(on, &parallel, "parallel left");

    ang_scene clipped = scene;
    assert_true(ang_scene_clip_parse("20%,90%,10%,80%,30%,75%", on->volume, &clipped, NULL));
    check_scene(on, &clipped, "clipped");

    ang_scene cut = scene;
    assert_true(ang_clip_plane_parse("0.8,-0.5,0.6,0", &cut.clip_plane, NULL));
    cut.clip_plane.offset_mm = ang_vec3_dot(cut.clip_plane.normal, ang_volume_centre(on->volume)) + 1.5;
    check_scene(on, &cut, "cut by a plane");

    ang_scene inside = scene;
    inside.camera.eye = ang_vec3_along(ang_volume_centre(on->volume), inside.camera.forward, 1.5);
    inside.camera.fov_deg = 80;
    check_scene(on, &inside, "inside");
    ang_transfer_free(transfer);
}

static void every_method_shows_the_reference_picture(void **state) {
    (void)state;
    static const ang_backend backends[] = {ANG_BACKEND_OSMESA, ANG_BACKEND_EGL};
    int tried = 0;
    for (size_t b = 0; b < sizeof backends / sizeof *backends; b++) {
        ang_error err = {0};
        bench on = {.gl = ang_gl_create(backends[b], &err), .volume = sheared_volume()};
        if (!on.gl) {
            print_message("no %s here: %s\n", ang_backend_name(backends[b]), err.message);
            ang_volume_free(on.volume);
            continue;
        }
        on.truth = ang_method_reference.create(NULL, on.volume, &ang_render_options_default, &err);
        for (const ang_method *const *method = ang_methods(); *method; method++) {
            on.method = *method;
            if (on.method == &ang_method_reference) continue;
            on.renderer =
                on.method->create(on.method->needs_gl ? on.gl : NULL, on.volume, &ang_render_options_default, &err);
            if (!on.renderer) fail_msg("%s", err.message);
            check_method(&on);
            on.method->destroy(on.renderer);
            tried++;
        }
        ang_method_reference.destroy(on.truth);
        ang_gl_destroy(on.gl);
        ang_volume_free(on.volume);
    }
    assert_true(tried > 0);
}

static void options_that_change_nothing_are_known(void **state) {
    (void)state;
    ang_render_options options = ang_render_options_default;
    for (const ang_method *const *method = ang_methods(); *method; method++)
        assert_int_equal(ang_method_ignores(*method, &options), 0);
    options.proxy = ANG_PROXY_CONVEX_HULL;
    options.bricks[1] = 3;
    options.termination = 0.9;
    assert_int_equal(ang_method_ignores(&ang_method_slicing, &options), 0);
    assert_int_equal(ang_method_ignores(&ang_method_singlepass, &options), ANG_TAKES_PROXY | ANG_TAKES_BRICKS);
    assert_int_equal(ang_method_ignores(&ang_method_reference, &options),
                     ANG_TAKES_PROXY | ANG_TAKES_BRICKS | ANG_TAKES_TERMINATION);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(every_method_shows_the_reference_picture),
                                       cmocka_unit_test(options_that_change_nothing_are_known)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
