/* Rays that go from cell to cell: against the reference and closed forms; every width of SIMD gives the same bits. */
#include "tests/core/casting.h"

#include "core/cpu/method_cpu.h"
#include "core/error/metrics.h"
#include "core/render/planner.h"

static ang_image draw_anew(const ang_method *method, const ang_volume *volume, const ang_scene *scene,
                           const ang_render_options *options, ang_frame_stats *stats) {
    ang_renderer *renderer = open_renderer(method, NULL, volume);
    ang_image image = draw(method, renderer, scene, options, stats);
    method->destroy(renderer);
    return image;
}

static double largest_error(const ang_image *truth, ang_image *image) {
    ang_metrics off;
    assert_true(ang_metrics_compute(image, truth, false, &off, NULL));
    ang_image_clear(image);
    return off.max;
}

static void homogeneous_media_have_their_closed_form(void **state) {
    (void)state;
    ang_volume *volume = sheared_volume(flat_value);
    for (int power = -4; power <= 4; power++)
        for (int which = 0; which < SCENES; which++) {
            double kappa = pow(10, power);
            ang_transfer *transfer = constant_transfer(kappa, 0.25, 0.5, 1);
            ang_scene scene = make_scene(which, volume, transfer);
            scene.shading = which % 2 ? ANG_SHADING_PHONG : ANG_SHADING_NONE; /* without a gradient changes nothing */
            ang_image image = draw_anew(&ang_method_adaptive, volume, &scene, &exact, NULL);
            for (int i = 0; i < width * height; i++) {
                double alpha = -expm1(-kappa * ray_length(volume, &scene, i));
                assert_close(image.rgba[4 * i + 3], alpha, 4e-6);
                assert_close(image.rgba[4 * i + 1], 0.5 * alpha, 4e-6);
            }
            ang_image_clear(&image);
            ang_transfer_free(transfer);
        }
    ang_volume_free(volume);
}

static double ramp_value(int x, int y, int z) { return 9 * x + 11 * y - 7 * z; }

/* Where the field is linear nothing that the transfer function does is missed, a spike of half a HU, steps and plateaus
 * at opacity 1 among it. */
static void linear_fields_miss_nothing(void **state) {
    (void)state;
    static const ang_transfer_point spike[] = {{.hu = 200, .colour = {1, 0.5, 0.25}, .opacity = 0},
                                               {.hu = 200.25, .colour = {1, 0.5, 0.25}, .opacity = 0.95},
                                               {.hu = 200.5, .colour = {1, 0.5, 0.25}, .opacity = 0},
                                               {.hu = 300, .colour = {0, 0.5, 1}, .opacity = 0},
                                               {.hu = 300, .colour = {0, 0.5, 1}, .opacity = 0.02}};
    static const ang_transfer_point plateau[] = {
        {.hu = 100, .colour = {0.2, 0.5, 1}, .opacity = 0},     {.hu = 200, .colour = {0.2, 0.5, 1}, .opacity = 0.05},
        {.hu = 260, .colour = {1, 0.5, 0.25}, .opacity = 0.05}, {.hu = 260, .colour = {1, 0.5, 0.25}, .opacity = 1},
        {.hu = 300, .colour = {1, 0.75, 0.25}, .opacity = 1},   {.hu = 300, .colour = {0, 0, 1}, .opacity = 0}};
    ang_volume *volume = sheared_volume(ramp_value);
    for (int which = 0; which < 2 * SCENES; which++) {
        ang_transfer *transfer = which < SCENES ? ang_transfer_create(spike, 5, 1, false, NULL, NULL)
                                                : ang_transfer_create(plateau, 6, 1, false, NULL, NULL);
        ang_scene scene = make_scene(which % SCENES, volume, transfer);
        ang_image truth = draw_anew(&ang_method_reference, volume, &scene, &exact, NULL);
        ang_image image = draw_anew(&ang_method_adaptive, volume, &scene, &exact, NULL);
        double off = largest_error(&truth, &image);
        if (off > 0.1) fail_msg("scene %d: %g levels", which, off);
        ang_image_clear(&truth);
        ang_transfer_free(transfer);
    }
    ang_volume_free(volume);
}

/* The picture for an error is within it, by the method and by whatever is chosen: the estimate says so, and so says the
 * reference. */
