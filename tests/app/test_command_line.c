/* The program as scripts use it: exit codes, what goes to stdout, JSON, privacy, atomic output. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
/* after them */
#include <cjson/cJSON.h>
#include <cmocka.h>
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "tests/app/program.h"
#include "tests/io/shipped_presets.h"

#define TMP     ANG_TEST_TMP "/command-line"
#define PHANTOM TMP "/phantom"

static int make_phantom(void **state) {
    (void)state;
    mkdir(TMP, 0777);
    (void)!system("rm -rf " PHANTOM);
    return run("phantom -o " PHANTOM " --dims 64x60x24 --quiet");
}

/* Parts of the plan that no picture test can force: a context that nothing is drawn with. */
static void opengl_that_is_not_needed_changes_nothing(void **state) {
    (void)state;
    expect(0, "render " PHANTOM " -o " TMP "/no-gl.exr --method reference --size 24x20 --preset cta-head -q 2>&1");
    expect(0, "render " PHANTOM " -o " TMP
              "/gl.exr --method reference --force gl --size 24x20 --preset cta-head --explain 2>&1");
    assert_null(strstr(output, "left out  OpenGL"));
    assert_int_equal(system("cmp -s " TMP "/no-gl.exr " TMP "/gl.exr"), 0);
}

static void gradients_that_cannot_be_had_are_said(void **state) {
    (void)state;
    expect(0,
           "render " PHANTOM " -o " TMP
           "/looked-up.png --size 24x20 --method envelope --preset cta-head --gradients texture --manual-filter 2>&1");
    assert_non_null(strstr(output, "--gradients texture: gradients are looked up, since --manual-filter"));
}

static void usage_errors_give_two(void **state) {
    (void)state;
    unsetenv("DISPLAY"); /* else a window opens */
    unsetenv("WAYLAND_DISPLAY");
    expect(2, "2>&1");
    assert_non_null(strstr(output, "angioscope VERB --help"));
    expect(2, "fly 2>&1");
    assert_non_null(strstr(output, "'fly'"));
    expect(3, TMP "/no-such-folder 2>&1");
    assert_non_null(strstr(output, "no such file or folder"));
    expect(2, "render 2>&1");
    expect(2, "render " PHANTOM " 2>&1");
    expect(2, "render " PHANTOM " -o " TMP "/x.png --step 0 2>&1");
    expect(2, "render " PHANTOM " -o " TMP "/x.png --mode sideways 2>&1");
    assert_non_null(strstr(output, "--mode sideways"));
    expect(2, "render " PHANTOM " -o " TMP "/x.png --preset cta-haed 2>&1");
    assert_non_null(strstr(output, "cta-head"));
    expect(2, "render " PHANTOM " -o " TMP "/x.png --preset " TMP "/no-such.json 2>&1");
    assert_non_null(strstr(output, "no-such.json"));
    expect(2, "render " PHANTOM " -o " TMP "/x.png --no-such-option 2>&1");
    expect(2, "render " PHANTOM " -o " TMP "/x.png --clip 1,1,2,2,3,3 2>&1");
    expect(2, "render " PHANTOM " -o " TMP "/x.png --clip-plane 0,0,0,5 2>&1");
    assert_non_null(strstr(output, "--clip-plane 0,0,0,5: give NX,NY,NZ,OFFSET_MM"));
    expect(2, "render " PHANTOM " -o " TMP "/x.jpeg2 2>&1");
    assert_false(exists(TMP "/x.png"));
}

static void what_a_method_cannot_do_is_said(void **state) {
    (void)state;
    expect(0, "render " PHANTOM " -o " TMP "/said.png --size 32x32 --method singlepass --bricks 2x2x2 2>&1");
    assert_non_null(strstr(output, "warning: --bricks has no effect with --method singlepass"));
    expect(0, "render " PHANTOM " -o " TMP "/said.png --size 32x32 --method slicing --step 20 2>&1");
    assert_non_null(strstr(output, "20 voxels: what is thinner may be missed"));
    expect(0, "render " PHANTOM " -o " TMP "/said.png --size 32x32 --method slicing --fov 170 --zoom 20 2>&1");
    assert_non_null(strstr(output, "so wide a field of view"));
    expect(2, "render " PHANTOM " -o " TMP "/said.png --size 32x32 --method slicing --passes-steps 3 2>&1");
    assert_non_null(strstr(output, "--passes-steps 3"));
}

