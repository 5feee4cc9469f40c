/* The viewer in a real window: the basics. */
#include "tests/core/fixtures.h"

#include "io/load.h"

#define FOLDER ANG_TEST_TMP "/view"
#include "tests/app/viewer_hands.h"

static void it_opens_what_it_is_given(void **state) {
    (void)state;
    need_window();
    expect_text("phase", "ready");
    expect_number("axial.slices", 48, 0);
    expect_number("coronal.slices", 96, 0);
    expect_number("sagittal.slices", 96, 0);
    expect_text("preset.name", "cta-head");
}

static void slices_scroll_and_window(void **state) {
    (void)state;
    need_window();
    go_to("axial");
    cJSON *before = read_state();
    double slice = number_at(before, "axial.slice");
    cJSON_Delete(before);
    hands("click --repeat 3 --delay 10 4");
    expect_number("axial.slice", slice + 3, 0);
    hands("key Page_Down");
    expect_number("axial.slice", slice - 7, 0);
    go_to("coronal");
    hands("key Up Up");
    expect_number("coronal.slice", 51, 0);
    hands("key 3");
    expect_number("window.width", 400, 0);
    expect_number("window.centre", 40, 0);
    /* 1 pixel: a 300th of the width; to the right wider, up brighter */
    drag(1, 60, -30);
    expect_number("window.width", 400 + 60 * 400 / 300.0, 1e-6);
    expect_number("window.centre", 40 - 30 * 400 / 300.0, 1e-6);
    hands("key ctrl+z");
    expect_number("window.width", 400, 0);
    hands("key ctrl+shift+z");
    expect_number("window.width", 480, 1e-6);
    hands("key 2");
    expect_number("window.width", 600, 0);
}

/* A click moves the crosshair; its slices follow in the other panes. */
static void a_click_links_the_panes(void **state) {
    (void)state;
    need_window();
    int x, y;
    middle("axial", &x, &y);
    cJSON *before = read_state();
    double pixel = 95 * 230.4 / 96 / number_at(before, "panes.axial.3"); /* the slice fits the pane's height */
    cJSON_Delete(before);
    hands("mousemove %d %d click 1", x + 40, y + 20);
    /* Right of the pane's middle is to the patient's left, down is to the back; slices are 2.4 mm apart. */
    expect_number("crosshair_mm.0", 40 * pixel, 1.3);
    expect_number("crosshair_mm.1", 5 + 20 * pixel, 1.3);
    cJSON *after = read_state();
    assert_close(number_at(after, "sagittal.slice"), 48.5 + number_at(after, "crosshair_mm.0") / 2.4, 0.01);
    cJSON_Delete(after);
}

/* Greys of the saved slice against interpolation of the volume, place by place: left is left. */
static void a_saved_slice_is_the_volumes(void **state) {
    (void)state;
    need_window();
    go_to("axial");
    hands("key ctrl+s");
    expect_text("saved", "angioscope-axial-0001.png");
    cJSON *shown = read_state();
    double z = number_at(shown, "crosshair_mm.2");
    double centre = number_at(shown, "window.centre"), width = number_at(shown, "window.width");
    cJSON_Delete(shown);
    ang_load_report report = {0};
    ang_volume *volume = ang_load(FOLDER "/phantom", &(ang_load_options){0}, &report, NULL, NULL);
    ang_image picture;
    assert_non_null(volume);
    assert_true(ang_picture_read(PICTURES "/angioscope-axial-0001.png", &picture, NULL));
    ang_mat4 to_index;
    assert_true(ang_mat4_inverse(&volume->affine, &to_index));
    double pixel = 95 * ang_volume_spacing(volume, 1) / picture.height;
    ang_vec3 middle_mm = ang_volume_centre(volume);
    /* The status line's value under the pointer. */
    int at_x, at_y;
    middle("axial", &at_x, &at_y);
    hands("mousemove %d %d", at_x + 37, at_y + 11);
    cJSON *rect = read_state();
    ang_vec3 pointed = {
        middle_mm.x + (at_x + 37 + 0.5 - number_at(rect, "panes.axial.0") - picture.width / 2.0) * pixel,
        middle_mm.y + (at_y + 11 + 0.5 - number_at(rect, "panes.axial.1") - picture.height / 2.0) * pixel, z};
    cJSON_Delete(rect);
    double under = ang_volume_hu(volume, ang_volume_sample(volume, ang_mat4_point(&to_index, pointed)));
    expect_number("hovered_hu", under, 0.01);
    int seen = 0;
    for (int y = 3; y < picture.height - 3; y += 11)
        for (int x = 3; x < picture.width - 3; x += 11) {
            ang_vec3 mm = {middle_mm.x + (x + 0.5 - picture.width / 2.0) * pixel,
                           middle_mm.y + (y + 0.5 - picture.height / 2.0) * pixel, z};
            ang_vec3 index = ang_mat4_point(&to_index, mm);
            double grey = 0;
            if (index.x >= 0 && index.x <= 95 && index.y >= 0 && index.y <= 95) {
                double hu = ang_volume_hu(volume, ang_volume_sample(volume, index));
                grey = fmin(fmax((hu - centre) / width + 0.5, 0), 1);
                seen += grey > 0.1;
            }
            assert_close((double)picture.rgba[4 * (y * picture.width + x)] * 255, grey * 255, 1);
        }
    assert_true(seen > 50);
    ang_image_clear(&picture);
    ang_volume_free(volume);
    ang_load_report_clear(&report);
}

