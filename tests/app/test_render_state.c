/* Pictures drawn again from what they carry, without a window. */
#include "tests/core/fixtures.h"

#include "tests/app/program.h"

#include <string.h>

#define FOLDER ANG_TEST_TMP "/render_state"
#define DATA   FOLDER "/phantom"
#define QUIET  " -q -o " FOLDER

static int opening(void **state) {
    (void)state;
    if (system("rm -rf " FOLDER " && mkdir -p " FOLDER) != 0) return -1;
    return run("phantom -o " DATA " --dims 48x48x24 --quiet") || run("phantom -o " FOLDER "/other --dims 48x48x24 "
                                                                     "--seed 2 --quiet");
}

static bool same_files(const char *a, const char *b) {
    char command[1024];
    snprintf(command, sizeof command, "cmp -s " FOLDER "/%s " FOLDER "/%s", a, b);
    return system(command) == 0;
}

static void need_pictures(void) {
#ifndef ANG_WITH_OIIO
    print_message("skipped: this build writes no PNG\n");
    skip();
#endif
}

/* The file with its state is the same to the byte. */
static void a_picture_is_drawn_again(void **state) {
    (void)state;
    need_pictures();
    static const char *const scenes[] = {
        "--preset cta-head --view 20,10,5 --zoom 1.3 --pan 3,-2 --clip 10%,90%,0,100%,0,80% --axes --shift 20 "
        "--background 0.1,0.2,0.3,0.5 --size 120x90",
        "--mode mip --view left --projection parallel --size 90x120 --step 0.3",
        "--mode iso --iso 321.7 --fov 20 --size 100x100",
        "--preset ct-bone --shading none --cut-plane axial:30% --size 100x100 --termination 0.9",
        "--mode lookups --method cpu --size 64x64",
        "--preset cta-head --every 3 --size 64x50",
        "--preset cta-head --method cpu --max-time 0.01 --size 64x50", /* draws every fourth pixel */
    };
    for (size_t i = 0; i < sizeof scenes / sizeof *scenes; i++) {
        static const char *const endings[] = {"png", "exr"};
        for (size_t e = 0; e < (i == 0 ? 2 : 1); e++) {
            char arguments[1024], names[2][32];
            snprintf(arguments, sizeof arguments, "render " DATA " --backend none %s" QUIET "/%zu.%s", scenes[i], i,
                     endings[e]);
            expect(0, arguments);
            snprintf(arguments, sizeof arguments,
                     "render " DATA " --backend none --state " FOLDER "/%zu.%s" QUIET "/%zu-again.%s", i, endings[e], i,
                     endings[e]);
            expect(0, arguments);
            snprintf(names[0], sizeof names[0], "%zu.%s", i, endings[e]);
            snprintf(names[1], sizeof names[1], "%zu-again.%s", i, endings[e]);
            if (!same_files(names[0], names[1])) fail_msg("%s is not drawn again: %s", names[0], scenes[i]);
        }
    }
}

/* Bricks meet elsewhere than where the volume is whole. */
static void memory_for_textures_is_carried(void **state) {
    (void)state;
    need_pictures();
    expect(0, "render " DATA " --method slicing --gpu-memory 0.08 --preset cta-head --size 64x64" QUIET "/bricks.exr");
    expect(0, "render " DATA " --state " FOLDER "/bricks.exr" QUIET "/bricks-again.exr");
    assert_true(same_files("bricks.exr", "bricks-again.exr"));
    expect(0, "render " DATA " --state " FOLDER "/bricks.exr --gpu-memory 100" QUIET "/whole.exr");
    assert_false(same_files("bricks.exr", "whole.exr"));
}

/* Sizes of raw input are in the picture. */
static void raw_input_is_read_again(void **state) {
    (void)state;
    need_pictures();
    FILE *file = fopen(FOLDER "/noise.raw", "wb");
    uint64_t seed = 9;
    assert_non_null(file);
    for (int i = 0; i < 12 * 10 * 8; i++) fputc((int)(256 * random_unit(&seed)), file);
    fclose(file);
    expect(0, "render " FOLDER "/noise.raw --backend none --raw-dims 12x10x8 --raw-type u8 --raw-spacing 1,1,2 "
              "--size 40x40" QUIET "/raw.png");
    expect(0, "render " FOLDER "/noise.raw --backend none --state " FOLDER "/raw.png" QUIET "/raw-again.png");
    assert_true(same_files("raw.png", "raw-again.png"));
}

