/* The ray caster on the processor: against the single pass, closed forms and the reference; every width of SIMD and
 * every way of skipping gives the same bits. */
#include "tests/core/backends.h"
#include "tests/core/casting.h"

#include "core/cpu/method_cpu.h"

#include <string.h>

static ang_image cast(ang_renderer *renderer, const ang_scene *scene, const ang_render_options *options) {
    return draw(&ang_method_cpu, renderer, scene, options, NULL);
}

/* Calls `check` with every scene in every mode, in dvr shaded and not and with both classifications, at three steps. */
typedef void scene_check(void *context, const ang_scene *scene, const ang_render_options *options, const char *what);
static void every_scene(const ang_volume *volume, const ang_transfer *transfer, scene_check *check, void *context) {
    static const double steps[] = {0.11, 0.5, 1.9};
    for (int which = 0; which < SCENES; which++)
        for (int mode = ANG_MODE_DVR; mode <= ANG_MODE_ISO; mode++)
            for (int way = 0; way < (mode == ANG_MODE_DVR ? 4 : 1); way++)
                for (int step = 0; step < 3; step++) {
                    char what[64];
                    ang_scene scene = make_scene(which, volume, transfer);
                    scene.mode = (ang_mode)mode;
                    scene.shading = way % 2 ? ANG_SHADING_PHONG : ANG_SHADING_NONE;
                    ang_render_options options = exact;
                    options.step_voxels = steps[step];
                    options.classification = way / 2 ? ANG_CLASSIFY_PREFIX : ANG_CLASSIFY_MIDPOINT;
                    snprintf(what, sizeof what, "scene %d, %s %s %s, step %g", which, ang_mode_name(scene.mode),
                             ang_shading_name(scene.shading), ang_classify_name(options.classification), steps[step]);
                    check(context, &scene, &options, what);
                }
}

/* All that steps as a whole have to do with: colours that jump, a peak narrower than a voxel's change, a plateau at
 * opacity 1 behind something clear. */
static ang_transfer *stiff(void) {
    static const ang_transfer_point points[] = {
        {.hu = 150, .colour = {0.6, 0.1, 0.05}, .opacity = 0},  {.hu = 220, .colour = {0.9, 0.4, 0.2}, .opacity = 0.15},
        {.hu = 220, .colour = {0.2, 0.4, 0.9}, .opacity = 0},   {.hu = 300, .colour = {0.2, 0.4, 0.9}, .opacity = 0},
        {.hu = 302, .colour = {0.1, 0.9, 0.2}, .opacity = 0.7}, {.hu = 304, .colour = {0.2, 0.4, 0.9}, .opacity = 0.05},
        {.hu = 450, .colour = {1, 0.95, 0.9}, .opacity = 0.1},  {.hu = 450, .colour = {1, 0.8, 0.7}, .opacity = 1},
        {.hu = 520, .colour = {0.7, 0.8, 1}, .opacity = 1},     {.hu = 520, .colour = {1, 0.95, 0.9}, .opacity = 0.3}};
    return ang_transfer_create(points, sizeof points / sizeof *points, 1, false, NULL, NULL);
}

typedef struct pair {
    ang_renderer *cpu, *singlepass;
} pair;

static void is_the_single_pass_picture(void *context, const ang_scene *scene, const ang_render_options *options,
                                       const char *what) {
    const pair *on = context;
    ang_image truth = draw(&ang_method_singlepass, on->singlepass, scene, options, NULL);
    ang_image image = cast(on->cpu, scene, options);
    int flipped = 0;
    double worst = 0;
    for (int i = 0; i < width * height; i++) {
        double far = 0;
        for (int c = 0; c < 4; c++) far = fmax(far, fabs((double)image.rgba[4 * i + c] - truth.rgba[4 * i + c]));
        /* A ray that touches a surface, or cuts an edge of the box, may hit or miss by rounding. */
        if (far > 1e-2) flipped++;
        if (far <= 1e-2) worst = fmax(worst, far);
    }
    /* Places in float are 2e-6 of 44 voxels apart at most; values differ by that times 600 HU a voxel of 500 shown. */
    bool surface = scene->mode == ANG_MODE_ISO;
    if (flipped > (surface ? 2 : 0) || worst > (surface ? 5e-4 : 1e-5))
        fail_msg("%s: %d pixels flip, others differ by %g", what, flipped, worst);
    ang_image_clear(&truth);
    ang_image_clear(&image);
}

