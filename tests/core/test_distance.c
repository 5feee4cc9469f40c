/* The distance grid against the definition. */
#include "tests/core/fixtures.h"

#include "core/plan/distance.h"

#include <string.h>

static int nearest(const int dims[3], const uint8_t *visible, int x, int y, int z) {
    int best = 255;
    for (int k = 0, i = 0; k < dims[2]; k++)
        for (int j = 0; j < dims[1]; j++)
            for (int h = 0; h < dims[0]; h++, i++) {
                if (!visible[i]) continue;
                int far = abs(h - x) > abs(j - y) ? abs(h - x) : abs(j - y);
                if (abs(k - z) > far) far = abs(k - z);
                if (far < best) best = far;
            }
    return best;
}

static void distances_are_those_of_the_definition(void **state) {
    (void)state;
    static const int shapes[][3] = {{1, 1, 1},  {17, 1, 1},  {1, 9, 4},   {13, 11, 7},
                                    {6, 5, 21}, {131, 4, 3}, {128, 3, 3}, {300, 2, 2}};
    uint64_t seed = 11;
    for (size_t s = 0; s < sizeof shapes / sizeof *shapes; s++)
        for (int filling = 0; filling < 5; filling++) {
            const int *dims = shapes[s];
            size_t count = (size_t)(dims[0] * dims[1] * dims[2]);
            uint8_t *visible = calloc(count, 1), *distance = malloc(count);
            for (size_t i = 0; i < count; i++) visible[i] = random_unit(&seed) < filling * 0.01;
            if (filling == 4) memset(visible, 1, count);
            ang_block_distances(dims, visible, distance);
            for (size_t i = 0; i < count; i++) {
                int x = (int)i % dims[0], y = (int)i / dims[0] % dims[1], z = (int)i / dims[0] / dims[1];
                assert_int_equal(distance[i], nearest(dims, visible, x, y, z));
            }
            free(visible);
            free(distance);
        }
}

static void what_is_farther_than_a_byte_holds_is_255(void **state) {
    (void)state;
    static const int dims[3] = {400, 1, 1};
    uint8_t visible[400] = {1}, distance[400];
    ang_block_distances(dims, visible, distance);
    for (int i = 0; i < 400; i++) assert_int_equal(distance[i], i < 255 ? i : 255);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(distances_are_those_of_the_definition),
                                       cmocka_unit_test(what_is_farther_than_a_byte_holds_is_255)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