static void pictures_keep_the_error_asked_for(void **state) {
    (void)state;
    static const double limits[] = {0.25, 2};
    ang_volume *volume = sheared_volume(sparse_value);
    ang_transfer *transfer = vessels();
    for (int which = 0; which < 2 * SCENES; which++) {
        ang_scene scene = make_scene(which % SCENES, volume, transfer);
        scene.shading = which < SCENES ? ANG_SHADING_NONE : ANG_SHADING_PHONG;
        ang_image truth = draw_anew(&ang_method_reference, volume, &scene, &exact, NULL);
        for (size_t l = 0; l < sizeof limits / sizeof *limits; l++) {
            ang_budget budget = {limits[l], NAN};
            ang_costs costs = {0};
            ang_planned planned;
            ang_error err = {0};
            const ang_method *asked = which % 2 ? &ang_method_adaptive : NULL;
            if (!ang_planner_plan(NULL, volume, &scene, &ang_render_options_default, asked, &budget, &costs, &planned,
                                  NULL, &err))
                fail_msg("%s", err.message);
            assert_true(planned.keeps_error);
            ang_render_options options = {.step_voxels = planned.step_voxels, .termination = planned.termination};
            ang_image image = draw(planned.method, planned.renderer, &scene, &options, NULL);
            double off = largest_error(&truth, &image);
            if (off > limits[l]) fail_msg("scene %d, %g levels: %g", which, limits[l], off);
            planned.method->destroy(planned.renderer);
        }
        ang_image_clear(&truth);
    }
    ang_transfer_free(transfer);
    ang_volume_free(volume);
}

/* They fall with the square of the step. */
static void errors_are_of_order_two(void **state) {
    (void)state;
    ang_volume *volume = sheared_volume(sparse_value);
    ang_transfer *transfer = vessels();
    ang_scene scene = make_scene(0, volume, transfer);
    ang_image truth = draw_anew(&ang_method_reference, volume, &scene, &exact, NULL);
    for (double step = 1; step > 0.06; step /= 2) {
        ang_render_options options = {.step_voxels = step, .termination = 1};
        ang_image image = draw_anew(&ang_method_adaptive, volume, &scene, &options, NULL);
        double off = largest_error(&truth, &image);
        print_message("step %g: %g levels\n", step, off);
        if (off > 3 * step * step + 0.02) fail_msg("step %g: %g levels", step, off);
    }
    ang_image_clear(&truth);
    ang_transfer_free(transfer);
    ang_volume_free(volume);
}

/* Values of a flat stretch of the transfer function, with noise, and of slopes beside it. */
static double patchy_value(int x, int y, int z) {
    uint64_t seed = (uint64_t)(1 + x + 100 * y + 10000 * z);
    random_unit(&seed);
    bool flat = x > 4 && x < 26 && y > 4;
    return flat ? 300 + 90 * random_unit(&seed) : z % 8 < 4 ? 100 : 500 * random_unit(&seed);
}

/* Blocks in which colour and extinction stay the same are one step, exactly: fewer steps than cells, the picture that a
 * step in each cell gives, which a slope far too slight to be seen asks for, and the same bits whatever is skipped. */
static void flat_blocks_are_one_step(void **state) {
    (void)state;
    for (int which = 0; which < SCENES; which++) {
        ang_volume *volume = sheared_volume(patchy_value);
        ang_image image[2];
        ang_frame_stats stats[2] = {{0}, {0}};
        for (int slope = 0; slope < 2; slope++) {
            const ang_transfer_point points[] = {
                {.hu = 200, .colour = {0.2, 0.5, 1}, .opacity = 0},
                {.hu = 290, .colour = {1, 0.5, 0.25}, .opacity = 0.03},
                {.hu = 400, .colour = {1, 0.5, slope ? 0.250001 : 0.25}, .opacity = 0.03},
                {.hu = 480, .colour = {0.1, 0.9, 0.25}, .opacity = 0.3},
            };
            ang_transfer *transfer = ang_transfer_create(points, 4, 1, false, NULL, NULL);
            ang_scene scene = make_scene(which, volume, transfer);
            scene.shading = ANG_SHADING_NONE;
            image[slope] = draw_anew(&ang_method_adaptive, volume, &scene, &exact, &stats[slope]);
            ang_render_options whole = exact;
            whole.no_skip = true;
            ang_image unskipped = draw_anew(&ang_method_adaptive, volume, &scene, &whole, NULL);
            assert_true(difference(&image[slope], &unskipped) == 0);
            ang_image_clear(&unskipped);
            ang_transfer_free(transfer);
        }
        print_message("scene %d: %.0f of %.0f steps\n", which, (double)stats[0].samples, (double)stats[1].samples);
        assert_true(difference(&image[0], &image[1]) < 3e-6);
        assert_true(stats[0].samples < 0.9 * (double)stats[1].samples);
        ang_image_clear(&image[0]);
        ang_image_clear(&image[1]);
        ang_volume_free(volume);
    }
}