static void lookups_are_a_heat_map(void **state) {
    (void)state;
    expect(0, "render " PHANTOM " -o " TMP "/said.png --size 32x32 --method envelope --mode lookups 2>&1");
    assert_non_null(strstr(output, "samples a pixel, from none (black) to"));
    expect(2, "render " PHANTOM " -o " TMP "/said.png --size 32x32 --method reference --mode lookups 2>&1");
    assert_non_null(strstr(output, "--mode lookups"));
}

static void json_takes_no_value_but_for_render(void **state) {
    (void)state;
    static const char *const commands[] = {"info " PHANTOM " --json - 2>&1", "info " PHANTOM " --json x.json 2>&1",
                                           "info " PHANTOM " --json=- 2>&1", "check a.png b.png --json - 2>&1"};
    for (size_t i = 0; i < sizeof commands / sizeof *commands; i++) {
        expect(2, commands[i]);
        if (!strstr(output, "--json takes no value")) fail_msg("%s: %s", commands[i], output);
    }
    expect(2, "info " PHANTOM " " PHANTOM " 2>&1");
    assert_null(strstr(output, "--json"));
    expect(2, "info " PHANTOM " --jsom 2>&1");
    assert_non_null(strstr(output, "unknown option --jsom"));
}

static void help_goes_to_stdout(void **state) {
    (void)state;
    expect(0, "--help 2>/dev/null");
    assert_non_null(strstr(output, "render"));
    expect(0, "render --help 2>/dev/null");
    assert_non_null(strstr(output, "--termination"));
    assert_non_null(strstr(output, "default 0.5"));
    assert_non_null(strstr(output, "mirror"));
    expect(0, "--version 2>/dev/null");
}

static void phantoms_that_cannot_be_are_refused(void **state) {
    (void)state;
    expect(2, "phantom -o " TMP "/never --dims 8x8x65536 2>&1");
    assert_non_null(strstr(output, "each from 1 to 65535"));
    expect(2, "phantom -o " TMP "/never --dims 8x8x8 --spacing 0,1,1 2>&1");
    assert_non_null(strstr(output, "--spacing 0,1,1"));
    expect(2, "phantom -o " TMP "/never --dims 8x8x8 --spacing 1e-20,1e-20,1e-20 2>&1");
    assert_non_null(strstr(output, "give 0.01 to 1000"));
    assert_false(exists(TMP "/never"));
    expect(0, "phantom --help");
    assert_non_null(strstr(output, "folder to write"));
    assert_null(strstr(output, ".png"));
    expect(0, "render --help");
    assert_non_null(strstr(output, ".pfm"));
}

static int count_of(const char *needle) {
    int count = 0;
    for (const char *at = output; (at = strstr(at, needle)); at++) count++;
    return count;
}

static void a_refusal_is_said_once(void **state) {
    (void)state;
    (void)!system("rm -rf " TMP "/gap; cp -r " PHANTOM " " TMP "/gap; rm " TMP "/gap/IM0007.dcm");
    expect(4, "render " TMP "/gap -o " TMP "/x.png --strict 2>&1");
    assert_int_equal(count_of("missing slice"), 1);
    expect(0, "render " TMP "/gap -o " TMP "/a.png --size 16x16 2>&1");
    assert_int_equal(count_of("missing slice"), 1);
}

static void missing_and_foreign_input_give_three(void **state) {
    (void)state;
    expect(3, "info " TMP "/nothing-here 2>&1");
    assert_non_null(strstr(output, "nothing-here"));
    FILE *file = fopen(TMP "/words.txt", "w");
    assert_non_null(file);
    fputs("no image\n", file);
    fclose(file);
    expect(3, "info " TMP "/words.txt 2>&1");
    expect(3, "render " TMP "/words.txt -o " TMP "/x.png 2>&1");
}