static void every_scene_is_the_single_pass_picture(void **state) {
    open_gl(state);
    ang_volume *volume = sheared_volume(sparse_value);
    ang_transfer *transfer = vessels();
    pair on = {open_renderer(&ang_method_cpu, NULL, volume), open_renderer(&ang_method_singlepass, gl, volume)};
    every_scene(volume, transfer, is_the_single_pass_picture, &on);
    ang_method_cpu.destroy(on.cpu);
    ang_method_singlepass.destroy(on.singlepass);
    ang_transfer_free(transfer);
    ang_volume_free(volume);
}

/* Skipping and widths change no bit, forced parts nothing that shows. */
static void is_the_same_however(void *context, const ang_scene *scene, const ang_render_options *options,
                                const char *what) {
    ang_renderer *renderer = context;
    ang_cast_width widths[ANG_CAST_WIDTHS];
    int count = ang_cast_widths(widths);
    ang_cpu_set_width(renderer, &widths[count - 1]);
    ang_render_options plain = *options, forced = *options, early = *options;
    plain.no_skip = true;
    forced.forced = (1u << ANG_FORCIBLE) - 1;
    forced.threads = 1;
    early.termination = 0.9;
    ang_image truth = cast(renderer, scene, &plain), ended = cast(renderer, scene, &early);
    for (int w = 0; w < count; w++) {
        ang_cpu_set_width(renderer, &widths[w]);
        ang_image skipped = cast(renderer, scene, options), used = cast(renderer, scene, &forced);
        ang_image cut = cast(renderer, scene, &early);
        double a = difference(&truth, &skipped), b = difference(&truth, &used), c = difference(&ended, &cut);
        /* Forced rounding makes whole what interpolation left beside a whole value. */
        if (a > 0 || b > 1e-6 || c > 0) fail_msg("%s, %s: %g, %g, %g", what, widths[w].name, a, b, c);
    }
    ang_image_clear(&truth);
    ang_image_clear(&ended);
}

static void widths_and_skipping_change_no_bit(void **state) {
    (void)state;
    ang_volume *volume = sheared_volume(sparse_value);
    for (size_t i = 0; i < ang_volume_count(volume); i++)
        if (i % 44 < 18) volume->data[i] = 900;
    for (int kind = 0; kind < 2; kind++) {
        ang_transfer *transfer = kind ? stiff() : vessels();
        ang_renderer *renderer = open_renderer(&ang_method_cpu, NULL, volume);
        every_scene(volume, transfer, is_the_same_however, renderer);
        ang_method_cpu.destroy(renderer);
        ang_transfer_free(transfer);
    }
    ang_volume_free(volume);
}

/* One bright voxel: at corners of blocks, at the volume's corners, in the midst of a block. */
static int bright[3];
static double one_voxel(int x, int y, int z) {
    return x == bright[0] && y == bright[1] && z == bright[2] ? 600 : -1000;
}

