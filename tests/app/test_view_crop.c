/* Crop box and clip plane in a real window: dragged in the volume and in slices, undone, and the saved picture beside
 * the headless one. */
#include "tests/core/fixtures.h"

#define FOLDER ANG_TEST_TMP "/view-crop"
#include "tests/app/viewer_hands.h"

#include "core/scene/scene.h"
#include "io/load.h"

#define PHANTOM FOLDER "/phantom"
enum { NX = 96, NY = 96, NZ = 48 };

static ang_volume *volume;

static int opening(void **state) {
    if (open_phantom(state) != 0) return -1;
    if (!skipped) volume = ang_load(PHANTOM, &(ang_load_options){0}, &(ang_load_report){0}, NULL, NULL);
    return skipped || volume ? 0 : -1;
}

static int closing(void **state) {
    ang_volume_free(volume);
    return close_display(state);
}

/* The value of an option in the state's list for `render`. */
static void option_now(const char *option, char *value, size_t size) {
    char path[64];
    cJSON *state = read_state();
    snprintf(path, sizeof path, "render.%s", option);
    snprintf(value, size, "%s", text_at(state, path));
    cJSON_Delete(state);
}

static void expect_option(const char *option, const char *expected) {
    char value[256] = "";
    for (int i = 0; i < 200; i++) {
        option_now(option, value, sizeof value);
        if (strcmp(value, expected) == 0) return;
        nap(50);
    }
    fail_msg("%s is '%s', not '%s'", option, value, expected);
}

static ang_camera camera_now(void) {
    char text[256];
    ang_view view = ang_view_default;
    option_now("view", text, sizeof text);
    assert_true(ang_view_parse(text, &view, NULL));
    option_now("pan", text, sizeof text);
    assert_int_equal(sscanf(text, "%lf,%lf", &view.pan_mm[0], &view.pan_mm[1]), 2);
    option_now("zoom", text, sizeof text);
    view.zoom = atof(text);
    option_now("projection", text, sizeof text);
    view.projection = (ang_projection)ang_projection_from_name(text);
    return ang_camera_for(volume, &view);
}

/* Where the window shows a place (LPS mm). */
static void place_of(ang_vec3 mm, double *x, double *y) {
    ang_camera camera = camera_now();
    ang_vec3 from = ang_vec3_sub(mm, camera.eye);
    double width = number_now("panes.volume.2"), height = number_now("panes.volume.3");
    double half = camera.projection == ANG_PARALLEL ? camera.half_height
                                                    : tan(15 * M_PI / 180) * ang_vec3_dot(from, camera.forward);
    *x = number_now("panes.volume.0") + width / 2 + ang_vec3_dot(from, camera.right) * height / 2 / half;
    *y = number_now("panes.volume.1") + height / 2 - ang_vec3_dot(from, camera.up) * height / 2 / half;
}

static ang_vec3 index_mm(double x, double y, double z) { return ang_mat4_point(&volume->affine, (ang_vec3){x, y, z}); }

static void it_opens_whole(void **state) {
    (void)state;
    need_window();
    expect_text("phase", "ready");
    expect_number("crop.upper.0", NX - 1, 0);
    expect_number("crop.upper.2", NZ - 1, 0);
    expect_option("clip", "");
}

/* The head's end is dragged down to where its handle would be at slice `wanted`. */
static void drag_head_end(double wanted) {
    double x0, y0, x1, y1, upper = number_now("crop.upper.2");
    place_of(index_mm((NX - 1) / 2.0, (NY - 1) / 2.0, upper), &x0, &y0);
    place_of(index_mm((NX - 1) / 2.0, (NY - 1) / 2.0, wanted), &x1, &y1);
    double pixels = hypot(x1 - x0, y1 - y0) / fabs(upper - wanted);
    drag_between(x0, y0, x1, y1);
    expect_number("crop.upper.2", wanted, 1 / pixels); /* a pixel: both ends are rounded */
}

