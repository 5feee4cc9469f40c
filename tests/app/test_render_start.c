/* What a picture without a GPU brings into the process: not OpenGL in software, nor codecs and picture formats that
 * nobody asked for. The system's own loader says what is opened. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "tests/app/program.h"

#include <stdlib.h>
#include <string.h>

#define FOLDER ANG_TEST_TMP "/render_start"
#define RENDER "render " FOLDER "/ct --preset cta-head --size 32x32 --quiet -o " FOLDER

static int setup(void **state) {
    (void)state;
    if (system("rm -rf " FOLDER " && mkdir -p " FOLDER) != 0) return -1;
    expect(0, "phantom -o " FOLDER "/ct --dims 32x32x24 --quiet 2>&1");
    return 0;
}

static int teardown(void **state) {
    (void)state;
    return system("rm -rf " FOLDER);
}

/* Names of the files that the program opens to run code in them. */
static void list_opened(const char *arguments) {
    char command[4096];
    snprintf(command, sizeof command, "LD_DEBUG=files %s %s 2>&1 | grep 'file=.*generating link map'", ANG_PROGRAM,
             arguments);
    FILE *pipe = popen(command, "r");
    assert_non_null(pipe);
    output[fread(output, 1, sizeof output - 1, pipe)] = '\0';
    pclose(pipe);
    assert_non_null(strstr(output, "libc.so"));
}

static bool takes_cpu(void) {
    expect(0, RENDER "/auto.png --json - 2>/dev/null");
    if (strstr(output, "\"cpu\"")) return true;
    print_message("skipped: auto takes a GPU here\n");
    return false;
}

static void what_is_not_used_is_not_opened(void **state) {
    (void)state;
    if (!takes_cpu()) return;
    assert_null(strstr(output, "gl_renderer"));
    static const char *const spared[] = {"LLVM", "OSMesa", "gallium", "_dri.so", "gdcm", "OpenImageIO"};
    list_opened(RENDER "/auto.png");
    for (size_t i = 0; i < sizeof spared / sizeof *spared; i++)
        if (strstr(output, spared[i])) fail_msg("%s is opened", spared[i]);
    expect(0, RENDER "/auto.png --explain 2>&1");
    assert_non_null(strstr(output, "left out  OpenGL: this method needs none; saves making a context"));
}

static void pictures_are_the_same_without_a_context(void **state) {
    (void)state;
    if (!takes_cpu()) return;
    expect(0, RENDER "/cpu.png --method cpu --backend none 2>&1");
    expect(0, "check " FOLDER "/auto.png " FOLDER "/cpu.png --threshold 0");
}

#ifdef ANG_WITH_OSMESA
static void what_asks_for_opengl_has_it(void **state) {
    (void)state;
    if (!takes_cpu()) return;
    expect(0, RENDER "/named.png --backend osmesa --json - 2>/dev/null");
    assert_non_null(strstr(output, "gl_renderer"));
    /* An option that only slicing takes. */
    expect(0, RENDER "/bricks.png --bricks 2x2x2 --json - 2>/dev/null");
    assert_non_null(strstr(output, "\"slicing\""));
    assert_non_null(strstr(output, "gl_renderer"));
}
#endif

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_is_not_used_is_not_opened),
        cmocka_unit_test(pictures_are_the_same_without_a_context),
#ifdef ANG_WITH_OSMESA
        cmocka_unit_test(what_asks_for_opengl_has_it),
#endif
    };
    return cmocka_run_group_tests(tests, setup, teardown);
}
