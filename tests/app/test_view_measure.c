/* Measuring with real hands in a real window: lengths, angles and regions against the phantom's geometry and voxels. */
#include "tests/core/fixtures.h"

#define FOLDER ANG_TEST_TMP "/view_measure"
#include "tests/app/viewer_hands.h"

#include "core/scene/annotation.h"
#include "core/scene/objects.h"
#include "core/volume/measures.h"
#include "io/image/annotate.h"
#include "io/load.h"

/* 96 x 96 x 48 voxels of 2.4, 2.4 and 2 mm about (0, 5, 8). */
static const double voxel[3] = {2.4, 2.4, 2};

static ang_volume *load_phantom(void) {
    ang_load_report report = {0};
    ang_volume *volume = ang_load(FOLDER "/phantom", &(ang_load_options){0}, &report, NULL, NULL);
    assert_non_null(volume);
    ang_load_report_clear(&report);
    return volume;
}

/* mm of a pixel of the axial pane, whose height the slice fits; and the pixel that shows a place. */
static double axial_pixel(void) {
    cJSON *state = read_state();
    double height = number_at(state, "panes.axial.3");
    cJSON_Delete(state);
    return 95 * voxel[0] / height;
}

static void axial_place(double x_mm, double y_mm, int *x, int *y) {
    double pixel = axial_pixel();
    cJSON *state = read_state();
    double left = number_at(state, "panes.axial.0"), top = number_at(state, "panes.axial.1");
    *x = (int)floor(left + number_at(state, "panes.axial.2") / 2 + x_mm / pixel);
    *y = (int)floor(top + number_at(state, "panes.axial.3") / 2 + (y_mm - 5) / pixel);
    cJSON_Delete(state);
}

/* From one pixel of the window to another, with the left button. */
static void pull(int x0, int y0, int x1, int y1) {
    hands("mousemove %d %d mousedown 1 mousemove %d %d mousemove %d %d mouseup 1", x0, y0, (x0 + x1) / 2, (y0 + y1) / 2,
          x1, y1);
}

static void to_axial_slice(int number) {
    go_to("axial");
    cJSON *state = read_state();
    int steps = number - (int)number_at(state, "axial.slice");
    cJSON_Delete(state);
    if (steps != 0) hands("click --repeat %d --delay 15 %d", abs(steps), steps > 0 ? 4 : 5);
    expect_number("axial.slice", number, 0);
}

/* Without a mouse: from the crosshair to where keys have moved it. */
static void keys_measure_from_the_crosshair(void **state) {
    (void)state;
    need_window();
    expect_text("phase", "ready");
    to_axial_slice(24);
    hands("key --delay 60 m Insert shift+Right shift+Right shift+Right shift+Right shift+Right shift+Down shift+Down");
    nap(100);
    expect_number("measures.count", 0, 0);
    hands("key Insert");
    expect_number("measures.count", 1, 0);
    expect_number("measures.values.0.value", hypot(5 * voxel[0], 2 * voxel[1]), 1e-9);
    hands("key --delay 60 Delete Home w");
    expect_number("measures.count", 0, 0);
    expect_text("tool", "window");
}

/* The vault of the skull is inside an ellipsoid about (0, 18, 32) mm with half axes of 66 mm across and upwards, so
 * that it is 132 mm wide there. The slice is at 33 mm. */
static void the_skull_is_as_wide_as_it_was_made(void **state) {
    (void)state;
    need_window();
    expect_text("phase", "ready");
    to_axial_slice(37);
    double half = 66 * sqrt(1 - 1 / (66.0 * 66)), pixel = axial_pixel();
    /* The bone does begin there: half of its value, within a voxel. */
    ang_volume *volume = load_phantom();
    int row = (int)lround((18 - 5) / voxel[1] + 47.5);
    for (int side = -1; side <= 1; side += 2) {
        double edge = NAN, before = 0;
        for (double x = 40; x < 75 && isnan(edge); x += 0.1) {
            ang_vec3 index = {side * x / voxel[0] + 47.5, row, 36};
            double hu = ang_volume_hu(volume, ang_volume_sample(volume, index));
            if (before < 300 && hu >= 300) edge = x;
            before = hu;
        }
        assert_close(edge, half, voxel[0]);
    }
    ang_volume_free(volume);
    int x0, x1, y;
    axial_place(-half, 18, &x0, &y);
    axial_place(half, 18, &x1, &y);
    hands("key m");
    expect_text("tool", "measure");
    pull(x0, y, x1, y);
    expect_number("measures.count", 1, 0);
    expect_text("measures.list.0.kind", "length");
    expect_text("measures.values.0.unit", "mm");
    expect_number("measures.values.0.value", (x1 - x0) * pixel, 1e-9);
    expect_number("measures.values.0.value", 2 * half, pixel);
    expect_number("measures.list.0.points_mm.0.0", -half, pixel);
    expect_number("measures.list.0.points_mm.1.1", 18, pixel);
    expect_number("measures.list.0.points_mm.0.2", 33, 1e-9);
    /* The tool stays, and the crosshair has not moved. */
    expect_text("tool", "measure");
}