static void a_handle_in_the_volume_takes_its_face_along(void **state) {
    (void)state;
    need_window();
    go_to("volume");
    hands("key alt+a");
    expect_number("azimuth_deg", 0, 0);
    drag(1, 60, 45); /* turns: the tool is still "window" */
    hands("key x");
    expect_text("tool", "crop");
    double degrees = 180 / number_now("panes.volume.3");
    ang_view turned = ang_view_default;
    ang_view_turn(&turned, 60 * degrees, 45 * degrees);
    expect_number("elevation_deg", turned.elevation_deg, 2);
    drag_head_end(30); /* in perspective */
    expect_number("crop.lower.2", 0, 0);
    expect_number("crop.upper.0", NX - 1, 0);
    char clip[256];
    option_now("clip", clip, sizeof clip);
    double mm[6];
    assert_int_equal(sscanf(clip, "%lf,%lf,%lf,%lf,%lf,%lf", &mm[0], &mm[1], &mm[2], &mm[3], &mm[4], &mm[5]), 6);
    assert_close(mm[5], number_now("crop.upper.2") * ang_volume_spacing(volume, 2), 1e-9);
    assert_close(mm[1], (NX - 1) * ang_volume_spacing(volume, 0), 1e-9);
    hands("key o");
    expect_option("projection", "parallel");
    drag_head_end(38); /* in parallel projection */
    hands("key ctrl+z");
    expect_number("crop.upper.2", 30, 0.5);
    hands("key ctrl+z key ctrl+z"); /* the projection, the first drag */
    expect_number("crop.upper.2", NZ - 1, 0);
    hands("key ctrl+shift+z");
    expect_number("crop.upper.2", 30, 0.5);
}

/* The least x, the patient's right, is on the left of the axial slice, which fills the pane's height. */
static void an_edge_in_a_slice_goes_with_the_pointer(void **state) {
    (void)state;
    need_window();
    int x, y;
    middle("axial", &x, &y);
    double step = number_now("panes.axial.3") / (NY - 1); /* pixels a voxel: they are square in mm */
    assert_close(ang_volume_spacing(volume, 0), ang_volume_spacing(volume, 1), 1e-9);
    double left = x - (NX - 1) / 2.0 * step;
    hands("mousemove %ld %d", lround(left), y + 31);
    drag(1, 40, 7);
    expect_number("crop.lower.0", 40 / step, 1e-6);
    /* Ten times finer with Shift. */
    hands("mousemove %ld %d keydown shift", lround(left + 40), y + 31);
    drag(1, 20, 0);
    hands("keyup shift");
    expect_number("crop.lower.0", 42 / step, 1e-6);
    /* A corner takes both: the right one in front. */
    double right = x + (NX - 1) / 2.0 * step, front = number_now("panes.axial.1") + 1;
    hands("mousemove %ld %ld", lround(right), lround(front));
    drag(1, -30, 50);
    expect_number("crop.upper.0", NX - 1 - 30 / step, 1e-6);
    expect_number("crop.lower.1", 50 / step, 1e-6);
    /* No further than a voxel before the other side. */
    hands("mousemove %ld %d", lround(left + 42), y + 31);
    drag(1, 900, 0);
    expect_number("crop.lower.0", NX - 2 - 30 / step, 1e-6);
    hands("key ctrl+z");
    expect_number("crop.lower.0", 42 / step, 1e-6);
}

static void escape_takes_a_drag_back(void **state) {
    (void)state;
    need_window();
    double before = number_now("crop.upper.2"), x, y;
    double lower = number_now("crop.lower.0"), upper = number_now("crop.upper.0");
    place_of(index_mm((lower + upper) / 2, (number_now("crop.lower.1") + NY - 1) / 2, before), &x, &y);
    hands("mousemove %ld %ld mousedown 1 mousemove_relative 0 20", lround(x), lround(y));
    expect_other("crop.upper.2", before, 0.99);
    hands("key Escape");
    expect_number("crop.upper.2", before, 0);
    hands("mousemove_relative 0 20 mouseup 1");
    expect_number("crop.upper.2", before, 0);
}

static void a_cropped_picture_is_the_headless_one(void **state) {
    (void)state;
    need_window();
    go_to("volume");
    hands("key ctrl+s");
    expect_text("saved", "angioscope-volume-0001.png");
    compare_with_headless("angioscope-volume-0001.png", PHANTOM);
    /* Switched off the box is kept. */
    double upper = number_now("crop.upper.2");
    hands("key alt+x");
    expect_option("clip", "");
    expect_number("crop.upper.2", upper, 0);
    hands("key ctrl+s");
    expect_text("saved", "angioscope-volume-0002.png");
    compare_with_headless("angioscope-volume-0002.png", PHANTOM);
    assert_true(difference(PICTURES "/angioscope-volume-0001.png", PICTURES "/angioscope-volume-0002.png") > 50);
    hands("key alt+x");
    expect_number("crop.upper.2", upper, 0);
}

