/* Pictures within an error or a time: what is planned is compared with the reference and with what was asked. */
#include "tests/core/backends.h"

#include "core/render/planner.h"
#include "core/volume/phantom.h"

#include <string.h>

enum { SIDE = 48 };

/* Made up: 0.1 us a sample, a millisecond a pixel of the reference. */
static ang_costs made_up(void) {
    static const char *const names[] = {"envelope", "raycast", "slicing", "singlepass"};
    ang_costs costs = {.count = 5};
    for (int i = 0; i < 4; i++) {
        snprintf(costs.of[i].method, sizeof costs.of[i].method, "%s", names[i]);
        costs.of[i].model = (ang_cost_model){.term = {1, 1e-4, 1e-4, 1e-4, 1e-3}};
    }
    snprintf(costs.of[4].method, sizeof costs.of[4].method, "reference");
    costs.of[4].model = (ang_cost_model){.term = {0, 1, 0, 0, 0}};
    return costs;
}

static ang_volume *make_head(void) {
    ang_phantom_params params = ang_phantom_params_default;
    for (int axis = 0; axis < 3; axis++) params.dims[axis] = axis < 2 ? 48 : 32;
    ang_volume *volume = ang_phantom_make(&params, 0, NULL, NULL, NULL);
    assert_non_null(volume);
    return volume;
}

static ang_transfer *make_bone(void) {
    static const ang_transfer_point points[] = {{.hu = 250, .colour = {0.8, 0.3, 0.2}, .opacity = 0},
                                                {.hu = 900, .colour = {1, 0.95, 0.9}, .opacity = 0.3}};
    return ang_transfer_create(points, 2, 1, false, NULL, NULL);
}

static ang_scene make_picture(const ang_volume *volume, const ang_transfer *transfer) {
    ang_scene scene = ang_scene_default(volume);
    scene.width = scene.height = SIDE;
    scene.transfer = transfer;
    return scene;
}

static ang_planned plan(ang_gl *gl, const ang_volume *volume, const ang_scene *scene, const ang_method *asked,
                        double max_error, double max_ms) {
    ang_budget budget = {max_error, max_ms};
    ang_costs costs = made_up();
    ang_planned planned;
    ang_error err = {0};
    if (!ang_planner_plan(gl, volume, scene, &ang_render_options_default, asked, &budget, &costs, &planned, NULL, &err))
        fail_msg("%s", err.message);
    return planned;
}

static ang_image draw(const ang_method *method, ang_renderer *renderer, const ang_scene *scene,
                      const ang_planned *planned) {
    ang_render_options options = ang_render_options_default;
    ang_image image;
    ang_error err = {0};
    if (planned && planned->step_voxels > 0) options.step_voxels = planned->step_voxels;
    if (planned) options.termination = planned->termination;
    assert_true(ang_image_create(&image, scene->width, scene->height, NULL));
    if (!method->render(renderer, scene, &options, &image, NULL, NULL, &err)) fail_msg("%s", err.message);
    return image;
}

/* Levels that the planned picture is from the reference. */
static double true_error(const ang_volume *volume, const ang_scene *scene, const ang_planned *planned) {
    ang_renderer *reference = ang_method_reference.create(NULL, volume, &ang_render_options_default, NULL);
    ang_image truth = draw(&ang_method_reference, reference, scene, NULL);
    ang_image image = draw(planned->method, planned->renderer, scene, planned);
    double worst = 0;
    for (int i = 0; i < 4 * SIDE * SIDE; i++)
        worst = fmax(worst, 255 * fabs((double)truth.rgba[i] - (double)image.rgba[i]));
    ang_image_clear(&truth);
    ang_image_clear(&image);
    ang_method_reference.destroy(reference);
    return worst;
}

