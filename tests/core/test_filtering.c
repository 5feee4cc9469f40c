/* How finely texture units interpolate, on every backend that is here. */
#include "tests/core/backends.h"

#include "core/render/filtering.h"

#include <string.h>

static void bits_and_deviation_agree(void **state) {
    open_gl(state);
    ang_error err = {0};
    double deviation = -1;
    int bits = ang_gl_filter_bits(gl, &deviation, &err);
    if (bits == 0) fail_msg("%s", err.message);
    print_message("%s: %d bits, %.3g from a line\n", ang_gl_renderer(gl), bits, deviation);
    /* OpenGL asks for 4 bits; fixed point with b bits, rounded, is at most 2^-(b+1) off. */
    assert_true(bits >= 4 && bits <= 16);
    assert_true(deviation >= 0 && deviation <= ldexp(1, -bits));
    if (bits < 16) assert_true(deviation > ldexp(1, -(bits + 2)));
}

/* numerics.md: llvmpipe filters R16 in full float. */
static void software_filters_in_float(void **state) {
    open_gl(state);
    if (!strstr(ang_gl_renderer(gl), "llvmpipe")) skip();
    ang_error err = {0};
    double deviation = 1;
    assert_int_equal(ang_gl_filter_bits(gl, &deviation, &err), 16);
    assert_true(deviation < 1e-6);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(bits_and_deviation_agree),
        cmocka_unit_test(software_filters_in_float),
    };
    return run_on_backends(tests);
}
