/* The slice panes in a real window, of a series with a tilted gantry: planes turned by hand, what they then show, and
 * cine. */
#include "tests/core/fixtures.h"

#include "core/volume/phantom.h"
#include "io/dicom/write.h"
#include "io/load.h"

#define FOLDER ANG_TEST_TMP "/view_slices"
#include "tests/app/viewer_hands.h"

static const double tilt_deg = 17;
static const double rounding_deg = 0.02; /* the crosshair's place in the window is known to rounding only */
static const double snap_deg = 1;        /* within it planes go to the patient's axes */
/* Of the crosshair's lines, at scale 1: free at the pane's edges; share of the way out at which handles are. */
static const double edge = 26, handle_share = 0.8;

static bool write_tilted(void) {
    ang_phantom_params params = ang_phantom_params_default;
    memcpy(params.dims, (int[]){96, 96, 48}, sizeof params.dims);
    ang_volume *volume = ang_phantom_make(&params, 0, NULL, NULL, NULL);
    if (!volume) return false;
    volume->affine.m[1][2] = volume->affine.m[2][2] * tan(tilt_deg * M_PI / 180);
    bool done = ang_dicom_write(FOLDER "/tilted", volume, 5, NULL, NULL);
    ang_volume_free(volume);
    return done;
}

static int opening(void **state) {
    (void)state;
    if (open_display() != 0) return -1;
    if (skipped) return 0;
    if (!write_tilted()) return -1;
    start_viewer(FOLDER "/tilted --preset cta-head");
    return 0;
}

static ang_vec3 vector_at(cJSON *state, const char *name) {
    char path[64];
    double v[3];
    for (int i = 0; i < 3; i++) {
        snprintf(path, sizeof path, "%s.%d", name, i);
        v[i] = number_at(state, path);
    }
    return (ang_vec3){v[0], v[1], v[2]};
}

static void assert_vector(ang_vec3 actual, ang_vec3 expected, double tolerance) {
    assert_close(ang_vec3_length(ang_vec3_sub(actual, expected)), 0, tolerance);
}

static void expect_vector(const char *name, ang_vec3 expected, double tolerance) {
    char path[64];
    for (int i = 0; i < 3; i++) {
        snprintf(path, sizeof path, "%s.%d", name, i);
        expect_number(path, ang_vec3_at(expected, i), tolerance);
    }
}

/* Where the crosshair is in the axial pane, in pixels of the window, and how far to the right its handle is while the
 * planes lie along the patient. */
static void axial_handle(double *x, double *y, double *handle) {
    cJSON *state = read_state();
    ang_volume *volume = ang_load(FOLDER "/tilted", &(ang_load_options){0}, &(ang_load_report){0}, NULL, NULL);
    assert_non_null(volume);
    ang_vec3 from = ang_vec3_sub(vector_at(state, "crosshair_mm"), ang_volume_centre(volume));
    double mm = number_at(state, "axial.mm_per_pixel"), width = number_at(state, "panes.axial.2");
    double in_pane = width / 2 + (from.x - number_at(state, "axial.pan_mm.0")) / mm;
    *x = number_at(state, "panes.axial.0") + in_pane;
    *y = number_at(state, "panes.axial.1") + number_at(state, "panes.axial.3") / 2 +
         (from.y - number_at(state, "axial.pan_mm.1")) / mm;
    *handle = handle_share * (width - edge - in_pane);
    cJSON_Delete(state);
    ang_volume_free(volume);
}

/* Takes the handle on the right and leads it about the crosshair, by so many degrees and then so many more from where
 * it was; the angle in degrees that whole pixels make of the last one. `share` of the hand's way is the planes'. Leaves
 * the button down. */