static void outputs_that_cannot_be_written_give_seven(void **state) {
    (void)state;
    expect(7, "render " PHANTOM " -o " TMP "/no/such/folder/x.png --size 16x16 --quiet 2>&1");
    assert_non_null(strstr(output, "no/such/folder"));
}

static void outputs_are_checked_before_the_work(void **state) {
    (void)state;
    expect(7, "render " PHANTOM " -o " TMP "/early.png --size 16x16 --quiet --json " TMP "/no/such/x.json 2>&1");
    assert_false(exists(TMP "/early.png"));
    expect(7, "render " TMP "/nothing-here -o " TMP "/no/such/x.png 2>&1");
    expect(2, "render " TMP "/nothing-here -o " TMP "/x.png --preset no-such-preset 2>&1");
    expect(7, "--help 2>/dev/null >/dev/full");
}

static void refused(const char *arguments, const char *needle) {
    expect(2, arguments);
    if (!strstr(output, needle)) fail_msg("angioscope %s: no '%s' in: %s", arguments, needle, output);
}

static void outputs_do_not_overwrite_what_is_read(void **state) {
    (void)state;
    (void)!system(
        "rm -rf " TMP "/same; mkdir -p " TMP "/same/deep; cd " TMP "/same; cp -r " PHANTOM " study; ln -s study "
        "link; head -c 8 /dev/zero > v.png; cp v.png old.png; ln old.png hard.json; echo '{\"dims\": \"2x2x2\", "
        "\"type\": \"u8\"}' > v.json; cp " ANG_PRESETS "/ct-mip.json mine.json");
    refused("render " PHANTOM " -o " TMP "/same/new.png --json " TMP "/same/deep/../new.png 2>&1", "--json ");
    refused("render " PHANTOM " -o " TMP "/same/old.png --json " TMP "/same/hard.json 2>&1", "is the picture too");
    refused("render " PHANTOM " -o " TMP "/same/new.png --frames 2 --orbit 9 --json " TMP "/same/new-0002.png 2>&1",
            "is the picture too");
    refused("render " TMP "/same/v.png -o " TMP "/same/deep/../v.png 2>&1", "is read as input");
    refused("render " TMP "/same/v.png -o " TMP "/same/new.png --json " TMP "/same/v.json 2>&1", "is read as input");
    refused("render " TMP "/same/link -o " TMP "/same/new.png --json " TMP "/same/study/IM0003.dcm 2>&1",
            "is read as input");
    refused("render " PHANTOM " -o " TMP "/same/new.png --preset " TMP "/same/mine.json --json " TMP
            "/same/mine.json 2>&1",
            "is read as preset");
    refused("check " TMP "/same/old.png " TMP "/same/v.png --heat " TMP "/same/v.png 2>&1", "--heat");
    assert_false(exists(TMP "/same/new.png"));
    /* A picture beside the slices, and one that is there from the last time, are nobody's harm. */
    expect(0, "render " TMP "/same/study -o " TMP "/same/study/new.png --size 16x16 --quiet --json " TMP
              "/same/study/new.json");
    expect(0, "render " TMP "/same/study -o " TMP "/same/study/new.png --size 16x16 --quiet --json " TMP
              "/same/study/new.json");
}

static void an_empty_picture_is_said(void **state) {
    (void)state;
    expect(0, "render " PHANTOM " -o " TMP "/a.png --size 16x16 --mode iso --iso 9999 2>&1");
    assert_non_null(strstr(output, "empty"));
    expect(0, "render " PHANTOM " -o " TMP "/a.png --size 16x16 --mode iso --iso 300 2>&1");
    assert_null(strstr(output, "empty"));
}

