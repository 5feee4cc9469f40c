/* Measuring: lengths, angles and regions against closed forms. */
#include "tests/core/fixtures.h"
#include "tests/core/regions.h"

#include <string.h>

static const double spacing[3] = {0.5, 0.5, 2};
static double constant(int x, int y, int z) {
    (void)x, (void)y, (void)z;
    return 37;
}
/* 10 HU a voxel along x, 3 along y, -7 along z. */
static double ramp(int x, int y, int z) { return 10 * x + 3 * y - 7 * z; }

static void lengths_and_angles_are_euclids(void **state) {
    (void)state;
    ang_measurement length = {.kind = ANG_MEASURE_LENGTH, .point = {{1, 2, 3}, {3, 5, 9}}};
    assert_close(ang_measurement_value(&length), 7, 1e-12);
    /* Two diagonals of a cube's faces that meet: 60 degrees. */
    ang_measurement angle = {.kind = ANG_MEASURE_ANGLE, .point = {{11, 1, 0}, {10, 0, 0}, {11, 0, 1}}};
    assert_close(ang_measurement_value(&angle), 60, 1e-12);
    angle.point[2] = (ang_vec3){7, -3, 0};
    assert_close(ang_measurement_value(&angle), 180, 1e-6);
    /* Nearly none, where the arc cosine would lose all digits. */
    angle.point[0] = (ang_vec3){11, 0, 0}, angle.point[2] = (ang_vec3){12, 2e-9, 0};
    assert_close(ang_measurement_value(&angle), 1e-9 * 180 / M_PI, 1e-15);
    angle.point[2] = angle.point[1];
    assert_close(ang_measurement_value(&angle), 0, 0);
}

static void areas_are_of_the_figure(void **state) {
    (void)state;
    ang_measurement r = axial_region(ANG_MEASURE_RECTANGLE, 5, 9, 2, 1, 4);
    assert_close(ang_measurement_value(&r), 24, 1e-12);
    r.kind = ANG_MEASURE_ELLIPSE;
    assert_close(ang_measurement_value(&r), M_PI * 1.5 * 4, 1e-12);
    /* Along axes that are turned. */
    double c = cos(0.3), s = sin(0.3);
    ang_vec3 right = {c, s, 0}, down = {-s, c, 0};
    r = region(ANG_MEASURE_RECTANGLE, (ang_vec3){1, 1, 1},
               ang_vec3_add((ang_vec3){1, 1, 1}, ang_vec3_along(ang_vec3_scale(right, 3), down, 5)), right, down);
    assert_close(ang_measurement_value(&r), 15, 1e-12);
}

static void a_region_has_the_values_of_its_voxels(void **state) {
    (void)state;
    ang_volume *volume = make_volume(40, 30, 5, spacing, constant);
    ang_measurement r = axial_region(ANG_MEASURE_ELLIPSE, 2, 2, 11, 9, 4);
    ang_region_values v = ang_region_measure(volume, &r);
    assert_close(v.mean, 37, 1e-9);
    assert_close(v.sd, 0, 1e-6);
    ang_volume_free(volume);

    /* The 7 x 5 voxels from (4, 6) in slice 2: a ramp's mean is that of its corners, its variance the sum of those of
     * its two sides, (n^2 - 1) / 12 steps squared each; here as a sample's. */
    volume = make_volume(40, 30, 5, spacing, ramp);
    r = axial_region(ANG_MEASURE_RECTANGLE, 4 * 0.5 - 0.1, 6 * 0.5 - 0.1, 10 * 0.5 + 0.1, 10 * 0.5 + 0.1, 4);
    v = ang_region_measure(volume, &r);
    assert_int_equal(v.count, 35);
    assert_close(v.mean, 10 * 7 + 3 * 8 - 14, 1e-9);
    assert_close(v.sd, sqrt((100 * 48 + 9 * 24) / 12.0 * 35 / 34), 1e-9);
    assert_close(v.least, 40 + 18 - 14, 1e-9);
    assert_close(v.most, 100 + 30 - 14, 1e-9);
    /* Corners that are voxel centres: these count; the other way round it is the same region. */
    r = axial_region(ANG_MEASURE_RECTANGLE, 5, 5, 2, 3, 4);
    assert_int_equal(ang_region_measure(volume, &r).count, 35);
    /* A coronal region: steps of 0.5 and 2 mm. */
    r = region(ANG_MEASURE_RECTANGLE, (ang_vec3){1.9, 5, 1.9}, (ang_vec3){5.1, 5, 6.1}, (ang_vec3){1, 0, 0},
               (ang_vec3){0, 0, -1});
    v = ang_region_measure(volume, &r);
    assert_int_equal(v.count, 7 * 3);
    assert_close(v.mean, 70 + 30 - 14, 1e-9);
    /* A region between voxel centres has the value of its middle. */
    r = axial_region(ANG_MEASURE_ELLIPSE, 2.1, 2.1, 2.3, 2.3, 4);
    v = ang_region_measure(volume, &r);
    assert_int_equal(v.count, 1);
    assert_close(v.mean, 10 * 4.4 + 3 * 4.4 - 14, 1e-9);
    ang_volume_free(volume);
}

