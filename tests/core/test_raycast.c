/* Ray casting in passes against the single pass, whose samples it takes, and against closed forms; on every backend
 * here. That it shows the reference's picture is test_methods' business. */
#include "tests/core/backends.h"
#include "tests/core/scenes.h"

#include "core/render/block_ranges.h"
#include "core/render/method.h"

#include <string.h>

static double ramp_y(int x, int y, int z) {
    (void)x, (void)z;
    return 10 * y;
}
static double distance_value(int x, int y, int z) {
    return fmax(900 - 30 * sqrt((x - 21) * (x - 21) + (y - 19) * (y - 19) + (z - 14) * (z - 14)), 0);
}

/* Empty on one side, so that there is something to skip. */
static double half_value(int x, int y, int z) { return x > 20 ? sparse_value(x, y, z) : -50; }

static const ang_render_options exact = {.step_voxels = 0.5, .termination = 1};

static ang_renderer *open_renderer(const ang_method *method, ang_gl *gl, const ang_volume *volume) {
    ang_error err = {0};
    ang_renderer *renderer = method->create(gl, volume, &exact, &err);
    if (!renderer) fail_msg("%s", err.message);
    return renderer;
}

static ang_image draw_with(const ang_method *method, ang_renderer *renderer, const ang_scene *scene,
                           const ang_render_options *options, ang_frame_stats *stats) {
    ang_error err = {0};
    ang_image image;
    assert_true(ang_image_create(&image, scene->width, scene->height, &err));
    if (!method->render(renderer, scene, options, &image, stats, NULL, &err)) fail_msg("%s", err.message);
    for (int i = 0; i < 4 * image.width * image.height; i++) assert_true(isfinite(image.rgba[i]));
    return image;
}

static ang_image draw(ang_renderer *renderer, const ang_scene *scene, const ang_render_options *options,
                      ang_frame_stats *stats) {
    return draw_with(&ang_method_raycast, renderer, scene, options, stats);
}

/* The greatest difference of the scene under other options from a picture. */
static double changed_by(ang_renderer *renderer, const ang_scene *scene, const ang_image *image,
                         const ang_render_options *options, ang_frame_stats *stats) {
    ang_image other = draw(renderer, scene, options, stats);
    return difference(image, &other);
}

/* Single pixels of an outline where a ray just touches a surface may differ: the shaders' samples do by rounding. */
static void check_same(const ang_image *a, ang_image *b, bool surface, const char *what) {
    int flipped = 0;
    for (int p = 0; p < a->width * a->height; p++) {
        double change = 0;
        for (int c = 0; c < 4; c++) change = fmax(change, fabs((double)a->rgba[4 * p + c] - b->rgba[4 * p + c]));
        if (!(change <= (surface ? 2e-5 : 1e-6))) flipped++;
        if (!surface && flipped) fail_msg("%s, pixel %d: %g", what, p, change);
    }
    if (flipped > 1) fail_msg("%s: %d pixels differ", what, flipped);
    ang_image_clear(b);
}

/* In all modes, projections and shadings, whatever a pass takes; skipping changes no bit, whichever passes find what to
 * skip. */
static void the_single_pass_is_repeated(void **state) {
    open_gl(state);
    static const int steps[] = {1, 3, 8, 64, 0};
    ang_volume *volume = sheared_volume(half_value);
    ang_transfer *transfer = vessels();
    ang_renderer *single = open_renderer(&ang_method_singlepass, gl, volume);
    ang_renderer *renderer = open_renderer(&ang_method_raycast, gl, volume);
    for (int which = 0; which < SCENES; which++)
        for (int mode = ANG_MODE_DVR; mode <= ANG_MODE_ISO; mode++)
            for (int shading = 0; shading < (mode == ANG_MODE_DVR ? 2 : 1); shading++)
                for (size_t m = 0; m < sizeof steps / sizeof *steps; m++) {
                    ang_scene scene = make_scene(which, volume, transfer);
                    scene.mode = (ang_mode)mode;
                    scene.shading = (ang_shading)shading;
                    char what[80];
                    snprintf(what, sizeof what, "scene %d, mode %d, shading %d, steps %d", which, mode, shading,
                             steps[m]);
                    ang_render_options options = exact;
                    options.manual_filter = which == 1;
                    ang_frame_stats once = {0}, whole = {0}, skipped = {0}, separate = {0};
                    ang_image truth = draw_with(&ang_method_singlepass, single, &scene, &options, &once);
                    options.no_skip = true;
                    options.pass_steps = steps[m];
                    ang_image image = draw(renderer, &scene, &options, &whole);
                    options.no_skip = false;
                    double change = changed_by(renderer, &scene, &image, &options, &skipped);
                    if (change != 0) fail_msg("%s, skipping: %g", what, change);
                    options.separate_passes = true;
                    change = changed_by(renderer, &scene, &image, &options, &separate);
                    if (change != 0) fail_msg("%s, separate: %g", what, change);
                    assert_int_equal(whole.fragments, once.fragments);
                    assert_int_equal(skipped.samples, separate.samples);
                    if (mode != ANG_MODE_ISO) assert_int_equal(whole.samples, once.samples);
                    if (skipped.bricks_drawn < skipped.bricks_total && steps[m] > 0 && steps[m] <= 8)
                        assert_true(skipped.samples < whole.samples);
                    check_same(&truth, &image, mode == ANG_MODE_ISO, what);
                    ang_image_clear(&truth);
                }
    ang_method_singlepass.destroy(single);
    ang_method_raycast.destroy(renderer);
    ang_transfer_free(transfer);
    ang_volume_free(volume);
}

