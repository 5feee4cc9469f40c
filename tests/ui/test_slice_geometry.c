/* Left is left: where pixels of the slice panes lie in the patient. */
#include "tests/ui/volumes.h"

#include "core/scene/annotation.h"
#include "ui/state/slice_geometry.h"

#include <string.h>

static ang_volume *body(void) {
    ang_volume *volume = make_volume(41, 61, 21, (double[]){2, 1, 5}, zero);
    volume->affine.m[0][3] = -50; /* x -50 to 30, y 7 to 67, z -400 to -300 */
    volume->affine.m[1][3] = 7;
    volume->affine.m[2][3] = -400;
    return volume;
}

/* The patient's right is on the left of axial and coronal pictures; sagittal ones look from the left. */
static void letters_are_those_of_radiology(void **state) {
    (void)state;
    static const char *const letters[ANG_ORIENTATIONS][4] = {/* left, right, top, bottom */
                                                             {"R", "L", "A", "P"},
                                                             {"R", "L", "H", "F"},
                                                             {"A", "P", "H", "F"}};
    static const char *const towards[] = {"H", "P", "R"}; /* away from who looks */
    for (int i = 0; i < ANG_ORIENTATIONS; i++) {
        ang_slice_axes axes = ang_slice_axes_of(&ang_turn_none, (ang_orientation)i);
        assert_string_equal(ang_letters_make(ang_vec3_scale(axes.right, -1)).text, letters[i][0]);
        assert_string_equal(ang_letters_make(axes.right).text, letters[i][1]);
        assert_string_equal(ang_letters_make(ang_vec3_scale(axes.down, -1)).text, letters[i][2]);
        assert_string_equal(ang_letters_make(axes.down).text, letters[i][3]);
        assert_string_equal(ang_letters_make(axes.inward).text, towards[i]);
        /* right, up and towards the eye are right-handed: nothing is mirrored */
        ang_vec3 eye = ang_vec3_cross(axes.right, ang_vec3_scale(axes.down, -1));
        assert_close(ang_vec3_dot(eye, axes.inward), -1, 1e-15);
    }
}

static void slices_pass_through_voxel_centres(void **state) {
    (void)state;
    ang_volume *volume = body();
    static const int counts[ANG_ORIENTATIONS] = {21, 61, 41};
    static const double first[ANG_ORIENTATIONS] = {-400, 7, -50}, step[ANG_ORIENTATIONS] = {5, 1, 2};
    for (int flipped = 0; flipped < 2; flipped++) {
        for (int i = 0; i < ANG_ORIENTATIONS; i++) {
            ang_slice_range range = ang_slice_range_of(volume, &ang_turn_none, (ang_orientation)i);
            assert_int_equal(range.count, counts[i]);
            assert_close(range.first, first[i], 1e-9);
            assert_close(range.step, step[i], 1e-12);
            ang_vec3 at = ang_slice_place(&range, (ang_vec3){1.25, 20.5, -333}, 7);
            assert_close(ang_vec3_dot(at, range.normal), first[i] + 7 * step[i], 1e-9);
            assert_int_equal(ang_slice_index(&range, at), 7);
            assert_int_equal(ang_slice_index(&range, ang_slice_place(&range, at, -3)), 0);
            assert_int_equal(ang_slice_index(&range, ang_slice_place(&range, at, 1000)), counts[i] - 1);
        }
        /* The same body stored from the feet up or from the head down. */
        volume->affine.m[2][2] = -5;
        volume->affine.m[2][3] = -300;
    }
    ang_volume_free(volume);
}

