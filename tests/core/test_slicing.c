/* Slicing against itself where pictures must be the same bits, and against closed forms; on every backend here. That it
 * shows the reference's picture is test_methods' business. */
#include "tests/core/backends.h"
#include "tests/core/scenes.h"

#include "core/plan/planes.h"
#include "core/render/method.h"

#include <string.h>

static const ang_render_options exact = {.step_voxels = 0.5, .termination = 1, .pass_steps = 1};

static ang_renderer *open_renderer(ang_gl *gl, const ang_volume *volume, const ang_render_options *options) {
    ang_error err = {0};
    ang_renderer *renderer = ang_method_slicing.create(gl, volume, options, &err);
    if (!renderer) fail_msg("%s", err.message);
    return renderer;
}

static ang_image draw(ang_renderer *renderer, const ang_scene *scene, const ang_render_options *options,
                      ang_frame_stats *stats) {
    ang_error err = {0};
    ang_image image;
    assert_true(ang_image_create(&image, scene->width, scene->height, &err));
    if (!ang_method_slicing.render(renderer, scene, options, &image, stats, NULL, &err)) fail_msg("%s", err.message);
    for (int i = 0; i < 4 * image.width * image.height; i++) assert_true(isfinite(image.rgba[i]));
    return image;
}

/* The same scene again under other options. */
static double changed_by(ang_renderer *renderer, const ang_scene *scene, const ang_image *image,
                         const ang_render_options *options, ang_frame_stats *stats) {
    ang_image other = draw(renderer, scene, options, stats);
    return difference(image, &other);
}

static void homogeneous_media_at_any_step_bricks_and_extinction(void **state) {
    open_gl(state);
    ang_volume *volume = sheared_volume(flat_value);
    ang_renderer *renderer = open_renderer(gl, volume, &exact);
    for (int which = 0; which < SCENES; which++)
        for (int power = -6; power <= 6; power += 3) {
            double kappa = pow(10, power);
            ang_transfer *transfer = constant_transfer(kappa, 0.25, 0.5, 1);
            ang_scene scene = make_scene(which, volume, transfer);
            static const double steps[] = {0.07, 0.5, 1.3, 100};
            for (size_t i = 0; i < sizeof steps / sizeof *steps; i++) {
                ang_render_options options = exact;
                options.step_voxels = steps[i];
                if (i == 1) memcpy(options.bricks, (const int[3]){5, 3, 4}, sizeof options.bricks);
                ang_image image = draw(renderer, &scene, &options, NULL);
                for (int p = 0; p < width * height; p++) {
                    double alpha = -expm1(-kappa * ray_length(volume, &scene, p));
                    /* Rays that graze an edge of the box are as uncertain as its float coordinates. */
                    double tolerance = 4e-6 + fmin(2e-5 * kappa, 4e-4);
                    assert_close(image.rgba[4 * p + 3], alpha, tolerance);
                    assert_close(image.rgba[4 * p], 0.25 * alpha, tolerance);
                }
                ang_image_clear(&image);
            }
            ang_transfer_free(transfer);
        }
    ang_method_slicing.destroy(renderer);
    ang_volume_free(volume);
}

/* Bricks of equal and of mixed size, skipping and proxies decide what is drawn, never what is seen: the same bits.
 * Every sample is drawn once: the counts agree as well. */