/* A handle is dragged, the drag is cancelled, undone, redone; the measure deleted and brought back. */
static void a_length_is_edited(void **state) {
    (void)state;
    need_window();
    cJSON *shown = read_state();
    double length = number_at(shown, "measures.values.0.value"), pixel = axial_pixel();
    int x, y;
    axial_place(number_at(shown, "measures.list.0.points_mm.1.0"), number_at(shown, "measures.list.0.points_mm.1.1"),
                &x, &y);
    cJSON_Delete(shown);
    pull(x, y, x - 20, y);
    expect_number("measures.values.0.value", length - 20 * pixel, 1e-9);
    expect_number("measures.count", 1, 0);
    hands("key ctrl+z");
    expect_number("measures.values.0.value", length, 1e-9);
    hands("key ctrl+shift+z");
    expect_number("measures.values.0.value", length - 20 * pixel, 1e-9);
    hands("mousemove %d %d mousedown 1 mousemove %d %d", x - 20, y, x - 60, y + 30);
    expect_number("measures.values.0.value", hypot(length - 60 * pixel, 30 * pixel), 1e-9);
    hands("key Escape");
    expect_number("measures.values.0.value", length - 20 * pixel, 1e-9);
    hands("mouseup 1");
    nap(100);
    expect_number("measures.values.0.value", length - 20 * pixel, 1e-9);
    /* By its line all of it moves. */
    pull(x - 100, y, x - 90, y + 12);
    expect_number("measures.values.0.value", length - 20 * pixel, 1e-9);
    expect_number("measures.list.0.points_mm.0.1", 18 + 12 * pixel, pixel);
    hands("key Delete");
    expect_number("measures.count", 0, 0);
    hands("key --delay 60 ctrl+z ctrl+z ctrl+z");
    expect_number("measures.values.0.value", length, 1e-9);
}

static void clicks_make_an_angle(void **state) {
    (void)state;
    need_window();
    int x, y;
    axial_place(-20, 30, &x, &y);
    hands("key m");
    hands("mousemove %d %d click 1", x, y - 40);
    hands("mousemove %d %d click 1", x, y);
    hands("mousemove %d %d", x + 30, y);
    nap(100);
    expect_number("measures.count", 1, 0);
    hands("click 1");
    expect_number("measures.count", 2, 0);
    expect_text("measures.list.1.kind", "angle");
    expect_number("measures.values.1.value", 90, 1e-9);
    /* One that is half made is given up by Esc, and by another slice. */
    hands("mousemove %d %d click 1 key Escape", x + 60, y + 20);
    hands("mousemove %d %d click 1 click 4 click 5", x + 50, y + 40);
    hands("mousemove %d %d", x + 80, y + 10);
    nap(100);
    hands("key Escape");
    expect_number("measures.count", 2, 0);
    hands("key Delete"); /* none is chosen */
    expect_number("measures.count", 2, 0);
}

