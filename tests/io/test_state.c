/* State files: round trips, where the data are, and what is said about broken ones. */
#include "tests/core/fixtures.h"

#include "core/scene/image.h"
#include "io/image/image_io.h"
#include "io/preset/preset.h"
#include "io/session/state.h"

#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#define FOLDER ANG_TEST_TMP "/state"
#define HEAD   "{\"angioscope_state\": 1,\n \"preset\": {\"points\": [[0,1,1,1,0.5]]},\n "

static ang_state parse(const char *text) {
    ang_state state;
    ang_error err = {0};
    if (!ang_state_parse(FOLDER "/a.json", text, &state, &err)) fail_msg("%s", err.message);
    return state;
}

static int opening(void **state) {
    (void)state;
    return system("rm -rf " FOLDER " && mkdir -p " FOLDER "/data " FOLDER "/other");
}

/* Numbers that need all their digits. */
static ang_state everything(void) {
    ang_state state = ang_state_default;
    state.input_path = strdup(FOLDER "/data");
    state.input_name = strdup("00c0ffee-3");
    state.raw_dims = strdup("4x5x6");
    state.raw_type = strdup("u8");
    state.raw_spacing = strdup("1,1,2");
    state.preset = ang_preset_parse(
        "x.json", "{\"name\": \"mine\", \"mode\": \"iso\", \"iso_hu\": 0.1, \"points\": [[0.3,1,0,1,0.7]]}", NULL);
    state.preset_changed = true;
    state.shift_hu = -1.0 / 3;
    state.stretch = nextafter(1, 2);
    state.window_centre = 0.1 + 0.2;
    state.window_width = 1e-5;
    state.slab = ANG_SLAB_MINIP;
    state.slab_mm = 10;
    state.crosshair = (ang_vec3){M_PI, -M_E, 1e-17};
    state.crop_lower = (ang_vec3){-0.5, 1 / 3.0, 2};
    state.crop_upper = (ang_vec3){0.5, 10 / 3.0, 7};
    const double turn[9] = {0.6, 0.8, 0, -0.8, 0.6, 0, 0, 0, 1};
    memcpy(state.planes_turn, turn, sizeof turn);
    state.voxels_shown = state.turns_about_crosshair = true;
    for (int i = 0; i < ANG_STATE_SLICES; i++)
        state.slice[i] = (ang_state_slice){.zoom = 1 + i / 7.0, .pan_mm = {-i / 3.0, 5}};
    snprintf(state.maximised, sizeof state.maximised, "coronal");
    snprintf(state.tool, sizeof state.tool, "pan");
    snprintf(state.method, sizeof state.method, "auto");
    state.corner_text = false;
    state.measures.hidden = true;
    ang_measurement length = {.kind = ANG_MEASURE_LENGTH, .point = {{0.1, -1e-7, 1.0 / 3}, {7, 8, 9}}};
    ang_measurement region = {.kind = ANG_MEASURE_ELLIPSE,
                              .point = {{1, 2, 3}, {4, 5, 6}},
                              .right = {cos(0.3), sin(0.3), 0},
                              .down = {-sin(0.3), cos(0.3), 0},
                              .label_placed = true,
                              .label_mm = {-1.0 / 7, 2}};
    ang_measures_add(&state.measures, &length);
    ang_measures_add(&state.measures, &region);
    assert_true(ang_state_add_option(&state, "view", "1,2,3", NULL) && ang_state_add_option(&state, "axes", "", NULL));
    return state;
}

static void all_of_it_comes_back(void **context) {
    (void)context;
    ang_error err = {0};
    ang_state wrote = everything(), read;
    if (!ang_state_write(FOLDER "/all.json", &wrote, "1.2.3", &err)) fail_msg("%s", err.message);
    assert_true(ang_state_probe(FOLDER "/all.json"));
    if (!ang_state_read(FOLDER "/all.json", &read, &err)) fail_msg("%s", err.message);
    assert_string_equal(read.input_path, FOLDER "/data");
    assert_string_equal(read.input_name, "00c0ffee-3");
    assert_int_equal(ang_state_series(&read), 3);
    assert_string_equal(read.raw_dims, "4x5x6");
    assert_string_equal(read.raw_type, "u8");
    assert_string_equal(read.raw_spacing, "1,1,2");
    assert_string_equal(read.preset->name, "mine");
    assert_true(ang_transfer_same(read.preset->transfer, wrote.preset->transfer));
    assert_int_equal(read.preset->mode, ANG_MODE_ISO);
    double a[] = {read.shift_hu,    read.stretch,     read.window_centre, read.window_width,  read.slab_mm,
                  read.crosshair.x, read.crosshair.y, read.crosshair.z,   read.preset->iso_hu};
    double b[] = {wrote.shift_hu,     wrote.stretch,     wrote.window_centre,
                  wrote.window_width, wrote.slab_mm,     wrote.crosshair.x,
                  wrote.crosshair.y,  wrote.crosshair.z, 0.1};
    assert_memory_equal(a, b, sizeof a);
    assert_memory_equal(&read.crop_lower, &wrote.crop_lower, sizeof read.crop_lower);
    assert_memory_equal(&read.crop_upper, &wrote.crop_upper, sizeof read.crop_upper);
    assert_memory_equal(read.slice, wrote.slice, sizeof read.slice);
    assert_memory_equal(read.planes_turn, wrote.planes_turn, sizeof read.planes_turn);
    assert_true(read.voxels_shown && read.turns_about_crosshair);
    assert_int_equal(read.slab, ANG_SLAB_MINIP);
    assert_true(ang_measures_same(&read.measures, &wrote.measures));
    assert_int_equal(read.measures.count, 2);
    assert_string_equal(read.maximised, "coronal");
    assert_string_equal(read.tool, "pan");
    assert_string_equal(read.method, "auto");
    assert_true(read.preset_changed && !read.corner_text && read.crosshair_lines);
    assert_int_equal(read.option_count, 2);
    assert_string_equal(ang_state_option_value(&read, "view"), "1,2,3");
    assert_string_equal(ang_state_option_value(&read, "axes"), "");
    assert_null(ang_state_option_value(&read, "zoom"));
    ang_state_clear(&wrote);
    ang_state_clear(&read);
}

