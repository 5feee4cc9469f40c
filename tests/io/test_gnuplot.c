/* gnuplot as a program that makes texts of texts. */
#include "io/gnuplot.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "tests/io/bad_places.h"

static void need_gnuplot(void) {
    const char *why = NULL;
    if (ang_gnuplot_there(&why)) return;
    print_message("%s\n", why);
    skip();
}

static void a_plot_is_an_svg(void **state) {
    (void)state;
    need_gnuplot();
    ang_error err = {0};
    char *svg = NULL;
    if (!ang_gnuplot_run("set terminal svg\n$d << END\n1 2\n3 4\nEND\nplot $d title 'the name'\n", &svg, &err))
        fail_msg("%s", err.message);
    assert_non_null(strstr(svg, "<svg"));
    assert_non_null(strstr(svg, "the name"));
    assert_non_null(strstr(svg, "</svg>"));
    free(svg);
}

/* More than pipes hold, in both directions. */
static void long_scripts_do_not_hang(void **state) {
    (void)state;
    need_gnuplot();
    enum { lines = 20000, length = 16 };
    char *script = malloc(lines * length + 256), *svg = NULL;
    assert_non_null(script);
    char *end = script + sprintf(script, "set terminal svg\n$d << END\n");
    for (int i = 0; i < lines; i++) end += sprintf(end, "%d %d\n", i, i * 7 % 1000);
    strcpy(end, "END\nplot $d with lines\n");
    ang_error err = {0};
    if (!ang_gnuplot_run(script, &svg, &err)) fail_msg("%s", err.message);
    assert_true(strlen(svg) > 100000);
    free(svg);
    free(script);
}

static void what_is_wrong_is_said_in_one_line(void **state) {
    (void)state;
    need_gnuplot();
    ang_error err = {0};
    char *svg = NULL;
    assert_false(ang_gnuplot_run("set terminal svg\nplot sideways of it\n", &svg, &err));
    assert_null(svg);
    assert_int_equal(err.code, ANG_OUTPUT);
    assert_non_null(strstr(err.message, "gnuplot made no plot"));
    assert_null(strchr(err.message, '\n'));
}

/* As on a full disk: gnuplot itself ends as if all were well. */
static int plot_beyond_a_limit(const char *path) {
    (void)path;
    ang_error err = {0};
    char *svg = NULL;
    if (!limit_files(2000)) return NOT_POSSIBLE;
    if (ang_gnuplot_run("set terminal svg\nplot sin(x)\n", &svg, &err)) return 1;
    return svg == NULL && err.code == ANG_OUTPUT ? 0 : 2;
}
static void half_a_plot_is_none(void **state) {
    (void)state;
    need_gnuplot();
    expect_in_child(0, plot_beyond_a_limit, NULL);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_plot_is_an_svg),
        cmocka_unit_test(long_scripts_do_not_hang),
        cmocka_unit_test(what_is_wrong_is_said_in_one_line),
        cmocka_unit_test(half_a_plot_is_none),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