static void homogeneous_media_at_any_step_and_extinction(void **state) {
    open_gl(state);
    static const int shapes[][3] = {{1, 1, 1}, {1, 8, 8}, {8, 1, 8}, {44, 39, 30}};
    static const double spacing[3] = {0.8, 0.9, 30};
    for (size_t s = 0; s < sizeof shapes / sizeof *shapes; s++) {
        ang_volume *volume = make_volume(shapes[s][0], shapes[s][1], shapes[s][2], spacing, flat_value);
        volume->affine.m[1][2] = 0.5;
        /* An affine that mirrors turns the faces of the box round. */
        if (s == 3) volume->affine.m[0][0] = -0.8;
        ang_renderer *renderer = open_renderer(&ang_method_raycast, gl, volume);
        for (int which = 0; which < SCENES; which++)
            for (int power = -6; power <= 6; power += 3) {
                double kappa = pow(10, power);
                ang_transfer *transfer = constant_transfer(kappa, 0.25, 0.5, 1);
                ang_scene scene = make_scene(which, volume, transfer);
                if (which == 2) scene.clip_lower = ang_scene_default(volume).clip_lower;
                ang_render_options options = exact;
                options.step_voxels = which % 2 ? 0.5 : 7;
                options.pass_steps = 5;
                options.separate_passes = which % 2;
                ang_image image = draw(renderer, &scene, &options, NULL);
                double tolerance = 4e-6 + fmin(4e-5 * kappa, 4e-3);
                for (int p = 0; p < width * height; p++) {
                    double alpha = -expm1(-kappa * ray_length(volume, &scene, p));
                    assert_close(image.rgba[4 * p + 3], alpha, tolerance);
                    assert_close(image.rgba[4 * p], 0.25 * alpha, tolerance);
                }
                ang_image_clear(&image);
                ang_transfer_free(transfer);
            }
        ang_method_raycast.destroy(renderer);
        ang_volume_free(volume);
    }
}

static void nothing_to_see_takes_no_sample(void **state) {
    open_gl(state);
    ang_volume *volume = sheared_volume(half_value);
    ang_transfer *transfer = constant_transfer(0, 1, 1, 1);
    ang_renderer *renderer = open_renderer(&ang_method_raycast, gl, volume);
    for (int which = 0; which < SCENES; which++)
        for (int separate = 0; separate < 2; separate++) {
            ang_scene scene = make_scene(which, volume, transfer);
            ang_render_options options = exact;
            options.separate_passes = separate;
            ang_frame_stats stats = {0};
            ang_image image = draw(renderer, &scene, &options, &stats);
            for (int i = 0; i < 4 * width * height; i++) assert_true(image.rgba[i] == 0);
            assert_int_equal(stats.samples, 0);
            assert_int_equal(stats.bricks_drawn, 0);
            assert_int_equal(stats.fragments, 0);
            assert_int_equal(stats.passes, 0);
            ang_image_clear(&image);
        }
    ang_method_raycast.destroy(renderer);
    ang_transfer_free(transfer);
    ang_volume_free(volume);
}

static bool says(const ang_plan_items *items, const char *text) {
    for (size_t i = 0; i < items->count; i++)
        if (items->item[i].why && strstr(items->item[i].why, text)) return true;
    return false;
}

