/* Envelope and skipping change no bit: against the single pass, on every backend that is here. */
#include "tests/core/backends.h"
#include "tests/core/drawer.h"
#include "tests/core/scenes.h"

#include "core/render/envelope_hull.h"
#include "core/render/gradient_texture.h"
#include "core/render/leaf_ranges.h"
#include "core/render/skip_grid.h"

#include <string.h>

static const ang_render_options exact = {.step_voxels = 0.5, .termination = 1, .gradients = ANG_GRADIENTS_LOOKUPS};

/* How far the envelope's picture is from the single pass's. */
static double apart(const drawer *envelope, const drawer *singlepass, const ang_scene *scene,
                    const ang_render_options *options, ang_frame_stats *stats) {
    ang_image truth = draw(singlepass, scene, options, NULL), image = draw(envelope, scene, options, stats);
    double far = difference(&truth, &image);
    ang_image_clear(&truth);
    return far;
}

static void every_scene_is_the_single_pass_picture(void **state) {
    open_gl(state);
    ang_volume *volume = sheared_volume(sparse_value);
    ang_transfer *transfer = vessels();
    drawer envelope = open_drawer(gl, &ang_method_envelope, volume);
    drawer singlepass = open_drawer(gl, &ang_method_singlepass, volume);
    for (int which = 0; which < SCENES; which++)
        for (int mode = ANG_MODE_DVR; mode <= ANG_MODE_ISO; mode++)
            for (int shading = 0; shading < 2; shading++)
                for (int step = 0; step < 4; step++) {
                    static const double steps[] = {0.07, 0.5, 1.9, 40};
                    ang_scene scene = make_scene(which, volume, transfer);
                    scene.mode = (ang_mode)mode;
                    scene.shading = (ang_shading)shading;
                    ang_render_options options = exact;
                    options.step_voxels = steps[step];
                    options.skipping = (ang_skipping)((mode + step) % 3);
                    options.quads = step == 1 ? 40 : 0;
                    ang_frame_stats stats = {0};
                    double far = apart(&envelope, &singlepass, &scene, &options, &stats);
                    if (far > 0)
                        fail_msg("scene %d, mode %d, shading %d, step %g: %g", which, mode, shading, steps[step], far);
                    if (mode == ANG_MODE_DVR && options.skipping != ANG_SKIP_OUTSIDE)
                        assert_true(stats.bricks_drawn < stats.bricks_total);
                }
    envelope.method->destroy(envelope.renderer);
    singlepass.method->destroy(singlepass.renderer);
    ang_transfer_free(transfer);
    ang_volume_free(volume);
}

/* The eye deep inside with a wide view, where faces would be clipped; and so many shaded samples that a nested loop
 * would run out of llvmpipe's rounds. */
static void eyes_inside_and_many_samples(void **state) {
    open_gl(state);
    ang_volume *volume = sheared_volume(sparse_value);
    ang_transfer *transfer = vessels();
    drawer envelope = open_drawer(gl, &ang_method_envelope, volume);
    drawer singlepass = open_drawer(gl, &ang_method_singlepass, volume);
    ang_scene scene = make_scene(3, volume, transfer);
    for (int turn = 0; turn < 12; turn++) {
        ang_view view = ang_view_default;
        view.azimuth_deg = 30 * turn;
        view.elevation_deg = 7 * turn - 40;
        view.zoom = 30;
        view.fov_deg = 120;
        scene.camera = ang_camera_for(volume, &view);
        assert_true(apart(&envelope, &singlepass, &scene, &exact, NULL) == 0);
    }
    scene = make_scene(0, volume, transfer);
    scene.shading = ANG_SHADING_PHONG;
    scene.width = scene.height = 12;
    ang_render_options fine = exact;
    fine.step_voxels = 0.004;
    assert_true(apart(&envelope, &singlepass, &scene, &fine, NULL) == 0);
    envelope.method->destroy(envelope.renderer);
    singlepass.method->destroy(singlepass.renderer);
    ang_transfer_free(transfer);
    ang_volume_free(volume);
}