/* As many marks as there may be, with all their digits: more than a command line of this test has room for. */
static void long_values_are_carried_whole(void **state) {
    (void)state;
    need_pictures();
    uint64_t seed = 7;
    expect(0, "presets show ct-skin");
    FILE *file = fopen(FOLDER "/marks.json", "w");
    assert_non_null(file);
    fprintf(file, "{\"angioscope_state\": 1, \"preset\": %s, \"render\": {\"size\": \"40x40\", \"measure\": \"",
            output);
    for (int i = 0; i < 6 * 64; i++) fprintf(file, "%s%.17g", i ? "," : "", 160 * (random_unit(&seed) - 0.5));
    fprintf(file, "\"}}");
    fclose(file);
    expect(0, "render " DATA " --backend none --state " FOLDER "/marks.json" QUIET "/marks.png");
    expect(0, "render " DATA " --backend none --state " FOLDER "/marks.png" QUIET "/marks-again.png");
    assert_true(same_files("marks.png", "marks-again.png"));
    expect(0, "render " DATA " --backend none --size 40x40 --preset ct-skin" QUIET "/none.png");
    assert_false(same_files("marks.png", "none.png"));
}

static void each_frame_carries_its_own(void **state) {
    (void)state;
    need_pictures();
    expect(0, "render " DATA " --backend none --frames 3 --orbit 90 --size 64x64" QUIET "/frame.png");
    expect(0, "render " DATA " --backend none --state " FOLDER "/frame-0002.png" QUIET "/second.png");
    assert_true(same_files("frame-0002.png", "second.png"));
    assert_false(same_files("frame-0001.png", "second.png"));
}

/* What the command line says goes first. */
static void options_go_first(void **state) {
    (void)state;
    need_pictures();
    expect(0, "render " DATA " --backend none --view left --size 60x60 --preset ct-bone" QUIET "/left.png");
    expect(0, "render " DATA " --backend none --view right --size 60x60 --preset ct-skin" QUIET "/right.png");
    expect(0, "render " DATA " --backend none --state " FOLDER
              "/left.png --view right --preset ct-skin --method auto" QUIET "/turned.png");
    assert_true(same_files("right.png", "turned.png"));
}

static void what_cannot_be_is_refused(void **state) {
    (void)state;
    need_pictures();
    static const struct {
        int code;
        const char *arguments, *says;
    } refused[] = {
        {2, "render --state " FOLDER "/p.png" QUIET "/q.png", "p.png: this state does not say where its data are"},
        {2, "render " DATA " --state " FOLDER "/p.png" QUIET "/p.png", "is read as state"},
        {2, "render " DATA " --state " FOLDER "/none.json" QUIET "/q.png", "none.json: cannot be read"},
        {2, "render " DATA " --state " FOLDER "/empty.png" QUIET "/q.png", "carries no text angioscope_state"},
        {2, "render " DATA " --state " FOLDER "/evil.json" QUIET "/q.png", "render.output is no setting of a picture"},
        {2, "render " DATA " --state " FOLDER "/odd.json" QUIET "/q.png", "render.zoom: --zoom -1: must be a number"},
    };
    expect(0, "render " DATA " --backend none --size 20x20" QUIET "/p.png");
    expect(0, "check " FOLDER "/p.png " FOLDER "/p.png --heat " FOLDER "/empty.png");
    expect(0, "presets show ct-bone > " FOLDER "/preset.json");
    assert_int_equal(system("cd " FOLDER " && for what in 'evil output \"x.png\"' 'odd zoom -1'; do set -- $what; "
                            "echo \"{\\\"angioscope_state\\\": 1, \\\"preset\\\": $(cat preset.json), \\\"render\\\": "
                            "{\\\"$2\\\": $3}}\" > $1.json; done"),
                     0);
    for (size_t i = 0; i < sizeof refused / sizeof *refused; i++) {
        char arguments[1024];
        snprintf(arguments, sizeof arguments, "%s 2>&1", refused[i].arguments);
        expect(refused[i].code, arguments);
        if (!strstr(output, refused[i].says)) fail_msg("%s says: %s", refused[i].arguments, output);
    }
}