static double lead(int count, const double *degrees, const char *with, double share) {
    double x, y, handle, turned = 0;
    axial_handle(&x, &y, &handle);
    int from_x = (int)lround(x + handle), from_y = (int)lround(y);
    hands("mousemove %d %d", from_x, from_y);
    expect_text("hovered", "axial");
    nap(600); /* no double click with what was pressed before, whose effect has been seen */
    hands("%s mousedown 1", with);
    for (int i = 0; i < count; i++) {
        int to_x = (int)lround(x + handle * cos(degrees[i] * M_PI / 180)),
            to_y = (int)lround(y + handle * sin(degrees[i] * M_PI / 180));
        hands("mousemove %d %d mousemove %d %d", from_x, (from_y + to_y) / 2, to_x, to_y);
        turned = (atan2(to_y - y, to_x - x) - atan2(from_y - y, from_x - x)) * 180 / M_PI;
        expect_number("coronal.lean_deg", fabs(turned) < snap_deg ? 0 : turned * share, rounding_deg);
    }
    return turned;
}

static void it_opens(void **state) {
    (void)state;
    need_window();
    expect_text("phase", "ready");
    expect_number("axial.lean_deg", 0, 0);
    expect_number("sagittal.slices", 96, 0);
}

static void a_handle_turns_the_other_planes(void **state) {
    (void)state;
    need_window();
    double turned = lead(1, (double[]){30}, "", 1);
    hands("mouseup 1");
    expect_number("coronal.lean_deg", turned, rounding_deg);
    expect_number("sagittal.lean_deg", turned, rounding_deg);
    expect_number("axial.lean_deg", 0, 0);
    expect_number("axial.turned_deg", turned, rounding_deg);
    double c = cos(turned * M_PI / 180), s = sin(turned * M_PI / 180);
    expect_vector("coronal.right", (ang_vec3){c, s, 0}, 1e-3);
    expect_vector("coronal.down", (ang_vec3){0, 0, -1}, 1e-9);
    expect_vector("sagittal.right", (ang_vec3){-s, c, 0}, 1e-3);
    expect_vector("axial.right", (ang_vec3){1, 0, 0}, 0);
}

/* Greys of the saved oblique slice against interpolation of the volume at the turned places. */
static void a_saved_oblique_slice_is_the_volumes(void **state) {
    (void)state;
    need_window();
    go_to("coronal");
    hands("key ctrl+s");
    expect_text("saved", "angioscope-coronal-0001.png");
    cJSON *shown = read_state();
    double turned = number_at(shown, "axial.turned_deg") * M_PI / 180;
    ang_vec3 right = {cos(turned), sin(turned), 0}, down = {0, 0, -1}, inward = {-sin(turned), cos(turned), 0};
    ang_vec3 crosshair = vector_at(shown, "crosshair_mm");
    double centre = number_at(shown, "window.centre"), width = number_at(shown, "window.width");
    double pan_x = number_at(shown, "coronal.pan_mm.0"), pan_y = number_at(shown, "coronal.pan_mm.1");
    double mm = number_at(shown, "coronal.mm_per_pixel");
    cJSON_Delete(shown);
    ang_volume *volume = ang_load(FOLDER "/tilted", &(ang_load_options){0}, &(ang_load_report){0}, NULL, NULL);
    ang_image picture;
    ang_mat4 to_index;
    assert_non_null(volume);
    assert_true(fabs(volume->affine.m[1][2]) > 0.1); /* the tilt has come through */
    assert_true(ang_picture_read(PICTURES "/angioscope-coronal-0001.png", &picture, NULL));
    assert_true(ang_mat4_inverse(&volume->affine, &to_index));
    ang_vec3 middle_mm = ang_volume_centre(volume);
    middle_mm = ang_vec3_along(middle_mm, inward, ang_vec3_dot(ang_vec3_sub(crosshair, middle_mm), inward));
    int seen = 0;
    for (int y = 2; y < picture.height - 2; y += 5)
        for (int x = 2; x < picture.width - 2; x += 7) {
            ang_vec3 at = ang_vec3_along(middle_mm, right, pan_x + (x + 0.5 - picture.width / 2.0) * mm);
            at = ang_vec3_along(at, down, pan_y + (y + 0.5 - picture.height / 2.0) * mm);
            ang_vec3 index = ang_mat4_point(&to_index, at);
            double grey = 0;
            bool inside = true, face = false;
            for (int axis = 0; axis < 3; axis++) {
                double i = ang_vec3_at(index, axis), last = volume->dims[axis] - 1;
                inside = inside && i >= 0 && i <= last;
                face = face || fabs(i) < 1e-3 || fabs(i - last) < 1e-3; /* rounding decides */
            }
            if (face) continue;
            if (inside) {
                double hu = ang_volume_hu(volume, ang_volume_sample(volume, index));
                grey = fmin(fmax((hu - centre) / width + 0.5, 0), 1);
                seen += grey > 0.1;
            }
            assert_close((double)picture.rgba[4 * (y * picture.width + x)] * 255, grey * 255, 1);
        }
    assert_true(seen > 100);
    ang_image_clear(&picture);
    ang_volume_free(volume);
}