static void a_picture_of_one_grey_is_said(void **state) {
    (void)state;
    expect(0, "render " PHANTOM " -o " TMP "/a.png --size 16x16 --mode minip 2>&1");
    assert_non_null(strstr(output, "warning: the picture is all one grey: in mode minip"));
    assert_non_null(strstr(output, " HU;"));
    expect(0, "render " PHANTOM " -o " TMP "/a.png --size 16x16 --mode mip 2>&1");
    assert_null(strstr(output, "one grey"));
    /* Empty is another matter, and opaque colour is none of its business. */
    expect(0, "render " PHANTOM " -o " TMP "/a.png --size 16x16 --mode iso --iso 9999 2>&1");
    assert_null(strstr(output, "one grey"));
}

static void options_without_effect_are_said(void **state) {
    (void)state;
    expect(0, "render " PHANTOM " -o " TMP "/a.png --size 16x16 --orbit 90 --iso 300 2>&1");
    assert_non_null(strstr(output, "note: --orbit turns nothing"));
    assert_non_null(strstr(output, "note: --iso has no effect in mode dvr"));
    expect(0, "render " PHANTOM " -o " TMP "/a.png --size 16x16 --orbit 90 --repeat 2 --mode iso --iso 300 2>&1");
    assert_null(strstr(output, "--orbit"));
    assert_null(strstr(output, "--iso"));
    expect(0, "render " PHANTOM " -o " TMP "/a.png --size 16x16 --orbit 90 --iso 300 --quiet 2>&1");
    assert_string_equal(output, "");
    static const char *const unused[][2] = {
        {"--fps 30", "--fps has no effect but in films (.mp4, .avi)"},
        {"--keep-phi", "--keep-phi has no effect but in DICOM (.dcm) and --json"},
        {"--fov 50 --projection parallel", "--fov has no effect with --projection parallel"},
        {"--step 0.3 --method reference", "--step has no effect with --method reference"},
        {"--termination 0.5 --no-termination", "--termination has no effect beside --no-termination"},
        {"--shading phong --mode mip", "--shading has no effect in mode mip"},
        {"--classification prefix --mode iso --iso 300 --method slicing", "--classification has no effect in mode iso"},
    };
    for (size_t i = 0; i < sizeof unused / sizeof *unused; i++) {
        char arguments[512];
        snprintf(arguments, sizeof arguments, "render " PHANTOM " -o " TMP "/a.png --size 16x16 %s 2>&1", unused[i][0]);
        expect(0, arguments);
        if (!strstr(output, unused[i][1])) fail_msg("%s: %s", unused[i][0], output);
    }
    expect(0, "render " PHANTOM " -o " TMP "/a.png --size 16x16 --keep-phi --json - 2>&1");
    assert_null(strstr(output, "no effect"));
    expect(2, "render " PHANTOM " -o " TMP "/a.xyz 2>&1");
    assert_non_null(strstr(output, ".pfm; or .dcm, .mp4 or .avi"));
    expect(2, "presets list --view left 2>&1");
    assert_non_null(strstr(output, "presets list: takes no --view, which is for: presets sheet"));
    expect(2, "presets show ct-bone -o " TMP "/x.json 2>&1");
    assert_false(exists(TMP "/x.json"));
}

static void no_gl_gives_five(void **state) {
    (void)state;
    expect(5, "render " PHANTOM " -o " TMP "/x.png --size 16x16 --method singlepass --backend none --quiet 2>&1");
    assert_non_null(strstr(output, "--method reference"));
    assert_null(strstr(output, "cpu"));
}

static cJSON *parsed(void) {
    cJSON *json = cJSON_Parse(output);
    if (!json) fail_msg("not JSON: %s", output);
    return json;
}

static double at(const cJSON *json, const char *name, int index) {
    const cJSON *item = cJSON_GetObjectItemCaseSensitive(json, name);
    if (index >= 0) item = cJSON_GetArrayItem(item, index);
    if (!cJSON_IsNumber(item)) fail_msg("no number %s", name);
    return item->valuedouble;
}