static void termination_spares_samples_within_its_bound(void **state) {
    open_gl(state);
    ang_volume *volume = sheared_volume(flat_value);
    ang_transfer *dense = constant_transfer(2, 0.25, 0.5, 1), *thin = constant_transfer(1e-4, 1, 1, 1);
    ang_renderer *renderer = open_renderer(&ang_method_raycast, gl, volume);
    ang_scene scene = make_scene(0, volume, dense);
    ang_frame_stats all = {0}, some = {0};
    ang_render_options options = exact;
    options.step_voxels = 0.1;
    options.pass_steps = 8;
    ang_image image = draw(renderer, &scene, &options, &all);
    static const double thresholds[] = {0.5, 0.95, 0.999};
    for (size_t i = 0; i < sizeof thresholds / sizeof *thresholds; i++) {
        options.termination = thresholds[i];
        float counts[width * height];
        some.counts = counts;
        double change = changed_by(renderer, &scene, &image, &options, &some), sum = 0;
        for (int p = 0; p < width * height; p++) sum += (double)counts[p];
        assert_true(sum == (double)some.samples);
        assert_true((double)some.samples < 0.5 * (double)all.samples);
        assert_true(change <= 1 - thresholds[i] + 1e-6);
    }
    ang_image_clear(&image);
    scene.transfer = thin;
    ang_plan plan = {0};
    assert_true(ang_method_raycast.explain(renderer, &scene, &options, &plan, NULL));
    assert_true(says(&plan.left_out, "no ray can reach the threshold"));
    assert_true(says(&plan.left_out, "no block of the volume is invisible"));
    assert_true(says(&plan.left_out, "nothing is skipped or ends early"));
    assert_int_equal(plan.pass_count, 2);
    ang_plan_clear(&plan);
    ang_method_raycast.destroy(renderer);
    ang_transfer_free(dense);
    ang_transfer_free(thin);
    ang_volume_free(volume);
}

/* A plane across the rays, and a clip box that ends 1e-4 voxels behind it, where every ray meets it between its last
 * sample and its end, or as much before it, where none does. That hits are refined as in the single pass is shown
 * above, by their shading. */
static void surfaces_lie_where_they_should(void **state) {
    open_gl(state);
    static const double unit[3] = {1, 1, 1};
    ang_transfer *transfer = vessels();
    ang_volume *volume = make_volume(8, 41, 8, unit, ramp_y);
    ang_renderer *renderer = open_renderer(&ang_method_raycast, gl, volume);
    ang_scene scene = make_scene(1, volume, transfer);
    ang_view view = ang_view_default;
    view.projection = ANG_PARALLEL;
    scene.camera = ang_camera_for(volume, &view); /* along +y */
    scene.mode = ANG_MODE_ISO;
    for (int k = 0; k < 40; k++) {
        double place = 3.01 + 0.87 * k;
        scene.iso_hu = 10 * place;
        ang_render_options options = exact;
        options.pass_steps = 1 + k % 9;
        ang_image shown[2];
        for (int before = 0; before < 2; before++) {
            scene.clip_upper.y = place + (before ? -1e-4 : 1e-4);
            shown[before] = draw(renderer, &scene, &options, NULL);
        }
        for (int p = 0; p < width * height; p++) {
            double length = ray_length(volume, &scene, p);
            assert_true(shown[0].rgba[4 * p + 3] == (length > 0 ? 1 : 0));
            assert_true(shown[1].rgba[4 * p + 3] == 0);
        }
        for (int before = 0; before < 2; before++) ang_image_clear(&shown[before]);
        scene.clip_upper.y = 40;
    }
    ang_method_raycast.destroy(renderer);
    ang_volume_free(volume);
    ang_transfer_free(transfer);
}

/* A ball of 10 voxels: rays within that of its middle meet it, whichever passes there are. */
static void balls_have_their_silhouette(void **state) {
    open_gl(state);
    static const double unit[3] = {1, 1, 1};
    ang_volume *volume = make_volume(44, 39, 30, unit, distance_value);
    ang_transfer *transfer = vessels();
    ang_renderer *renderer = open_renderer(&ang_method_raycast, gl, volume);
    ang_ray_frame frame;
    for (int which = 0; which < 2; which++) {
        ang_scene scene = make_scene(which, volume, transfer);
        scene.mode = ANG_MODE_ISO;
        scene.iso_hu = 600; /* 10 voxels from the middle */
        ang_render_options options = exact;
        options.termination = 0.999;
        options.separate_passes = which;
        ang_image image = draw(renderer, &scene, &options, NULL);
        assert_true(ang_ray_frame_make(volume, &scene, &frame, NULL));
        int hits = 0;
        for (int p = 0; p < width * height; p++) {
            ang_ray ray = ang_ray_through(&frame, p % width + 0.5, p / width + 0.5);
            ang_vec3 from = ang_vec3_sub((ang_vec3){21, 19, 14}, ang_vec3_add(ray.origin, frame.centre));
            double along = ang_vec3_dot(from, ray.direction_mm);
            double off = ang_vec3_length(ang_vec3_along(from, ray.direction_mm, -along));
            if (fabs(off - 10) > 0.3) assert_true(image.rgba[4 * p + 3] == (off < 10));
            hits += image.rgba[4 * p + 3] > 0;
        }
        assert_true(hits > 100);
        ang_image_clear(&image);
    }
    ang_method_raycast.destroy(renderer);
    ang_transfer_free(transfer);
    ang_volume_free(volume);
}

