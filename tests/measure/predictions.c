/* Cost models measured here: what they predict, by way of the plan, beside the clock. It prints; a clock is no test. */
#include "tests/core/backends.h"

#include "core/base/clock.h"
#include "core/base/median.h"
#include "core/render/planner.h"
#include "core/volume/phantom.h"

enum { SIDE = 200, FRAMES = 3, ROUNDS = 3, MODES = 3 };
static const double most_miss = 4; /* beyond it a plan is measured again */

/* Median, ms, of frames of what was planned. */
static double time_planned(const ang_planned *planned, const ang_scene *whole) {
    ang_scene scene = planned->stride > 1 ? ang_scene_subset(whole, planned->stride, 0, 0) : *whole;
    ang_render_options options = ang_render_options_default;
    ang_image image;
    double ms[FRAMES];
    if (planned->step_voxels > 0) options.step_voxels = planned->step_voxels;
    options.termination = planned->termination;
    assert_true(ang_image_create(&image, scene.width, scene.height, NULL));
    for (int i = planned->method->needs_gl ? -1 : 0; i < FRAMES; i++) { /* the first compiles */
        double start = ang_now_ms();
        assert_true(planned->method->render(planned->renderer, &scene, &options, &image, NULL, NULL, NULL));
        if (i >= 0) ms[i] = ang_now_ms() - start;
    }
    ang_image_clear(&image);
    return ang_median(ms, FRAMES);
}

/* Predicted over measured of one plan within a time. */
static double ratio_of(ang_gl *gl, const ang_volume *volume, const ang_scene *scene, const ang_method *method,
                       const ang_costs *costs) {
    ang_budget budget = {.max_error = NAN, .max_ms = 20};
    ang_planned planned;
    ang_error err = {0};
    if (!ang_planner_plan(gl, volume, scene, &ang_render_options_default, method, &budget, costs, &planned, NULL, &err))
        fail_msg("%s: %s", method->name, err.message);
    double ms = time_planned(&planned, scene);
    print_message("%s, mode %s: step %.3g, stride %d, predicted %.2f ms, measured %.2f\n", method->name,
                  ang_mode_name(scene->mode), planned.step_voxels, planned.stride, planned.ms, ms);
    method->destroy(planned.renderer);
    return planned.ms / ms;
}

/* Every method in every mode, whatever step and stride the plan chooses. Where the machine was busy with other things
 * in one of the two measurements the median of three says more, which lie apart so that not all of them meet the same.
 */
static void predictions_are_what_pictures_take(void **state) {
    open_gl(state);
    ang_phantom_params params = ang_phantom_params_default;
    for (int axis = 0; axis < 3; axis++) params.dims[axis] = axis < 2 ? 48 : 32;
    static const ang_transfer_point points[] = {{.hu = 250, .colour = {0.8, 0.3, 0.2}, .opacity = 0},
                                                {.hu = 900, .colour = {1, 0.95, 0.9}, .opacity = 0.3}};
    static const ang_mode modes[MODES] = {ANG_MODE_DVR, ANG_MODE_ISO, ANG_MODE_MIP};
    ang_transfer *transfer = ang_transfer_create(points, 2, 1, false, NULL, NULL);
    ang_volume *volume = ang_phantom_make(&params, 0, NULL, NULL, NULL);
    assert_non_null(volume);
    ang_costs costs = {.count = 0};
    double ratio[ANG_COSTS_MOST][MODES][ROUNDS];
    assert_true(ang_costs_measure(gl, &costs, NULL, NULL));
    for (int round = 0; round < ROUNDS; round++)
        for (size_t i = 0; i < costs.count; i++)
            for (int m = 0; m < MODES; m++) {
                if (round > 0 && ang_cost_miss(ratio[i][m][0], 1) <= most_miss) continue;
                ang_scene scene = ang_scene_default(volume);
                scene.width = scene.height = SIDE;
                scene.transfer = transfer;
                scene.mode = modes[m];
                scene.iso_hu = 400;
                ratio[i][m][round] = ratio_of(gl, volume, &scene, ang_method_find(costs.of[i].method), &costs);
            }
    for (size_t i = 0; i < costs.count; i++)
        for (int m = 0; m < MODES; m++) {
            bool once = ang_cost_miss(ratio[i][m][0], 1) <= most_miss;
            print_message("%-10s %-4s predicted / measured %.2f\n", costs.of[i].method, ang_mode_name(modes[m]),
                          ang_median(ratio[i][m], once ? 1 : ROUNDS));
        }
    ang_transfer_free(transfer);
    ang_volume_free(volume);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(predictions_are_what_pictures_take)};
    return cmocka_run_group_tests_name("osmesa", tests, open_osmesa, close_backend);
}