static void one_bright_voxel_is_never_skipped(void **state) {
    (void)state;
    static const int places[][3] = {{0, 0, 0}, {8, 8, 8}, {7, 8, 16}, {25, 19, 17}, {12, 8, 3}, {24, 16, 8}};
    static const double spacings[][3] = {{1, 1, 1}, {0.5, 0.5, 500}};
    ang_transfer *transfer = vessels();
    int shown = 0;
    for (size_t p = 0; p < sizeof places / sizeof *places; p++)
        for (int s = 0; s < 2; s++) {
            memcpy(bright, places[p], sizeof bright);
            ang_volume *volume = make_volume(26, 20, 18, spacings[s], one_voxel);
            ang_renderer *renderer = open_renderer(&ang_method_cpu, NULL, volume);
            for (int which = 0; which < SCENES; which++) {
                if (which == 2) continue; /* its clip box may hold nothing */
                ang_scene scene = make_scene(which, volume, transfer);
                for (int mode = ANG_MODE_DVR; mode <= ANG_MODE_ISO; mode++) {
                    scene.mode = (ang_mode)mode;
                    ang_render_options all = exact;
                    all.no_skip = true;
                    ang_image truth = cast(renderer, &scene, &all), image = cast(renderer, &scene, &exact);
                    for (int i = 0; i < width * height; i++) shown += mode == ANG_MODE_DVR && truth.rgba[4 * i + 3] > 0;
                    assert_true(difference(&truth, &image) == 0);
                    ang_image_clear(&truth);
                }
            }
            ang_method_cpu.destroy(renderer);
            ang_volume_free(volume);
        }
    assert_true(shown > 0);
    ang_transfer_free(transfer);
}

/* 1 - exp(-kappa L), L from the geometry in double. */
static void check_homogeneous(const ang_volume *volume, const ang_scene *scene, const ang_render_options *options,
                              double kappa, double tolerance) {
    ang_renderer *renderer = open_renderer(&ang_method_cpu, NULL, volume);
    ang_image image = cast(renderer, scene, options);
    static const double colour[3] = {0.25, 0.5, 1};
    for (int i = 0; i < width * height; i++) {
        double alpha = -expm1(-kappa * ray_length(volume, scene, i));
        assert_true(image.rgba[4 * i + 3] >= 0 && image.rgba[4 * i + 3] <= 1);
        assert_close(image.rgba[4 * i + 3], alpha, tolerance);
        for (int c = 0; c < 3; c++) assert_close(image.rgba[4 * i + c], alpha * colour[c], tolerance);
    }
    ang_image_clear(&image);
    ang_method_cpu.destroy(renderer);
}

static void homogeneous_media_have_their_closed_form(void **state) {
    (void)state;
    static const double steps[] = {0.07, 0.5, 1, 1.3, 100};
    ang_volume *volume = sheared_volume(flat_value);
    for (int power = -6; power <= 6; power++) {
        ang_transfer *transfer = constant_transfer(pow(10, power), 0.25, 0.5, 1);
        for (size_t i = 0; i < sizeof steps / sizeof *steps; i++) {
            ang_scene scene = make_scene((int)i % SCENES, volume, transfer);
            ang_render_options options = exact;
            options.step_voxels = steps[i];
            check_homogeneous(volume, &scene, &options, pow(10, power), 1e-6);
        }
        ang_transfer_free(transfer);
    }
    ang_volume_free(volume);
    /* One voxel thick along some axes; shading without a gradient changes nothing. */
    static const int shapes[][3] = {{1, 1, 1}, {1, 8, 8}, {8, 1, 8}, {8, 8, 1}, {2, 3, 1}, {6, 6, 6}};
    static const double spacings[][3] = {{1, 1, 1}, {1, 1, 1000}, {0.3, 0.4, 5}};
    ang_transfer *transfer = constant_transfer(0.3, 0.25, 0.5, 1);
    for (size_t s = 0; s < sizeof shapes / sizeof *shapes; s++)
        for (size_t p = 0; p < sizeof spacings / sizeof *spacings; p++) {
            ang_volume *thin = make_volume(shapes[s][0], shapes[s][1], shapes[s][2], spacings[p], flat_value);
            thin->affine.m[0][3] = -1e5;
            for (int which = 0; which < 2; which++) {
                ang_scene scene = make_scene(which, thin, transfer);
                scene.shading = ANG_SHADING_PHONG;
                check_homogeneous(thin, &scene, &exact, 0.3, 2e-6);
            }
            ang_volume_free(thin);
        }
    ang_transfer_free(transfer);
}