static void pixels_are_square_in_mm_and_the_slice_fits(void **state) {
    (void)state;
    ang_volume *volume = body();
    ang_vec3 crosshair = {3, 30, -350};
    for (int i = 0; i < ANG_ORIENTATIONS; i++) {
        ang_slice_view view = ang_slice_view_default;
        ang_slice_frame frame =
            ang_slice_frame_make(volume, &ang_turn_none, (ang_orientation)i, &view, crosshair, 480, 330);
        ang_vec3 a = ang_slice_at(&frame, 10, 10), b = ang_slice_at(&frame, 11, 10), c = ang_slice_at(&frame, 10, 11);
        assert_close(ang_vec3_length(ang_vec3_sub(b, a)), frame.mm_per_pixel, 1e-9);
        assert_close(ang_vec3_length(ang_vec3_sub(c, a)), frame.mm_per_pixel, 1e-9);
        /* The plane holds the crosshair. */
        assert_close(ang_vec3_dot(ang_vec3_sub(a, crosshair), frame.axes.inward), 0, 1e-9);
        double x, y;
        ang_slice_locate(&frame, a, &x, &y);
        assert_close(x, 10, 1e-9);
        assert_close(y, 10, 1e-9);
        /* Every corner of the volume lies in the pane, and one direction is filled. */
        double least_x = 1e9, most_x = -1e9, least_y = 1e9, most_y = -1e9;
        for (int k = 0; k < 8; k++) {
            ang_vec3 index = {k & 1 ? 40 : 0, k & 2 ? 60 : 0, k & 4 ? 20 : 0};
            ang_slice_locate(&frame, ang_mat4_point(&volume->affine, index), &x, &y);
            least_x = fmin(least_x, x), most_x = fmax(most_x, x), least_y = fmin(least_y, y), most_y = fmax(most_y, y);
        }
        assert_true(least_x > -1e-6 && most_x < 480 + 1e-6 && least_y > -1e-6 && most_y < 330 + 1e-6);
        assert_close(fmin(least_x, least_y), 0, 1e-6);
    }
    ang_volume_free(volume);
}

static void zooming_keeps_what_is_under_the_pointer(void **state) {
    (void)state;
    ang_volume *volume = body();
    ang_vec3 crosshair = {3, 30, -350};
    ang_slice_view view = {.zoom = 1.3, .pan_mm = {4, -9}};
    for (int i = 0; i < ANG_ORIENTATIONS; i++) {
        ang_slice_frame frame =
            ang_slice_frame_make(volume, &ang_turn_none, (ang_orientation)i, &view, crosshair, 480, 330);
        ang_vec3 before = ang_slice_at(&frame, 123, 45);
        double scale = frame.mm_per_pixel;
        ang_slice_zoom(&view, &frame, 123, 45, 2.5);
        frame = ang_slice_frame_make(volume, &ang_turn_none, (ang_orientation)i, &view, crosshair, 480, 330);
        assert_close(ang_vec3_length(ang_vec3_sub(ang_slice_at(&frame, 123, 45), before)), 0, 1e-9);
        assert_close(frame.mm_per_pixel * 2.5, scale, 1e-9);
    }
    ang_volume_free(volume);
}

static double place_coded(int x, int y, int z) { return x + 100 * y + 10000 * (z % 3); }

/* A picture of an axial slice: the voxel under a pixel is the one there, wherever it comes from. */
static void pictures_show_what_lies_under_the_pointer(void **state) {
    (void)state;
    ang_volume *volume = make_volume(30, 40, 7, (double[]){0.5, 0.5, 2}, place_coded);
    ang_slice_view view = ang_slice_view_default;
    ang_vec3 crosshair = ang_mat4_point(&volume->affine, (ang_vec3){3, 4, 5});
    enum { width = 300, height = 200 };
    static float hu[width * height];
    for (int i = 0; i < ANG_ORIENTATIONS; i++) {
        ang_slice_frame frame =
            ang_slice_frame_make(volume, &ang_turn_none, (ang_orientation)i, &view, crosshair, width, height);
        ang_reslice_plane plane = ang_slice_plane(&frame, 0, ANG_SLAB_MEAN);
        assert_true(ang_reslice(volume, &plane, 0, hu, NULL));
        ang_mat4 to_index;
        assert_true(ang_mat4_inverse(&volume->affine, &to_index));
        int seen = 0;
        for (int y = 0; y < height; y += 7)
            for (int x = 0; x < width; x += 7) {
                ang_vec3 index = ang_mat4_point(&to_index, ang_slice_at(&frame, x + 0.5, y + 0.5));
                double value = (double)hu[y * width + x];
                if (isnan(value)) continue;
                assert_close(value, ang_volume_hu(volume, ang_volume_sample(volume, index)), 2e-2);
                seen++;
            }
        assert_true(seen > 50);
    }
    ang_volume_free(volume);
}