static void info_and_render_describe_the_input(void **state) {
    (void)state;
    expect(0, "info " PHANTOM " --json 2>/dev/null");
    cJSON *json = parsed();
    const cJSON *input = cJSON_GetObjectItemCaseSensitive(json, "input");
    assert_int_equal((int)at(input, "dims", 0), 64);
    assert_int_equal((int)at(input, "dims", 1), 60);
    assert_int_equal((int)at(input, "dims", 2), 24);
    assert_true(fabs(at(input, "spacing_mm", 2) - 96. / 24) < 1e-6);
    assert_true(at(input, "tilt_deg", -1) == 0);
    double crc = at(input, "stored_crc32", -1);
    cJSON_Delete(json);

    expect(0, "render " PHANTOM " -o " TMP "/a.png --size 40x30 --preset cta-head --repeat 3 --json - 2>/dev/null");
    json = parsed();
    input = cJSON_GetObjectItemCaseSensitive(json, "input");
    assert_true(at(input, "stored_crc32", -1) == crc);
    const cJSON *time = cJSON_GetObjectItemCaseSensitive(json, "time_ms");
    assert_true(at(time, "frame_min", -1) <= at(time, "frame_median", -1));
    assert_true(at(time, "frame_median", -1) <= at(time, "frame_max", -1));
    const cJSON *counts = cJSON_GetObjectItemCaseSensitive(json, "counts");
    assert_true(at(counts, "samples", -1) > 0);
    assert_non_null(cJSON_GetObjectItemCaseSensitive(cJSON_GetObjectItemCaseSensitive(json, "plan"), "left_out"));
    cJSON_Delete(json);
}

static bool is_null(const cJSON *json, const char *name) {
    return cJSON_IsNull(cJSON_GetObjectItemCaseSensitive(json, name));
}

/* How wrong the picture may be, by its parts; what is not known is null. */
static void the_json_says_how_wrong_the_picture_is(void **state) {
    (void)state;
    static const struct {
        const char *options;
        bool estimated, truth;
        double quantisation;
    } pictures[] = {{"-o " TMP "/e.png --preset cta-head --step 1", true, false, 0.5},
                    {"-o " TMP "/e.pfm --preset cta-head --mode mip", true, false, 0},
                    {"-o " TMP "/e.png --preset cta-head --background 1,1,1,0", true, false, 1},
                    {"-o " TMP "/e.png --preset ct-bone-iso", false, false, 0.5},
                    {"-o " TMP "/e.png --preset cta-head --method reference", true, true, 0.5}};
    for (size_t i = 0; i < sizeof pictures / sizeof *pictures; i++) {
        char command[512];
        snprintf(command, sizeof command, "render " PHANTOM " %s --size 40x30 --json - 2>/dev/null",
                 pictures[i].options);
        expect(0, command);
        cJSON *json = parsed();
        const cJSON *error = cJSON_GetObjectItemCaseSensitive(json, "error");
        const cJSON *parts = cJSON_GetObjectItemCaseSensitive(error, "parts");
        assert_true(at(error, "quantisation", -1) == pictures[i].quantisation);
        assert_true(at(error, "pixels", -1) == 40 * 30);
        assert_true(at(error, "rms", -1) >= 0 && at(error, "p999", -1) >= 0 && at(error, "flipped", -1) >= 0);
        assert_true(is_null(error, "estimate") != pictures[i].estimated);
        assert_true((cJSON_GetObjectItemCaseSensitive(error, "why") != NULL) != pictures[i].estimated);
        if (pictures[i].estimated) {
            double sum = at(parts, "step", -1) + at(parts, "termination", -1) + at(parts, "filtering", -1) +
                         at(parts, "arithmetic", -1);
            assert_true(fabs(at(error, "estimate", -1) - fmin(sum, 255)) < 1e-9);
            assert_true(pictures[i].truth ? sum == 0 : sum > 0);
        }
        assert_true(is_null(error, "bound") != pictures[i].truth);
        assert_true(pictures[i].truth ? at(error, "ms", -1) == 0 : at(error, "ms", -1) > 0);
        cJSON_Delete(json);
    }
    expect(0, "render " PHANTOM " -o " TMP "/e.png --preset cta-head --mode lookups --size 40x30 --json - 2>/dev/null");
    cJSON *json = parsed();
    assert_true(is_null(cJSON_GetObjectItemCaseSensitive(json, "error"), "estimate"));
    cJSON_Delete(json);
}