/* Other data are drawn, with a warning; so that one picture's look can be given to others. */
static void other_data_are_told(void **state) {
    (void)state;
    need_pictures();
    expect(0, "render " DATA " --backend none --size 20x20" QUIET "/p.png");
    expect(0, "render " FOLDER "/other --backend none --state " FOLDER "/p.png -o " FOLDER "/o.png 2>&1");
    assert_non_null(strstr(output, "the data are not those that the state was saved of"));
    expect(0, "render " DATA " --backend none --state " FOLDER "/p.png -o " FOLDER "/o.png 2>&1");
    assert_null(strstr(output, "warning"));
}

/* How a state's own data were read says nothing of others: nobody is told of options that nobody typed. */
static void how_data_were_read_goes_with_them(void **state) {
    (void)state;
    need_pictures();
    static const char *const inputs[] = {
        "\"raw_dims\": \"12x10x8\", \"raw_type\": \"u8\", \"raw_spacing\": \"1,1,2\"",
        "\"name\": \"00000000-1.3\"",
        "\"name\": \"00000000-7\"",
    };
    expect(0, "render " DATA " --backend none --preset ct-bone --size 20x20" QUIET "/plain.exr");
    for (size_t i = 0; i < sizeof inputs / sizeof *inputs; i++) {
        expect(0, "presets show ct-bone");
        FILE *file = fopen(FOLDER "/elsewhere.json", "w");
        assert_non_null(file);
        fprintf(file, "{\"angioscope_state\": 1, \"preset\": %s, \"render\": {\"size\": \"20x20\"}, \"input\": {%s}}",
                output, inputs[i]);
        fclose(file);
        expect(0, "render " DATA " --backend none --state " FOLDER "/elsewhere.json" QUIET "/elsewhere.exr 2>&1");
        expect(0, "check " FOLDER "/plain.exr " FOLDER "/elsewhere.exr --threshold 0");
        expect(3, "render " DATA " --backend none --state " FOLDER "/elsewhere.json --phase 3" QUIET "/no.exr 2>&1");
        assert_non_null(strstr(output, "--phase 3"));
    }
}

/* Methods are compared in the picture's scene, not its own method with itself. */
static void a_report_is_of_it(void **state) {
    (void)state;
    need_pictures();
    expect(0,
           "render " DATA " --backend none --mode iso --iso 300 --view left --size 16x16 --method cpu" QUIET "/s.png");
    expect(0, "report " DATA " --backend none --state " FOLDER "/s.png -q -o " FOLDER "/report 2>&1");
    expect(0,
           "report " DATA " --backend none --mode iso --iso 300 --view left --size 16x16 -q -o " FOLDER "/plain 2>&1");
    assert_int_equal(system("grep -q '\"mode\":[[:space:]]*\"iso\"' " FOLDER "/report/report.json"), 0);
    assert_int_equal(system("grep -q '\"azimuth\":[[:space:]]*90' " FOLDER "/report/report.json"), 0);
    /* As many settings as without. */
    assert_int_equal(system("test $(wc -l < " FOLDER "/report/report.csv) = $(wc -l < " FOLDER "/plain/report.csv)"),
                     0);
}

/* No folder's name, and the file of the preset is not named. */
static void a_picture_names_no_files(void **state) {
    (void)state;
    need_pictures();
    assert_int_equal(system("mkdir -p " FOLDER "/Doe^Jane && cp -r " DATA " " FOLDER "/Doe^Jane/ct"), 0);
    expect(0, "presets show ct-bone > " FOLDER "/Doe^Jane/own.json");
    expect(0, "render " FOLDER "/Doe^Jane/ct --backend none --preset " FOLDER "/Doe^Jane/own.json --size 20x20" QUIET
              "/anonymous.png");
    assert_int_equal(system("grep -qa Doe " FOLDER "/anonymous.png"), 256);
    assert_int_equal(system("grep -qa angioscope_state " FOLDER "/anonymous.png"), 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_picture_is_drawn_again),          cmocka_unit_test(memory_for_textures_is_carried),
        cmocka_unit_test(raw_input_is_read_again),           cmocka_unit_test(long_values_are_carried_whole),
        cmocka_unit_test(each_frame_carries_its_own),        cmocka_unit_test(options_go_first),
        cmocka_unit_test(what_cannot_be_is_refused),         cmocka_unit_test(other_data_are_told),
        cmocka_unit_test(how_data_were_read_goes_with_them), cmocka_unit_test(a_report_is_of_it),
        cmocka_unit_test(a_picture_names_no_files),
    };
    return cmocka_run_group_tests(tests, opening, NULL);
}