/* Shading with gradients made beforehand differs by their rounding alone, and only what shows is made. */
static void gradients_made_beforehand_shade_the_same(void **state) {
    open_gl(state);
    ang_volume *volume = sheared_volume(sparse_value);
    for (size_t i = 0; i < ang_volume_count(volume); i++)
        if (i % 44 < 18) volume->data[i] = 900;
    ang_transfer *transfer = vessels();
    drawer envelope = open_drawer(gl, &ang_method_envelope, volume);
    for (int which = 0; which < SCENES; which++) {
        ang_scene scene = make_scene(which, volume, transfer);
        scene.shading = ANG_SHADING_PHONG;
        ang_render_options texture = exact;
        texture.gradients = ANG_GRADIENTS_TEXTURE;
        ang_frame_stats looked_up = {0}, made = {0};
        ang_image truth = draw(&envelope, &scene, &exact, &looked_up);
        ang_image image = draw(&envelope, &scene, &texture, &made);
        /* A step is 1/32767 of 1224 HU over two voxels of 0.8 mm: 0.02 HU/mm, beside g0 = 1. */
        double far = difference(&truth, &image);
        assert_true(far > 0 && far < 2e-3);
        assert_true(made.samples <= looked_up.samples);
        ang_image_clear(&truth);
    }
    ang_skip_grid grid = {0};
    ang_gradient_texture gradients = {0};
    ang_error err = {0};
    ang_scene scene = make_scene(0, volume, transfer);
    scene.mode = ANG_MODE_ISO;
    size_t filled = 0;
    for (int iso = 500; iso >= 200; iso -= 300) {
        scene.iso_hu = iso;
        ang_visibility visibility = ang_visibility_make(volume, &scene, NULL);
        assert_true(ang_skip_grid_update(&grid, gl, volume, NULL, &visibility, 1, &err));
        assert_true(ang_gradient_texture_update(&gradients, gl, volume, &grid.shown, 2, &err));
        assert_int_equal(gradients.blocks_filled, grid.shown.visible_blocks);
        assert_true(gradients.blocks_filled > filled && gradients.blocks_filled < grid.shown.blocks);
        filled = gradients.blocks_filled;
    }
    ang_gradient_texture_destroy(&gradients);
    ang_skip_grid_destroy(&grid);
    envelope.method->destroy(envelope.renderer);
    ang_transfer_free(transfer);
    ang_volume_free(volume);
}

/* One bright voxel: at corners of blocks, at the volume's corners, in the midst of a block. */
static int bright[3];
static double one_voxel(int x, int y, int z) {
    return x == bright[0] && y == bright[1] && z == bright[2] ? 600 : -1000;
}

static void one_bright_voxel_anywhere(void **state) {
    open_gl(state);
    static const int places[][3] = {{0, 0, 0}, {8, 8, 8}, {7, 8, 16}, {25, 19, 17}, {12, 8, 3}, {24, 16, 8}};
    static const double spacings[][3] = {{1, 1, 1}, {0.5, 0.5, 500}};
    ang_transfer *transfer = vessels();
    for (size_t p = 0; p < sizeof places / sizeof *places; p++)
        for (int s = 0; s < 2; s++) {
            memcpy(bright, places[p], sizeof bright);
            ang_volume *volume = make_volume(26, 20, 18, spacings[s], one_voxel);
            drawer envelope = open_drawer(gl, &ang_method_envelope, volume);
            drawer singlepass = open_drawer(gl, &ang_method_singlepass, volume);
            for (int which = 0; which < SCENES; which++) {
                if (which == 2) continue; /* its clip box may hold nothing */
                ang_scene scene = make_scene(which, volume, transfer);
                for (int mode = ANG_MODE_DVR; mode <= ANG_MODE_ISO; mode++) {
                    scene.mode = (ang_mode)mode;
                    assert_true(apart(&envelope, &singlepass, &scene, &exact, NULL) == 0);
                }
            }
            envelope.method->destroy(envelope.renderer);
            singlepass.method->destroy(singlepass.renderer);
            ang_volume_free(volume);
        }
    ang_transfer_free(transfer);
}

static void skipping_spares_samples_and_termination_keeps_its_bound(void **state) {
    open_gl(state);
    ang_volume *volume = sheared_volume(sparse_value);
    for (size_t i = 0; i < ang_volume_count(volume); i++)
        if (i % 44 < 18) volume->data[i] = 900;
    ang_transfer *transfer = vessels();
    drawer envelope = open_drawer(gl, &ang_method_envelope, volume);
    for (int which = 0; which < SCENES; which++) {
        ang_scene scene = make_scene(which, volume, transfer);
        ang_render_options all = exact, early = exact;
        all.no_skip = true;
        early.termination = 0.95;
        static float counts[width * height];
        ang_frame_stats every = {0}, some = {.counts = counts}, few = {0};
        ang_image truth = draw(&envelope, &scene, &all, &every), skipped = draw(&envelope, &scene, &exact, &some);
        ang_image ended = draw(&envelope, &scene, &early, &few);
        assert_true(difference(&truth, &skipped) == 0);
        assert_true(difference(&truth, &ended) <= 0.05 + 1e-6);
        assert_true(some.samples < 0.8 * (double)every.samples);
        assert_true(few.samples <= some.samples);
        double sum = 0;
        for (int i = 0; i < width * height; i++) sum += counts[i];
        assert_true((uint64_t)sum == some.samples);
        ang_image_clear(&truth);
    }
    envelope.method->destroy(envelope.renderer);
    ang_transfer_free(transfer);
    ang_volume_free(volume);
}