static void a_plane_cuts_what_is_before_the_crosshair(void **state) {
    (void)state;
    need_window();
    go_to("volume");
    hands("key o key ctrl+x key Home key k");
    expect_option("projection", "parallel");
    expect_number("crop.upper.2", NZ - 1, 0);
    ang_camera camera = camera_now();
    ang_vec3 normal = ang_vec3_scale(camera.forward, -1);
    expect_number("clip_plane.normal.0", normal.x, 1e-9);
    expect_number("clip_plane.normal.1", normal.y, 1e-9);
    expect_number("clip_plane.normal.2", normal.z, 1e-9);
    ang_vec3 crosshair = {number_now("crosshair_mm.0"), number_now("crosshair_mm.1"), number_now("crosshair_mm.2")};
    double offset = ang_vec3_dot(normal, crosshair);
    expect_number("clip_plane.offset_mm", offset, 1e-9);
    hands("key ctrl+s");
    expect_text("saved", "angioscope-volume-0003.png");
    compare_with_headless("angioscope-volume-0003.png", PHANTOM);
    assert_true(difference(PICTURES "/angioscope-volume-0003.png", PICTURES "/angioscope-volume-0002.png") > 50);

    /* The ring, 52 pixels about the foot, pushes it: seen from straight before up is away. */
    double x, y;
    place_of(crosshair, &x, &y);
    double mm = camera.half_height * 2 / number_now("panes.volume.3");
    assert_int_equal(camera.projection, ANG_PARALLEL);
    hands("mousemove %ld %ld", lround(x) + 52, lround(y));
    drag(1, 0, -25);
    expect_number("clip_plane.offset_mm", offset - 25 * mm, 1e-6);
    hands("key ctrl+z");
    expect_number("clip_plane.offset_mm", offset, 1e-9);

    /* The arrow's tip, 84 pixels long: 42 to the right turn it by 30 degrees about the foot. */
    hands("mousemove %ld %ld", lround(x), lround(y));
    drag(1, 42, 0);
    ang_vec3 turned = ang_vec3_along(ang_vec3_scale(camera.right, 0.5), camera.forward, -cos(M_PI / 6));
    expect_number("clip_plane.normal.0", turned.x, 1e-6);
    expect_number("clip_plane.normal.1", turned.y, 1e-6);
    expect_number("clip_plane.normal.2", turned.z, 1e-6);
    expect_number("clip_plane.offset_mm", ang_vec3_dot(turned, crosshair), 1e-6);
    hands("key ctrl+s");
    expect_text("saved", "angioscope-volume-0004.png");
    compare_with_headless("angioscope-volume-0004.png", PHANTOM);
    /* A click finds what shows first, not what was cut away before it. */
    hands("mousemove %ld %ld click 1", lround(x) - 60, lround(y) - 40);
    expect_other("crosshair_mm.0", crosshair.x, 0);
    ang_vec3 found = {number_now("crosshair_mm.0"), number_now("crosshair_mm.1"), number_now("crosshair_mm.2")};
    assert_true(ang_vec3_length(ang_vec3_sub(found, crosshair)) > 5);
    double voxel = ang_volume_spacing(volume, 0); /* the crosshair goes to the nearest slices */
    assert_true(ang_vec3_dot(turned, found) < ang_vec3_dot(turned, crosshair) + voxel);
    hands("key shift+k");
    expect_number("clip_plane.normal.1", -turned.y, 1e-6);
    hands("key alt+k");
    expect_number("clip_plane.normal.1", 0, 0);
    hands("key ctrl+z key ctrl+z");
    expect_number("clip_plane.normal.1", turned.y, 1e-6);
    hands("key ctrl+z"); /* the click */
    expect_number("crosshair_mm.0", crosshair.x, 0);
    expect_number("clip_plane.normal.1", turned.y, 1e-6);
    hands("key ctrl+z");
    expect_number("clip_plane.normal.1", normal.y, 1e-12);
}