static void errors_are_kept(void **state) {
    open_gl(state);
    ang_volume *volume = make_head();
    ang_transfer *transfer = make_bone();
    ang_scene scene = make_picture(volume, transfer);
    static const double limits[] = {8, 2, 0.5};
    double step = INFINITY;
    for (size_t i = 0; i < 3; i++) {
        ang_planned planned = plan(gl, volume, &scene, NULL, limits[i], NAN);
        assert_true(planned.keeps_error);
        assert_string_equal(planned.missed, "");
        assert_int_equal(planned.stride, 1);
        double off = true_error(volume, &scene, &planned);
        print_message("at most %g: %s, step %.3g, estimated %.3g, %.3g off\n", limits[i], planned.method->name,
                      planned.step_voxels, planned.error, off);
        assert_true(off <= limits[i]);
        assert_true(planned.step_voxels <= step);
        step = planned.step_voxels;
        planned.method->destroy(planned.renderer);
    }
    /* Beyond what floats can do: only the reference is left, or where that was not asked for a sentence. */
    ang_planned exact = plan(gl, volume, &scene, NULL, 1e-5, NAN);
    assert_ptr_equal(exact.method, &ang_method_reference);
    assert_true(exact.keeps_error);
    exact.method->destroy(exact.renderer);
    ang_planned missed = plan(gl, volume, &scene, &ang_method_singlepass, 1e-5, NAN);
    assert_ptr_equal(missed.method, &ang_method_singlepass);
    assert_false(missed.keeps_error);
    assert_non_null(strstr(missed.missed, "--max-error"));
    missed.method->destroy(missed.renderer);
    ang_transfer_free(transfer);
    ang_volume_free(volume);
}

static void times_are_generous_or_impossible(void **state) {
    open_gl(state);
    ang_volume *volume = make_head();
    ang_transfer *transfer = make_bone();
    ang_scene scene = make_picture(volume, transfer);
    ang_planned generous = plan(gl, volume, &scene, NULL, NAN, 1e9);
    assert_true(generous.keeps_time);
    assert_string_equal(generous.missed, "");
    assert_int_equal(generous.stride, 1);
    assert_true(generous.error < 0.1);
    generous.method->destroy(generous.renderer);
    ang_planned impossible = plan(gl, volume, &scene, NULL, NAN, 1e-6);
    assert_false(impossible.keeps_time);
    assert_non_null(strstr(impossible.missed, "--max-time"));
    assert_true(impossible.stride > 1 || impossible.step_voxels >= 1);
    impossible.method->destroy(impossible.renderer);
    ang_transfer_free(transfer);
    ang_volume_free(volume);
}

/* A plane in x and y is what lies between its pixels, and pixels that are drawn stay as they are. */
static void interpolation_is_bilinear(void **state) {
    (void)state;
    for (int stride = 1; stride <= 4; stride++) {
        ang_image whole, drawn;
        int side = (SIDE - 1) / stride + 1;
        assert_true(ang_image_create(&whole, SIDE, SIDE, NULL) && ang_image_create(&drawn, side, side, NULL));
        for (int i = 0; i < 4 * side * side; i++)
            drawn.rgba[i] = (float)(0.01 * stride * (i / 4 % side) + 0.003 * stride * (i / 4 / side) + 0.1 * (i % 4));
        ang_image_enlarge(&drawn, stride, 0, &whole);
        for (int i = 0; i < 4 * SIDE * SIDE; i++) {
            double x = i / 4 % SIDE, y = i / 4 / SIDE, last = stride * (side - 1);
            assert_close((double)whole.rgba[i], 0.01 * fmin(x, last) + 0.003 * fmin(y, last) + 0.1 * (i % 4), 1e-6);
        }
        ang_image_clear(&whole);
        ang_image_clear(&drawn);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(errors_are_kept),
        cmocka_unit_test(times_are_generous_or_impossible),
        cmocka_unit_test(interpolation_is_bilinear),
    };
    return cmocka_run_group_tests_name("any backend", tests, open_osmesa, close_backend);
}