static void bricks_skipping_and_proxies_change_no_bit(void **state) {
    open_gl(state);
    ang_volume *volume = sheared_volume(sparse_value);
    ang_transfer *transfer = vessels();
    ang_renderer *renderer = open_renderer(gl, volume, &exact);
    for (int which = 0; which < SCENES; which++)
        for (int mode = ANG_MODE_DVR; mode <= ANG_MODE_ISO; mode++) {
            ang_scene scene = make_scene(which, volume, transfer);
            scene.mode = (ang_mode)mode;
            scene.shading = which % 2 ? ANG_SHADING_PHONG : ANG_SHADING_NONE;
            ang_render_options plain = exact;
            plain.no_skip = true;
            ang_frame_stats whole = {0}, stats = {0};
            ang_image image = draw(renderer, &scene, &plain, &whole);
            bool once = mode != ANG_MODE_ISO; /* a hit hides what comes after, so that fewer samples are drawn */

            static const int bricks[][3] = {{1, 1, 1}, {2, 2, 1}, {3, 5, 2}, {8, 7, 6}, {64, 64, 64}};
            for (size_t b = 0; b < sizeof bricks / sizeof *bricks; b++) {
                if (b == 4 && which != 0) continue;
                ang_render_options options = plain;
                memcpy(options.bricks, bricks[b], sizeof options.bricks);
                assert_true(changed_by(renderer, &scene, &image, &options, &stats) == 0);
                if (once) assert_int_equal(stats.samples, whole.samples);
                options.no_skip = false;
                assert_true(changed_by(renderer, &scene, &image, &options, &stats) == 0);
                assert_true(stats.samples <= whole.samples);
            }
            assert_true(changed_by(renderer, &scene, &image, &exact, &stats) == 0);
            for (int proxy = ANG_PROXY_VERTEX_PROGRAM; proxy <= ANG_PROXY_CONVEX_HULL; proxy++) {
                ang_render_options options = exact;
                options.proxy = (ang_proxy)proxy;
                assert_true(changed_by(renderer, &scene, &image, &options, NULL) == 0);
                memcpy(options.bricks, bricks[2], sizeof options.bricks);
                ang_frame_stats again = {0};
                assert_true(changed_by(renderer, &scene, &image, &options, &again) == 0);
            }
            ang_image_clear(&image);
        }
    ang_method_slicing.destroy(renderer);
    ang_transfer_free(transfer);
    ang_volume_free(volume);
}

/* Which planes are composited before they blend changes the order of roundings alone. */
static void groups_of_planes_change_rounding_alone(void **state) {
    open_gl(state);
    ang_volume *volume = sheared_volume(sparse_value);
    ang_transfer *transfer = vessels();
    ang_renderer *renderer = open_renderer(gl, volume, &exact);
    for (int which = 0; which < SCENES; which++)
        for (int mode = ANG_MODE_DVR; mode <= ANG_MODE_ISO; mode++)
            for (int group = 0; group <= 4; group += 2) {
                ang_scene scene = make_scene(which, volume, transfer);
                scene.mode = (ang_mode)mode;
                scene.shading = which % 2 ? ANG_SHADING_PHONG : ANG_SHADING_NONE;
                ang_frame_stats one = {0}, grouped = {0};
                ang_image image = draw(renderer, &scene, &exact, &one);
                ang_render_options options = exact;
                options.pass_steps = group;
                options.no_skip = true;
                memcpy(options.bricks, (const int[3]){3, 5, 2}, sizeof options.bricks);
                bool extreme = mode == ANG_MODE_MIP || mode == ANG_MODE_MINIP || mode == ANG_MODE_ISO;
                double change = changed_by(renderer, &scene, &image, &options, &grouped);
                assert_true(change <= (extreme ? 0 : 1e-6));
                options.proxy = ANG_PROXY_MARCHING_CUBES;
                assert_true(changed_by(renderer, &scene, &image, &options, NULL) <= (extreme ? 0 : 1e-6));
                options.no_skip = false;
                assert_true(changed_by(renderer, &scene, &image, &options, NULL) <= (extreme ? 0 : 1e-6));
                if (mode != ANG_MODE_ISO) assert_true(grouped.samples >= one.samples);
                ang_image_clear(&image);
            }
    ang_method_slicing.destroy(renderer);
    ang_transfer_free(transfer);
    ang_volume_free(volume);
}

/* Samples that a ray method's lattice of planes would take, counted in double. */
static uint64_t count_samples(const ang_volume *volume, const ang_scene *scene, double step) {
    ang_ray_frame frame;
    assert_true(ang_ray_frame_make(volume, scene, &frame, NULL));
    ang_slice_planes planes = ang_slice_planes_make(&frame, step);
    uint64_t count = 0;
    for (int p = 0; p < width * height; p++) {
        ang_ray ray = ang_ray_through(&frame, p % width + 0.5, p / width + 0.5);
        if (!(ray.enter < ray.leave)) continue;
        double cosine = ang_vec3_dot(ray.direction_mm, frame.axis_mm);
        double from = ceil((ray.enter * cosine - planes.first) / planes.distance);
        double to = floor((ray.leave * cosine - planes.first) / planes.distance);
        from = fmax(from, 0);
        to = fmin(to, planes.count - 1);
        count += to >= from ? (uint64_t)(to - from) + 1 : 1; /* between two planes: half-way */
    }
    return count;
}