static void text_of(const char *path, char *text, size_t size) {
    FILE *file = fopen(path, "r");
    assert_non_null(file);
    text[fread(text, 1, size - 1, file)] = '\0';
    fclose(file);
}

/* Data below the state's folder move with it; others are named in full. */
static void the_path_is_relative_below_the_folder(void **context) {
    (void)context;
    char text[8192], moved[4096];
    ang_state state = everything();
    assert_true(ang_state_write(FOLDER "/near.json", &state, "1", NULL));
    text_of(FOLDER "/near.json", text, sizeof text);
    assert_non_null(strstr(text, "\"path\":\t\"data\""));
    assert_true(ang_state_write(FOLDER "/other/far.json", &state, "1", NULL));
    text_of(FOLDER "/other/far.json", text, sizeof text);
    char *whole = realpath(FOLDER "/data", NULL);
    snprintf(moved, sizeof moved, "\"path\":\t\"%s\"", whole);
    assert_non_null(strstr(text, moved));
    free(whole);
    ang_state_clear(&state);
}

/* What a picture carries has no path and nothing of the window. */
static void a_picture_carries_it(void **context) {
    (void)context;
#ifndef ANG_WITH_OIIO
    skip();
#endif
    static const char *const names[] = {FOLDER "/p.png", FOLDER "/p.exr"};
    static const double black[4] = {0, 0, 0, 1};
    ang_image image = {0};
    ang_error err = {0};
    ang_state wrote = everything(), read;
    assert_true(ang_image_create(&image, 3, 2, NULL));
    char *text = ang_state_print(&wrote, "1", NULL);
    assert_null(strstr(text, FOLDER));
    assert_null(strstr(text, "crosshair"));
    for (int i = 0; i < 2; i++) {
        assert_true(ang_image_write_stated(names[i], &image, black, text, &err));
        char *carried = ang_image_state(names[i], &err);
        assert_non_null(carried);
        assert_string_equal(carried, text);
        free(carried);
        if (!ang_state_read(names[i], &read, &err)) fail_msg("%s", err.message);
        assert_null(read.input_path);
        assert_true(ang_transfer_same(read.preset->transfer, wrote.preset->transfer));
        assert_string_equal(ang_state_option_value(&read, "view"), "1,2,3");
        ang_state_clear(&read);
    }
    assert_true(ang_image_write(names[0], &image, black, NULL));
    assert_false(ang_state_read(names[0], &read, &err));
    assert_int_equal(err.code, ANG_USAGE);
    free(text);
    ang_image_clear(&image);
    ang_state_clear(&wrote);
}

/* What is left out means as suits; numbers stand for options as well as texts. */
static void most_may_be_left_open(void **context) {
    (void)context;
    ang_state state = parse(HEAD "\"render\": {\"zoom\": 1.5, \"axes\": true}, \"live\": {\"phase\": \"ready\"}}");
    assert_null(state.input_path);
    assert_int_equal(ang_state_series(&state), 0);
    assert_true(isnan(state.crop_lower.x) && isnan(state.crop_upper.z));
    assert_true(isnan(state.crosshair.x) && isnan(state.window_width));
    assert_string_equal(ang_state_option_value(&state, "zoom"), "1.5");
    assert_string_equal(ang_state_option_value(&state, "axes"), "");
    assert_close(state.slice[2].zoom, 1, 0);
    ang_state_clear(&state);
}

