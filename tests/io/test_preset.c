/* Preset files: the shipped ones, both forms, and what is said about broken ones. */
#include "io/json.h"
#include "io/preset/preset.h"
#include "tests/io/shipped_presets.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static const char full[] = "{\n"
                           "  \"name\": \"mine\", \"version\": 1, \"modality\": \"CTA\",\n"
                           "  \"description\": \"a \\\"test\\\"\", \"mode\": \"iso\", \"shading\": \"phong\",\n"
                           "  \"phong\": {\"ambient\": 0.2, \"g0\": 5},\n"
                           "  \"unit_distance\": 2, \"window\": {\"centre\": 100, \"width\": 700}, \"iso_hu\": 150,\n"
                           "  \"points\": [\n"
                           "    {\"hu\": -100, \"colour\": [0, 0, 0], \"opacity\": 0},\n"
                           "    {\"hu\": 200.5, \"colour\": [1, 0.5, 0.25], \"opacity\": 1}\n"
                           "  ]\n"
                           "}\n";

static ang_preset *parse(const char *text) {
    ang_error err;
    ang_preset *preset = ang_preset_parse("folder/my.json", text, &err);
    if (!preset) print_message("%s\n", err.message);
    assert_non_null(preset);
    return preset;
}

static void full_form(void **state) {
    (void)state;
    ang_preset *p = parse(full);
    assert_string_equal(p->name, "mine");
    assert_string_equal(p->modality, "CTA");
    assert_string_equal(p->description, "a \"test\"");
    assert_int_equal(p->mode, ANG_MODE_ISO);
    assert_int_equal(p->shading, ANG_SHADING_PHONG);
    assert_float_equal(p->phong.ambient, 0.2, 0);
    assert_float_equal(p->phong.diffuse, ang_phong_default.diffuse, 0);
    assert_float_equal(p->phong.g0, 5, 0);
    assert_float_equal(p->window_centre, 100, 0);
    assert_float_equal(p->window_width, 700, 0);
    assert_float_equal(p->iso_hu, 150, 0);
    assert_float_equal(p->transfer->unit_distance, 2, 0);
    assert_int_equal(p->transfer->count, 2);
    assert_float_equal(p->transfer->points[1].hu, 200.5, 0);
    assert_float_equal(p->transfer->points[1].colour[2], 0.25, 0);
    ang_preset_free(p);
}

static void simple_form(void **state) {
    (void)state;
    ang_preset *p = parse("{\"unit_mm\":2.5,\"comment\":\"c\",\"points\":[[-1024,0,0,0,0],[150,0.6,0.05,0.02,0.5]]}");
    assert_string_equal(p->name, "my");
    assert_string_equal(p->description, "c");
    assert_int_equal(p->mode, ANG_MODE_DVR);
    assert_true(isnan(p->iso_hu));
    assert_float_equal(p->transfer->unit_distance, 2.5, 0);
    assert_float_equal(p->transfer->points[1].colour[1], 0.05, 0);
    assert_float_equal(p->transfer->points[1].opacity, 0.5, 0);
    ang_preset_free(p);
}

/* No text of a preset can steer a terminal or spoil a file of another program. */
static void texts_are_of_printable_characters(void **state) {
    (void)state;
    ang_preset *preset = ang_preset_parse("my.json",
                                          "{\"name\": \"a\\u001b[31m\\nb \\u00f6\", \"description\": \"\xFF\", "
                                          "\"unit_mm\": 1, \"points\": [[0, 0, 0, 0, 0], [9, 1, 1, 1, 1]]}",
                                          NULL);
    assert_non_null(preset);
    assert_string_equal(preset->name, "a?[31m b \xC3\xB6");
    assert_string_equal(preset->description, "?");
    ang_preset_free(preset);
}

static void extinction_and_steps(void **state) {
    (void)state;
    ang_preset *p = parse("{\"points\":[{\"hu\":1,\"colour\":[0,0,0],\"extinction\":0},"
                          "{\"hu\":1,\"colour\":[0,0,0],\"extinction\":12.5}]}");
    assert_true(p->transfer->by_extinction);
    assert_float_equal(ang_transfer_extinction(p->transfer, 1), 12.5, 0);
    ang_preset_free(p);
}

/* Puts `now` in the place of `before` in the full form. */
static void check_broken(const char *before, const char *now, const char *message) {
    const char *at = strstr(full, before);
    assert_non_null(at);
    char text[2048];
    snprintf(text, sizeof text, "%.*s%s%s", (int)(at - full), full, now, at + strlen(before));
    ang_error err = {0};
    assert_null(ang_preset_parse("my.json", text, &err));
    assert_int_equal(err.code, ANG_USAGE);
    if (strncmp(err.message, message, strlen(message)) != 0) {
        print_message("%s\n  instead of\n%s\n", err.message, message);
        fail();
    }
    assert_null(strchr(err.message, '\n'));
}

