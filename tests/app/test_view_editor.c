/* The transfer-function editor, presets and the error of the picture, in a real window. */
#include "tests/core/fixtures.h"

#include "io/load.h"
#include "io/preset/preset.h"

#define FOLDER ANG_TEST_TMP "/view-editor"
#include "tests/app/viewer_hands.h"

/* Where the editor draws things. */
typedef struct plot {
    double low, high, left, top, width, height;
} plot;

static plot read_plot(void) {
    cJSON *state = read_state();
    plot plot = {number_at(state, "editor.hu.0"),   number_at(state, "editor.hu.1"),
                 number_at(state, "editor.plot.0"), number_at(state, "editor.plot.1"),
                 number_at(state, "editor.plot.2"), number_at(state, "editor.plot.3")};
    cJSON_Delete(state);
    return plot;
}

static int x_of(const plot *plot, double hu) {
    return (int)lround(plot->left + (hu - plot->low) / (plot->high - plot->low) * plot->width);
}
static int y_of(const plot *plot, double opacity) {
    return (int)lround(plot->top + (1 - sqrt(opacity)) * plot->height);
}

/* A box around two points, of 300 and 350 HU, and a drag of one of them. */
static void points_in_a_box_move_together(void **state) {
    (void)state;
    need_window();
    expect_text("phase", "ready");
    expect_number("preset.points.4.hu", 300, 0);
    expect_number("preset.points.5.hu", 350, 0);
    plot plot = read_plot();
    /* Narrower, so that the points are apart: about 325 HU, which stays where it is. */
    hands("mousemove %d %d click --repeat 6 --delay 20 4", x_of(&plot, 325), y_of(&plot, 0.8));
    expect_number("editor.hu.1", 325 + (plot.high - 325) * pow(0.85, 6), 20);
    plot = read_plot();
    double per_pixel = (plot.high - plot.low) / plot.width;
    drag_between(x_of(&plot, 325) - (int)(45 / per_pixel), y_of(&plot, 0.6), x_of(&plot, 325) + (int)(45 / per_pixel),
                 y_of(&plot, 0.25));
    expect_number("editor.points.0", 4, 0);
    expect_number("editor.points.1", 5, 0);
    double first = number_now("preset.points.4.opacity"), second = number_now("preset.points.5.opacity");
    hands("mousemove %d %d", x_of(&plot, 350), y_of(&plot, second));
    drag(1, 5, -10);
    expect_number("preset.points.4.hu", 300 + 5 * per_pixel, 1e-6);
    expect_number("preset.points.5.hu", 350 + 5 * per_pixel, 1e-6);
    double higher = 10 / plot.height;
    expect_number("preset.points.4.opacity", pow(sqrt(first) + higher, 2), 1e-9);
    expect_number("preset.points.5.opacity", pow(sqrt(second) + higher, 2), 1e-9);
    /* Far to the right: the second one stops at the third, of 400 HU, and the first keeps its distance. */
    hands("mousemove %d %d", x_of(&plot, 350) + 5, y_of(&plot, second) - 10);
    drag(1, (int)(200 / per_pixel), 0);
    expect_number("preset.points.5.hu", 400, 1e-9);
    expect_number("preset.points.4.hu", 350, 1e-9);
    hands("key --delay 60 ctrl+z ctrl+z");
    expect_number("preset.points.4.hu", 300, 0);
    expect_number("preset.points.5.opacity", second, 0);
}

static void keys_alone_edit(void **state) {
    (void)state;
    need_window();
    go_to("axial"); /* the pointer does nothing from here on */
    hands("key n key shift+n");
    expect_text("preset.name", "cta-head");
    hands("key --delay 60 e");
    expect_number("editor.point", 0, 0);
    hands("key --delay 60 period period period shift+period");
    expect_number("editor.points.0", 3, 0);
    expect_number("editor.points.1", 4, 0);
    double hu = number_now("preset.points.3.hu"), opacity = number_now("preset.points.4.opacity");
    hands("key --delay 60 Up Up shift+Down");
    expect_number("preset.points.4.opacity", opacity + 0.019, 1e-9);
    double low = number_now("editor.hu.0"), high = number_now("editor.hu.1");
    double step = pow(10, floor(log10((high - low) / 100)));
    for (int i = 0; i < 2; i++)
        if (step * (i == 0 ? 5 : 2) <= (high - low) / 100) {
            step *= i == 0 ? 5 : 2;
            break;
        }
    hands("key --delay 60 Left shift+Right");
    expect_number("preset.points.3.hu", hu - 0.9 * step, 1e-9);
    int count = 14;
    hands("key --delay 60 Insert");
    expect_number("preset.points.14.hu", 3071, 0); /* one more */
    hands("key --delay 60 Delete");
    expect_number("preset.points.13.hu", 3071, 0);
    hands("key --delay 60 ctrl+a");
    char last[32];
    snprintf(last, sizeof last, "editor.points.%d", count - 1);
    expect_number(last, count - 1, 0);
    hands("key --delay 60 shift+e equal minus");
    expect_number("editor.hu.1", 3071 + 0.03 * 4095, 20);
    /* Esc lets go of the points, then of the keys: arrows scroll slices again. */
    hands("key --delay 60 Escape Escape");
    expect_number("editor.point", -1, 0);
    double slice = number_now("axial.slice");
    hands("key --delay 60 Up");
    expect_number("axial.slice", slice + 1, 0);
    hands("key --delay 60 ctrl+z");
    expect_number("axial.slice", slice, 0);
    hands("key --delay 60 ctrl+z ctrl+z ctrl+z ctrl+z ctrl+z ctrl+z ctrl+z");
    expect_number("preset.points.3.hu", hu, 0);
}