/* The plane's line in a slice goes with the pointer. */
static void the_planes_line_is_dragged_in_a_slice(void **state) {
    (void)state;
    need_window();
    go_to("volume");
    hands("key alt+l key k"); /* from the patient's left: across x, through the middle */
    expect_number("clip_plane.normal.0", 1, 1e-12);
    double offset = number_now("clip_plane.offset_mm");
    int x, y;
    middle("axial", &x, &y);
    double mm = (NY - 1) * ang_volume_spacing(volume, 1) / number_now("panes.axial.3");
    double line = x + (offset - ang_volume_centre(volume).x) / mm;
    hands("mousemove %ld %d", lround(line), y + 60);
    drag(1, 33, -9);
    expect_number("clip_plane.offset_mm", offset + 33 * mm, 1e-6);
    hands("key ctrl+z");
    expect_number("clip_plane.offset_mm", offset, 0);
}

/* Ctrl and Shift: up makes all of it more opaque. */
static void a_drag_strengthens_opacity(void **state) {
    (void)state;
    need_window();
    int x, y;
    middle("volume", &x, &y);
    double before = number_now("preset.points.5.opacity");
    hands("key w mousemove %d %d keydown ctrl keydown shift", x, y);
    drag(1, 0, -30);
    hands("keyup shift keyup ctrl");
    expect_number("preset.points.5.opacity", 1 - pow(1 - before, exp(30 / 150.0)), 1e-9);
    hands("key ctrl+z");
    expect_number("preset.points.5.opacity", before, 0);
}

/* Another window goes on with the box, its being off, and the plane. */
static void a_session_has_box_and_plane(void **state) {
    (void)state;
    need_window();
    double before[10], after[10];
    static const char *const paths[10] = {
        "crop.lower.0", "crop.lower.1",        "crop.lower.2",        "crop.upper.0",        "crop.upper.1",
        "crop.upper.2", "clip_plane.normal.0", "clip_plane.normal.1", "clip_plane.normal.2", "clip_plane.offset_mm"};
    hands("key x");
    expect_text("tool", "crop");
    drag_head_end(31.7);
    go_to("volume");
    hands("key k key ctrl+s");
    expect_text("saved", "angioscope-volume-0005.png");
    for (int off = 0; off < 2; off++) {
        if (off) hands("key alt+x");
        if (off) expect_option("clip", "");
        for (int i = 0; i < 10; i++) before[i] = number_now(paths[i]);
        hands("key ctrl+alt+s");
        expect_text("saved", off ? "angioscope-state-0002.json" : "angioscope-state-0001.json");
        hands("key ctrl+q");
        assert_int_equal(wait_for_end(), 0);
        start_viewer(off ? "--state " PICTURES "/angioscope-state-0002.json"
                         : "--state " PICTURES "/angioscope-state-0001.json");
        expect_text("phase", "ready");
        for (int i = 0; i < 10; i++) after[i] = number_now(paths[i]);
        for (int i = 0; i < 10; i++) assert_close(after[i], before[i], i < 6 ? 0 : 1e-12);
        go_to("axial"); /* where the pointer lies already it would not move */
        go_to("volume");
        hands("key ctrl+s");
        expect_text("saved", off ? "angioscope-volume-0007.png" : "angioscope-volume-0006.png");
    }
    assert_true(difference(PICTURES "/angioscope-volume-0006.png", PICTURES "/angioscope-volume-0005.png") <= 0);
    assert_true(difference(PICTURES "/angioscope-volume-0007.png", PICTURES "/angioscope-volume-0005.png") > 50);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(it_opens_whole),
        cmocka_unit_test(a_handle_in_the_volume_takes_its_face_along),
        cmocka_unit_test(an_edge_in_a_slice_goes_with_the_pointer),
        cmocka_unit_test(escape_takes_a_drag_back),
        cmocka_unit_test(a_cropped_picture_is_the_headless_one),
        cmocka_unit_test(a_plane_cuts_what_is_before_the_crosshair),
        cmocka_unit_test(the_planes_line_is_dragged_in_a_slice),
        cmocka_unit_test(a_drag_strengthens_opacity),
        cmocka_unit_test(a_session_has_box_and_plane),
        cmocka_unit_test(it_ends_well),
    };
    return cmocka_run_group_tests(tests, opening, closing);
}