static void the_json_says_what_picture_it_was(void **state) {
    (void)state;
    (void)!system("mkdir -p " TMP "/doe-john; sed 's/\"name\": \"ct-mip\"/\"name\": \"mine\"/' " ANG_PRESETS
                  "/ct-mip.json > " TMP "/doe-john/secret.json");
    expect(0, "render " PHANTOM " -o " TMP "/a.png --preset " TMP
              "/doe-john/secret.json --size 40x30 --shift 10 --iso 250 "
              "--view 30,20,10 --zoom 1.5 --projection parallel --fov 40 --clip 0%,50%,0%,100%,0%,100% --clip-plane "
              "0,3,-4,2.5 "
              "--background 1,0.5,0 --step 2 --termination 0.9 --json - 2>/dev/null");
    assert_null(strstr(output, "doe-john"));
    assert_null(strstr(output, "secret"));
    cJSON *json = parsed();
    const cJSON *picture = cJSON_GetObjectItemCaseSensitive(json, "picture");
    assert_string_equal(cJSON_GetObjectItemCaseSensitive(picture, "preset")->valuestring, "mine");
    assert_string_equal(cJSON_GetObjectItemCaseSensitive(picture, "mode")->valuestring, "mip");
    assert_string_equal(cJSON_GetObjectItemCaseSensitive(picture, "shading")->valuestring, "none");
    assert_string_equal(cJSON_GetObjectItemCaseSensitive(picture, "projection")->valuestring, "parallel");
    const cJSON *window = cJSON_GetObjectItemCaseSensitive(picture, "window");
    assert_true(at(window, "centre", -1) == 330 && at(window, "width", -1) == 900); /* moved by the shift */
    assert_true(at(picture, "iso_hu", -1) == 250 && at(picture, "shift", -1) == 10);
    const cJSON *view = cJSON_GetObjectItemCaseSensitive(picture, "view");
    assert_true(at(view, "azimuth", -1) == 30 && at(view, "elevation", -1) == 20 && at(view, "roll", -1) == 10);
    assert_true(at(picture, "zoom", -1) == 1.5 && at(picture, "fov_deg", -1) == 40);
    assert_true(at(picture, "size", 0) == 40 && at(picture, "size", 1) == 30);
    const cJSON *clip = cJSON_GetObjectItemCaseSensitive(picture, "clip");
    assert_true(fabs(at(clip, "lower", 0)) < 1e-9 && fabs(at(clip, "upper", 0) - 31.5) < 1e-9);
    assert_true(fabs(at(clip, "upper", 2) - 23) < 1e-9);
    const cJSON *plane = cJSON_GetObjectItemCaseSensitive(picture, "clip_plane");
    assert_true(fabs(at(plane, "normal", 1) - 0.6) < 1e-12 && fabs(at(plane, "normal", 2) + 0.8) < 1e-12);
    assert_true(at(plane, "offset_mm", -1) == 2.5);
    assert_true(at(picture, "background", 1) == 0.5 && at(picture, "background", 3) == 1);
    assert_true(at(picture, "step_voxels", -1) == 2 && at(picture, "termination", -1) == 0.9);
    cJSON_Delete(json);
}

static void nothing_of_the_patient_is_in_the_json(void **state) {
    (void)state;
    expect(0, "info " PHANTOM " --json 2>/dev/null");
    assert_null(strstr(output, "Phantom^"));
    assert_null(strstr(output, "2.25."));
    assert_null(strstr(output, "command-line"));
    expect(0, "info " PHANTOM " 2>/dev/null");
    assert_null(strstr(output, "2.25."));
    expect(0, "render " PHANTOM " -o " TMP "/a.png --size 16x16 --json - 2>/dev/null");
    assert_null(strstr(output, "2.25."));
    assert_null(strstr(output, "command-line"));
}