static void every_sample_is_drawn_once(void **state) {
    open_gl(state);
    ang_volume *volume = sheared_volume(flat_value);
    ang_transfer *transfer = constant_transfer(0.1, 1, 1, 1);
    ang_renderer *renderer = open_renderer(gl, volume, &exact);
    for (int which = 0; which < SCENES; which++) {
        ang_scene scene = make_scene(which, volume, transfer);
        ang_frame_stats stats = {0};
        ang_render_options options = exact;
        memcpy(options.bricks, (const int[3]){4, 5, 3}, sizeof options.bricks);
        ang_image image = draw(renderer, &scene, &options, &stats);
        ang_image_clear(&image);
        double expected = (double)count_samples(volume, &scene, 0.5 * ang_volume_smallest_spacing(volume));
        /* A few lie on a face to rounding. */
        assert_close((double)stats.samples, expected, 1e-4 * expected);
        if (which < 2) assert_int_equal(stats.bricks_drawn, 60);
        assert_int_equal(stats.bricks_total, 60);
    }
    ang_method_slicing.destroy(renderer);
    ang_transfer_free(transfer);
    ang_volume_free(volume);
}

static void nothing_to_see_draws_nothing(void **state) {
    open_gl(state);
    ang_volume *volume = sheared_volume(sparse_value);
    ang_transfer *transfer = constant_transfer(0, 1, 1, 1);
    ang_renderer *renderer = open_renderer(gl, volume, &exact);
    ang_scene scene = make_scene(0, volume, transfer);
    ang_frame_stats stats = {0};
    ang_image image = draw(renderer, &scene, &exact, &stats);
    for (int i = 0; i < 4 * width * height; i++) assert_true(image.rgba[i] == 0);
    assert_int_equal(stats.samples, 0);
    assert_int_equal(stats.polygons, 0);
    ang_image_clear(&image);
    ang_method_slicing.destroy(renderer);
    ang_transfer_free(transfer);
    ang_volume_free(volume);
}

static void termination_spares_samples_within_its_bound(void **state) {
    open_gl(state);
    ang_volume *volume = sheared_volume(flat_value);
    ang_transfer *dense = constant_transfer(2, 0.25, 0.5, 1), *thin = constant_transfer(1e-4, 1, 1, 1);
    ang_renderer *renderer = open_renderer(gl, volume, &exact);
    ang_scene scene = make_scene(0, volume, dense);
    ang_frame_stats all = {0}, some = {0};
    ang_render_options fine = exact;
    fine.step_voxels = 0.1;
    ang_image image = draw(renderer, &scene, &fine, &all);
    assert_int_equal(all.passes, 1);
    static const double thresholds[] = {0.5, 0.95, 0.999};
    for (size_t i = 0; i < sizeof thresholds / sizeof *thresholds; i++) {
        ang_render_options options = exact;
        options.termination = thresholds[i];
        options.step_voxels = fine.step_voxels;
        double change = changed_by(renderer, &scene, &image, &options, &some);
        assert_true(some.samples < 0.8 * (double)all.samples);
        assert_true(some.passes > 2);
        assert_true(change <= 1 - thresholds[i] + 1e-6);
    }
    ang_image_clear(&image);

    scene.transfer = thin; /* cannot reach the threshold: no looks for finished pixels, back to front */
    ang_render_options options = exact;
    options.termination = 0.999;
    image = draw(renderer, &scene, &options, &some);
    assert_int_equal(some.passes, 1);
    ang_plan plan = {0};
    assert_true(ang_method_slicing.explain(renderer, &scene, &options, &plan, NULL));
    bool said = false;
    for (size_t i = 0; i < plan.left_out.count; i++)
        said = said || strstr(plan.left_out.item[i].why, "no ray can reach the threshold");
    assert_true(said);
    ang_plan_clear(&plan);
    ang_image_clear(&image);
    ang_method_slicing.destroy(renderer);
    ang_transfer_free(dense);
    ang_transfer_free(thin);
    ang_volume_free(volume);
}