/* Straight over the voxels of the slice. */
static void compare_with_voxels(const ang_volume *volume, int measure, bool ellipse) {
    char path[64];
    double corner[2][3];
    cJSON *shown = read_state();
    for (int i = 0; i < 2; i++)
        for (int axis = 0; axis < 3; axis++) {
            snprintf(path, sizeof path, "measures.list.%d.points_mm.%d.%d", measure, i, axis);
            corner[i][axis] = number_at(shown, path);
        }
    double sum = 0, least = INFINITY, most = -INFINITY, squares = 0, middle[2], half[2];
    for (int axis = 0; axis < 2; axis++) {
        middle[axis] = (corner[0][axis] + corner[1][axis]) / 2;
        half[axis] = fabs(corner[1][axis] - corner[0][axis]) / 2;
    }
    int z = (int)lround((corner[0][2] - 8) / voxel[2] + 23.5), count = 0;
    for (int pass = 0; pass < 2; pass++)
        for (int y = 0; y < 96; y++)
            for (int x = 0; x < 96; x++) {
                double u = ((x - 47.5) * voxel[0] - middle[0]) / half[0];
                double v = ((y - 47.5) * voxel[1] + 5 - middle[1]) / half[1];
                if (ellipse ? u * u + v * v > 1 : fmax(fabs(u), fabs(v)) > 1) continue;
                double hu = ang_volume_hu(volume, volume->data[((size_t)z * 96 + (size_t)y) * 96 + (size_t)x]);
                if (pass == 1) {
                    squares += (hu - sum / count) * (hu - sum / count);
                    continue;
                }
                sum += hu;
                count++;
                least = fmin(least, hu);
                most = fmax(most, hu);
            }
    cJSON_Delete(shown);
    const struct {
        const char *name;
        double expected;
    } rows[] = {{"count", count},    {"mean_hu", sum / count}, {"sd_hu", sqrt(squares / (count - 1))},
                {"least_hu", least}, {"most_hu", most},        {"value", (ellipse ? M_PI : 4) * half[0] * half[1]}};
    assert_true(count > 50);
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        snprintf(path, sizeof path, "measures.values.%d.%s", measure, rows[i].name);
        expect_number(path, rows[i].expected, 1e-6);
    }
}

static void regions_have_the_values_of_their_voxels(void **state) {
    (void)state;
    need_window();
    int x, y;
    ang_volume *volume = load_phantom();
    axial_place(25, 60, &x, &y);
    hands("key m");
    pull(x, y, x + 70, y - 50);
    expect_number("measures.count", 3, 0);
    expect_text("measures.list.2.kind", "ellipse");
    compare_with_voxels(volume, 2, true);
    axial_place(-55, -40, &x, &y);
    hands("key m");
    pull(x, y, x + 45, y + 60);
    expect_number("measures.count", 4, 0);
    expect_text("measures.list.3.kind", "rectangle");
    compare_with_voxels(volume, 3, false);
    /* A corner is dragged. */
    pull(x + 45, y + 60, x + 61, y + 41);
    compare_with_voxels(volume, 3, false);
    ang_volume_free(volume);
}

/* How many pixels have the colour of marks. */
static int marked(const char *name, const char *pane) {
    char path[256], side[2][32];
    ang_image picture;
    snprintf(path, sizeof path, PICTURES "/%s", name);
    assert_true(ang_picture_read(path, &picture, NULL));
    cJSON *shown = read_state();
    for (int i = 0; i < 2; i++) snprintf(side[i], sizeof side[i], "panes.%s.%d", pane, 2 + i);
    assert_int_equal(picture.width, (int)number_at(shown, side[0]));
    assert_int_equal(picture.height, (int)number_at(shown, side[1]));
    cJSON_Delete(shown);
    int count = 0;
    for (int i = 0; i < picture.width * picture.height; i++) {
        const float *p = picture.rgba + 4 * i;
        count += p[0] > 0.85F && p[1] > 0.7F && p[2] < 0.3F;
    }
    ang_image_clear(&picture);
    return count;
}

/* The pane as it is seen has the marks of its slice and of no other. */
static void marks_are_seen_on_their_slice(void **state) {
    (void)state;
    need_window();
    to_axial_slice(37);
    hands("key w key shift+x mousemove_relative 1 1 key F12");
    expect_text("saved", "angioscope-axial-seen-0001.png");
    int seen = marked("angioscope-axial-seen-0001.png", "axial");
    to_axial_slice(36);
    hands("key F12");
    expect_text("saved", "angioscope-axial-seen-0002.png");
    int elsewhere = marked("angioscope-axial-seen-0002.png", "axial");
    to_axial_slice(37);
    hands("key shift+m key F12");
    expect_text("saved", "angioscope-axial-seen-0003.png");
    int hidden = marked("angioscope-axial-seen-0003.png", "axial");
    print_message("%d pixels of marks on their slice, %d on the next, %d where hidden\n", seen, elsewhere, hidden);
    assert_true(seen > 400); /* the length alone is 130 mm long */
    assert_int_equal(elsewhere, 0);
    assert_int_equal(hidden, 0);
    hands("key shift+m key shift+x");
}

