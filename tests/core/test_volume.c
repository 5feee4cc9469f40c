#include "tests/core/fixtures.h"

#include "core/volume/histogram.h"
#include "core/volume/octree.h"

#include <string.h>

static const double unit[3] = {1, 1, 1};

static double noise_value(int x, int y, int z) {
    uint64_t state = (uint64_t)(x + 1) * 73856093u ^ (uint64_t)(y + 1) * 19349663u ^ (uint64_t)(z + 1) * 83492791u;
    for (int i = 0; i < 5; i++) random_unit(&state);
    return floor(3000 * random_unit(&state)) - 1000;
}

static double linear_value(int x, int y, int z) { return 3 * x - 5 * y + 7 * z; }

static void a_matrix_and_its_inverse_cancel(void **state) {
    (void)state;
    ang_mat4 a = {{{0.7, 0.1, 0.02, -120}, {0, 0.6, -0.3, 45}, {0.05, 0, 2.5, 1e5}, {0, 0, 0, 1}}}, inverse;
    assert_true(ang_mat4_inverse(&a, &inverse));
    uint64_t seed = 3;
    for (int i = 0; i < 100; i++) {
        ang_vec3 p = {random_unit(&seed), 500 * random_unit(&seed), -300 * random_unit(&seed)};
        ang_vec3 q = ang_mat4_point(&inverse, ang_mat4_point(&a, p));
        assert_close(ang_vec3_length(ang_vec3_sub(p, q)), 0, 1e-9);
    }
    ang_mat4 flat = {{{1, 2, 3, 0}, {1, 2, 3, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}}};
    assert_false(ang_mat4_inverse(&flat, &inverse));
}

static void box_has_voxel_centres_and_half_a_spacing_where_flat(void **state) {
    (void)state;
    double spacing[3] = {0.5, 2, 3};
    ang_volume *volume = make_volume(5, 1, 4, spacing, linear_value);
    ang_vec3 lower, upper;
    ang_volume_box(volume, &lower, &upper);
    assert_close(lower.x, 0, 0);
    assert_close(upper.x, 4, 0);
    assert_close(lower.y, -0.5, 0);
    assert_close(upper.y, 0.5, 0);
    assert_close(ang_volume_half_diagonal(volume), sqrt(2. * 2 + 2 * 2 + 9 * 9) / 2, 1e-12);
    assert_close(ang_volume_smallest_spacing(volume), 0.5, 0);
    ang_volume_free(volume);
}

static void slices_are_measured_along_their_normal(void **state) {
    (void)state;
    double spacing[3] = {0.5, 2, 3};
    ang_volume *volume = make_volume(4, 4, 4, spacing, linear_value);
    assert_close(ang_volume_slice_distance(volume), 3, 1e-12);
    volume->affine.m[1][2] = 4; /* sheared: 5 mm to the next centre, 3 mm to its plane */
    assert_close(ang_volume_spacing(volume, 2), 5, 1e-12);
    assert_close(ang_volume_slice_distance(volume), 3, 1e-12);
    volume->affine.m[2][2] = -3;
    assert_close(ang_volume_slice_distance(volume), 3, 1e-12);
    ang_volume_free(volume);
}

static void samples_and_gradients_of_a_linear_field_are_exact(void **state) {
    (void)state;
    double spacing[3] = {0.5, 2, 4};
    ang_volume *volume = make_volume(9, 9, 9, spacing, linear_value);
    ang_mat4 to_index;
    assert_true(ang_mat4_inverse(&volume->affine, &to_index));
    ang_vec3 at = {3.3, 4.7, 2.9};
    assert_close(ang_volume_hu(volume, ang_volume_sample(volume, at)), 3 * 3.3 - 5 * 4.7 + 7 * 2.9, 1e-10);
    ang_vec3 gradient = ang_volume_gradient(volume, &to_index, at);
    assert_close(gradient.x, 3 / 0.5, 1e-10);
    assert_close(gradient.y, -5 / 2., 1e-10);
    assert_close(gradient.z, 7 / 4., 1e-10);
    /* At a face one side is clamped: half the difference. */
    gradient = ang_volume_gradient(volume, &to_index, (ang_vec3){0, 4, 4});
    assert_close(gradient.x, 3 / 0.5 / 2, 1e-10);
    ang_volume_free(volume);
}

static void padding_becomes_air_and_leaves_the_statistics(void **state) {
    (void)state;
    ang_volume *volume = make_volume(20, 20, 5, unit, linear_value);
    for (size_t i = 0; i < 400 * 5; i++) {
        size_t x = i % 20, y = i / 20 % 20;
        if (x + y < 4 || x + y > 34 || x > y + 15 || y > x + 15) volume->data[i] = 0; /* -1024 HU is air, */
    }
    uint16_t found;
    assert_false(ang_volume_find_padding(volume, &found));
    volume->intercept = -2024; /* -2024 HU is none */
    for (size_t i = 0; i < 2000; i++)
        if (volume->data[i] > 0) volume->data[i] = (uint16_t)(volume->data[i] + 1000);
    assert_true(ang_volume_find_padding(volume, &found));
    assert_int_equal(found, 0);
    size_t expected = 0;
    for (size_t i = 0; i < 2000; i++) expected += volume->data[i] == 0;
    assert_true(ang_volume_mark_padding(volume, found, NULL));
    assert_int_equal(volume->padding_count, expected);
    assert_true(ang_volume_is_padding(volume, 0));
    assert_close(ang_volume_hu(volume, volume->data[0]), -1000, 0);
    ang_volume_update_range(volume, 2);
    assert_true(ang_volume_hu(volume, volume->minimum) > -200);
    ang_histogram *histogram = ang_histogram_build(volume, 2, NULL);
    assert_int_equal(histogram->total, 2000 - expected);
    uint64_t counts[ANG_HISTOGRAM_BINS] = {0};
    for (size_t i = 0; i < 2000; i++) counts[volume->data[i]] += !ang_volume_is_padding(volume, i);
    assert_memory_equal(counts, histogram->bin, sizeof counts);
    assert_int_equal(counts[volume->data[0]], 0);
    free(histogram);
    ang_volume_free(volume);
}