/* A volume that the budget does not hold is drawn from bricks: bit for bit the same picture where weights are made in
 * the shader; with the texture unit's but for the rounding of its coordinates, which are shares of another size. */
static void a_memory_budget_streams_bricks(void **state) {
    open_gl(state);
    static const double spacing[3] = {0.8, 0.9, 1.4};
    ang_volume *volume = make_volume(101, 77, 83, spacing, sparse_value);
    volume->affine.m[1][2] = 0.5;
    ang_transfer *transfer = vessels();
    ang_render_options small = exact;
    small.gpu_memory = 300000;
    ang_renderer *whole = open_renderer(gl, volume, &exact), *bricks = open_renderer(gl, volume, &small);
    for (int which = 0; which < SCENES; which++)
        for (int mode = ANG_MODE_DVR; mode <= ANG_MODE_ISO; mode++)
            for (int manual = 0; manual < 2; manual++) {
                ang_scene scene = make_scene(which, volume, transfer);
                scene.mode = (ang_mode)mode;
                scene.shading = which % 2 ? ANG_SHADING_PHONG : ANG_SHADING_NONE;
                ang_render_options options = exact;
                options.manual_filter = manual;
                ang_frame_stats stats = {0};
                ang_image image = draw(whole, &scene, &options, NULL);
                double change = changed_by(bricks, &scene, &image, &options, &stats);
                if (!(change <= (manual ? 0 : 5e-5)))
                    fail_msg("scene %d, mode %d, manual %d: %g", which, mode, manual, change);
                assert_true(stats.bricks_uploaded > 0);
                assert_non_null(stats.note);
                assert_non_null(strstr(stats.note, "--gpu-memory"));
                ang_image_clear(&image);
            }
    ang_method_slicing.destroy(whole);
    ang_method_slicing.destroy(bricks);

    /* Invisible bricks are never uploaded, and what is there is not uploaded again. */
    ang_render_options options = exact;
    options.gpu_memory = 2 * ang_volume_count(volume) - 1;
    for (size_t i = 0; i < ang_volume_count(volume); i++)
        if (i / (101 * 77) > 30) volume->data[i] = 0;
    bricks = open_renderer(gl, volume, &options);
    ang_scene scene = make_scene(0, volume, transfer);
    ang_frame_stats first = {0}, second = {0};
    ang_image image = draw(bricks, &scene, &options, &first);
    assert_true(changed_by(bricks, &scene, &image, &options, &second) == 0);
    ang_render_options all = options;
    all.no_skip = true;
    ang_frame_stats third = {0};
    assert_true(changed_by(bricks, &scene, &image, &all, &third) == 0);
    assert_true(first.bricks_uploaded > 0);
    assert_int_equal(second.bricks_uploaded, 0);
    assert_true(third.bricks_uploaded >= first.bricks_uploaded);
    ang_image_clear(&image);
    ang_method_slicing.destroy(bricks);

    /* Where a still view needs more bricks than fit, those that fit stay. */
    memcpy(options.bricks, (const int[3]){6, 5, 5}, sizeof options.bricks);
    options.gpu_memory = 700000;
    bricks = open_renderer(gl, volume, &options);
    image = draw(bricks, &scene, &options, &first);
    for (int again = 0; again < 3; again++) {
        assert_true(changed_by(bricks, &scene, &image, &options, &second) == 0);
        assert_true(second.bricks_uploaded > 0);
        assert_true(second.bricks_uploaded < 0.75 * first.bricks_uploaded);
    }
    ang_image_clear(&image);
    ang_method_slicing.destroy(bricks);

    /* A budget below the least brick is refused. */
    options.gpu_memory = 100;
    bricks = open_renderer(gl, volume, &options);
    ang_error err = {0};
    assert_true(ang_image_create(&image, scene.width, scene.height, &err));
    assert_false(ang_method_slicing.render(bricks, &scene, &options, &image, NULL, NULL, &err));
    assert_int_equal(err.code, ANG_LIMIT);
    assert_non_null(strstr(err.message, "--gpu-memory"));
    ang_image_clear(&image);
    ang_method_slicing.destroy(bricks);
    ang_transfer_free(transfer);
    ang_volume_free(volume);
}

