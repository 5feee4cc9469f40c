/* Slices and slabs against closed forms. */
#include "tests/core/fixtures.h"

#include "core/volume/reslice.h"

#include <string.h>

static double linear(int x, int y, int z) { return 3 * x + 5 * y - 7 * z + 100; }
static double one_bright(int x, int y, int z) { return x == 5 && y == 6 && z == 4 ? 1000 : 0; }

/* Anisotropic, sheared and turned, as a tilted gantry and an oblique series give it. */
static void make_oblique(ang_volume *volume) {
    const double rows[3][4] = {{0.6, -0.32, 0.1, 20}, {0.24, 0.8, 0.5, -35}, {0.05, -0.1, 1.9, 400}};
    memcpy(volume->affine.m, rows, sizeof rows);
}

static double linear_at(const ang_volume *volume, ang_vec3 mm) {
    ang_mat4 to_index;
    assert_true(ang_mat4_inverse(&volume->affine, &to_index));
    ang_vec3 index = ang_mat4_point(&to_index, mm);
    return 3 * index.x + 5 * index.y - 7 * index.z + 100;
}

static ang_vec3 pixel_place(const ang_reslice_plane *plane, int i, int j) {
    return ang_vec3_along(ang_vec3_along(plane->origin, plane->step_x, i), plane->step_y, j);
}

static bool inside(const ang_volume *volume, ang_vec3 mm, double margin) {
    ang_mat4 to_index;
    assert_true(ang_mat4_inverse(&volume->affine, &to_index));
    ang_vec3 p = ang_mat4_point(&to_index, mm);
    for (int axis = 0; axis < 3; axis++)
        if (ang_vec3_at(p, axis) < margin || ang_vec3_at(p, axis) > volume->dims[axis] - 1 - margin) return false;
    return true;
}

enum { side = 300 };
static float hu[side * side];

static void linear_fields_are_exact_at_any_angle(void **state) {
    (void)state;
    ang_volume *volume = make_volume(24, 30, 14, (double[]){1, 1, 1}, linear);
    make_oblique(volume);
    uint64_t seed = 7;
    for (int turn = 0; turn < 12; turn++) {
        ang_vec3 x = {random_unit(&seed) - 0.5, random_unit(&seed) - 0.5, random_unit(&seed) - 0.5};
        ang_vec3 y = {random_unit(&seed) - 0.5, random_unit(&seed) - 0.5, random_unit(&seed) - 0.5};
        ang_reslice_plane plane = {.step_x = ang_vec3_scale(ang_vec3_unit(x), 0.31),
                                   .step_y = ang_vec3_scale(ang_vec3_unit(y), 0.27),
                                   .width = side,
                                   .height = side - turn,
                                   .thickness_mm = turn % 3 == 0 ? 0 : turn,
                                   .slab = ANG_SLAB_MEAN};
        ang_vec3 centre = ang_volume_centre(volume);
        plane.origin = ang_vec3_along(ang_vec3_along(centre, plane.step_x, -side / 2.0), plane.step_y, -side / 2.0);
        assert_true(ang_reslice(volume, &plane, 1 + turn % 3, hu, NULL));
        ang_vec3 normal = ang_vec3_unit(ang_vec3_cross(x, y));
        int seen = 0;
        for (int j = 0; j < plane.height; j++)
            for (int i = 0; i < plane.width; i++) {
                ang_vec3 at = pixel_place(&plane, i, j);
                bool all = inside(volume, ang_vec3_along(at, normal, plane.thickness_mm / 2), 1e-3) &&
                           inside(volume, ang_vec3_along(at, normal, -plane.thickness_mm / 2), 1e-3);
                double value = (double)hu[j * plane.width + i];
                if (all) {
                    assert_close(value, linear_at(volume, at), 1e-3);
                    seen++;
                } else if (plane.thickness_mm == 0 && !inside(volume, at, -1e-3)) {
                    assert_true(isnan(value));
                }
            }
        assert_true(seen > 500);
    }
    ang_volume_free(volume);
}

/* Not interpolated: each place has the value of the voxel whose centre is nearest along the volume's axes. */
static void nearest_voxels_have_one_value(void **state) {
    (void)state;
    ang_volume *volume = make_volume(24, 30, 14, (double[]){1, 1, 1}, linear);
    make_oblique(volume);
    ang_mat4 to_index;
    assert_true(ang_mat4_inverse(&volume->affine, &to_index));
    ang_reslice_plane plane = {
        .step_x = {0.21, 0.05, 0.1}, .step_y = {-0.08, 0.19, 0.04}, .width = side, .height = side, .nearest = true};
    ang_vec3 centre = ang_volume_centre(volume);
    plane.origin = ang_vec3_along(ang_vec3_along(centre, plane.step_x, -side / 2.0), plane.step_y, -side / 2.0);
    assert_true(ang_reslice(volume, &plane, 0, hu, NULL));
    int seen = 0;
    for (int j = 0; j < side; j++)
        for (int i = 0; i < side; i++) {
            ang_vec3 at = pixel_place(&plane, i, j);
            if (!inside(volume, at, 1e-3)) continue;
            ang_vec3 index = ang_mat4_point(&to_index, at);
            double value = (double)hu[j * side + i], edge = 0;
            for (int axis = 0; axis < 3; axis++) {
                double from = ang_vec3_at(index, axis) + 0.5;
                edge = fmax(edge, 0.5 - fabs(from - floor(from) - 0.5) < 1e-6); /* rounding decides */
            }
            if (edge > 0) continue;
            assert_close(value, linear((int)round(index.x), (int)round(index.y), (int)round(index.z)), 1e-3);
            seen++;
        }
    assert_true(seen > 500);
    ang_volume_free(volume);
}