static void histogram_counts_every_voxel_once(void **state) {
    (void)state;
    ang_volume *volume = make_volume(33, 17, 21, unit, noise_value);
    ang_histogram *histogram = ang_histogram_build(volume, 2, NULL);
    uint64_t counts[ANG_HISTOGRAM_BINS] = {0};
    for (size_t i = 0; i < ang_volume_count(volume); i++) counts[volume->data[i]]++;
    assert_memory_equal(counts, histogram->bin, sizeof counts);
    assert_int_equal(ang_histogram_quantile(histogram, 0), volume->minimum);
    assert_int_equal(ang_histogram_quantile(histogram, 1), volume->maximum);
    free(histogram);
    ang_volume_free(volume);
}

/* The range of the node at `place` of a level whose nodes have `size` cells. */
static ang_minmax brute_force(const ang_volume *volume, const int place[3], const int size[3], int apron) {
    ang_minmax range = {UINT16_MAX, 0};
    int low[3], high[3];
    for (int axis = 0; axis < 3; axis++) {
        int bottom = place[axis] * size[axis] - (apron - 1);
        int top = place[axis] * size[axis] + size[axis] + (apron - 1), last = volume->dims[axis] - 1;
        low[axis] = bottom < 0 ? 0 : bottom;
        high[axis] = top > last ? last : top;
    }
    for (int z = low[2]; z <= high[2]; z++)
        for (int y = low[1]; y <= high[1]; y++)
            for (int x = low[0]; x <= high[0]; x++) {
                uint16_t v = volume->data[x + volume->dims[0] * (y + volume->dims[1] * z)];
                range.min = v < range.min ? v : range.min;
                range.max = v > range.max ? v : range.max;
            }
    return range;
}

static void check_octree(const ang_volume *volume, const int *leaf, int apron) {
    ang_octree *octree = ang_octree_build(volume, leaf, apron, 2, NULL);
    assert_non_null(octree);
    for (int level = 0; level < octree->levels; level++) {
        const ang_octree_level *l = &octree->level[level];
        int size[3];
        for (int axis = 0; axis < 3; axis++) size[axis] = octree->leaf[axis] << level;
        size_t voxels = 0;
        for (int i = 0, z = 0; z < l->dims[2]; z++)
            for (int y = 0; y < l->dims[1]; y++)
                for (int x = 0; x < l->dims[0]; x++, i++) {
                    int node[3] = {x, y, z}, first[3], end[3];
                    ang_minmax expected = brute_force(volume, node, size, apron);
                    assert_int_equal(l->nodes[i].min, expected.min);
                    assert_int_equal(l->nodes[i].max, expected.max);
                    ang_octree_cells(octree, level, node, first, end);
                    voxels += (size_t)(end[0] - first[0]) * (size_t)(end[1] - first[1]) * (size_t)(end[2] - first[2]);
                }
        assert_int_equal(voxels, (size_t)octree->cells[0] * (size_t)octree->cells[1] * (size_t)octree->cells[2]);
    }
    const ang_octree_level *top = &octree->level[octree->levels - 1];
    assert_int_equal(top->dims[0] * top->dims[1] * top->dims[2], 1);
    assert_int_equal(top->nodes[0].min, volume->minimum);
    assert_int_equal(top->nodes[0].max, volume->maximum);
    ang_octree_free(octree);
}

static void octree_equals_brute_force_for_any_dims(void **state) {
    (void)state;
    static const int sizes[][3] = {{1, 1, 1},   {2, 3, 1},    {8, 8, 8},   {9, 9, 9},   {17, 5, 33},
                                   {64, 1, 70}, {40, 41, 42}, {1, 100, 3}, {65, 66, 7}, {10, 1, 1}};
    static const int leaves[][3] = {{8, 8, 8}, {3, 5, 2}, {1, 1, 1}, {64, 7, 200}};
    for (size_t s = 0; s < sizeof sizes / sizeof *sizes; s++)
        for (int k = 0; k < 8; k++) {
            ang_volume *volume = make_volume(sizes[s][0], sizes[s][1], sizes[s][2], unit, noise_value);
            check_octree(volume, k / 2 > 0 ? leaves[k / 2] : NULL, 1 + k % 2);
            check_octree(volume, leaves[k / 2], 5);
            ang_volume_free(volume);
        }
}

static void impossible_sizes_are_refused(void **state) {
    (void)state;
    ang_error err;
    assert_null(ang_volume_create((const int[3]){0, 5, 5}, &err));
    assert_int_equal(err.code, ANG_INPUT);
    assert_null(ang_volume_create((const int[3]){2147483647, 2147483647, 2147483647}, &err));
    assert_int_equal(err.code, ANG_LIMIT);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_matrix_and_its_inverse_cancel),
        cmocka_unit_test(box_has_voxel_centres_and_half_a_spacing_where_flat),
        cmocka_unit_test(slices_are_measured_along_their_normal),
        cmocka_unit_test(samples_and_gradients_of_a_linear_field_are_exact),
        cmocka_unit_test(padding_becomes_air_and_leaves_the_statistics),
        cmocka_unit_test(histogram_counts_every_voxel_once),
        cmocka_unit_test(octree_equals_brute_force_for_any_dims),
        cmocka_unit_test(impossible_sizes_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