static void pictures_of_the_same_scene_are_equal(void **state) {
    (void)state;
    expect(0, "render " PHANTOM " -o " TMP "/a.png --size 64x48 --preset ct-bone --quiet");
    expect(0, "render " PHANTOM " -o " TMP "/b.png --size 64x48 --preset ct-bone --quiet");
    expect(0, "check " TMP "/a.png " TMP "/b.png");
    expect(0, "render " PHANTOM " -o " TMP "/c.png --size 64x48 --preset ct-bone --view left --quiet");
    expect(1, "check " TMP "/a.png " TMP "/c.png --heat " TMP "/heat.png 2>/dev/null");
    assert_true(exists(TMP "/heat.png"));
    expect(0, "check " TMP "/a.png " TMP "/c.png --threshold 255");
    assert_non_null(strstr(output, "dB, over pixels and all four channels"));
    expect(0, "check " TMP "/a.png " TMP "/c.png --threshold 255 --json");
    cJSON *json = parsed();
    assert_true(at(json, "max", -1) > 10);
    cJSON_Delete(json);
    /* The truth in double precision and the GL picture, both as 8-bit files. */
    expect(0, "render " PHANTOM " -o " TMP "/r.png --size 64x48 --preset ct-bone --method reference --quiet");
    expect(0, "render " PHANTOM " -o " TMP "/f.png --size 64x48 --preset ct-bone --step 0.03 --no-termination --quiet");
    expect(0, "check " TMP "/r.png " TMP "/f.png --threshold 2");
}

static void frames_are_numbered(void **state) {
    (void)state;
    expect(0, "render " PHANTOM " -o " TMP "/turn.png --size 16x16 --frames 3 --orbit 360 --quiet");
    assert_true(exists(TMP "/turn-0001.png") && exists(TMP "/turn-0002.png") && exists(TMP "/turn-0003.png"));
    assert_false(exists(TMP "/turn-0004.png"));
}

static void nouns_follow_their_number(void **state) {
    (void)state;
    (void)!system("rm -rf " TMP "/single " TMP "/double");
    expect(0, "phantom -o " TMP "/single --dims 8x8x1 2>&1");
    assert_non_null(strstr(output, "1 slice and truth.json"));
    expect(0, "phantom -o " TMP "/double --dims 8x8x2 2>&1");
    assert_non_null(strstr(output, "2 slices and truth.json"));
    (void)!system("cp " TMP "/double/IM0001.dcm " TMP "/double/again.dcm");
    expect(0, "info " TMP "/double 2>/dev/null");
    assert_non_null(strstr(output, "2 read, 1 duplicate dropped"));
    assert_non_null(strstr(output, "1 slice with the same position and pixels as another: dropped"));
    expect(2, "phantom -o " TMP "/single --spacing 1,1 2>&1");
    assert_non_null(strstr(output, "must be 3 numbers"));
}

static void presets_are_listed_and_shown(void **state) {
    (void)state;
    expect(0, "presets list");
    for (size_t i = 0; i < sizeof shipped / sizeof *shipped; i++)
        if (!strstr(output, shipped[i])) fail_msg("no preset %s", shipped[i]);
    expect(0, "presets show cta-head");
    cJSON_Delete(parsed());
}

static void progress_and_messages_go_to_stderr(void **state) {
    (void)state;
    expect(0, "render " PHANTOM " -o " TMP "/a.png --size 16x16 2>/dev/null");
    assert_string_equal(output, "");
    expect(0, "render " PHANTOM " -o " TMP "/a.png --size 16x16 --quiet 2>&1");
    assert_string_equal(output, "");
}