static void thin_volumes_and_great_steps(void **state) {
    open_gl(state);
    static const int shapes[][3] = {{1, 1, 1}, {1, 8, 8}, {8, 1, 8}, {8, 8, 1}, {6, 6, 6}};
    static const double spacings[][3] = {{1, 1, 1}, {1, 1, 1000}, {0.3, 0.4, 5}};
    ang_transfer *transfer = constant_transfer(0.3, 0.25, 0.5, 1);
    for (size_t s = 0; s < sizeof shapes / sizeof *shapes; s++)
        for (size_t p = 0; p < sizeof spacings / sizeof *spacings; p++) {
            const int *n = shapes[s];
            ang_volume *volume = make_volume(n[0], n[1], n[2], spacings[p], flat_value);
            volume->affine.m[0][3] = -1e5;
            ang_renderer *renderer = open_renderer(gl, volume, &exact);
            ang_scene scene = make_scene(0, volume, transfer);
            /* Places in float. */
            double tolerance = 2e-5 + 0.3 * 2e-7 * ang_volume_half_diagonal(volume);
            scene.shading = ANG_SHADING_PHONG; /* without a gradient it changes nothing */
            for (int inside = 0; inside < 2; inside++) {
                if (inside) {
                    scene.camera.eye = ang_vec3_along(ang_volume_centre(volume), scene.camera.right, 0.1);
                    scene.camera.fov_deg = 120;
                }
                ang_render_options options = exact;
                options.step_voxels = inside ? 0.5 : 7;
                ang_image image = draw(renderer, &scene, &options, NULL);
                for (int i = 0; i < width * height; i++)
                    assert_close(image.rgba[4 * i + 3], -expm1(-0.3 * ray_length(volume, &scene, i)), tolerance);
                ang_image_clear(&image);
            }
            ang_method_slicing.destroy(renderer);
            ang_volume_free(volume);
        }
    ang_transfer_free(transfer);
}

/* Opacity of a homogeneous medium along every ray of the box. */
static void check_every_ray(ang_renderer *renderer, const ang_volume *volume, const ang_scene *scene, double step,
                            int group) {
    ang_render_options options = exact;
    options.step_voxels = step;
    options.pass_steps = group;
    ang_image image = draw(renderer, scene, &options, NULL);
    for (int p = 0; p < scene->width * scene->height; p++)
        assert_close(image.rgba[4 * p + 3], -expm1(-0.7 * ray_length(volume, scene, p)), 6e-5);
    ang_image_clear(&image);
}

/* Slabs thinner than a step, and flat clip boxes: rays that meet the box between two planes or behind the last. */
static void thin_slabs_seen_obliquely_have_no_holes(void **state) {
    open_gl(state);
    static const double unit[3] = {1, 1, 1};
    ang_volume *slab = make_volume(104, 104, 2, unit, flat_value), *block = sheared_volume(flat_value);
    ang_transfer *transfer = constant_transfer(0.7, 0.25, 0.5, 1);
    ang_renderer *of_slab = open_renderer(gl, slab, &exact), *of_block = open_renderer(gl, block, &exact);
    ang_view view = ang_view_default;
    for (int k = 0; k < 40; k++) {
        view.projection = k & 1 ? ANG_PERSPECTIVE : ANG_PARALLEL;
        view.azimuth_deg = k < 20 ? 0 : 13 * k;
        view.elevation_deg = k < 20 ? 64 : 5 * k - 150;
        ang_scene scene = make_scene(1, slab, transfer), clipped = make_scene(1, block, transfer);
        scene.camera = ang_camera_for(slab, &view);
        scene.height = 150;
        check_every_ray(of_slab, slab, &scene, 3 + 0.1 * k, k & 2 ? 2 : 1);
        check_every_ray(of_slab, slab, &scene, 3 + 0.1 * k, k & 2 ? 1 : 4);
        clipped.camera = ang_camera_for(block, &view);
        assert_true(ang_scene_clip_parse("10,30,12,12.4,3,35", block, &clipped, NULL));
        check_every_ray(of_block, block, &clipped, 0.3 + 0.05 * k, 1);
    }
    ang_method_slicing.destroy(of_slab);
    ang_method_slicing.destroy(of_block);
    ang_transfer_free(transfer);
    ang_volume_free(slab);
    ang_volume_free(block);
}

