/* The viewer in a real window: a display without a screen (Xvfb), hands by xdotool, eyes by the state that the program
 * writes and by the pictures that it saves. */
#include "tests/core/fixtures.h"

#include "io/image/image_io.h"
#include "io/json.h"
#include "io/load.h"
#include "io/preset.h"
#include "tests/app/program.h"

#include <cjson/cJSON.h>
#include <fcntl.h>
#include <signal.h>
#include <string.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

#define FOLDER ANG_TEST_TMP "/view"
#define STATE  FOLDER "/state.json"

static pid_t server, viewer;
static const char *skipped; /* why there is no window to be had */

static void nap(int milliseconds) {
    struct timespec time = {milliseconds / 1000, milliseconds % 1000 * 1000000L};
    nanosleep(&time, NULL);
}

static bool installed(const char *program) {
    char command[128];
    snprintf(command, sizeof command, "command -v %s >/dev/null 2>&1", program);
    return system(command) == 0;
}

/* Xvfb on a display that is free, whose number becomes DISPLAY. */
static bool start_server(void) {
    int ends[2];
    if (pipe(ends) != 0) return false;
    server = fork();
    if (server == 0) {
        char number[16];
        close(ends[0]);
        int quiet = open("/dev/null", O_WRONLY);
        dup2(quiet, 2);
        snprintf(number, sizeof number, "%d", ends[1]);
        execlp("Xvfb", "Xvfb", "-displayfd", number, "-screen", "0", "1280x720x24", "-noreset", (char *)NULL);
        _exit(127);
    }
    close(ends[1]);
    char text[16] = {0};
    size_t used = 0;
    while (used + 1 < sizeof text && !strchr(text, '\n') && read(ends[0], text + used, 1) == 1) used++;
    close(ends[0]);
    if (!strchr(text, '\n')) return false;
    char display[24];
    snprintf(display, sizeof display, ":%d", atoi(text));
    setenv("DISPLAY", display, 1);
    return true;
}

static void start_viewer(const char *input) {
    viewer = fork();
    if (viewer == 0) {
        execl(ANG_PROGRAM, ANG_PROGRAM, input, "--write-state", STATE, "--pictures", FOLDER "/pictures", "--preset",
              "cta-head", (char *)NULL);
        _exit(127);
    }
}

/* The state as last written; the caller deletes it. NULL: none yet. */
static cJSON *read_state(void) {
    ang_json json;
    if (!ang_json_open(STATE, &json, NULL)) return NULL;
    cJSON *root = json.root;
    json.root = NULL;
    ang_json_close(&json);
    return root;
}

/* "axial.slice", "render.3" */
static cJSON *field(cJSON *root, const char *path) {
    char name[64];
    while (root && *path) {
        size_t length = strcspn(path, ".");
        snprintf(name, sizeof name, "%.*s", (int)length, path);
        root = cJSON_IsArray(root) ? cJSON_GetArrayItem(root, atoi(name)) : cJSON_GetObjectItem(root, name);
        path += length + (path[length] == '.');
    }
    return root;
}

static double number_at(cJSON *root, const char *path) {
    cJSON *item = field(root, path);
    return cJSON_IsNumber(item) ? item->valuedouble : NAN;
}

static const char *text_at(cJSON *root, const char *path) {
    const char *text = cJSON_GetStringValue(field(root, path));
    return text ? text : "";
}

/* Waits until a number of the state is as expected; the state is then as well refined. */
static void expect_number(const char *path, double expected, double tolerance) {
    double value = NAN;
    for (int i = 0; i < 200; i++) {
        cJSON *state = read_state();
        value = number_at(state, path);
        bool refined = cJSON_IsTrue(field(state, "refined"));
        cJSON_Delete(state);
        if (fabs(value - expected) <= tolerance && refined) return;
        nap(50);
    }
    fail_msg("%s is %.10g, not %.10g within %g", path, value, expected, tolerance);
}

