/* Left is left: where pixels of the slice panes lie in the patient. */
#include "tests/core/fixtures.h"

#include "core/scene/annotation.h"
#include "ui/state/slice_geometry.h"

#include <string.h>

static double zero(int x, int y, int z) {
    (void)x, (void)y, (void)z;
    return 0;
}

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
        ang_slice_axes axes = ang_slice_axes_of((ang_orientation)i);
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
            ang_slice_range range = ang_slice_range_of(volume, (ang_orientation)i);
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
        ang_slice_frame frame = ang_slice_frame_make(volume, (ang_orientation)i, &view, crosshair, 480, 330);
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
        ang_slice_frame frame = ang_slice_frame_make(volume, (ang_orientation)i, &view, crosshair, 480, 330);
        ang_vec3 before = ang_slice_at(&frame, 123, 45);
        double scale = frame.mm_per_pixel;
        ang_slice_zoom(&view, &frame, 123, 45, 2.5);
        frame = ang_slice_frame_make(volume, (ang_orientation)i, &view, crosshair, 480, 330);
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
        ang_slice_frame frame = ang_slice_frame_make(volume, (ang_orientation)i, &view, crosshair, width, height);
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

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(letters_are_those_of_radiology),
        cmocka_unit_test(slices_pass_through_voxel_centres),
        cmocka_unit_test(pixels_are_square_in_mm_and_the_slice_fits),
        cmocka_unit_test(zooming_keeps_what_is_under_the_pointer),
        cmocka_unit_test(pictures_show_what_lies_under_the_pointer),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
