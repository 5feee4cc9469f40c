/* Which blocks show, found by the ends of their ranges, against the question asked of every block by itself. */
#include "tests/core/fixtures.h"

#include "core/plan/block_grid.h"
#include "core/plan/distance.h"

#include <string.h>

enum { NX = 150, NY = 21, NZ = 14 };

static uint64_t seed = 5;

/* Balls in noise, one value in the lower half. */
static double value(int x, int y, int z) {
    if (z < NZ / 2) return 0;
    double far = hypot(hypot(x - 60, y - 10), 3 * (z - 10));
    return floor((far < 8 ? 900 : -200) + 60 * random_unit(&seed));
}

/* What ang_block_grid_update says of one range. */
static bool shows(const ang_visibility *visibility, ang_minmax range, bool rounding) {
    if (ang_visibility_of(visibility, range)) return true;
    if (!rounding || range.min == range.max) return false;
    range.min = (uint16_t)(range.min > 0 ? range.min - 1 : 0);
    range.max = (uint16_t)(range.max < UINT16_MAX ? range.max + 1 : UINT16_MAX);
    return ang_visibility_of(visibility, range);
}

static void compare(ang_block_grid *grid, const ang_visibility *visibility, bool rounding, int threads) {
    bool changed;
    assert_true(ang_block_grid_update(grid, visibility, rounding, threads, &changed, NULL));
    const ang_octree *octree = grid->octree;
    ang_block_box box = ang_block_box_none();
    uint8_t *visible = malloc(grid->blocks), *distance = malloc(grid->blocks);
    size_t count = 0;
    for (size_t i = 0; i < grid->blocks; i++) {
        visible[i] = shows(visibility, octree->level[0].nodes[i], rounding);
        count += visible[i];
        if (visible[i]) ang_block_box_add(&box, octree, i);
    }
    ang_block_distances(octree->level[0].dims, visible, distance);
    assert_int_equal(grid->visible_blocks, count);
    assert_memory_equal(grid->visible, visible, grid->blocks);
    assert_memory_equal(grid->distance, distance, grid->blocks);
    assert_memory_equal(&grid->box, &box, sizeof box);
    free(distance);
    free(visible);
}

static void blocks_show_as_each_range_by_itself(void **state) {
    (void)state;
    static const double spacing[3] = {1, 1, 1};
    /* Steps, peaks of one value, ramps; nothing at 0 HU in some. */
    static const ang_transfer_point points[][4] = {
        {{-150, {1, 1, 1}, 0}, {-150, {1, 1, 1}, 0.5}, {-149, {1, 1, 1}, 0.5}, {-149, {1, 1, 1}, 0}},
        {{-1, {1, 0, 0}, 0}, {0, {1, 0, 0}, 1}, {1, {1, 0, 0}, 0}, {2000, {1, 0, 0}, 0}},
        {{100, {0, 1, 1}, 0}, {899.5, {0, 1, 1}, 0.001}, {950.25, {0, 1, 1}, 0.7}, {950.75, {0, 1, 1}, 0}},
        {{-1500, {0, 1, 1}, 0.1}, {-201, {0, 1, 1}, 0}, {955, {0, 1, 1}, 0}, {960, {0, 1, 1}, 0.2}}};
    ang_volume *volume = make_volume(NX, NY, NZ, spacing, value);
    ang_scene scene = ang_scene_default(volume);
    ang_block_grid grid = {0};
    assert_true(ang_block_grid_start(&grid, volume, NULL, 2, NULL));
    for (size_t t = 0; t < sizeof points / sizeof *points; t++)
        for (int limit = 0; limit <= 64; limit += 32) { /* 0: intervals of a value or less; else wider ones */
            ang_transfer *transfer = ang_transfer_create(points[t], 4, 1, false, NULL, NULL);
            ang_transfer_tables *tables =
                ang_tables_create(transfer, 1, -1024, volume->minimum, volume->maximum, limit, NULL);
            assert_non_null(tables);
            ang_visibility visibility = ang_visibility_make(volume, &scene, tables);
            for (int rounding = 0; rounding < 2; rounding++) compare(&grid, &visibility, rounding, 1 + rounding);
            ang_tables_free(tables);
            ang_transfer_free(transfer);
        }
    static const ang_mode modes[] = {ANG_MODE_MIP, ANG_MODE_MINIP, ANG_MODE_MEAN, ANG_MODE_ISO};
    static const double places[] = {-INFINITY, -200, -199.97, -140, 0, 0.04, 1, 899, 959.96, 960, 961, INFINITY};
    for (size_t m = 0; m < sizeof modes / sizeof *modes; m++)
        for (size_t p = 0; p < sizeof places / sizeof *places; p++) {
            ang_visibility visibility = {.mode = modes[m], .threshold = places[p] + 1024};
            for (int rounding = 0; rounding < 2; rounding++) compare(&grid, &visibility, rounding, 2);
        }
    ang_block_grid_clear(&grid);
    ang_volume_free(volume);
}

/* Tables are filled region by region: the same as asking the transfer function of every value. */
static void tables_see_what_the_transfer_function_sees(void **state) {
    (void)state;
    for (int round = 0; round < 40; round++) {
        ang_transfer_point points[12];
        double hu = -1200;
        for (int i = 0; i < 12; i++) {
            double move = random_unit(&seed);
            hu += move < 0.2 ? 0 : move < 0.5 ? floor(move * 10) : move * 400;
            points[i] = (ang_transfer_point){hu, {1, 1, 1}, random_unit(&seed) < 0.5 ? 0 : random_unit(&seed)};
        }
        ang_transfer *transfer = ang_transfer_create(points, 12, 1, false, NULL, NULL);
        double slope = round % 3 == 0 ? 1 : 0.3 + random_unit(&seed), intercept = -1024.25;
        ang_transfer_tables *tables = ang_tables_create(transfer, slope, intercept, 0, 65535, 0, NULL);
        assert_non_null(tables);
        uint32_t count = 0;
        for (int v = 0; v < 65536; v++) {
            double low = slope * v + intercept, high = slope * (v + 1) + intercept;
            if (tables->point_visible[v] != ang_transfer_visible(transfer, low, low))
                fail_msg("round %d, value %d: %d", round, v, tables->point_visible[v]);
            assert_int_equal(tables->visible[v], count);
            count += ang_transfer_visible(transfer, low, high);
        }
        ang_tables_free(tables);
        ang_transfer_free(transfer);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(blocks_show_as_each_range_by_itself),
                                       cmocka_unit_test(tables_see_what_the_transfer_function_sees)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