static void voxels_come_back_on_their_own_grid(void **state) {
    (void)state;
    ang_volume *volume = make_volume(9, 8, 7, (double[]){0.5, 0.75, 2}, one_bright);
    volume->affine.m[0][3] = -100.1;
    volume->affine.m[2][3] = 33.3;
    for (int z = 0; z < 7; z++) {
        ang_reslice_plane plane = {.origin = ang_mat4_point(&volume->affine, (ang_vec3){0, 0, z}),
                                   .step_x = {0.5, 0, 0},
                                   .step_y = {0, 0.75, 0},
                                   .width = 9,
                                   .height = 8};
        assert_true(ang_reslice(volume, &plane, 0, hu, NULL));
        for (int i = 0; i < 72; i++) assert_close((double)hu[i], z == 4 && i == 6 * 9 + 5 ? 1000 : 0, 1e-2);
    }
    ang_volume_free(volume);
}

/* A slab of whole voxels about one bright voxel: the extremes find it, the mean shares it out. */
static void slabs_show_mean_and_extremes(void **state) {
    (void)state;
    ang_volume *volume = make_volume(12, 12, 9, (double[]){1, 1, 1}, one_bright);
    ang_reslice_plane plane = {.origin = {5, 6, 4}, .step_x = {1, 0, 0}, .step_y = {0, 1, 0}, .width = 1, .height = 1};
    plane.thickness_mm = 4;
    plane.slab = ANG_SLAB_MEAN;
    assert_int_equal(ang_reslice_planes(volume, &plane), 4);
    assert_true(ang_reslice(volume, &plane, 1, hu, NULL));
    /* planes at -1.5, -0.5, 0.5 and 1.5 mm: two of them half way to the voxel */
    assert_close((double)hu[0], 250, 1e-3);
    plane.slab = ANG_SLAB_MIP;
    assert_int_equal(ang_reslice_planes(volume, &plane), 9);
    assert_true(ang_reslice(volume, &plane, 1, hu, NULL));
    assert_close((double)hu[0], 1000, 1e-3);
    plane.slab = ANG_SLAB_MINIP;
    assert_true(ang_reslice(volume, &plane, 1, hu, NULL));
    assert_close((double)hu[0], 0, 1e-3);
    /* Half of the slab lies outside: the mean is over what is inside. */
    plane.origin.z = 8;
    plane.slab = ANG_SLAB_MEAN;
    assert_true(ang_reslice(volume, &plane, 1, hu, NULL));
    assert_close((double)hu[0], 0, 1e-3);
    plane.origin.z = 30;
    assert_true(ang_reslice(volume, &plane, 1, hu, NULL));
    assert_true(isnan(hu[0]));
    ang_volume_free(volume);
}

static void axes_of_one_voxel_have_a_thickness(void **state) {
    (void)state;
    ang_volume *volume = make_volume(6, 6, 1, (double[]){1, 1, 3}, linear);
    ang_reslice_plane plane = {
        .origin = {2, 3, 1.4}, .step_x = {1, 0, 0}, .step_y = {0, 0, 1}, .width = 2, .height = 2};
    assert_true(ang_reslice(volume, &plane, 1, hu, NULL));
    assert_close((double)hu[0], linear(2, 3, 0), 1e-3);
    assert_close((double)hu[1], linear(3, 3, 0), 1e-3);
    assert_true(isnan(hu[2]) && isnan(hu[3])); /* 2.4 mm: beyond half a spacing */
    ang_volume_free(volume);
}

static void what_cannot_be_is_refused(void **state) {
    (void)state;
    ang_volume *volume = make_volume(4, 4, 4, (double[]){1, 1, 1}, linear);
    ang_reslice_plane plane = {.step_x = {1, 0, 0}, .step_y = {2, 0, 0}, .width = 2, .height = 2};
    ang_error err = {0};
    assert_false(ang_reslice(volume, &plane, 1, hu, &err));
    assert_int_equal(err.code, ANG_USAGE);
    plane.step_y = (ang_vec3){0, 1, 0};
    plane.height = 0;
    assert_false(ang_reslice(volume, &plane, 1, hu, &err));
    volume->affine.m[1][1] = 0;
    plane.height = 2;
    assert_false(ang_reslice(volume, &plane, 1, hu, &err));
    assert_int_equal(err.code, ANG_GEOMETRY);
    ang_volume_free(volume);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(linear_fields_are_exact_at_any_angle), cmocka_unit_test(nearest_voxels_have_one_value),
        cmocka_unit_test(voxels_come_back_on_their_own_grid),   cmocka_unit_test(slabs_show_mean_and_extremes),
        cmocka_unit_test(axes_of_one_voxel_have_a_thickness),   cmocka_unit_test(what_cannot_be_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