static void oblique_slices_scroll_along_their_normal(void **state) {
    (void)state;
    need_window();
    go_to("coronal");
    cJSON *before = read_state();
    ang_vec3 from = vector_at(before, "crosshair_mm");
    ang_vec3 inward = ang_vec3_cross(vector_at(before, "coronal.right"), vector_at(before, "coronal.down"));
    double slice = number_at(before, "coronal.slice");
    cJSON_Delete(before);
    hands("click --repeat 4 --delay 10 4");
    expect_number("coronal.slice", slice + 4, 0);
    cJSON *after = read_state();
    ang_vec3 gone = ang_vec3_sub(vector_at(after, "crosshair_mm"), from);
    cJSON_Delete(after);
    /* Voxels of 2.4 mm: 2.4 / cos(30) from slice to slice across, less where the tilt is steeper. */
    double distance = ang_vec3_dot(gone, inward);
    assert_true(distance > 4 * 1.5 && distance < 4 * 2.8);
    assert_vector(gone, ang_vec3_scale(inward, distance), 1e-6);
    hands("click --repeat 4 --delay 10 5");
    expect_number("coronal.slice", slice, 0);
    expect_vector("crosshair_mm", from, 1e-6);
}

/* A click in an oblique pane: the crosshair is exactly there, and the pane's plane stays. */
static void a_click_in_an_oblique_pane_keeps_its_plane(void **state) {
    (void)state;
    need_window();
    int x, y;
    middle("coronal", &x, &y);
    cJSON *before = read_state();
    ang_vec3 from = vector_at(before, "crosshair_mm"), right = vector_at(before, "coronal.right");
    ang_vec3 inward = ang_vec3_cross(right, vector_at(before, "coronal.down"));
    cJSON_Delete(before);
    hands("mousemove %d %d click 1", x + 31, y - 13);
    double across = expect_other("crosshair_mm.0", from.x, 1);
    hands("mousemove %d %d click 1", x + 41, y - 13);
    expect_other("crosshair_mm.0", across, 1);
    cJSON *after = read_state();
    ang_vec3 gone = ang_vec3_sub(vector_at(after, "crosshair_mm"), from);
    cJSON_Delete(after);
    assert_close(ang_vec3_dot(gone, inward), 0, 1e-6);
    assert_true(ang_vec3_dot(gone, right) > 5);
}