/* Budgets, without OpenGL, where beside the reference there are only rays on the processor. */
static void budgets_are_kept_or_said_to_be_missed(void **state) {
    (void)state;
    static const char draw[] = "render " PHANTOM " -o " TMP "/budget.png --size 12x12 --preset cta-head --backend none "
                               "--threads 1 --quiet --json -";
    char command[512];
    assert_int_equal(setenv("XDG_CACHE_HOME", TMP "/cache", 1), 0);
    snprintf(command, sizeof command, "%s --max-error 0.001 --frames 2 --orbit 90", draw);
    expect(0, command);
    cJSON *json = cJSON_Parse(output);
    assert_null(strstr(output, "has no effect"));
    assert_non_null(strstr(output, "checked with the first of the 2 pictures"));
    const cJSON *budget = cJSON_GetObjectItemCaseSensitive(json, "budget");
    assert_string_equal(cJSON_GetObjectItemCaseSensitive(budget, "method")->valuestring, "reference");
    assert_true(cJSON_IsTrue(cJSON_GetObjectItemCaseSensitive(budget, "error_kept")));
    assert_true(cJSON_IsTrue(cJSON_GetObjectItemCaseSensitive(budget, "time_kept")));
    assert_true(cJSON_IsNull(cJSON_GetObjectItemCaseSensitive(budget, "max_time_ms")));
    cJSON_Delete(json);
    snprintf(command, sizeof command, "%s --max-error 0.001 --termination 0.9", draw);
    expect(0, command);
    assert_non_null(strstr(output, "--termination has no effect with --method reference"));
    snprintf(command, sizeof command, "%s --method reference --max-time 0.001", draw);
    expect(0, command);
    assert_null(strstr(output, "of the 2 pictures"));
    json = cJSON_Parse(output);
    budget = cJSON_GetObjectItemCaseSensitive(json, "budget");
    assert_true(cJSON_IsFalse(cJSON_GetObjectItemCaseSensitive(budget, "time_kept")));
    assert_int_equal(cJSON_GetObjectItemCaseSensitive(budget, "stride")->valueint, 4);
    assert_non_null(strstr(output, "was missed"));
    assert_true(cJSON_IsTrue(
        cJSON_GetObjectItemCaseSensitive(cJSON_GetObjectItemCaseSensitive(budget, "cost_models"), "cached")));
    cJSON_Delete(json);
    snprintf(command, sizeof command, "%s --max-error 0 2>&1", draw);
    expect(2, command);
    snprintf(command, sizeof command, "%s --force slaps 2>&1", draw);
    expect(2, command);
    assert_non_null(strstr(output, "near-plane"));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(budgets_are_kept_or_said_to_be_missed),
        cmocka_unit_test(usage_errors_give_two),
        cmocka_unit_test(what_a_method_cannot_do_is_said),
        cmocka_unit_test(lookups_are_a_heat_map),
        cmocka_unit_test(json_takes_no_value_but_for_render),
        cmocka_unit_test(help_goes_to_stdout),
        cmocka_unit_test(phantoms_that_cannot_be_are_refused),
        cmocka_unit_test(a_refusal_is_said_once),
        cmocka_unit_test(missing_and_foreign_input_give_three),
        cmocka_unit_test(outputs_that_cannot_be_written_give_seven),
        cmocka_unit_test(outputs_are_checked_before_the_work),
        cmocka_unit_test(outputs_do_not_overwrite_what_is_read),
        cmocka_unit_test(an_empty_picture_is_said),
        cmocka_unit_test(a_picture_of_one_grey_is_said),
        cmocka_unit_test(options_without_effect_are_said),
        cmocka_unit_test(no_gl_gives_five),
        cmocka_unit_test(info_and_render_describe_the_input),
        cmocka_unit_test(the_json_says_how_wrong_the_picture_is),
        cmocka_unit_test(the_json_says_what_picture_it_was),
        cmocka_unit_test(nothing_of_the_patient_is_in_the_json),
        cmocka_unit_test(pictures_of_the_same_scene_are_equal),
        cmocka_unit_test(frames_are_numbered),
        cmocka_unit_test(opengl_that_is_not_needed_changes_nothing),
        cmocka_unit_test(gradients_that_cannot_be_had_are_said),
        cmocka_unit_test(nouns_follow_their_number),
        cmocka_unit_test(presets_are_listed_and_shown),
        cmocka_unit_test(progress_and_messages_go_to_stderr),
    };
    return cmocka_run_group_tests(tests, make_phantom, NULL);
}