static void assert_vector(ang_vec3 actual, ang_vec3 expected, double tolerance) {
    assert_close(actual.x, expected.x, tolerance);
    assert_close(actual.y, expected.y, tolerance);
    assert_close(actual.z, expected.z, tolerance);
}

/* Turned by 30 degrees about the patient's long axis, from left towards posterior. */
static void a_turn_about_z_turns_the_upright_planes(void **state) {
    (void)state;
    ang_turn turn = ang_turn_about(&ang_turn_none, (ang_vec3){0, 0, 1}, 30);
    double c = sqrt(0.75), s = 0.5;
    ang_slice_axes axial = ang_slice_axes_of(&turn, ANG_AXIAL), coronal = ang_slice_axes_of(&turn, ANG_CORONAL);
    ang_slice_axes sagittal = ang_slice_axes_of(&turn, ANG_SAGITTAL);
    assert_vector(axial.right, (ang_vec3){1, 0, 0}, 1e-15); /* it turns in itself: its picture stays */
    assert_vector(axial.down, (ang_vec3){0, 1, 0}, 1e-15);
    assert_vector(coronal.right, (ang_vec3){c, s, 0}, 1e-15);
    assert_vector(coronal.down, (ang_vec3){0, 0, -1}, 1e-15);
    assert_vector(coronal.inward, (ang_vec3){-s, c, 0}, 1e-15);
    assert_vector(sagittal.right, (ang_vec3){-s, c, 0}, 1e-15);
    assert_vector(sagittal.inward, (ang_vec3){-c, -s, 0}, 1e-15);
    assert_string_equal(ang_letters_make(coronal.right).text, "LP");
    assert_close(ang_slice_lean(&turn, ANG_CORONAL), 30, 1e-12);
    assert_close(ang_slice_lean(&turn, ANG_AXIAL), 0, 0);
    assert_close(ang_slice_turned(&turn, ANG_AXIAL), 30, 1e-12);
    assert_close(ang_slice_turned(&turn, ANG_CORONAL), 0, 1e-12);
    /* In the axial pane the other two planes show as lines turned clockwise by 30 degrees. */
    ang_volume *volume = body();
    ang_slice_view view = ang_slice_view_default;
    ang_slice_frame frame = ang_slice_frame_make(volume, &turn, ANG_AXIAL, &view, (ang_vec3){0}, 480, 330);
    double line[2];
    ang_slice_cut(&frame, &turn, ANG_CORONAL, line);
    assert_close(fabs(line[0]), c, 1e-12);
    assert_close(line[1] / line[0], s / c, 1e-12);
    ang_slice_cut(&frame, &turn, ANG_SAGITTAL, line);
    assert_close(fabs(line[0]), s, 1e-12);
    assert_close(line[0] / line[1], -s / c, 1e-12);
    ang_volume_free(volume);
}

static ang_turn random_turn(uint64_t *seed) {
    ang_turn turn = ang_turn_none;
    for (int i = 0; i < 4; i++) {
        ang_vec3 axis = {random_unit(seed) - 0.5, random_unit(seed) - 0.5, random_unit(seed) - 0.5};
        turn = ang_turn_about(&turn, ang_vec3_unit(axis), 360 * random_unit(seed) - 180);
    }
    return turn;
}