/* What the table calls invisible is, for any range and any scene. */
static void the_table_of_ranges_is_conservative(void **state) {
    (void)state;
    uint64_t seed = 88172645463325252u;
    ang_volume *volume = sheared_volume(half_value);
    ang_transfer *transfer = vessels();
    uint8_t *table = malloc((size_t)ANG_BLOCK_LEVELS * ANG_BLOCK_LEVELS);
    assert_non_null(table);
    int left_out = 0;
    for (int round = 0; round < 40; round++) {
        uint16_t lowest = (uint16_t)(65535 * random_unit(&seed)), highest = lowest;
        if (round % 8) highest = (uint16_t)(lowest + (65535 - lowest) * pow(random_unit(&seed), 3));
        double middle = lowest + random_unit(&seed) * (highest - lowest);
        ang_transfer *moved = ang_transfer_shifted(transfer, middle - 1024 - 300, NULL);
        assert_non_null(moved);
        ang_transfer_tables *tables = ang_tables_create(moved, 1, -1024, lowest, highest, 0, NULL);
        assert_non_null(tables);
        ang_scene scene = make_scene(0, volume, moved);
        scene.mode = (ang_mode)(round % 5);
        scene.iso_hu = scene.window_centre = middle - 1024;
        ang_visibility visibility = ang_visibility_make(volume, &scene, tables);
        ang_block_table(&visibility, lowest, highest, table);
        for (int k = 0; k < 20000; k++) {
            double span = highest - lowest, a = random_unit(&seed), b = pow(random_unit(&seed), 4);
            ang_minmax range = {.min = (uint16_t)(lowest + a * span)};
            range.max = (uint16_t)(range.min + b * (highest - range.min));
            bool shows = table[ang_block_entry(lowest, highest, range)] > 0;
            if (!shows) assert_false(ang_visibility_of(&visibility, range));
            left_out += !shows;
        }
        ang_tables_free(tables);
        ang_transfer_free(moved);
    }
    assert_true(left_out > 100000);
    free(table);
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
    ang_volume *volume = sheared_volume(half_value);
    ang_transfer *transfer = vessels();
    ang_renderer *renderer = open_renderer(&ang_method_raycast, gl, volume);
    ang_scene scene = make_scene(0, volume, NULL);
    ang_image image;
    ang_error err = {0};
    assert_true(ang_image_create(&image, width, height, &err));
    assert_false(ang_method_raycast.render(renderer, &scene, &exact, &image, NULL, NULL, &err));
    assert_int_equal(err.code, ANG_USAGE);
    scene.transfer = transfer;
    for (int tested = 0; tested < 2; tested++) {
        int calls = 0;
        ang_progress progress = {stop_at_once, &calls};
        ang_render_options options = exact;
        options.no_skip = !tested;
        options.pass_steps = 1;
        assert_false(ang_method_raycast.render(renderer, &scene, &options, &image, NULL, &progress, &err));
        assert_int_equal(err.code, ANG_INTERRUPTED);
        assert_int_equal(calls, 1);
    }
    ang_render_options options = exact;
    options.pass_steps = 65;
    assert_false(ang_method_raycast.render(renderer, &scene, &options, &image, NULL, NULL, &err));
    assert_int_equal(err.code, ANG_USAGE);
    options = exact;
    options.step_voxels = 0;
    assert_false(ang_method_raycast.render(renderer, &scene, &options, &image, NULL, NULL, &err));
    assert_int_equal(err.code, ANG_USAGE);
    assert_null(ang_method_raycast.create(NULL, volume, &exact, &err));
    assert_int_equal(err.code, ANG_GL);
    ang_image_clear(&image);
    ang_method_raycast.destroy(renderer);
    ang_transfer_free(transfer);
    ang_volume_free(volume);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_single_pass_is_repeated),
        cmocka_unit_test(homogeneous_media_at_any_step_and_extinction),
        cmocka_unit_test(nothing_to_see_takes_no_sample),
        cmocka_unit_test(termination_spares_samples_within_its_bound),
        cmocka_unit_test(surfaces_lie_where_they_should),
        cmocka_unit_test(balls_have_their_silhouette),
        cmocka_unit_test(the_table_of_ranges_is_conservative),
        cmocka_unit_test(refusals_and_interruption),
    };
    return run_on_backends(tests);
}
