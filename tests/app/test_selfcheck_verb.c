/* angioscope selfcheck as scripts use it: exit codes, what goes to stdout, JSON. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
/* after them */
#include <cjson/cJSON.h>
#include <cmocka.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "tests/app/program.h"

#define TMP ANG_TEST_TMP "/selfcheck"

static int make_folder(void **state) {
    (void)state;
    mkdir(TMP, 0777);
    return 0;
}

static void unknown_arguments_give_two(void **state) {
    (void)state;
    expect(2, "selfcheck /tmp 2>&1");
    assert_non_null(strstr(output, "takes no files"));
    expect(2, "selfcheck --cases 1,99 2>&1");
    assert_non_null(strstr(output, "there is no case 99"));
    expect(2, "selfcheck --cases 1.5 2>&1");
    expect(2, "selfcheck --cases all 2>&1");
    expect(2, "selfcheck --backend carrier-pigeon 2>&1");
    expect(2, "selfcheck --size 3x3 2>&1");
    expect(2, "selfcheck --json 2>&1");
    expect(7, "selfcheck --cases 23 --json " TMP "/no/such/folder.json 2>&1");
}

static void the_table_goes_to_stdout_and_progress_to_stderr(void **state) {
    (void)state;
    expect(0, "selfcheck --backend none --cases 2,12,23 2>/dev/null");
    assert_non_null(strstr(output, "no OpenGL"));
    assert_non_null(strstr(output, "(no method)"));
    assert_non_null(strstr(output, "cpu"));
    assert_non_null(strstr(output, "reference"));
    assert_non_null(strstr(output, "planes through vertex, edge, face"));
    assert_null(strstr(output, "homogeneous medium"));
    assert_null(strstr(output, "checking"));
    assert_non_null(strstr(output, "5 ok, 0 red"));
    expect(0, "selfcheck --backend none --cases 23 2>&1 >/dev/null");
    assert_non_null(strstr(output, "checking"));
    expect(0, "selfcheck --backend none --cases 23 --quiet 2>&1 >/dev/null");
    assert_int_equal(strlen(output), 0);
    expect(0, "selfcheck --backend none --cases 17 2>/dev/null");
    assert_non_null(strstr(output, "case 17 does not apply to reference: it does not divide"));
    expect(0, "selfcheck --help");
    assert_non_null(strstr(output, "--cases"));
}

static void json_says_what_was_measured(void **state) {
    (void)state;
    expect(0, "selfcheck --backend none --cases 1,12,27 --json - --quiet 2>/dev/null");
    cJSON *root = cJSON_Parse(output);
    assert_non_null(root);
    const cJSON *list = cJSON_GetObjectItem(root, "cases");
    assert_int_equal(cJSON_GetArraySize(list), 3);
    static const char *const methods[] = {"reference", NULL, "reference"}, *const verdicts[] = {"ok", "ok",
                                                                                                "not applicable"};
    for (int i = 0; i < 3; i++) {
        const cJSON *entry = cJSON_GetArrayItem(list, i), *results = cJSON_GetObjectItem(entry, "results");
        assert_true(strlen(cJSON_GetStringValue(cJSON_GetObjectItem(entry, "red_means"))) > 20);
        /* The last is the reference's; before it come those of the other methods that need no OpenGL. */
        int count = methods[i] ? 3 : 1;
        assert_int_equal(cJSON_GetArraySize(results), count);
        const cJSON *result = cJSON_GetArrayItem(results, count - 1), *method = cJSON_GetObjectItem(result, "method");
        if (methods[i])
            assert_string_equal(cJSON_GetStringValue(method), methods[i]);
        else
            assert_true(cJSON_IsNull(method));
        assert_string_equal(cJSON_GetStringValue(cJSON_GetObjectItem(result, "verdict")), verdicts[i]);
        if (i == 2) continue;
        double measured = cJSON_GetNumberValue(cJSON_GetObjectItem(result, "measured"));
        assert_true(measured >= 0 && measured <= cJSON_GetNumberValue(cJSON_GetObjectItem(result, "high")));
    }
    assert_true(cJSON_GetNumberValue(cJSON_GetObjectItem(root, "red")) == 0);
    cJSON_Delete(root);

    expect(0, "selfcheck --backend none --cases 23 --quiet --json " TMP "/out.json");
    assert_non_null(strstr(output, "unordered points")); /* the table as well */
    assert_int_equal(access(TMP "/out.json", R_OK), 0);
}

static void missing_opengl_gives_five(void **state) {
    (void)state;
    int code = run("selfcheck --backend osmesa --cases 23 --quiet 2>&1 >/dev/null; "
                   "MESA_GL_VERSION_OVERRIDE=4.2 " ANG_PROGRAM " selfcheck --backend osmesa --cases 23 --quiet 2>&1");
    assert_int_equal(code, 5);
    assert_non_null(strstr(output, "osmesa: not here"));
}

/* llvmpipe leaves blending out where it is told to: a driver that is really broken. */
static void a_broken_driver_gives_one(void **state) {
    (void)state;
    int code = run("--version >/dev/null; LP_PERF=no_blend MESA_SHADER_CACHE_DISABLE=true " ANG_PROGRAM
                   " selfcheck --backend osmesa --cases 22 2>&1");
    if (strstr(output, "osmesa: not here")) skip();
    assert_non_null(strstr(output, "RED case 22, sphere, slicing, osmesa"));
    assert_non_null(strstr(output, "projections miss the brightest value"));
    assert_non_null(strstr(output, "checks are red"));
    assert_int_equal(code, 1);
}

static void an_interrupt_gives_130(void **state) {
    (void)state;
    int status =
        system("timeout --preserve-status -s INT 0.3 " ANG_PROGRAM " selfcheck --backend none --quiet >/dev/null 2>&1");
    assert_true(WIFEXITED(status));
    assert_int_equal(WEXITSTATUS(status), 130);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(unknown_arguments_give_two),
        cmocka_unit_test(the_table_goes_to_stdout_and_progress_to_stderr),
        cmocka_unit_test(json_says_what_was_measured),
        cmocka_unit_test(missing_opengl_gives_five),
        cmocka_unit_test(a_broken_driver_gives_one),
        cmocka_unit_test(an_interrupt_gives_130),
    };
    return cmocka_run_group_tests(tests, make_folder, NULL);
}