/* A plateau at opacity 1 is a surface at any step; nothing shows where everything is transparent, for no sample. */
static void opaque_and_transparent_are_exact(void **state) {
    (void)state;
    static const ang_transfer_point points[] = {{.hu = 90, .colour = {0.5, 0.25, 1}, .opacity = 1},
                                                {.hu = 110, .colour = {0.5, 0.25, 1}, .opacity = 1}};
    ang_volume *volume = sheared_volume(flat_value);
    ang_transfer *opaque = ang_transfer_create(points, 2, 1, false, NULL, NULL);
    ang_transfer *nothing = constant_transfer(0, 1, 1, 1);
    ang_renderer *renderer = open_renderer(&ang_method_cpu, NULL, volume);
    ang_scene scene = make_scene(0, volume, opaque);
    ang_render_options fine = exact;
    fine.step_voxels = 1e-3;
    ang_image image = cast(renderer, &scene, &fine);
    int met = 0;
    for (int i = 0; i < width * height; i++) {
        if (!(ray_length(volume, &scene, i) > 1e-3)) continue;
        met++;
        assert_true(image.rgba[4 * i + 3] == 1 && image.rgba[4 * i] == 0.5f && image.rgba[4 * i + 1] == 0.25f);
    }
    assert_true(met > 100);
    ang_image_clear(&image);
    scene.transfer = nothing;
    ang_frame_stats stats = {0};
    image = draw(&ang_method_cpu, renderer, &scene, &exact, &stats);
    for (int i = 0; i < 4 * width * height; i++) assert_true(image.rgba[i] == 0);
    assert_int_equal(stats.samples, 0);
    ang_image_clear(&image);
    ang_method_cpu.destroy(renderer);
    ang_transfer_free(opaque);
    ang_transfer_free(nothing);
    ang_volume_free(volume);
}

static void padding_is_left_out_of_means(void **state) {
    (void)state;
    ang_volume *volume = sheared_volume(sparse_value);
    for (size_t i = 0; i < ang_volume_count(volume); i++)
        if (i % 7 < 2 || i / 44 % 39 > 30) volume->data[i] = 5;
    assert_true(ang_volume_mark_padding(volume, 5, NULL));
    ang_volume_update_range(volume, 1);
    ang_renderer *renderer = open_renderer(&ang_method_cpu, NULL, volume);
    ang_renderer *reference = open_renderer(&ang_method_reference, NULL, volume);
    ang_scene scene = make_scene(0, volume, NULL);
    scene.mode = ANG_MODE_MEAN;
    ang_render_options fine = exact;
    fine.step_voxels = 0.02;
    ang_image truth = draw(&ang_method_reference, reference, &scene, &exact, NULL);
    ang_image image = cast(renderer, &scene, &fine);
    assert_close(difference(&truth, &image), 0, 2e-4);
    ang_image_clear(&truth);
    ang_method_cpu.destroy(renderer);
    ang_method_reference.destroy(reference);
    ang_volume_free(volume);
}

static bool stop_at_once(void *context, const char *what, double fraction) {
    (void)what, (void)fraction;
    ++*(int *)context;
    return false;
}

