/* The viewer in a real window: a display without a screen (Xvfb), hands by xdotool, eyes by the state that the program
 * writes and by the pictures that it saves. Define FOLDER, where the test's files go, before this; cmocka.h and what it
 * needs must be included first. */
#ifndef ANG_TESTS_APP_VIEWER_HANDS_H
#define ANG_TESTS_APP_VIEWER_HANDS_H

#include "io/image/image_io.h"
#include "io/json.h"
#include "tests/app/program.h"

#include <cjson/cJSON.h>
#include <fcntl.h>
#include <math.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#define STATE    FOLDER "/state.json" /* what --write-state writes */
#define PICTURES FOLDER "/pictures"

static pid_t server, viewer;
static const char *skipped; /* why there is no window to be had */

static inline void nap(int milliseconds) {
    struct timespec time = {milliseconds / 1000, milliseconds % 1000 * 1000000L};
    nanosleep(&time, NULL);
}

static inline bool installed(const char *program) {
    char command[128];
    snprintf(command, sizeof command, "command -v %s >/dev/null 2>&1", program);
    return system(command) == 0;
}

/* Xvfb on a display that is free, whose number becomes DISPLAY. */
static inline bool start_server(void) {
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

/* Opens the window; arguments for the shell. What it shows is written to STATE, what it saves goes to PICTURES. */
static inline void start_viewer(const char *arguments) {
    char command[2048];
    snprintf(command, sizeof command, "exec " ANG_PROGRAM " view --write-state " STATE " --pictures " PICTURES " %s",
             arguments);
    unlink(STATE); /* what an earlier one showed */
    viewer = fork();
    if (viewer == 0) {
        execl("/bin/sh", "sh", "-c", command, (char *)NULL);
        _exit(127);
    }
}

/* What `from` has goes to `to`, objects of one name into one another. */
static inline void merge(cJSON *to, cJSON *from) {
    while (from->child) {
        cJSON *item = cJSON_DetachItemViaPointer(from, from->child);
        cJSON *there = cJSON_GetObjectItem(to, item->string);
        if (there && cJSON_IsObject(there)) {
            merge(there, item);
            cJSON_Delete(item);
        } else {
            cJSON_AddItemToObject(to, item->string, item);
        }
    }
}

/* The state as last written, what is "live" taken up beside the rest; the caller deletes it. NULL: none yet. */
static inline cJSON *read_state(void) {
    ang_json json;
    if (!ang_json_open(STATE, &json, NULL)) return NULL;
    cJSON *root = json.root, *live = cJSON_DetachItemFromObject(root, "live");
    if (live) merge(root, live);
    cJSON_Delete(live);
    json.root = NULL;
    ang_json_close(&json);
    return root;
}

/* "axial.slice", "crosshair_mm.2" */
static inline cJSON *field(cJSON *root, const char *path) {
    char name[64];
    while (root && *path) {
        size_t length = strcspn(path, ".");
        snprintf(name, sizeof name, "%.*s", (int)length, path);
        root = cJSON_IsArray(root) ? cJSON_GetArrayItem(root, atoi(name)) : cJSON_GetObjectItem(root, name);
        path += length + (path[length] == '.');
    }
    return root;
}

/* NaN, or "", where there is none. */
static inline double number_at(cJSON *root, const char *path) {
    cJSON *item = field(root, path);
    return cJSON_IsNumber(item) ? item->valuedouble : NAN;
}

/* Of what is shown now. */
static inline double number_now(const char *path) {
    cJSON *state = read_state();
    double value = number_at(state, path);
    cJSON_Delete(state);
    return value;
}

static inline const char *text_at(cJSON *root, const char *path) {
    const char *text = cJSON_GetStringValue(field(root, path));
    return text ? text : "";
}

enum { PATIENCE = 600 }; /* naps of 50 ms: a build with sanitizers on a busy machine may need most of them */

/* Waits until a number of the state is as expected; the state is then as well refined. */
static inline void expect_number(const char *path, double expected, double tolerance) {
    double value = NAN;
    bool refined = false;
    for (int i = 0; i < PATIENCE; i++) {
        cJSON *state = read_state();
        value = number_at(state, path);
        refined = cJSON_IsTrue(field(state, "refined"));
        cJSON_Delete(state);
        if (fabs(value - expected) <= tolerance && refined) return;
        nap(50);
    }
    fail_msg("%s is %.17g, not %.17g within %g%s", path, value, expected, tolerance,
             refined ? "" : "; it is not refined");
}

/* Waits until a number of the state differs by more than `by` from what it was; what it is then. */
static inline double expect_other(const char *path, double than, double by) {
    for (int i = 0; i < PATIENCE; i++) {
        double value = number_now(path);
        if (fabs(value - than) > by) return value;
        nap(50);
    }
    fail_msg("%s stays %.17g within %g", path, than, by);
    return NAN;
}

/* Waits until the window draws no more: no frame in 700 ms. */
static inline void expect_no_frames(void) {
    double frames = NAN;
    for (int i = 0; i < PATIENCE / 10; i++) {
        double before = frames;
        frames = number_now("frames");
        if (fabs(frames - before) < 0.5) return;
        nap(700);
    }
    fail_msg("the window goes on drawing");
}

/* The same for a text, refined or not. */
static inline void expect_text(const char *path, const char *expected) {
    char value[256] = "";
    for (int i = 0; i < PATIENCE; i++) {
        cJSON *state = read_state();
        snprintf(value, sizeof value, "%s", text_at(state, path));
        cJSON_Delete(state);
        if (strcmp(value, expected) == 0) return;
        nap(50);
    }
    fail_msg("%s is '%s', not '%s'", path, value, expected);
}

/* The same for what is true or false. */
static inline void expect_flag(const char *path, bool expected) {
    for (int i = 0; i < PATIENCE; i++) {
        cJSON *state = read_state();
        bool is = cJSON_IsTrue(field(state, path));
        cJSON_Delete(state);
        if (is == expected) return;
        nap(50);
    }
    fail_msg("%s is not %s", path, expected ? "true" : "false");
}

/* Commands for xdotool. */
static inline void hands(const char *format, ...) {
    char commands[512], line[600];
    va_list args;
    va_start(args, format);
    vsnprintf(commands, sizeof commands, format, args);
    va_end(args);
    snprintf(line, sizeof line, "xdotool %s", commands);
    assert_int_equal(system(line), 0);
}

/* The middle of a pane. */
static inline void middle(const char *pane, int *x, int *y) {
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

/* The pointer to the middle of a pane. */
static inline void go_to(const char *pane) {
    int x, y;
    middle(pane, &x, &y);
    hands("mousemove %d %d mousemove %d %d", x - 1, y, x, y); /* keys follow a pointer that moves */
    expect_text("hovered", pane);
}

static inline void drag(int button, int dx, int dy) {
    /* In pieces, as a hand does; at the end it rests. */
    hands("mousedown %d mousemove_relative -- %d %d mousemove_relative -- %d %d mouseup %d", button, dx / 2, dy / 2,
          dx - dx / 2, dy - dy / 2, button);
}

/* With the left button from one place of the window to another, as near as whole pixels allow. */
static inline void drag_between(double x0, double y0, double x1, double y1) {
    hands("mousemove %ld %ld", lround(x0), lround(y0));
    drag(1, (int)lround(x1 - x0), (int)lround(y1 - y0));
}

/* An empty FOLDER, no preferences, and a display; `skipped` where there can be none. For a group's setup: 0 or -1. */
static inline int open_display(void) {
    if (system("rm -rf " FOLDER " && mkdir -p " FOLDER) != 0) return -1;
    setenv("XDG_CONFIG_HOME", FOLDER "/config", 1); /* not what the user has chosen */
    if (!installed("Xvfb") || !installed("xdotool"))
        skipped = "Xvfb or xdotool is not installed (packages xvfb, xdotool)";
#ifndef ANG_WITH_WINDOW
    skipped = "this build has no window";
#endif
    return skipped || start_server() ? 0 : -1;
}

/* For a group's setup: the window with a phantom of 96 x 96 x 48 voxels, FOLDER/phantom. */
static inline int open_phantom(void **state) {
    (void)state;
    if (open_display() != 0) return -1;
    if (skipped) return 0;
    if (run("phantom -o " FOLDER "/phantom --dims 96x96x48 --quiet") != 0) return -1;
    start_viewer(FOLDER "/phantom --preset cta-head");
    return 0;
}

/* For a group's teardown: ends the viewer, where it still runs, and the display. */
static inline int close_display(void **state) {
    (void)state;
    pid_t children[] = {viewer, server};
    for (int i = 0; i < 2; i++)
        if (children[i] > 0) {
            kill(children[i], SIGTERM); /* the server removes its lock */
            waitpid(children[i], NULL, 0);
        }
    return 0;
}

/* Skips the test where there is no window to be had. */
static inline void need_window(void) {
    if (!skipped) return;
    print_message("skipped: %s\n", skipped);
    skip();
}

/* The largest difference of two pictures, in levels. */
static inline double difference(const char *a, const char *b) {
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

static inline void write_file(const char *path, const char *text) {
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fputs(text, file);
    fclose(file);
}

/* A headless picture of the state as it is, beside what the window saved; `saved` is a name in PICTURES. */
static inline void compare_with_headless(const char *saved, const char *input) {
    char arguments[1024], path[256];
    snprintf(arguments, sizeof arguments, "render %s --state " STATE " -q -o " FOLDER "/headless.png", input);
    assert_int_equal(run(arguments), 0);
    snprintf(path, sizeof path, PICTURES "/%s", saved);
    double levels = difference(path, FOLDER "/headless.png");
    print_message("%s: %.3g levels from the headless picture\n", saved, levels);
    assert_true(levels <= 1.001);
}

/* Seconds of processor time of the viewer. */
static inline double processor_time(void) {
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

/* The exit code of the viewer, which was told to end; the next one may be started. */
static inline int wait_for_end(void) {
    int status = 0;
    for (int i = 0; i < PATIENCE; i++) {
        if (waitpid(viewer, &status, WNOHANG) == viewer) {
            viewer = 0;
            return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
        }
        nap(50);
    }
    fail_msg("the viewer does not end");
    return -1;
}

/* A group's last test. */
static inline void it_ends_well(void **state) {
    (void)state;
    need_window();
    hands("key ctrl+q");
    assert_int_equal(wait_for_end(), 0);
}

#endif