/* One sentence that names file, line and field. */
static void broken_ones_are_refused(void **context) {
    (void)context;
    static const struct {
        const char *text, *says;
    } broken[] = {
        {"", "a.json:1: is not valid JSON"},
        {HEAD "\"tool\": \"pan\"", "a.json:3: is not valid JSON"},
        {"[]", "is no state of angioscope"},
        {"{\"points\": []}", "is no state of angioscope"},
        {"{\"angioscope_state\": 2}", "angioscope_state is 2; this program reads version 1"},
        {"{\"angioscope_state\": \"1\"}", "angioscope_state is \"1\"; it must be a number"},
        {"{\"angioscope_state\": 1}", "the state has no preset"},
        {"{\"angioscope_state\": 1,\n\"preset\":\n{\"points\":\n[[0,1,1,1,2]]}}", "a.json:4: points[0][4] is 2"},
        {HEAD "\"zooom\": 1}", "a.json:3: zooom is not a known field"},
        {HEAD "\"slab\": {\"mm\": -1}}", "a.json:3: slab.mm is -1"},
        {HEAD "\"slab\": {\"mode\": \"max\"}}", "slab.mode is \"max\"; it must be mean, mip or minip"},
        {HEAD "\"window\": {\"width\": 0}}", "window.width is 0"},
        {HEAD "\"window\": 3}", "window must be an object"},
        {HEAD "\"crosshair_mm\": [1, 2]}", "crosshair_mm must be 3 numbers"},
        {HEAD "\"crosshair_mm\": [1, 2, null]}", "crosshair_mm[2] is null"},
        {HEAD "\"axial\": {\"pan\": [0, 0]}}", "axial.pan is not a known field; known are zoom, pan_mm"},
        {HEAD "\"oblique\": {}}", "oblique is not a known field"},
        {HEAD "\"crop\": {\"lower\": [1, 2]}}", "crop must have lower and upper"},
        {HEAD "\"crop\": {\"lower\": [1, 2], \"upper\": [1, 2, 3]}}", "crop.lower must be 3 numbers"},
        {HEAD "\"input\": {\"path\": 3}}", "input.path must be a text"},
        {HEAD "\"measures\": []}", "measures must be an object"},
        {HEAD "\"measures\": {\"list\": [{\"kind\": \"area\"}]}}", "measures.list[0].kind is \"area\""},
        {HEAD "\"measures\": {\"list\": [{\"kind\": \"length\", \"points_mm\": [[1, 2, 3]]}]}}", "must be 2 points"},
        {HEAD "\"measures\": {\"list\": [{\"kind\": \"length\",\n\"points_mm\": [[1, 2, 3], [1, 2, true]]}]}}",
         "a.json:4: measures.list[0].points_mm[1][2]"},
        {HEAD "\"measures\": {\"list\": [{\"kind\": \"ellipse\", \"points_mm\": [[1, 2, 3], [4, 5, 6]], \"right\": [1, "
              "0, 0], "
              "\"down\": [1, 0, 0]}]}}",
         "at right angles"},
        {HEAD "\"corner_text\": 1}", "corner_text must be true or false"},
        {HEAD "\"render\": {\"view\": [1, 2]}}", "render.view must be a text, a number or true"},
        {HEAD "\"render\": {\"zoom\": 1, \"zoom\": 2}}", "render.zoom is given twice"},
        {HEAD "\"tool\": \"a tool of the name of which is no end\"}", "tool is"},
    };
    for (size_t i = 0; i < sizeof broken / sizeof *broken; i++) {
        ang_state state;
        ang_error err = {0};
        assert_false(ang_state_parse(FOLDER "/a.json", broken[i].text, &state, &err));
        assert_int_equal(err.code, ANG_USAGE);
        if (!strstr(err.message, broken[i].says) || strncmp(err.message, FOLDER "/a.json:", strlen(FOLDER) + 8) != 0)
            fail_msg("of %s is said: %s", broken[i].text, err.message);
        assert_null(state.preset);
    }
}

/* Every beginning of a good file and every byte of it made another: read or refused, never worse. */
static void damaged_ones_do_no_harm(void **context) {
    (void)context;
    char text[8192];
    ang_state state = everything();
    assert_true(ang_state_write(FOLDER "/whole.json", &state, "1", NULL));
    ang_state_clear(&state);
    text_of(FOLDER "/whole.json", text, sizeof text);
    size_t length = strlen(text);
    int refused = 0;
    for (size_t i = 0; i < length; i++) {
        char kept = text[i];
        text[i] = '\0';
        assert_false(ang_state_parse("cut.json", text, &state, NULL));
        text[i] = kept == '7' ? '{' : '7';
        bool read = ang_state_parse("changed.json", text, &state, NULL);
        refused += !read;
        if (read) ang_state_clear(&state);
        text[i] = kept;
    }
    assert_true(refused > (int)length / 2);
}

static void what_is_no_file_is_refused(void **context) {
    (void)context;
    ang_state state;
    ang_error err = {0};
    assert_false(ang_state_read(FOLDER "/none.json", &state, &err));
    assert_int_equal(err.code, ANG_USAGE);
    assert_non_null(strstr(err.message, "none.json: cannot be read"));
    assert_false(ang_state_probe(FOLDER "/none.json"));
    assert_false(ang_state_probe(FOLDER));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(all_of_it_comes_back),       cmocka_unit_test(the_path_is_relative_below_the_folder),
        cmocka_unit_test(a_picture_carries_it),       cmocka_unit_test(most_may_be_left_open),
        cmocka_unit_test(broken_ones_are_refused),    cmocka_unit_test(damaged_ones_do_no_harm),
        cmocka_unit_test(what_is_no_file_is_refused),
    };
    return cmocka_run_group_tests(tests, opening, NULL);
}