/* On a linear field interpolation is exact, whatever the plane: a figure that is the same about its middle has as mean
 * the value there. */
static void an_oblique_region_is_interpolated(void **state) {
    (void)state;
    static const double cube[3] = {0.5, 0.5, 0.5};
    ang_volume *volume = make_volume(64, 64, 64, cube, ramp);
    double c = cos(0.6), s = sin(0.6);
    ang_vec3 right = {c, 0, s}, down = {0, 1, 0}, middle = {16, 15, 15.5};
    ang_vec3 half = ang_vec3_along(ang_vec3_scale(right, 6), down, 5);
    ang_measurement r =
        region(ANG_MEASURE_ELLIPSE, ang_vec3_sub(middle, half), ang_vec3_add(middle, half), right, down);
    ang_region_values v = ang_region_measure(volume, &r);
    double slope = 20 * c - 14 * s; /* HU per mm along `right` */
    double at = 20 * 16 + 6 * 15 - 14 * 15.5;
    assert_close(v.mean, at, 0.5); /* the samples are not about the middle */
    /* Over an ellipse x has the variance a^2 / 4. */
    assert_close(v.sd, sqrt(slope * slope * 36 / 4 + 36 * 25 / 4.0), 0.8);
    /* As dense as voxels: along `right` a voxel is crossed every 0.5 / cos mm. */
    assert_close((double)v.count, M_PI * 6 * 5 / (0.5 / c * 0.5), 25);
    ang_volume_free(volume);
}

static void what_lies_outside_does_not_count(void **state) {
    (void)state;
    ang_volume *volume = make_volume(40, 30, 5, spacing, ramp);
    ang_measurement r = axial_region(ANG_MEASURE_RECTANGLE, -100, -100, 1.1, 0.6, 0);
    ang_region_values v = ang_region_measure(volume, &r);
    assert_int_equal(v.count, 3 * 2);
    assert_close(v.mean, 10 + 1.5, 1e-9);
    r = axial_region(ANG_MEASURE_ELLIPSE, -100, -100, -50, -50, 0);
    v = ang_region_measure(volume, &r);
    assert_int_equal(v.count, 0);
    assert_true(isnan(v.mean) && isnan(v.sd) && isnan(v.least) && isnan(v.most));
    char line[ANG_MEASURE_LINES][64];
    assert_int_equal(ang_measurement_lines(&r, &v, "HU", line), 2);
    assert_string_equal(line[0], "outside");
    ang_volume_free(volume);
}