static void expect_text(const char *path, const char *expected) {
    char value[256] = "";
    for (int i = 0; i < 200; i++) {
        cJSON *state = read_state();
        snprintf(value, sizeof value, "%s", text_at(state, path));
        cJSON_Delete(state);
        if (strcmp(value, expected) == 0) return;
        nap(50);
    }
    fail_msg("%s is '%s', not '%s'", path, value, expected);
}

static void hands(const char *format, ...) {
    char commands[512], line[600];
    va_list args;
    va_start(args, format);
    vsnprintf(commands, sizeof commands, format, args);
    va_end(args);
    snprintf(line, sizeof line, "xdotool %s", commands);
    assert_int_equal(system(line), 0);
}

/* The middle of a pane. */
static void middle(const char *pane, int *x, int *y) {
    char path[64];
    double rect[4];
    cJSON *state = read_state();
    for (int i = 0; i < 4; i++) {
        snprintf(path, sizeof path, "panes.%s.%d", pane, i);
        rect[i] = number_at(state, path);
    }
    cJSON_Delete(state);
    *x = (int)(rect[0] + rect[2] / 2);
    *y = (int)(rect[1] + rect[3] / 2);
}

static void go_to(const char *pane) {
    int x, y;
    middle(pane, &x, &y);
    hands("mousemove %d %d", x, y);
    expect_text("hovered", pane);
}

static void drag(int button, int dx, int dy) {
    /* In pieces, as a hand does; at the end it rests. */
    hands("mousedown %d mousemove_relative -- %d %d mousemove_relative -- %d %d mouseup %d", button, dx / 2, dy / 2,
          dx - dx / 2, dy - dy / 2, button);
}

static int opening(void **state) {
    (void)state;
    if (system("rm -rf " FOLDER " && mkdir -p " FOLDER) != 0) return -1;
    if (!installed("Xvfb") || !installed("xdotool"))
        skipped = "Xvfb or xdotool is not installed (packages xvfb, xdotool)";
#ifndef ANG_WITH_WINDOW
    skipped = "this build has no window";
#endif
    if (skipped) return 0;
    if (run("phantom -o " FOLDER "/phantom --dims 96x96x48 --quiet") != 0 || !start_server()) return -1;
    start_viewer(FOLDER "/phantom");
    return 0;
}

static int closing(void **state) {
    (void)state;
    pid_t children[] = {viewer, server};
    for (int i = 0; i < 2; i++)
        if (children[i] > 0) {
            kill(children[i], SIGTERM); /* the server removes its lock */
            waitpid(children[i], NULL, 0);
        }
    return 0;
}

static void need_window(void) {
    if (!skipped) return;
    print_message("skipped: %s\n", skipped);
    skip();
}

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
    assert_true(ang_picture_read(FOLDER "/pictures/angioscope-axial-0001.png", &picture, NULL));
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
    expect_text("render.3", "90,0,0");
    drag(3, 0, -45); /* zoom about where the drag began, the pane's middle */
    drag(2, 21, 10);
}

/* The largest difference of two pictures, in levels. */
static double difference(const char *a, const char *b) {
    ang_image left, right;
    ang_error err = {0};
    if (!ang_picture_read(a, &left, &err) || !ang_picture_read(b, &right, &err)) fail_msg("%s", err.message);
    assert_true(left.width == right.width && left.height == right.height);
    double most = 0, sum = 0;
    for (int i = 0; i < 4 * left.width * left.height; i++) {
        most = fmax(most, 255 * fabs((double)left.rgba[i] - (double)right.rgba[i]));
        if (i % 4 < 3) sum += (double)right.rgba[i];
    }
    assert_true(sum > 100); /* the picture shows something */
    ang_image_clear(&left);
    ang_image_clear(&right);
    return most;
}

static void write_file(const char *path, const char *text) {
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fputs(text, file);
    fclose(file);
}