static void the_volume_turns_with_the_hand(void **state) {
    (void)state;
    need_window();
    go_to("volume");
    cJSON *before = read_state();
    double degrees = 180 / number_at(before, "panes.volume.3"); /* a pixel; the pane's height is the lesser side */
    cJSON_Delete(before);
    drag(1, 40, 0);
    double azimuth = -40 * degrees;
    expect_number("azimuth_deg", azimuth, 1e-6);
    /* Down with Shift moves the preset to lower values. */
    hands("keydown shift");
    drag(1, 0, 30);
    hands("keyup shift");
    expect_number("shift_hu", -30 * (3071 + 1024) / 2000.0, 1e-6);
    expect_number("preset.points.1.hu", 140 - 30 * 4095 / 2000.0, 1e-6);
    hands("key alt+l");
    expect_text("render.view", "90,0,0");
    drag(3, 0, -45); /* zoom about where the drag began, the pane's middle */
    drag(2, 21, 10);
}

static void a_saved_volume_is_the_headless_picture(void **state) {
    (void)state;
    need_window();
    go_to("volume");
    hands("key ctrl+s");
    expect_text("saved", "angioscope-volume-0001.png");
    compare_with_headless("angioscope-volume-0001.png", FOLDER "/phantom");
    /* A surface in parallel projection, turned; then the greatest values, through the slices' window. */
    hands("key alt+a key o key 4");
    expect_text("preset.name", "ct-bone-iso");
    drag(1, -33, 21);
    hands("key ctrl+s");
    expect_text("saved", "angioscope-volume-0002.png");
    compare_with_headless("angioscope-volume-0002.png", FOLDER "/phantom");
    hands("key 7");
    expect_text("preset.name", "ct-mip");
    hands("key ctrl+s");
    expect_text("saved", "angioscope-volume-0003.png");
    compare_with_headless("angioscope-volume-0003.png", FOLDER "/phantom");
    hands("key o key 1");
    expect_text("preset.name", "cta-head");
}

/* A click on what shows: the crosshair comes to lie under it, in front of the middle of the head. */
static void a_click_on_the_volume_finds_its_surface(void **state) {
    (void)state;
    need_window();
    go_to("volume");
    hands("key r key alt+a key 9"); /* skin, from the front */
    expect_text("preset.name", "ct-skin");
    expect_text("render.view", "0,0,0");
    int x, y;
    middle("volume", &x, &y);
    x -= 23;
    y -= 10;
    hands("mousemove %d %d click 1", x, y);
    nap(300);
    expect_number("azimuth_deg", 0, 0);
    cJSON *now = read_state();
    ang_volume *volume = ang_load(FOLDER "/phantom", &(ang_load_options){0}, &(ang_load_report){0}, NULL, NULL);
    assert_non_null(volume);
    ang_view view = ang_view_default;
    view.zoom = atof(text_at(now, "render.zoom"));
    ang_camera camera = ang_camera_for(volume, &view);
    ang_vec3 mm = {number_at(now, "crosshair_mm.0"), number_at(now, "crosshair_mm.1"),
                   number_at(now, "crosshair_mm.2")};
    ang_vec3 from = ang_vec3_sub(mm, camera.eye);
    double height = number_at(now, "panes.volume.3"), width = number_at(now, "panes.volume.2");
    double pixels = height / 2 / tan(15 * M_PI / 180) / ang_vec3_dot(from, camera.forward); /* per mm at that depth */
    double at_x = number_at(now, "panes.volume.0") + width / 2 + ang_vec3_dot(from, camera.right) * pixels;
    double at_y = number_at(now, "panes.volume.1") + height / 2 - ang_vec3_dot(from, camera.up) * pixels;
    /* The crosshair goes to the nearest slices, at most half a voxel of 2.4 mm away. */
    assert_close(at_x, x + 0.5, 1.3 * pixels + 1);
    assert_close(at_y, y + 0.5, 1.3 * pixels + 1);
    assert_true(mm.y < -50); /* the forehead or the face, not the back of the head */
    cJSON_Delete(now);
    ang_volume_free(volume);
}