static void handles_move_what_they_should(void **state) {
    (void)state;
    ang_vec3 handle[ANG_MEASURE_HANDLES];
    for (int i = 0; i < ANG_MEASURE_HANDLES; i++) {
        ang_measurement r = axial_region(ANG_MEASURE_ELLIPSE, 2, 3, 10, 9, 4);
        assert_int_equal(ang_measurement_handles(&r, handle), 4);
        ang_vec3 opposite = handle[3 - i];
        ang_measurement_drag(&r, i, (ang_vec3){20, -4, 77}); /* the plane stays */
        ang_measurement_handles(&r, handle);
        assert_close(ang_vec3_length(ang_vec3_sub(handle[i], (ang_vec3){20, -4, 4})), 0, 1e-12);
        assert_close(ang_vec3_length(ang_vec3_sub(handle[3 - i], opposite)), 0, 1e-12);
    }
    ang_measurement angle = {.kind = ANG_MEASURE_ANGLE, .point = {{1, 0, 0}, {0, 0, 0}, {0, 1, 0}}};
    ang_measurement_drag(&angle, 2, (ang_vec3){-1, 0, 0});
    assert_close(ang_measurement_value(&angle), 180, 1e-9);
    ang_measurement_shift(&angle, (ang_vec3){5, 6, 7});
    assert_close(ang_measurement_value(&angle), 180, 1e-9);
    assert_close(angle.point[1].z, 7, 0);
}

static void texts_have_units(void **state) {
    (void)state;
    char line[ANG_MEASURE_LINES][64];
    ang_measurement m = {.kind = ANG_MEASURE_LENGTH, .point = {{0, 0, 0}, {12.345, 0, 0}}};
    assert_int_equal(ang_measurement_lines(&m, NULL, "HU", line), 1);
    assert_string_equal(line[0], "12.3 mm");
    m = (ang_measurement){.kind = ANG_MEASURE_ANGLE, .point = {{1, 0, 0}, {0, 0, 0}, {0, 1, 0}}};
    ang_measurement_lines(&m, NULL, "HU", line);
    assert_string_equal(line[0], "90.0\xc2\xb0");
    m = axial_region(ANG_MEASURE_RECTANGLE, 0, 0, 3, 4, 0);
    ang_region_values v = {40.4, 7.6, -12.3, 99.5, 10};
    assert_int_equal(ang_measurement_lines(&m, &v, "HU", line), 3);
    assert_string_equal(line[0], "mean 40 HU, SD 8 HU");
    assert_string_equal(line[1], "min -12 HU, max 100 HU");
    assert_string_equal(line[2], "area 12.0 mm\xc2\xb2");
    ang_measures all = {0};
    ang_measures_add(&all, &m);
    char *text = ang_measures_print(&all, &v, "HU", NULL);
    assert_string_equal(text,
                        "number\tkind\tvalue\tunit\tmean (HU)\tSD (HU)\tmin (HU)\tmax (HU)\tL (mm)\tP (mm)\tH (mm)\n"
                        "1\trectangle\t12.0\tmm2\t40\t8\t-12\t100\t1.5\t2.0\t0.0\n");
    free(text);
}

static void there_is_room_for_so_many(void **state) {
    (void)state;
    ang_measures all = {0};
    ang_measurement m = {.kind = ANG_MEASURE_LENGTH};
    for (int i = 0; i < ANG_MEASURES; i++) {
        m.point[1].x = i + 1;
        assert_int_equal(ang_measures_add(&all, &m), i);
    }
    assert_int_equal(ang_measures_add(&all, &m), -1);
    ang_measures_delete(&all, 3);
    ang_measures_delete(&all, 99);
    assert_int_equal(all.count, ANG_MEASURES - 1);
    assert_close(all.item[3].point[1].x, 5, 0);
    assert_close(all.item[2].point[1].x, 3, 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lengths_and_angles_are_euclids),
        cmocka_unit_test(areas_are_of_the_figure),
        cmocka_unit_test(a_region_has_the_values_of_its_voxels),
        cmocka_unit_test(an_oblique_region_is_interpolated),
        cmocka_unit_test(what_lies_outside_does_not_count),
        cmocka_unit_test(handles_move_what_they_should),
        cmocka_unit_test(texts_have_units),
        cmocka_unit_test(there_is_room_for_so_many),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