/* Faces are made where the visible set changes, and only then; too many for the budget leave the clip box. */
static void the_hull_follows_what_shows(void **state) {
    open_gl(state);
    ang_error err = {0};
    ang_volume *volume = sheared_volume(sparse_value);
    ang_transfer *transfer = vessels();
    ang_scene scene = make_scene(0, volume, transfer);
    scene.mode = ANG_MODE_ISO;
    ang_ray_frame frame;
    assert_true(ang_ray_frame_make(volume, &scene, &frame, &err));
    ang_skip_grid grid = {0};
    ang_envelope_hull hull = {0};
    static const double isos[] = {220, 220, 220.01, 500, 5000, 220};
    static const bool made[] = {true, false, false, true, true, true};
    for (size_t i = 0; i < sizeof isos / sizeof *isos; i++) {
        scene.iso_hu = isos[i];
        ang_visibility visibility = ang_visibility_make(volume, &scene, NULL);
        assert_true(ang_skip_grid_update(&grid, gl, volume, NULL, &visibility, 1, &err));
        assert_true(ang_envelope_hull_update(&hull, gl, &grid.shown, &frame, 100000, &err));
        assert_int_equal(hull.made_now, made[i]);
        assert_int_equal(hull.cells.side, 1);
        assert_int_equal(hull.faces, isos[i] > 4000 ? 0 : hull.cells.faces);
        assert_true(isos[i] > 4000 || hull.faces > 20);
        assert_true(made[i] || grid.blocks_uploaded == 0);
    }
    size_t fine = hull.faces;
    assert_true(ang_envelope_hull_update(&hull, gl, &grid.shown, &frame, fine - 1, &err));
    assert_int_equal(hull.cells.side, 2);
    assert_true(ang_envelope_hull_update(&hull, gl, &grid.shown, &frame, 5, &err));
    assert_int_equal(hull.cells.side, 0);
    ang_envelope_hull_destroy(&hull);
    ang_skip_grid_destroy(&grid);
    ang_transfer_free(transfer);
    ang_volume_free(volume);
}

static double any_value(int x, int y, int z) { return (x * 7919 + y * 104729 + z * 1299709) % 65536 - 1024; }

static void ranges_by_compute_shader_are_the_octrees(void **state) {
    open_gl(state);
    static const int shapes[][3] = {{33, 18, 9}, {1, 1, 1}, {2, 40, 1}, {64, 17, 25}};
    static const double unit[3] = {1, 1, 1};
    for (size_t s = 0; s < sizeof shapes / sizeof *shapes; s++) {
        ang_error err = {0};
        ang_volume *volume = make_volume(shapes[s][0], shapes[s][1], shapes[s][2], unit, any_value);
        ang_volume_texture field = {0};
        assert_true(ang_volume_texture_create(&field, gl, volume, &err));
        ang_octree *built = ang_octree_build(volume, NULL, 1, 1, &err);
        ang_octree *computed = ang_octree_allocate(volume, NULL, 1, &err);
        assert_true(ang_leaf_ranges_compute(gl, &field, computed, &err));
        ang_octree_finish(computed, 1);
        assert_int_equal(built->levels, computed->levels);
        for (int level = 0; level < built->levels; level++) {
            const int *dims = built->level[level].dims;
            assert_memory_equal(built->level[level].nodes, computed->level[level].nodes,
                                (size_t)(dims[0] * dims[1] * dims[2]) * sizeof(ang_minmax));
        }
        ang_octree_free(built);
        ang_octree_free(computed);
        ang_volume_texture_destroy(&field);
        ang_volume_free(volume);
    }
}

static void nothing_to_see_takes_no_sample(void **state) {
    open_gl(state);
    ang_volume *volume = sheared_volume(sparse_value);
    static const ang_transfer_point points[] = {{.hu = 3000, .opacity = 0}, {.hu = 3001, .opacity = 1}};
    ang_transfer *transfer = ang_transfer_create(points, 2, 1, false, NULL, NULL);
    drawer envelope = open_drawer(gl, &ang_method_envelope, volume);
    ang_scene scene = make_scene(0, volume, transfer);
    ang_frame_stats stats = {0};
    ang_image image = draw(&envelope, &scene, &exact, &stats);
    for (int i = 0; i < 4 * width * height; i++) assert_true(image.rgba[i] == 0);
    assert_int_equal(stats.samples, 0);
    ang_image_clear(&image);
    envelope.method->destroy(envelope.renderer);
    ang_transfer_free(transfer);
    ang_volume_free(volume);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_scene_is_the_single_pass_picture),
        cmocka_unit_test(eyes_inside_and_many_samples),
        cmocka_unit_test(gradients_made_beforehand_shade_the_same),
        cmocka_unit_test(one_bright_voxel_anywhere),
        cmocka_unit_test(skipping_spares_samples_and_termination_keeps_its_bound),
        cmocka_unit_test(the_hull_follows_what_shows),
        cmocka_unit_test(ranges_by_compute_shader_are_the_octrees),
        cmocka_unit_test(nothing_to_see_takes_no_sample),
    };
    return run_on_backends(tests);
}