static void counts_bounds_and_interruption(void **state) {
    (void)state;
    ang_volume *volume = sheared_volume(sparse_value);
    for (size_t i = 0; i < ang_volume_count(volume); i++)
        if (i % 44 < 18) volume->data[i] = 900;
    ang_transfer *transfer = vessels();
    ang_renderer *renderer = open_renderer(&ang_method_cpu, NULL, volume);
    for (int which = 0; which < SCENES; which++) {
        ang_scene scene = make_scene(which, volume, transfer);
        ang_render_options all = exact, early = exact;
        all.no_skip = true;
        early.termination = 0.95;
        static float counts[width * height];
        ang_frame_stats every = {0}, some = {.counts = counts}, few = {0};
        ang_image truth = draw(&ang_method_cpu, renderer, &scene, &all, &every);
        ang_image skipped = draw(&ang_method_cpu, renderer, &scene, &exact, &some);
        ang_image ended = draw(&ang_method_cpu, renderer, &scene, &early, &few);
        assert_true(difference(&truth, &skipped) == 0);
        double cut = difference(&truth, &ended);
        assert_true(cut > 0 && cut <= 0.05 + 1e-6);
        assert_true(some.samples < 0.8 * (double)every.samples && few.samples < some.samples);
        assert_true(some.bricks_drawn < some.bricks_total);
        /* The samples of the whole lattice are known without drawing. */
        double sum = 0, lattice = 0;
        for (int i = 0; i < width * height; i++) {
            double length = ray_length(volume, &scene, i);
            sum += counts[i];
            lattice += length > 0 ? fmax(1, ceil(length / every.step_mm - 1e-3)) : 0;
        }
        assert_true((uint64_t)sum == some.samples);
        assert_true(every.samples <= lattice && every.samples > 0.3 * lattice);
        ang_image_clear(&truth);
    }
    ang_scene scene = make_scene(0, volume, transfer);
    ang_image image;
    ang_error err = {0};
    int calls = 0;
    const ang_progress stop = {stop_at_once, &calls};
    assert_true(ang_image_create(&image, width, height, &err));
    ang_render_options one = exact;
    one.threads = 1;
    assert_false(ang_method_cpu.render(renderer, &scene, &one, &image, NULL, &stop, &err));
    assert_int_equal(err.code, ANG_INTERRUPTED);
    assert_int_equal(calls, 1);
    one.step_voxels = 0;
    assert_false(ang_method_cpu.render(renderer, &scene, &one, &image, NULL, NULL, &err));
    assert_int_equal(err.code, ANG_USAGE);
    ang_image_clear(&image);
    ang_method_cpu.destroy(renderer);
    ang_transfer_free(transfer);
    ang_volume_free(volume);
}

/* Another transfer function, mode or camera: the picture is that of a fresh renderer, and the octree is not built
 * again. */
static void nothing_is_kept_that_has_changed(void **state) {
    (void)state;
    ang_volume *volume = sheared_volume(sparse_value);
    ang_transfer *transfer = vessels(), *shifted = ang_transfer_shifted(transfer, 120, NULL);
    ang_renderer *kept = open_renderer(&ang_method_cpu, NULL, volume);
    for (int turn = 0; turn < 8; turn++) {
        ang_scene scene = make_scene(turn % SCENES, volume, turn % 3 ? transfer : shifted);
        scene.mode = turn % 4 == 3 ? ANG_MODE_ISO : turn % 4 == 2 ? ANG_MODE_MIP : ANG_MODE_DVR;
        ang_frame_stats stats = {0};
        ang_renderer *fresh = open_renderer(&ang_method_cpu, NULL, volume);
        ang_image truth = cast(fresh, &scene, &exact);
        ang_image image = draw(&ang_method_cpu, kept, &scene, &exact, &stats);
        assert_true(difference(&truth, &image) == 0);
        assert_true(turn == 0 || stats.octree_ms == 0);
        ang_image_clear(&truth);
        ang_method_cpu.destroy(fresh);
    }
    ang_method_cpu.destroy(kept);
    ang_transfer_free(transfer);
    ang_transfer_free(shifted);
    ang_volume_free(volume);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(widths_and_skipping_change_no_bit),
        cmocka_unit_test(one_bright_voxel_is_never_skipped),
        cmocka_unit_test(homogeneous_media_have_their_closed_form),
        cmocka_unit_test(opaque_and_transparent_are_exact),
        cmocka_unit_test(padding_is_left_out_of_means),
        cmocka_unit_test(counts_bounds_and_interruption),
        cmocka_unit_test(nothing_is_kept_that_has_changed),
    };
    const struct CMUnitTest with_gl[] = {cmocka_unit_test(every_scene_is_the_single_pass_picture)};
    return cmocka_run_group_tests(tests, NULL, NULL) +
           cmocka_run_group_tests_name("osmesa", with_gl, open_osmesa, close_backend);
}