/* Fields show no more digits than are of use; what they hold stays to the last one. */
static void fields_keep_what_they_do_not_show(void **state) {
    (void)state;
    need_window();
    plot plot = read_plot();
    double hu = number_now("preset.points.4.hu"), opacity = number_now("preset.points.4.opacity");
    hands("mousemove %d %d", x_of(&plot, hu), y_of(&plot, opacity));
    drag(1, 0, 7);
    expect_number("editor.point", 4, 0);
    double dragged = number_now("preset.points.4.opacity");
    assert_true(fabs(1000 * dragged - round(1000 * dragged)) > 1e-6); /* more than one decimal of a per cent */
    int y = (int)(plot.top + plot.height) + 46;
    /* Through both fields without a change, then one that has more decimals than are shown after a drag. */
    hands("mousemove %d %d click 1 key --delay 60 Tab key --delay 60 Return", (int)plot.left + 40, y);
    nap(200);
    expect_number("preset.points.4.opacity", dragged, 0);
    hands("mousemove %d %d click 1 key --delay 60 ctrl+a type --delay 60 287.65432", (int)plot.left + 40, y);
    hands("key --delay 60 Return");
    expect_number("preset.points.4.hu", 287.65432, 0);
    hands("key --delay 60 Escape key --delay 60 Escape key --delay 60 ctrl+z key --delay 60 ctrl+z");
    expect_number("preset.points.4.hu", hu, 0);
    expect_number("preset.points.4.opacity", opacity, 0);
}

/* A drag on the strip of colours: the state's share against a count of the volume's voxels. */
static void a_range_is_counted_and_marked(void **state) {
    (void)state;
    need_window();
    plot plot = read_plot();
    int y = (int)(plot.top + plot.height) + 6;
    drag_between(x_of(&plot, 150), y, x_of(&plot, 500), y);
    expect_number("editor.in_slices.hu.0", 150, 25);
    double low = number_now("editor.in_slices.hu.0"), high = number_now("editor.in_slices.hu.1");
    ang_volume *volume = ang_load(FOLDER "/phantom", &(ang_load_options){0}, &(ang_load_report){0}, NULL, NULL);
    assert_non_null(volume);
    size_t counted = 0, all = ang_volume_count(volume);
    for (size_t i = 0; i < all; i++) {
        double hu = ang_volume_hu(volume, volume->data[i]);
        counted += hu >= low - 1e-6 && hu <= high + 1e-6;
    }
    double ml = (double)counted * ang_volume_spacing(volume, 0) * ang_volume_spacing(volume, 1) *
                ang_volume_spacing(volume, 2) / 1000;
    assert_true(counted > 100);
    expect_number("editor.in_slices.voxels", (double)counted, 0);
    expect_number("editor.in_slices.share", (double)counted / (double)all, 1e-12);
    expect_number("editor.in_slices.ml", ml, 1e-6 * ml);
    ang_volume_free(volume);
    /* Orange pixels in the window, about as many as the share lets expect, and none when it is switched off. */
    int seen[2];
    for (int i = 0; i < 2; i++) {
        char name[sizeof PICTURES + 64];
        ang_image picture;
        hands("mousemove 5 600 key --delay 60 ctrl+shift+s");
        snprintf(name, sizeof name, "angioscope-window-%04d.png", i + 1);
        expect_text("saved", name);
        snprintf(name, sizeof name, PICTURES "/angioscope-window-%04d.png", i + 1);
        assert_true(ang_picture_read(name, &picture, NULL));
        double left = number_now("panes.axial.0"), top = number_now("panes.axial.1") + 50,
               bottom = number_now("panes.axial.3") - 50;
        seen[i] = 0;
        for (int p = 0; p < picture.width * picture.height; p++) {
            const float *c = picture.rgba + 4 * p;
            bool inside = p % picture.width > left && p / picture.width > top && p / picture.width < bottom;
            seen[i] += inside && c[0] - c[2] > 0.3f && c[1] - c[2] > 0.1f && c[0] - c[1] > 0.1f;
        }
        ang_image_clear(&picture);
        hands("key --delay 60 h");
        if (i == 0) nap(300);
    }
    print_message("%d and %d orange pixels\n", seen[0], seen[1]);
    assert_true(seen[0] > 200 && seen[1] < seen[0] / 20);
    hands("mousemove %d %d click 1", x_of(&plot, 300), y); /* the end of it */
    nap(300);
    cJSON *after = read_state();
    assert_null(field(after, "editor.in_slices"));
    cJSON_Delete(after);
    hands("key --delay 60 h Escape");
}