static ang_measurement length_at(cJSON *shown, int index) {
    char path[64];
    double mm[6];
    for (int i = 0; i < 6; i++) {
        snprintf(path, sizeof path, "measures.list.%d.points_mm.%d.%d", index, i / 3, i % 3);
        mm[i] = number_at(shown, path);
    }
    return (ang_measurement){.point = {{mm[0], mm[1], mm[2]}, {mm[3], mm[4], mm[5]}}};
}

/* Where a camera shows a place, in pixels of the volume's pane. */
static void project(cJSON *shown, const ang_volume *volume, ang_vec3 mm, double *x, double *y) {
    ang_view view = ang_view_default;
    view.zoom = atof(text_at(shown, "render.zoom"));
    ang_camera camera = ang_camera_for(volume, &view);
    ang_vec3 from = ang_vec3_sub(mm, camera.eye);
    double height = number_at(shown, "panes.volume.3"), width = number_at(shown, "panes.volume.2");
    double pixels = height / 2 / tan(15 * M_PI / 180) / ang_vec3_dot(from, camera.forward);
    *x = number_at(shown, "panes.volume.0") + width / 2 + ang_vec3_dot(from, camera.right) * pixels;
    *y = number_at(shown, "panes.volume.1") + height / 2 - ang_vec3_dot(from, camera.up) * pixels;
}

static void two_places_of_the_skin_are_measured(void **state) {
    (void)state;
    need_window();
    go_to("volume");
    hands("key 9 key r key alt+a key m key m"); /* from rectangle on to length */
    expect_text("preset.name", "ct-skin");
    expect_text("render.view", "0,0,0");
    int x, y;
    middle("volume", &x, &y);
    const int at[2][2] = {{x - 35, y - 20}, {x + 28, y + 17}};
    for (int i = 0; i < 2; i++) {
        hands("mousemove %d %d click 1", at[i][0], at[i][1]);
        nap(300);
    }
    expect_number("measures.count", 5, 0);
    ang_volume *volume = load_phantom();
    cJSON *shown = read_state();
    for (int i = 0; i < 2; i++) {
        double seen_x, seen_y;
        ang_vec3 mm = length_at(shown, 4).point[i];
        assert_true(mm.y < -40); /* on the side of the face */
        project(shown, volume, mm, &seen_x, &seen_y);
        assert_close(seen_x, at[i][0], 1);
        assert_close(seen_y, at[i][1], 1);
    }
    cJSON_Delete(shown);
    ang_volume_free(volume);
}

/* The window saves a pane without writing; 'render' writes the lengths. The same is written here onto what was saved.
 */
static void write_lengths(const char *from, const char *to, const ang_measurement *lengths, int count) {
    ang_volume *volume = load_phantom();
    ang_image picture;
    assert_true(ang_picture_read(from, &picture, NULL));
    cJSON *shown = read_state();
    ang_scene scene = ang_scene_default(volume);
    ang_view view = ang_view_default;
    view.zoom = atof(text_at(shown, "render.zoom"));
    cJSON_Delete(shown);
    scene.camera = ang_camera_for(volume, &view);
    scene.width = picture.width;
    scene.height = picture.height;
    ang_objects objects = {0};
    for (int i = 0; i < count; i++)
        assert_true(ang_objects_add_mark(&objects, volume, lengths[i].point[0], lengths[i].point[1], NULL));
    scene.objects = &objects;
    ang_annotation annotation = ang_annotation_of_objects(&scene);
    assert_int_equal(annotation.labels, count);
    assert_true(ang_image_annotate(&picture, &annotation, &(ang_notes){0}, NULL));
    assert_true(ang_image_write(to, &picture, scene.background, NULL));
    ang_objects_clear(&objects);
    ang_image_clear(&picture);
    ang_volume_free(volume);
}

/* A double click makes the pane large, with this tool as well, and measures nothing. */
static void a_double_click_measures_nothing(void **state) {
    (void)state;
    need_window();
    static const char *const panes[] = {"volume", "coronal"};
    for (int i = 0; i < 2; i++) {
        go_to(panes[i]);
        hands("mousemove_relative 8 -12 click --repeat 2 --delay 60 1");
        expect_text("maximised", panes[i]);
        hands("click --repeat 2 --delay 60 1");
        expect_text("maximised", "");
        hands("mousemove_relative 20 20 key Escape");
        nap(100);
        expect_number("measures.count", 5, 0);
    }
    expect_text("tool", "measure");
}