/* Whatever the turn: three right-handed frames whose planes are orthogonal, lines where these cut one another. */
static void planes_stay_orthogonal(void **state) {
    (void)state;
    uint64_t seed = 7;
    ang_volume *volume = body();
    ang_slice_view view = {.zoom = 1.3, .pan_mm = {3, -8}};
    for (int round = 0; round < 200; round++) {
        ang_turn turn = random_turn(&seed);
        ang_vec3 crosshair = {-10, 40, -350};
        ang_slice_axes axes[ANG_ORIENTATIONS];
        for (int i = 0; i < ANG_ORIENTATIONS; i++) {
            axes[i] = ang_slice_axes_of(&turn, (ang_orientation)i);
            assert_close(ang_vec3_length(axes[i].right), 1, 1e-9);
            assert_close(ang_vec3_dot(axes[i].right, axes[i].down), 0, 1e-9);
            assert_vector(ang_vec3_cross(axes[i].right, axes[i].down), axes[i].inward, 1e-9);
        }
        for (int i = 0; i < ANG_ORIENTATIONS; i++) {
            int other = (i + 1) % ANG_ORIENTATIONS;
            assert_close(ang_vec3_dot(axes[i].inward, axes[other].inward), 0, 1e-12);
            ang_slice_frame frame = ang_slice_frame_make(volume, &turn, (ang_orientation)i, &view, crosshair, 480, 330);
            double line[2], x, y;
            ang_slice_cut(&frame, &turn, (ang_orientation)other, line);
            ang_slice_locate(&frame, crosshair, &x, &y);
            ang_vec3 on_line = ang_slice_at(&frame, x + 50 * line[0], y + 50 * line[1]);
            assert_close(ang_vec3_dot(ang_vec3_sub(on_line, crosshair), axes[other].inward), 0, 1e-9);
            assert_close(ang_vec3_length(ang_vec3_sub(on_line, crosshair)), 50 * frame.mm_per_pixel, 1e-9);
            /* Turned about its own normal a pane's picture stays as it is. */
            ang_turn on = ang_turn_about(&turn, axes[i].inward, 25);
            assert_vector(ang_slice_axes_of(&on, (ang_orientation)i).right, axes[i].right, 1e-6);
        }
        ang_turn saved = turn;
        saved.x.x += 1e-5;
        assert_true(ang_turn_mend(&saved));
        assert_close(ang_vec3_length(saved.x), 1, 1e-15);
        saved.y = saved.x;
        assert_false(ang_turn_mend(&saved));
    }
    ang_volume_free(volume);
}

static void quarter_turns_are_exact_and_come_back(void **state) {
    (void)state;
    ang_volume *volume = body();
    ang_turn turn = ang_turn_none;
    for (int i = 0; i < 4; i++) turn = ang_turn_about(&turn, (ang_vec3){0, 0, 1}, 90);
    assert_true(ang_turn_same(&turn, &ang_turn_none));
    turn = ang_turn_about(&turn, (ang_vec3){0, 0, 1}, 90);
    /* The coronal pane has become a sagittal one, of the voxels' own slices. */
    ang_slice_range range = ang_slice_range_of(volume, &turn, ANG_CORONAL);
    assert_vector(range.normal, (ang_vec3){-1, 0, 0}, 0);
    assert_true(range.whole);
    assert_int_equal(range.count, 41);
    assert_close(range.step, 2, 1e-12);
    ang_vec3 at = ang_slice_move(&range, (ang_vec3){1.25, 20.5, -333}, 0);
    assert_vector(at, (ang_vec3){2, 20.5, -333}, 1e-9);
    ang_volume_free(volume);
}

/* Oblique slices step by a voxel of the axis that changes soonest, from one corner of the box to the other; the place
 * itself need be no slice's. */
static void oblique_slices_cover_the_box(void **state) {
    (void)state;
    ang_volume *volume = body();
    ang_turn turn = ang_turn_about(&ang_turn_none, (ang_vec3){1, 0, 0}, 30);
    ang_slice_range range = ang_slice_range_of(volume, &turn, ANG_AXIAL); /* normal (0, -1/2, sqrt(3)/2) */
    assert_false(range.whole);
    assert_close(range.step, 2, 1e-12); /* y: 1 mm / 0.5; z: 5 mm / 0.866 */
    assert_close(range.first, -67 * 0.5 - 400 * sqrt(0.75), 1e-9);
    assert_close(range.last, -7 * 0.5 - 300 * sqrt(0.75), 1e-9);
    assert_int_equal(range.count, (int)floor((60 * 0.5 + 100 * sqrt(0.75)) / 2) + 1);
    ang_vec3 place = {3.1, 30.7, -351.3};
    assert_vector(ang_slice_move(&range, place, 0), place, 1e-12);
    ang_vec3 on = ang_slice_move(&range, place, 3);
    assert_vector(on, ang_vec3_along(place, range.normal, 6), 1e-9);
    assert_int_equal(ang_slice_index(&range, on), ang_slice_index(&range, place) + 3);
    on = ang_slice_move(&range, place, 1000);
    assert_close(ang_vec3_dot(on, range.normal), range.last, 1e-9);
    assert_int_equal(ang_slice_index(&range, ang_slice_move(&range, place, -1000)), 0);
    ang_volume_free(volume);
}