static void a_preset_is_saved_by_name(void **state) {
    (void)state;
    need_window();
    go_to("volume");
    hands("key --delay 60 e period Up Up Up");
    expect_number("preset.points.1.opacity", 0.03, 1e-9);
    hands("key --delay 60 ctrl+p");
    expect_text("saving_preset.name", "cta-head");
    hands("key --delay 60 x BackSpace type --delay 60 'a/b'");
    expect_text("saving_preset.name", "a/b");
    hands("key --delay 60 Return");
    expect_text("saving_preset.problem", "A name must not hold a slash: it becomes a file's.");
    nap(200);
    hands("key --delay 60 x BackSpace type --delay 60 'my head'");
    expect_text("saving_preset.name", "my head");
    /* Tab goes on to what it is for and saves nothing. */
    hands("key --delay 100 Tab type --delay 60 'all that is red'");
    expect_text("saving_preset.name", "my head");
    hands("key --delay 60 Return");
    expect_text("saved", "my head.json");
    expect_text("preset.name", "my head");
    double opacity = number_now("preset.points.1.opacity");
    assert_int_equal(run("presets show 'my head'"), 0);
    ang_preset *saved = ang_preset_load(FOLDER "/config/angioscope/presets/my head.json", NULL);
    assert_non_null(saved);
    assert_string_equal(saved->name, "my head");
    assert_string_equal(saved->description, "all that is red");
    assert_close(saved->transfer->points[1].opacity, opacity, 0);
    ang_preset_free(saved);
    /* It is in the list at once: the one before and back. */
    hands("key --delay 100 shift+n");
    expect_text("preset.name", "mra");
    hands("key --delay 100 n");
    expect_text("preset.name", "my head");
    expect_number("preset.points.1.opacity", opacity, 0);
    /* It is replaced only where Enter is pressed once more. */
    hands("key --delay 60 period period Up Escape Escape ctrl+p"); /* the keys are still the editor's */
    expect_text("saving_preset.name", "my head");
    for (int i = 0; i < 2; i++) {
        hands("key --delay 60 Return");
        expect_flag(i == 0 ? "saving_preset.replaces" : "can_undo", true);
        expect_text("saving_preset.name", i == 0 ? "my head" : "");
        saved = ang_preset_load(FOLDER "/config/angioscope/presets/my head.json", NULL);
        assert_non_null(saved);
        assert_close(saved->transfer->points[1].opacity, opacity + 0.01 * i, 1e-9);
        ang_preset_free(saved);
    }
}

/* The estimate is that of the headless program for the same picture; a change drops it. */
static void the_error_is_estimated_at_rest(void **state) {
    (void)state;
    need_window();
    go_to("volume");
    hands("key --delay 60 1");
    expect_text("preset.name", "cta-head");
    expect_number("preset.points.13.hu", 3071, 0);
    expect_flag("at_rest", true);
    cJSON *shown = read_state();
    assert_false(cJSON_IsTrue(field(shown, "preset_changed")));
    double levels = number_at(shown, "error_levels");
    assert_true(levels > 0 && levels <= 255);
    cJSON_Delete(shown);
    assert_int_equal(run("render " FOLDER "/phantom --state " STATE " -q -o " FOLDER "/headless.png --json " FOLDER
                         "/headless.json"),
                     0);
    ang_json json;
    assert_true(ang_json_open(FOLDER "/headless.json", &json, NULL));
    assert_close(number_at(json.root, "error.estimate"), levels, 1e-4 * levels);
    ang_json_close(&json);
    hands("mousedown 1 mousemove_relative 10 0");
    nap(100);
    for (int i = 0; i < 100 && !isnan(number_now("error_levels")); i++) nap(20);
    assert_true(isnan(number_now("error_levels")));
    hands("mouseup 1");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(points_in_a_box_move_together),     cmocka_unit_test(keys_alone_edit),
        cmocka_unit_test(fields_keep_what_they_do_not_show), cmocka_unit_test(a_range_is_counted_and_marked),
        cmocka_unit_test(the_error_is_estimated_at_rest),    cmocka_unit_test(a_preset_is_saved_by_name),
    };
    return cmocka_run_group_tests(tests, open_phantom, close_display);
}