static void broken_files_are_explained(void **state) {
    (void)state;
    check_broken("\"opacity\": 1}", "\"opacity\": 1.7}", "my.json:8: points[1].opacity is 1.7; it must lie in 0..1");
    check_broken("\"opacity\": 1}", "\"opacity\": 1e999}", "my.json:8: points[1].opacity is inf; it must lie in 0..1");
    check_broken("\"opacity\": 1}", "\"opacity\": \"1\"}",
                 "my.json:8: points[1].opacity is \"1\"; it must be a number");
    check_broken("\"opacity\": 1}", "\"opacity\": NaN}", "my.json:8: is not valid JSON near \"NaN}");
    check_broken("\"opacity\": 1}", "\"extinction\": 1}",
                 "my.json:8: points[1] gives extinction and points[0] opacity;");
    check_broken(", \"opacity\": 1}", "}", "my.json:8: points[1] has no opacity (or extinction)");
    check_broken("\"hu\": 200.5", "\"hu\": -200",
                 "my.json:8: points[1] is at -200 HU, below the point before it (-100 HU)");
    check_broken("\"hu\": 200.5", "\"HU\": 200", "my.json:8: points[1].HU is not a known field; ");
    check_broken("0.5, 0.25]", "0.5, 1.25]", "my.json:8: points[1].colour[2] is 1.25; it must lie in 0..1");
    check_broken("[0, 0, 0]", "[0, 0]", "my.json:7: points[0].colour must be three numbers");
    check_broken("\"ambient\"", "\"ambiant\"",
                 "my.json:4: phong.ambiant is not a known field; did you mean phong.ambient?");
    check_broken("\"modality\"", "\"modalty\"", "my.json:2: modalty is not a known field; did you mean modality?");
    check_broken("\"modality\"", "\"xyzzy123\"", "my.json:2: xyzzy123 is not a known field; known are name, version,");
    check_broken("\"modality\"", "\"name\"", "my.json:2: name is given twice");
    check_broken("\"iso\"", "\"isosurface\"", "my.json:3: mode is \"isosurface\"; it must be one of dvr, mip,");
    check_broken("\"phong\",", "3,", "my.json:3: shading is 3; it must be one of none, phong");
    check_broken("{\"ambient\": 0.2, \"g0\": 5}", "7", "my.json:4: phong must be an object in braces");
    check_broken("\"version\": 1", "\"version\": 2", "my.json:2: version is 2; this program reads version 1");
    check_broken("\"width\": 700", "\"width\": 0", "my.json:5: window.width is 0; it must be 1e-06 or more");
    check_broken("\"unit_distance\": 2", "\"unit_distance\": -2",
                 "my.json:5: unit_distance is -2; it must be 1e-06 or more");
    check_broken("\"unit_distance\": 2", "\"unit_distance\": 2, \"unit_mm\": 3",
                 "my.json:5: unit_mm repeats unit_distance");
    check_broken("  ]\n}\n", "  ]\n", "my.json:10: is not valid JSON: it ends too early");
    check_broken("0.25], ", "0.25] ", "my.json:8: is not valid JSON near \"\"opacity\": 1}\"");
    check_broken("  ]\n}\n", "  ]\n} x\n", "my.json:10: is not valid JSON near \"x\"");

    ang_error err;
    const char *const others[] = {"",
                                  "[]",
                                  "3",
                                  "{}",
                                  "{\"points\":[]}",
                                  "{\"points\":{}}",
                                  "{\"points\":[3]}",
                                  "{\"points\":[[1,2]]}",
                                  "{\"points\":[[1,0,0,0,\"a\"]]}",
                                  "{\"points\":[[1,0,0,0,0],[1,0,0,0,0],[1,0,0,0,0]]}",
                                  "{\"points\":[{\"hu\":1,\"colour\":[0,0,0],\"extinction\":-1}]}"};
    for (size_t i = 0; i < sizeof others / sizeof *others; i++) {
        assert_null(ang_preset_parse("my.json", others[i], &err));
        assert_int_equal(err.code, ANG_USAGE);
    }
    assert_null(ang_preset_load("/nowhere/x.json", &err));
    assert_int_equal(err.code, ANG_USAGE);
    assert_null(ang_preset_load(ANG_PRESETS, &err));
    assert_int_equal(err.code, ANG_USAGE);
}

static void lines_are_found(void **state) {
    (void)state;
    const char text[] =
        "\xEF\xBB\xBF{\n\"a\\\"}\": \"]\\\\\",\n\"b\": [ [1,\n2], {\"c\":\n\n{\"d\": true}}],\n\"e\": 1}";
    assert_int_equal(ang_json_line(text, ""), 1);
    assert_int_equal(ang_json_line(text, "b"), 3);
    assert_int_equal(ang_json_line(text, "b[0][1]"), 4);
    assert_int_equal(ang_json_line(text, "b[1].c"), 4);
    assert_int_equal(ang_json_line(text, "b[1].c.d"), 6);
    assert_int_equal(ang_json_line(text, "e"), 7);
    assert_int_equal(ang_json_line(text, "b[7].c"), 3);
    assert_int_equal(ang_json_line("", "b[1].c"), 1);
}