/* In all modes, shaded and not; but for dvr it is the method cpu. */
static void widths_change_no_bit(void **state) {
    (void)state;
    ang_cast_width widths[ANG_CAST_WIDTHS];
    int count = ang_cast_widths(widths);
    ang_volume *volume = sheared_volume(sparse_value);
    ang_transfer *transfer = vessels();
    ang_renderer *renderer = open_renderer(&ang_method_adaptive, NULL, volume);
    for (int which = 0; which < SCENES; which++)
        for (int mode = -1; mode <= ANG_MODE_ISO; mode++) {
            ang_scene scene = make_scene(which, volume, transfer);
            scene.mode = mode < 0 ? ANG_MODE_DVR : (ang_mode)mode;
            scene.shading = mode < 0 ? ANG_SHADING_PHONG : ANG_SHADING_NONE;
            ang_render_options early = exact;
            early.termination = which % 2 ? 0.9 : 1;
            ang_cpu_set_width(renderer, &widths[count - 1]);
            ang_frame_stats narrow = {0}, wide = {0};
            ang_image truth = draw(&ang_method_adaptive, renderer, &scene, &early, &narrow);
            for (int w = 0; w < count; w++) {
                ang_cpu_set_width(renderer, &widths[w]);
                ang_image image = draw(&ang_method_adaptive, renderer, &scene, &early, &wide);
                assert_true(difference(&truth, &image) == 0);
                assert_int_equal(narrow.samples, wide.samples);
            }
            if (scene.mode != ANG_MODE_DVR) {
                ang_image image = draw_anew(&ang_method_cpu, volume, &scene, &early, NULL);
                assert_true(difference(&truth, &image) == 0);
            }
            ang_image_clear(&truth);
        }
    ang_method_adaptive.destroy(renderer);
    ang_transfer_free(transfer);
    ang_volume_free(volume);
}

static void skipping_changes_nothing(void **state) {
    (void)state;
    ang_volume *volume = sheared_volume(sparse_value);
    ang_transfer *transfer = vessels();
    ang_renderer *renderer = open_renderer(&ang_method_adaptive, NULL, volume);
    for (int which = 0; which < 2 * SCENES; which++)
        for (double step = 0.1; step < 2; step *= 3) {
            ang_scene scene = make_scene(which % SCENES, volume, transfer);
            scene.shading = which < SCENES ? ANG_SHADING_NONE : ANG_SHADING_PHONG;
            ang_render_options some = {.step_voxels = step, .termination = 1}, all = some;
            all.no_skip = true;
            ang_image truth = draw(&ang_method_adaptive, renderer, &scene, &all, NULL);
            ang_image image = draw(&ang_method_adaptive, renderer, &scene, &some, NULL);
            double off = difference(&truth, &image);
            if (off > 0) fail_msg("scene %d, step %g: %g", which, step, off);
            ang_image_clear(&truth);
        }
    ang_method_adaptive.destroy(renderer);
    ang_transfer_free(transfer);
    ang_volume_free(volume);
}

/* Another transfer function, mode, or skipping: the picture is that of a fresh renderer. */
static void nothing_is_kept_that_has_changed(void **state) {
    (void)state;
    ang_volume *volume = sheared_volume(sparse_value);
    ang_transfer *transfer = vessels(), *flat = constant_transfer(0.05, 1, 0.5, 0.25);
    ang_renderer *kept = open_renderer(&ang_method_adaptive, NULL, volume);
    for (int turn = 0; turn < 12; turn++) {
        ang_scene scene = make_scene(turn % SCENES, volume, turn % 3 ? transfer : flat);
        scene.mode = turn % 4 == 3 ? ANG_MODE_MIP : ANG_MODE_DVR;
        ang_render_options options = exact;
        options.no_skip = turn % 2;
        ang_image truth = draw_anew(&ang_method_adaptive, volume, &scene, &options, NULL);
        ang_image image = draw(&ang_method_adaptive, kept, &scene, &options, NULL);
        assert_true(difference(&truth, &image) == 0);
        ang_image_clear(&truth);
    }
    ang_method_adaptive.destroy(kept);
    ang_transfer_free(transfer);
    ang_transfer_free(flat);
    ang_volume_free(volume);
}

/* Samples of pixels are the picture's. */
static void counts_are_of_all_samples(void **state) {
    (void)state;
    ang_volume *volume = sheared_volume(sparse_value);
    ang_transfer *transfer = vessels();
    ang_scene scene = make_scene(0, volume, transfer);
    static float counts[width * height];
    ang_frame_stats stats = {.counts = counts};
    ang_image image = draw_anew(&ang_method_adaptive, volume, &scene, &exact, &stats);
    double sum = 0;
    for (int i = 0; i < width * height; i++) sum += (double)counts[i];
    assert_close(sum, (double)stats.samples, 0.5);
    assert_true(stats.samples > 0);
    ang_image_clear(&image);
    ang_transfer_free(transfer);
    ang_volume_free(volume);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(homogeneous_media_have_their_closed_form),
        cmocka_unit_test(linear_fields_miss_nothing),
        cmocka_unit_test(pictures_keep_the_error_asked_for),
        cmocka_unit_test(errors_are_of_order_two),
        cmocka_unit_test(flat_blocks_are_one_step),
        cmocka_unit_test(widths_change_no_bit),
        cmocka_unit_test(skipping_changes_nothing),
        cmocka_unit_test(nothing_is_kept_that_has_changed),
        cmocka_unit_test(counts_are_of_all_samples),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