static void turns_are_undone_and_cancelled(void **state) {
    (void)state;
    need_window();
    cJSON *before = read_state();
    double turned = number_at(before, "axial.turned_deg"), across = number_at(before, "crosshair_mm.0");
    cJSON_Delete(before);
    hands("key ctrl+z"); /* the clicks and turns of the wheel since are one step */
    expect_other("crosshair_mm.0", across, 5);
    expect_number("coronal.lean_deg", turned, 1e-9);
    hands("key ctrl+z");
    expect_number("coronal.lean_deg", 0, 0);
    hands("key ctrl+shift+z");
    expect_number("coronal.lean_deg", turned, 1e-9);
    hands("key ctrl+shift+z");
    expect_number("crosshair_mm.0", across, 0);
    hands("key ctrl+r");
    expect_number("coronal.lean_deg", 0, 0);
    expect_number("sagittal.lean_deg", 0, 0);
    /* Slices pass through voxels again. */
    cJSON *straight = read_state();
    double slices = (number_at(straight, "crosshair_mm.0") - 1.2) / 2.4;
    assert_close(slices, round(slices), 1e-6);
    cJSON_Delete(straight);
    lead(1, (double[]){20}, "", 1);
    hands("key Escape mouseup 1");
    expect_number("coronal.lean_deg", 0, 0);
    /* Ten times finer; without Shift it snaps where less than a degree is left. */
    turned = lead(1, (double[]){25}, "keydown shift", 0.1);
    hands("mouseup 1 keyup shift");
    expect_number("coronal.lean_deg", turned / 10, rounding_deg);
    hands("key ctrl+z");
    expect_number("coronal.lean_deg", 0, 0);
    turned = lead(2, (double[]){20, 0.6}, "", 1);
    assert_true(fabs(turned) > 0.1 && fabs(turned) < snap_deg);
    hands("mouseup 1");
    expect_number("coronal.lean_deg", 0, 0);
    /* The same by keys, about the sagittal slice's normal. */
    go_to("sagittal");
    hands("key --repeat 5 --delay 20 alt+Right");
    expect_number("axial.lean_deg", 5, 1e-9);
    expect_number("sagittal.lean_deg", 0, 0);
}

/* A click on the volume while planes are oblique: the crosshair is at the surface exactly, no slice nearby. */
static void the_volume_places_an_oblique_crosshair(void **state) {
    (void)state;
    need_window();
    go_to("volume");
    hands("key 9"); /* skin */
    expect_text("preset.name", "ct-skin");
    cJSON *before = read_state();
    ang_vec3 from = vector_at(before, "crosshair_mm");
    cJSON_Delete(before);
    int x, y;
    middle("volume", &x, &y);
    hands("mousemove %d %d click 1", x, y);
    assert_true(from.y - expect_other("crosshair_mm.1", from.y, 1) > 20); /* from within to the face */
    expect_number("axial.lean_deg", 5, 1e-9);
    hands("key 1 key alt+a");
    go_to("axial");
    hands("key ctrl+r");
    expect_number("axial.lean_deg", 0, 0);
}

static void cine_goes_on_until_it_is_stopped(void **state) {
    (void)state;
    need_window();
    go_to("axial");
    cJSON *before = read_state();
    double slice = number_at(before, "axial.slice"), coronal = number_at(before, "coronal.slice");
    cJSON_Delete(before);
    hands("key v");
    expect_text("cine.pane", "axial");
    for (int i = 0; i < 3; i++) slice = expect_other("axial.slice", slice, 0);
    hands("key alt+Up");
    expect_number("cine.per_second", 20, 0);
    hands("key alt+Down key shift+v");
    expect_number("cine.per_second", 15, 0);
    hands("key Escape");
    expect_text("cine.pane", "");
    expect_number("coronal.slice", coronal, 0);
    slice = number_now("axial.slice");
    expect_no_frames();
    expect_number("axial.slice", slice, 0);
    hands("key v");
    expect_text("cine.pane", "axial");
    hands("click 4");
    expect_text("cine.pane", "");
}

/* The volume turns; all of it is one step of undo. */
static void the_volume_turns_by_itself(void **state) {
    (void)state;
    need_window();
    go_to("volume");
    expect_number("azimuth_deg", 0, 0);
    hands("key v");
    double azimuth = expect_other("azimuth_deg", 0, 0);
    expect_other("azimuth_deg", azimuth, 0);
    hands("key v");
    expect_text("cine.pane", "");
    hands("key ctrl+z");
    expect_number("azimuth_deg", 0, 0);
}

