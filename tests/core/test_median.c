#include "core/base/median.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

static void the_middle_of_few(void **state) {
    (void)state;
    double one[] = {7}, two[] = {9, 4}, five[] = {3, -1, 8, 100, 5};
    assert_true(isnan(ang_median(NULL, 0)));
    assert_true(ang_median(one, 1) == 7);
    assert_true(ang_median(two, 2) == 6.5);
    assert_true(ang_median(five, 5) == 5);
    for (int i = 1; i < 5; i++) assert_true(five[i - 1] < five[i]);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(the_middle_of_few)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