static void the_volume_has_the_lengths_as_headless(void **state) {
    (void)state;
    need_window();
    go_to("volume");
    cJSON *shown = read_state();
    const ang_measurement lengths[] = {length_at(shown, 0), length_at(shown, 4)};
    cJSON_Delete(shown);
    hands("key 1 key ctrl+s"); /* arteries: nothing is so bright that it is cut off under the writing */
    expect_text("saved", "angioscope-volume-0001.png");
    expect_text("preset.name", "cta-head");
    write_lengths(PICTURES "/angioscope-volume-0001.png", PICTURES "/written.png", lengths, 2);
    compare_with_headless("written.png", FOLDER "/phantom");
    hands("key F12");
    expect_text("saved", "angioscope-volume-seen-0001.png");
}

static char *measures_text(void) {
    cJSON *shown = read_state();
    char *text = cJSON_Print(field(shown, "measures"));
    cJSON_Delete(shown);
    assert_non_null(text);
    return text;
}

/* A session has its measures, with the same values, and can undo none of them. */
static void measures_are_restored_with_the_session(void **state) {
    (void)state;
    need_window();
    hands("key w key ctrl+alt+s");
    expect_text("saved", "angioscope-state-0001.json");
    /* None is chosen in the new window. */
    go_to("axial");
    hands("key m key Escape");
    int x, y;
    axial_place(80, -80, &x, &y);
    hands("mousemove %d %d click 1 key Escape key w", x, y);
    expect_number("measures.chosen", -1, 0);
    char *before = measures_text();
    hands("key ctrl+q");
    assert_int_equal(wait_for_end(), 0);
    start_viewer("--state " PICTURES "/angioscope-state-0001.json");
    expect_text("phase", "ready");
    expect_number("measures.count", 5, 0);
    char *after = measures_text();
    assert_string_equal(after, before);
    free(before);
    free(after);
    cJSON *now = read_state();
    assert_true(cJSON_IsFalse(field(now, "can_undo")));
    cJSON_Delete(now);
    hands("key ctrl+q");
    assert_int_equal(wait_for_end(), 0);
}

/* In the head's middle the skin hides an ellipse; one around the head is seen where the head is not before it. */
static void regions_are_seen_in_the_volume_where_nothing_hides_them(void **state) {
    (void)state;
    need_window();
    start_viewer(FOLDER "/phantom --preset ct-skin");
    expect_text("phase", "ready");
    to_axial_slice(24);
    hands("key --delay 100 shift+x key --delay 100 m key --delay 100 m key --delay 100 m");
    int count[2], x0, y0, x1, y1;
    for (int i = 0; i < 2; i++) {
        double reach = i == 0 ? 20 : 105;
        char name[64];
        to_axial_slice(24);
        axial_place(-reach, -reach, &x0, &y0);
        axial_place(reach, reach, &x1, &y1);
        pull(x0, y0, x1, y1);
        expect_number("measures.count", i + 1, 0);
        go_to("volume");
        hands("key F12");
        snprintf(name, sizeof name, "angioscope-volume-seen-%04d.png", 2 + i);
        expect_text("saved", name);
        count[i] = marked(name, "volume");
    }
    print_message("%d pixels of an ellipse in the head, %d with one around it\n", count[0], count[1]);
    assert_int_equal(count[0], 0);
    assert_true(count[1] > 100);
    hands("key ctrl+q");
    assert_int_equal(wait_for_end(), 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(keys_measure_from_the_crosshair),
        cmocka_unit_test(the_skull_is_as_wide_as_it_was_made),
        cmocka_unit_test(a_length_is_edited),
        cmocka_unit_test(clicks_make_an_angle),
        cmocka_unit_test(regions_have_the_values_of_their_voxels),
        cmocka_unit_test(marks_are_seen_on_their_slice),
        cmocka_unit_test(two_places_of_the_skin_are_measured),
        cmocka_unit_test(a_double_click_measures_nothing),
        cmocka_unit_test(the_volume_has_the_lengths_as_headless),
        cmocka_unit_test(measures_are_restored_with_the_session),
        cmocka_unit_test(regions_are_seen_in_the_volume_where_nothing_hides_them),
    };
    return cmocka_run_group_tests(tests, open_phantom, close_display);
}