static void what_lies_under_the_crosshair_stays_when_planes_turn(void **state) {
    (void)state;
    ang_volume *volume = body();
    ang_turn turn = ang_turn_about(&ang_turn_none, ang_vec3_unit((ang_vec3){1, 2, 3}), 40);
    ang_vec3 crosshair = {20, 15, -310};
    for (int i = 0; i < ANG_ORIENTATIONS; i++) {
        ang_slice_view view = {.zoom = 2, .pan_mm = {4, -9}};
        ang_slice_axes before = ang_slice_axes_of(&ang_turn_none, (ang_orientation)i);
        ang_slice_axes after = ang_slice_axes_of(&turn, (ang_orientation)i);
        ang_slice_frame frame =
            ang_slice_frame_make(volume, &ang_turn_none, (ang_orientation)i, &view, crosshair, 480, 330);
        double x0, y0, x1, y1;
        ang_slice_locate(&frame, crosshair, &x0, &y0);
        ang_slice_keep_place(&view, volume, crosshair, &before, &after);
        double scale = frame.mm_per_pixel;
        frame = ang_slice_frame_make(volume, &turn, (ang_orientation)i, &view, crosshair, 480, 330);
        ang_slice_locate(&frame, crosshair, &x1, &y1);
        assert_close(x1, x0, 1e-9);
        assert_close(y1, y0, 1e-9);
        assert_close(frame.mm_per_pixel, scale, 0);
        ang_slice_keep_place(&view, volume, crosshair, &after, &before);
        assert_close(view.pan_mm[0], 4, 1e-9);
        assert_close(view.pan_mm[1], -9, 1e-9);
    }
    ang_volume_free(volume);
}

static void no_pan_loses_the_picture(void **state) {
    (void)state;
    ang_volume *volume = body(); /* 80 x 60 x 100 mm */
    ang_slice_view view = {.zoom = 5, .pan_mm = {1000, -1000}};
    ang_slice_axes axes = ang_slice_axes_of(&ang_turn_none, ANG_CORONAL);
    ang_slice_keep_inside(&view, volume, &axes);
    assert_close(view.pan_mm[0], 40, 1e-9);
    assert_close(view.pan_mm[1], -50, 1e-9);
    ang_volume_free(volume);
}

/* A ball of 1000 HU in a volume of unequal spacings, tilted as a gantry tilts, with its axes turned besides. */
static const ang_vec3 ball_centre = {11, -23, 40};
static const double ball_radius = 17;

static ang_volume *tilted_ball(void) {
    ang_volume *volume = make_volume(50, 60, 40, (double[]){1, 1, 1}, zero);
    ang_turn turn = ang_turn_about(&ang_turn_none, ang_vec3_unit((ang_vec3){1, -2, 0.5}), 35);
    ang_vec3 column[3] = {{1.1, 0, 0}, {0, 0.9, 0}, {0, 2 * sin(0.35), 2 * cos(0.35)}};
    for (int axis = 0; axis < 3; axis++) {
        ang_vec3 to = ang_turn_direction(&turn, column[axis]);
        for (int row = 0; row < 3; row++) volume->affine.m[row][axis] = ang_vec3_at(to, row);
    }
    ang_vec3 off = ang_vec3_sub(ball_centre, ang_mat4_direction(&volume->affine, (ang_vec3){24.3, 29.6, 19.7}));
    for (int row = 0; row < 3; row++) volume->affine.m[row][3] = ang_vec3_at(off, row);
    for (int z = 0, i = 0; z < 40; z++)
        for (int y = 0; y < 60; y++)
            for (int x = 0; x < 50; x++, i++) {
                ang_vec3 at = ang_mat4_point(&volume->affine, (ang_vec3){x, y, z});
                bool in = ang_vec3_length(ang_vec3_sub(at, ball_centre)) <= ball_radius;
                volume->data[i] = (uint16_t)(1024 + (in ? 1000 : 0));
            }
    return volume;
}