/* The scroll tool: a drag up goes on, to where it began by Esc. */
static void a_drag_scrolls(void **state) {
    (void)state;
    need_window();
    go_to("axial");
    hands("key Home key s"); /* in the middle */
    expect_text("tool", "scroll");
    cJSON *before = read_state();
    double slice = number_at(before, "axial.slice");
    double pixels = fmin(number_at(before, "panes.axial.3") / number_at(before, "axial.slices"), 8);
    cJSON_Delete(before);
    drag(1, 3, -40);
    expect_number("axial.slice", slice + round(40 / pixels), 0);
    hands("mousedown 1 mousemove_relative 0 50 mousemove_relative 0 9");
    expect_number("axial.slice", slice + round(40 / pixels) - round(59 / pixels), 0);
    hands("key Escape mouseup 1");
    expect_number("axial.slice", slice + round(40 / pixels), 0);
    hands("key w");
    expect_text("tool", "window");
}

/* Stored values are whole HU; what lies between voxels is not. */
static void voxels_are_shown_as_they_are(void **state) {
    (void)state;
    need_window();
    int x, y;
    middle("sagittal", &x, &y);
    hands("mousemove %d %d", x + 17, y - 5);
    expect_text("hovered", "sagittal");
    double between = number_now("hovered_hu");
    hands("key i");
    double hu = expect_other("hovered_hu", between, 0);
    assert_close(hu, round(hu), 1e-3);
    hands("key i");
    expect_number("hovered_hu", between, 1e-3);
}

/* A slab is coarse while it moves; what is saved then, and what stands at rest, is not. */
static void a_thick_slab_is_saved_as_it_is_at_rest(void **state) {
    (void)state;
    need_window();
    go_to("coronal");
    double slice = number_now("coronal.slice");
    hands("key --repeat 6 --delay 20 bracketright");
    expect_number("slab.mm", 80, 0);
    hands("click 5 key ctrl+s");
    expect_text("saved", "angioscope-coronal-0002.png");
    expect_flag("at_rest", true);
    expect_other("coronal.slice", slice, 0.5);
    hands("key ctrl+s");
    expect_text("saved", "angioscope-coronal-0003.png");
    assert_close(difference(PICTURES "/angioscope-coronal-0002.png", PICTURES "/angioscope-coronal-0003.png"), 0, 0);
    hands("click 4 key --repeat 6 --delay 20 bracketleft");
    expect_number("slab.mm", 0, 0);
    expect_number("coronal.slice", slice, 0);
}

/* A state brings planes and crosshair back as they were. */
static void states_keep_oblique_planes(void **state) {
    (void)state;
    need_window();
    go_to("sagittal");
    hands("key --repeat 7 --delay 20 alt+Left");
    expect_number("axial.lean_deg", 7, 1e-9);
    int x, y;
    double height = number_now("crosshair_mm.2");
    middle("sagittal", &x, &y);
    hands("mousemove %d %d click 1", x + 13, y + 5);
    expect_other("crosshair_mm.2", height, 0.1);
    hands("key ctrl+alt+s");
    expect_text("saved", "angioscope-state-0001.json");
    cJSON *before = read_state();
    ang_vec3 place = vector_at(before, "crosshair_mm"), right = vector_at(before, "coronal.right");
    double slice = number_at(before, "axial.slice"), pan = number_at(before, "axial.pan_mm.1");
    cJSON_Delete(before);
    hands("key ctrl+q");
    assert_int_equal(wait_for_end(), 0);
    start_viewer("--state " PICTURES "/angioscope-state-0001.json");
    expect_text("phase", "ready");
    expect_number("axial.lean_deg", 7, 1e-9);
    expect_vector("crosshair_mm", place, 1e-9);
    expect_vector("coronal.right", right, 1e-12);
    expect_number("axial.slice", slice, 0);
    expect_number("axial.pan_mm.1", pan, 1e-9);
    hands("key Home key ctrl+r");
    expect_number("axial.lean_deg", 0, 0);
}

/* The brightest channel where the patient's name would stand in the axial pane: the second line of its left corner,
 * beside the head. */
static double brightest_of_name(const char *picture) {
    ang_image image;
    assert_true(ang_picture_read(picture, &image, NULL));
    cJSON *state = read_state();
    int left = (int)number_at(state, "panes.axial.0") + 8, top = (int)number_at(state, "panes.axial.1") + 25;
    cJSON_Delete(state);
    double most = 0;
    for (int y = top; y < top + 12; y++)
        for (int x = left; x < left + 100; x++) most = fmax(most, (double)image.rgba[4 * (y * image.width + x)]);
    ang_image_clear(&image);
    return most;
}

