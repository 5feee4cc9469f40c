/* Numbers of fields: what was typed stays, what a drag gave is shown to what it can tell apart. */
#include "tests/core/fixtures.h"

#include "ui/state/number_text.h"

#include <stdio.h>
#include <stdlib.h>

/* As a field shows it, and what is read from there. */
static const char *shown(double value, double resolution, double *read) {
    static char text[64];
    snprintf(text, sizeof text, "%.*f", ang_number_decimals(value, resolution), value);
    *read = strtod(text, NULL);
    return text;
}

static void what_was_typed_is_shown_whole(void **state) {
    (void)state;
    static const char *const typed[] = {"0", "-1024", "123.456", "0.1", "-0.000001", "3071.25", "65535", "1e-3"};
    for (size_t i = 0; i < sizeof typed / sizeof *typed; i++) {
        double value = strtod(typed[i], NULL), read;
        shown(value, 10, &read);
        assert_true(read >= value && read <= value);
    }
}

static void what_was_dragged_is_shown_as_fine_as_it_can_be(void **state) {
    (void)state;
    double read;
    assert_string_equal(shown(1000.0 / 7, 9.4, &read), "142.9");
    assert_string_equal(shown(-1000.0 / 7, 0.11, &read), "-142.9");
    assert_string_equal(shown(1.0 / 7, 0.003, &read), "0.143");
    assert_string_equal(shown(100.0 / 3, 1e-12, &read), "33.333333");
}

static void shares_show_two_digits(void **state) {
    (void)state;
    static const double percent[] = {287.0 / 7, 100.0 / 3, 3.6 / 7, 0.086 / 7, 50, 0.25, -290.0 / 7};
    static const int decimals[] = {0, 1, 2, 4, 0, 2, 1};
    for (size_t i = 0; i < sizeof percent / sizeof *percent; i++)
        assert_int_equal(ang_percent_decimals(percent[i]), decimals[i]);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_was_typed_is_shown_whole),
        cmocka_unit_test(what_was_dragged_is_shown_as_fine_as_it_can_be),
        cmocka_unit_test(shares_show_two_digits),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