/* Every plane, however turned, shows it as the circle in which that plane cuts it: round, of the right size, in the
 * right place. */
static void a_ball_is_round_in_every_oblique_slice(void **state) {
    (void)state;
    ang_volume *volume = tilted_ball();
    enum { width = 240, height = 200 };
    static float hu[width * height];
    uint64_t seed = 11;
    double voxel = 1.1 + 0.9 + 2; /* no cell is longer */
    for (int round = 0; round < 8; round++) {
        ang_turn turn = round == 0 ? ang_turn_none : random_turn(&seed);
        for (int i = 0; i < ANG_ORIENTATIONS; i++) {
            ang_slice_axes axes = ang_slice_axes_of(&turn, (ang_orientation)i);
            double off = 9 * random_unit(&seed) - 4.5;
            ang_vec3 crosshair = ang_vec3_along(ball_centre, axes.inward, off);
            ang_slice_view view = {.zoom = 2};
            ang_slice_frame frame =
                ang_slice_frame_make(volume, &turn, (ang_orientation)i, &view, crosshair, width, height);
            ang_reslice_plane plane = ang_slice_plane(&frame, 0, ANG_SLAB_MEAN);
            assert_true(ang_reslice(volume, &plane, 0, hu, NULL));
            double area = 0, x_moment = 0, y_moment = 0, xx = 0, yy = 0;
            for (int y = 0; y < height; y++)
                for (int x = 0; x < width; x++) {
                    double value = (double)hu[y * width + x];
                    if (isnan(value)) continue;
                    ang_vec3 from = ang_vec3_sub(ang_slice_at(&frame, x + 0.5, y + 0.5), ball_centre);
                    double distance = ang_vec3_length(from);
                    if (distance < ball_radius - voxel) assert_close(value, 1000, 1e-3);
                    if (distance > ball_radius + voxel) assert_close(value, 0, 1e-3);
                    double share = value / 1000;
                    area += share, x_moment += share * (x + 0.5), y_moment += share * (y + 0.5);
                    xx += share * x * x, yy += share * y * y;
                }
            double mm = frame.mm_per_pixel, circle = M_PI * (ball_radius * ball_radius - off * off);
            double cx, cy;
            ang_slice_locate(&frame, crosshair, &cx, &cy);
            assert_close(area * mm * mm, circle, 0.03 * circle);
            assert_close(x_moment / area, cx, 0.2 / mm);
            assert_close(y_moment / area, cy, 0.2 / mm);
            /* The second moments of a disc about its middle are r^2 / 4 both ways. */
            double x_spread = xx / area - pow(x_moment / area - 0.5, 2),
                   y_spread = yy / area - pow(y_moment / area - 0.5, 2);
            assert_close(x_spread * mm * mm, circle / M_PI / 4, 0.05 * circle / M_PI / 4);
            assert_close(x_spread / y_spread, 1, 0.05);
        }
    }
    ang_volume_free(volume);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(letters_are_those_of_radiology),
        cmocka_unit_test(slices_pass_through_voxel_centres),
        cmocka_unit_test(pixels_are_square_in_mm_and_the_slice_fits),
        cmocka_unit_test(zooming_keeps_what_is_under_the_pointer),
        cmocka_unit_test(pictures_show_what_lies_under_the_pointer),
        cmocka_unit_test(a_turn_about_z_turns_the_upright_planes),
        cmocka_unit_test(planes_stay_orthogonal),
        cmocka_unit_test(quarter_turns_are_exact_and_come_back),
        cmocka_unit_test(oblique_slices_cover_the_box),
        cmocka_unit_test(what_lies_under_the_crosshair_stays_when_planes_turn),
        cmocka_unit_test(no_pan_loses_the_picture),
        cmocka_unit_test(a_ball_is_round_in_every_oblique_slice),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