/* Names are on the screen until F4; in a saved window only with --keep-phi. */
static void names_are_left_out_of_saved_windows(void **state) {
    (void)state;
    need_window();
    hands("key ctrl+shift+s");
    expect_text("saved", "angioscope-window-0001.png");
    hands("key F4 key ctrl+shift+s");
    expect_text("saved", "angioscope-window-0002.png");
    assert_close(brightest_of_name(PICTURES "/angioscope-window-0001.png"), 0, 0.02);
    hands("key ctrl+q");
    assert_int_equal(wait_for_end(), 0);
    start_viewer(FOLDER "/tilted --preset cta-head --keep-phi");
    expect_text("phase", "ready");
    expect_number("axial.slice", 25, 0);
    hands("key ctrl+shift+s");
    expect_text("saved", "angioscope-window-0003.png");
    assert_true(brightest_of_name(PICTURES "/angioscope-window-0003.png") > 0.5);
    hands("key F4 key ctrl+shift+s");
    expect_text("saved", "angioscope-window-0004.png");
    assert_close(brightest_of_name(PICTURES "/angioscope-window-0004.png"), 0, 0.02);
}

/* What lies under the crosshair stays, where that snaps to slices far apart too. */
static void planes_along_the_patient_leave_long_voxels_in_the_middle(void **state) {
    (void)state;
    need_window();
    hands("key ctrl+q");
    assert_int_equal(wait_for_end(), 0);
    int16_t values[16 * 16 * 8];
    for (int i = 0; i < 16 * 16 * 8; i++) values[i] = (int16_t)(i % 251);
    FILE *file = fopen(FOLDER "/long.raw", "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(values, sizeof values, 1, file), 1);
    fclose(file);
    start_viewer(FOLDER "/long.raw --raw-dims 16x16x8 --raw-type i16 --raw-spacing 0.1,100,1");
    expect_text("phase", "ready");
    go_to("axial");
    double across = number_now("crosshair_mm.1");
    hands("key --repeat 5 --delay 20 alt+Right");
    expect_number("coronal.lean_deg", 5, 1e-9);
    int x, y;
    middle("axial", &x, &y);
    hands("mousemove %d %d click 1", x, y + 2);
    expect_other("crosshair_mm.1", across, 1);
    hands("key ctrl+r");
    expect_number("coronal.lean_deg", 0, 0);
    expect_number("crosshair_mm.1", across, 1e-6);
    expect_number("coronal.pan_mm.0", 0, 0.1); /* of 1.5 mm */
    expect_number("sagittal.pan_mm.0", 0, 0.1);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(it_opens),
        cmocka_unit_test(a_handle_turns_the_other_planes),
        cmocka_unit_test(a_saved_oblique_slice_is_the_volumes),
        cmocka_unit_test(oblique_slices_scroll_along_their_normal),
        cmocka_unit_test(a_click_in_an_oblique_pane_keeps_its_plane),
        cmocka_unit_test(turns_are_undone_and_cancelled),
        cmocka_unit_test(the_volume_places_an_oblique_crosshair),
        cmocka_unit_test(cine_goes_on_until_it_is_stopped),
        cmocka_unit_test(the_volume_turns_by_itself),
        cmocka_unit_test(a_drag_scrolls),
        cmocka_unit_test(voxels_are_shown_as_they_are),
        cmocka_unit_test(a_thick_slab_is_saved_as_it_is_at_rest),
        cmocka_unit_test(states_keep_oblique_planes),
        cmocka_unit_test(names_are_left_out_of_saved_windows),
        cmocka_unit_test(planes_along_the_patient_leave_long_voxels_in_the_middle),
        cmocka_unit_test(it_ends_well),
    };
    return cmocka_run_group_tests(tests, opening, close_display);
}
