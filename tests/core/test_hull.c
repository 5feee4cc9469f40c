/* The cells of an envelope against their definition. */
#include "tests/core/fixtures.h"

#include "core/plan/hull.h"

static const int dims[3] = {13, 9, 6};

static void cells_hold_all_that_shows_within_the_budget(void **state) {
    (void)state;
    uint64_t seed = 5;
    for (int round = 0; round < 200; round++) {
        uint8_t visible[13 * 9 * 6];
        size_t count = sizeof visible, budget = 6 + (size_t)(random_unit(&seed) * 400);
        double share = random_unit(&seed) * random_unit(&seed);
        for (size_t i = 0; i < count; i++) visible[i] = random_unit(&seed) < share;
        int first[3], end[3];
        for (int axis = 0; axis < 3; axis++) {
            first[axis] = (int)(random_unit(&seed) * dims[axis]);
            end[axis] = first[axis] + 1 + (int)(random_unit(&seed) * (dims[axis] - first[axis]));
        }
        ang_hull_cells cells = {0};
        assert_true(ang_hull_cells_make(&cells, dims, visible, first, end, budget, NULL));
        assert_true(cells.side > 0); /* one cell has six faces */
        assert_true(cells.faces <= budget);
        size_t faces = 0;
        for (int z = -1; z <= cells.dims[2]; z++)
            for (int y = -1; y <= cells.dims[1]; y++)
                for (int x = -1; x <= cells.dims[0]; x++) {
                    bool shows = false;
                    for (int k = z * cells.side; k < (z + 1) * cells.side; k++)
                        for (int j = y * cells.side; j < (y + 1) * cells.side; j++)
                            for (int i = x * cells.side; i < (x + 1) * cells.side; i++)
                                shows = shows || (i >= first[0] && i < end[0] && j >= first[1] && j < end[1] &&
                                                  k >= first[2] && k < end[2] && visible[i + 13 * (j + 9 * k)]);
                    bool active = ang_hull_active(&cells, x, y, z);
                    assert_int_equal(active, shows);
                    faces += active != ang_hull_active(&cells, x + 1, y, z);
                    faces += active != ang_hull_active(&cells, x, y + 1, z);
                    faces += active != ang_hull_active(&cells, x, y, z + 1);
                }
        assert_int_equal(cells.faces, faces);
        ang_hull_cells_clear(&cells);
    }
}

static void too_small_a_budget_leaves_the_box(void **state) {
    (void)state;
    uint8_t visible[13 * 9 * 6] = {1};
    ang_hull_cells cells = {0};
    assert_true(ang_hull_cells_make(&cells, dims, visible, (const int[3]){0, 0, 0}, dims, 5, NULL));
    assert_int_equal(cells.side, 0);
    visible[0] = 0;
    assert_true(ang_hull_cells_make(&cells, dims, visible, (const int[3]){0, 0, 0}, dims, 5, NULL));
    assert_int_equal(cells.side, 1);
    assert_int_equal(cells.faces, 0);
    ang_hull_cells_clear(&cells);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(cells_hold_all_that_shows_within_the_budget),
                                       cmocka_unit_test(too_small_a_budget_leaves_the_box)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