static void bricks_are_shown_as_edges(void **state) {
    open_gl(state);
    ang_volume *volume = sheared_volume(sparse_value);
    ang_transfer *transfer = vessels();
    ang_renderer *renderer = open_renderer(gl, volume, &exact);
    for (int mode = ANG_MODE_DVR; mode <= ANG_MODE_MIP; mode++) {
        ang_scene scene = make_scene(0, volume, transfer);
        scene.mode = (ang_mode)mode;
        ang_image image = draw(renderer, &scene, &exact, NULL);
        ang_render_options options = exact;
        options.show_bricks = true;
        ang_frame_stats plain = {0}, edged = {0};
        ang_image again = draw(renderer, &scene, &exact, &plain), other = draw(renderer, &scene, &options, &edged);
        assert_int_equal(plain.samples, edged.samples);
        ang_image_clear(&again);
        int changed = 0;
        for (int p = 0; p < width * height; p++)
            changed += memcmp(image.rgba + 4 * p, other.rgba + 4 * p, 4 * sizeof(float)) != 0;
        assert_in_range(changed, 100, width * height * 3 / 4);
        ang_image_clear(&image);
        ang_image_clear(&other);
    }
    ang_method_slicing.destroy(renderer);
    ang_transfer_free(transfer);
    ang_volume_free(volume);
}

static bool stop_at_once(void *context, const char *what, double fraction) {
    (void)what, (void)fraction;
    ++*(int *)context;
    return false;
}

static void refusals_and_interruption(void **state) {
    open_gl(state);
    ang_volume *volume = sheared_volume(flat_value);
    ang_transfer *transfer = constant_transfer(1, 1, 1, 1);
    ang_renderer *renderer = open_renderer(gl, volume, &exact);
    ang_scene scene = make_scene(0, volume, NULL);
    ang_image image;
    ang_error err = {0};
    assert_true(ang_image_create(&image, width, height, &err));
    assert_false(ang_method_slicing.render(renderer, &scene, &exact, &image, NULL, NULL, &err));
    assert_int_equal(err.code, ANG_USAGE);
    scene.transfer = transfer;
    int calls = 0;
    ang_progress progress = {stop_at_once, &calls};
    ang_render_options options = exact;
    options.termination = 0.9;
    assert_false(ang_method_slicing.render(renderer, &scene, &options, &image, NULL, &progress, &err));
    assert_int_equal(err.code, ANG_INTERRUPTED);
    assert_int_equal(calls, 1);
    options.step_voxels = 0;
    assert_false(ang_method_slicing.render(renderer, &scene, &options, &image, NULL, NULL, &err));
    assert_int_equal(err.code, ANG_USAGE);
    assert_null(ang_method_slicing.create(NULL, volume, &exact, &err));
    assert_int_equal(err.code, ANG_GL);
    ang_image_clear(&image);
    ang_method_slicing.destroy(renderer);
    ang_transfer_free(transfer);
    ang_volume_free(volume);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(homogeneous_media_at_any_step_bricks_and_extinction),
        cmocka_unit_test(bricks_skipping_and_proxies_change_no_bit),
        cmocka_unit_test(groups_of_planes_change_rounding_alone),
        cmocka_unit_test(every_sample_is_drawn_once),
        cmocka_unit_test(nothing_to_see_draws_nothing),
        cmocka_unit_test(termination_spares_samples_within_its_bound),
        cmocka_unit_test(a_memory_budget_streams_bricks),
        cmocka_unit_test(thin_volumes_and_great_steps),
        cmocka_unit_test(thin_slabs_seen_obliquely_have_no_holes),
        cmocka_unit_test(bricks_are_shown_as_edges),
        cmocka_unit_test(refusals_and_interruption),
    };
    return run_on_backends(tests);
}