static void damaged_text_never_crashes(void **state) {
    (void)state;
    uint64_t random = 5;
    char text[sizeof full];
    for (int i = 0; i < 20000; i++) {
        memcpy(text, full, sizeof full);
        for (int k = 0; k < 1 + i % 3; k++) {
            random = random * 6364136223846793005u + 1442695040888963407u;
            size_t at = (size_t)(random >> 33) % (sizeof full - 1);
            random = random * 6364136223846793005u + 1442695040888963407u;
            text[at] = "{}[]\",:\\0129eE-+.n \n\xff\x01"[(random >> 33) % 23];
        }
        ang_error err = {0};
        ang_preset *p = ang_preset_parse("x", text, &err);
        if (!p) assert_true(err.message[0] != 0);
        ang_preset_free(p);
        ang_json_line(text, "points[1].colour[2]");
    }
}

static void printing_keeps_everything(void **state) {
    (void)state;
    ang_preset *p = parse(full);
    p->transfer->points[0].colour[1] = 0.1 + 0.2;
    ang_error err;
    char *text = ang_preset_print(p, &err);
    assert_non_null(text);
    ang_preset *q = parse(text);
    assert_string_equal(q->description, p->description);
    assert_int_equal(q->mode, p->mode);
    assert_memory_equal(&q->phong, &p->phong, sizeof p->phong);
    assert_memory_equal(q->transfer->points, p->transfer->points, 2 * sizeof *p->transfer->points);
    assert_float_equal(q->iso_hu, 150, 0);
    free(text);
    ang_preset_free(q);
    ang_preset_free(p);
}

static void shipped_presets_are_sound(void **state) {
    (void)state;
    const char *const folders[] = {"/nowhere", ANG_PRESETS, NULL};
    ang_preset_names names;
    ang_error err;
    assert_true(ang_preset_list(folders, &names, &err));
    assert_true(names.count >= 16);
    assert_null(names.names[names.count]);
    for (size_t i = 0; i < names.count; i++) {
        ang_preset *p = ang_preset_find(names.names[i], folders, &err);
        if (!p) print_message("%s\n", err.message);
        assert_non_null(p);
        assert_string_equal(p->name, names.names[i]);
        assert_true(strlen(p->description) > 10 && strlen(p->modality) > 1);
        if (p->mode == ANG_MODE_ISO) assert_true(isfinite(p->iso_hu));
        if (i > 0) assert_true(strcmp(names.names[i - 1], names.names[i]) < 0);
        bool vessels = strncmp(p->name, "cta-", 4) == 0 && p->mode == ANG_MODE_DVR;
        if (vessels) assert_false(ang_transfer_visible(p->transfer, 0, 129));
        ang_preset_free(p);
    }
    for (size_t i = 0; i < sizeof shipped / sizeof *shipped; i++) {
        size_t k = 0;
        while (k < names.count && strcmp(names.names[k], shipped[i]) != 0) k++;
        assert_true(k < names.count);
    }
    ang_preset_names_clear(&names);
}

static void unknown_names_are_explained(void **state) {
    (void)state;
    const char *const folders[] = {ANG_PRESETS, NULL}, *const none[] = {NULL};
    ang_error err;
    assert_null(ang_preset_find("cta-haed", folders, &err));
    assert_int_equal(err.code, ANG_USAGE);
    assert_non_null(strstr(err.message, "did you mean cta-head?"));
    assert_null(ang_preset_find("qqqqqqqqqqqq", folders, &err));
    assert_non_null(strstr(err.message, "there are: "));
    assert_null(ang_preset_find("cta-head", none, &err));
    assert_null(ang_preset_find("./cta-head.json", folders, &err));
    assert_int_equal(err.code, ANG_USAGE);
    ang_preset *p = ang_preset_find("cta-head.json", folders, &err);
    assert_non_null(p);
    ang_preset_free(p);
    p = ang_preset_find(ANG_PRESETS "/cta-head.json", none, &err);
    assert_non_null(p);
    ang_preset_free(p);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(full_form),
        cmocka_unit_test(simple_form),
        cmocka_unit_test(texts_are_of_printable_characters),
        cmocka_unit_test(extinction_and_steps),
        cmocka_unit_test(broken_files_are_explained),
        cmocka_unit_test(lines_are_found),
        cmocka_unit_test(damaged_text_never_crashes),
        cmocka_unit_test(printing_keeps_everything),
        cmocka_unit_test(shipped_presets_are_sound),
        cmocka_unit_test(unknown_names_are_explained),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