/* Camera, preset and size from the state, a headless picture of them, and the two beside one another. */
static void compare_with_headless(const char *saved) {
    char arguments[2048], path[256];
    cJSON *shown = read_state();
    char *preset = cJSON_Print(field(shown, "preset"));
    write_file(FOLDER "/shown.json", preset);
    int used = snprintf(arguments, sizeof arguments,
                        "render " FOLDER "/phantom -q -o " FOLDER "/headless.png --preset " FOLDER "/shown.json");
    const cJSON *option;
    cJSON_ArrayForEach(option, field(shown, "render")) used +=
        snprintf(arguments + used, sizeof arguments - (size_t)used, " %s", option->valuestring);
    free(preset);
    cJSON_Delete(shown);
    assert_int_equal(run(arguments), 0);
    snprintf(path, sizeof path, FOLDER "/pictures/%s", saved);
    double levels = difference(path, FOLDER "/headless.png");
    print_message("%s: %.3g levels from the headless picture\n", saved, levels);
    assert_true(levels <= 1.001);
}

static void a_saved_volume_is_the_headless_picture(void **state) {
    (void)state;
    need_window();
    go_to("volume");
    hands("key ctrl+s");
    expect_text("saved", "angioscope-volume-0001.png");
    compare_with_headless("angioscope-volume-0001.png");
    /* A surface in parallel projection, turned; then the greatest values, through the slices' window. */
    hands("key alt+a key o key 4");
    expect_text("preset.name", "ct-bone-iso");
    drag(1, -33, 21);
    hands("key ctrl+s");
    expect_text("saved", "angioscope-volume-0002.png");
    compare_with_headless("angioscope-volume-0002.png");
    hands("key 7");
    expect_text("preset.name", "ct-mip");
    hands("key ctrl+s");
    expect_text("saved", "angioscope-volume-0003.png");
    compare_with_headless("angioscope-volume-0003.png");
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
    expect_text("render.3", "0,0,0");
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
    view.zoom = atof(text_at(now, "render.7"));
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
    hands("key ctrl+p");
    expect_text("saved", "angioscope-preset-0001.json");
    assert_int_equal(run("presets show " FOLDER "/pictures/angioscope-preset-0001.json"), 0);
    ang_preset *saved = ang_preset_load(FOLDER "/pictures/angioscope-preset-0001.json", NULL);
    assert_non_null(saved);
    assert_close(saved->transfer->points[5].hu, 350 + 3 * per_pixel, 1e-9);
    ang_preset_free(saved);
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

/* Seconds of processor time of the viewer. */
static double processor_time(void) {
    char path[64], line[1024];
    unsigned long user, system;
    snprintf(path, sizeof path, "/proc/%d/stat", (int)viewer);
    FILE *file = fopen(path, "r");
    assert_non_null(file);
    assert_non_null(fgets(line, sizeof line, file));
    fclose(file);
    assert_int_equal(
        sscanf(strrchr(line, ')') + 2, "%*c %*d %*d %*d %*d %*d %*u %*u %*u %*u %*u %lu %lu", &user, &system), 2);
    return (double)(user + system) / (double)sysconf(_SC_CLK_TCK);
}

static void at_rest_it_sleeps(void **state) {
    (void)state;
    need_window();
    hands("mousemove 5 600");
    nap(1000);
    double before = processor_time();
    nap(2000);
    assert_true(processor_time() - before <= 0.02); /* two ticks: 1 % */
}

static int wait_for_end(void) {
    int status = 0;
    for (int i = 0; i < 100; i++) {
        if (waitpid(viewer, &status, WNOHANG) == viewer) {
            viewer = 0;
            return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
        }
        nap(50);
    }
    fail_msg("the viewer does not end");
    return -1;
}

static void it_ends_well(void **state) {
    (void)state;
    need_window();
    hands("key ctrl+q");
    assert_int_equal(wait_for_end(), 0);
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
    return cmocka_run_group_tests(tests, opening, closing);
}