/* Where the editor draws a value and an opacity. */
static void editor_place(double hu, double opacity, int *x, int *y) {
    cJSON *state = read_state();
    double low = number_at(state, "editor.hu.0"), high = number_at(state, "editor.hu.1");
    double left = number_at(state, "editor.plot.0"), top = number_at(state, "editor.plot.1");
    double width = number_at(state, "editor.plot.2"), height = number_at(state, "editor.plot.3");
    cJSON_Delete(state);
    *x = (int)lround(left + (hu - low) / (high - low) * width);
    *y = (int)lround(top + (1 - sqrt(opacity)) * height); /* a square-root scale */
}

/* Points are chosen, dragged, typed, added, deleted; and all of it undone. */
static void a_transfer_function_is_edited(void **state) {
    (void)state;
    need_window();
    go_to("volume");
    hands("key 1"); /* cta-head, whatever was before */
    expect_text("preset.name", "cta-head");
    expect_number("preset.points.5.hu", 350, 0);
    cJSON *before = read_state();
    double per_pixel =
        (number_at(before, "editor.hu.1") - number_at(before, "editor.hu.0")) / number_at(before, "editor.plot.2");
    double height = number_at(before, "editor.plot.3");
    cJSON_Delete(before);
    int x, y;
    editor_place(350, 0.4, &x, &y);
    hands("mousemove %d %d", x, y);
    drag(1, 3, -30);
    expect_number("editor.point", 5, 0);
    expect_number("preset.points.5.hu", 350 + 3 * per_pixel, 1e-6);
    double tall = sqrt(0.4) + 30 / height;
    expect_number("preset.points.5.opacity", tall * tall, 1e-6);
    /* The fields below have the chosen point: its HU is the first. */
    cJSON *plot = read_state();
    int left = (int)number_at(plot, "editor.plot.0") + 30;
    int below = (int)(number_at(plot, "editor.plot.1") + number_at(plot, "editor.plot.3")) + 44;
    cJSON_Delete(plot);
    hands("mousemove %d %d click 1 key ctrl+a type 361.5", left, below);
    hands("key Return");
    expect_number("preset.points.5.hu", 361.5, 0);
    editor_place(0, 0.7, &x, &y); /* nothing is near: a new point */
    hands("mousemove %d %d click --repeat 2 --delay 60 1", x, y);
    expect_number("editor.point", 1, 0);
    expect_number("preset.points.1.hu", 0, 0.51 * per_pixel);
    expect_number("preset.points.1.opacity", 0.7, 0.01);
    hands("key Delete");
    expect_number("preset.points.1.hu", 140, 0);
    hands("key --delay 60 ctrl+z");
    expect_number("preset.points.1.opacity", 0.7, 0.01);
    hands("key ctrl+z key ctrl+z");
    expect_number("preset.points.5.hu", 350 + 3 * per_pixel, 1e-6);
    hands("key ctrl+z");
    expect_number("preset.points.5.hu", 350, 0);
    expect_number("preset.points.5.opacity", 0.4, 0);
}

static void panes_grow_and_shrink(void **state) {
    (void)state;
    need_window();
    go_to("coronal");
    hands("click --repeat 2 --delay 60 1");
    expect_text("maximised", "coronal");
    hands("key Escape");
    expect_text("maximised", "");
    go_to("volume");
    hands("click --repeat 2 --delay 60 1");
    expect_text("maximised", "volume");
    hands("click --repeat 2 --delay 60 1");
    expect_text("maximised", "");
}

static void at_rest_it_sleeps(void **state) {
    (void)state;
    need_window();
    hands("mousemove 5 600");
    expect_flag("at_rest", true);
    double before = processor_time();
    nap(2000);
    assert_true(processor_time() - before <= 0.02); /* two ticks: 1 % */
}

static void what_cannot_be_read_is_said_in_the_window(void **state) {
    (void)state;
    need_window();
    write_file(FOLDER "/nothing.dcm", "no picture");
    start_viewer(FOLDER "/nothing.dcm");
    expect_text("phase", "failed");
    hands("key ctrl+q");
    assert_int_equal(wait_for_end(), 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(it_opens_what_it_is_given),
        cmocka_unit_test(at_rest_it_sleeps), /* before there are messages that go away after a while */
        cmocka_unit_test(slices_scroll_and_window),
        cmocka_unit_test(a_click_links_the_panes),
        cmocka_unit_test(a_saved_slice_is_the_volumes),
        cmocka_unit_test(the_volume_turns_with_the_hand),
        cmocka_unit_test(a_saved_volume_is_the_headless_picture),
        cmocka_unit_test(a_click_on_the_volume_finds_its_surface),
        cmocka_unit_test(a_transfer_function_is_edited),
        cmocka_unit_test(panes_grow_and_shrink),
        cmocka_unit_test(it_ends_well),
        cmocka_unit_test(what_cannot_be_read_is_said_in_the_window),
    };
    return cmocka_run_group_tests(tests, open_phantom, close_display);
}
