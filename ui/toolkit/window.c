#include "ui/toolkit/window.h"

#include "core/base/clock.h"
#include "core/base/memory.h"
#include "ui/toolkit/scale.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

struct ang_window {
    GLFWwindow *handle;
    ang_gl *gl;
    ang_event_queue queue;
    double x, y;         /* of the last move: where the pointer was when a button went down */
    unsigned modifiers;  /* ANG_MOD_* */
    bool alt_alone;      /* Alt went down, and nothing else has happened since */
    bool repeats;        /* the key that last went down repeats: so does the character after it */
    double asked, heard; /* seconds: when events were last asked for, and when all until then had come */
    bool damaged;        /* size or contents must be drawn again */
    char **dropped;      /* paths of the last drop */
    size_t dropped_count;
    bool dropped_fresh; /* nobody has asked for them yet */
    GLFWcursor *cursors[ANG_CURSOR_COUNT];
    ang_cursor cursor;
    double asked_scale; /* NaN: as suits the screen */
    double scale;
    int placed[4]; /* x, y, width, height before full screen */
};

/* Events that came while a picture was made are handed over late and have no time of their own: the earliest that they
 * may have come, so that two clicks do not fall apart because the frame between them took long. */
static double earliest(const ang_window *window) {
    static const double at_once = 0.002;
    double now = ang_now_ms() / 1000;
    return now - window->asked > at_once ? now : window->heard;
}

static void push(ang_window *window, ang_event event) {
    event.modifiers = window->modifiers;
    event.seconds = earliest(window);
    ang_event_push(&window->queue, &event);
}

static unsigned modifiers_of(int bits) {
    return (bits & GLFW_MOD_SHIFT ? ANG_MOD_SHIFT : 0u) | (bits & GLFW_MOD_CONTROL ? ANG_MOD_CONTROL : 0u) |
           (bits & GLFW_MOD_ALT ? ANG_MOD_ALT : 0u);
}

/* The state that X11 sends with a modifier's own key is that before it. */
static unsigned modifier_key(int key) {
    switch (key) {
    case GLFW_KEY_LEFT_SHIFT:
    case GLFW_KEY_RIGHT_SHIFT:
        return ANG_MOD_SHIFT;
    case GLFW_KEY_LEFT_CONTROL:
    case GLFW_KEY_RIGHT_CONTROL:
        return ANG_MOD_CONTROL;
    case GLFW_KEY_LEFT_ALT:
        return ANG_MOD_ALT;
    default:
        return 0;
    }
}

static int key_of(int key, int scancode) {
    static const struct {
        int glfw, own;
    } table[] = {{GLFW_KEY_ESCAPE, ANG_KEY_ESCAPE},
                 {GLFW_KEY_ENTER, ANG_KEY_ENTER},
                 {GLFW_KEY_KP_ENTER, ANG_KEY_ENTER},
                 {GLFW_KEY_TAB, ANG_KEY_TAB},
                 {GLFW_KEY_BACKSPACE, ANG_KEY_BACKSPACE},
                 {GLFW_KEY_INSERT, ANG_KEY_INSERT},
                 {GLFW_KEY_DELETE, ANG_KEY_DELETE},
                 {GLFW_KEY_LEFT, ANG_KEY_LEFT},
                 {GLFW_KEY_RIGHT, ANG_KEY_RIGHT},
                 {GLFW_KEY_UP, ANG_KEY_UP},
                 {GLFW_KEY_DOWN, ANG_KEY_DOWN},
                 {GLFW_KEY_PAGE_UP, ANG_KEY_PAGE_UP},
                 {GLFW_KEY_PAGE_DOWN, ANG_KEY_PAGE_DOWN},
                 {GLFW_KEY_HOME, ANG_KEY_HOME},
                 {GLFW_KEY_END, ANG_KEY_END},
                 {GLFW_KEY_SPACE, ANG_KEY_SPACE}};
    for (size_t i = 0; i < sizeof table / sizeof *table; i++)
        if (table[i].glfw == key) return table[i].own;
    if (key >= GLFW_KEY_F1 && key <= GLFW_KEY_F12) return ANG_KEY_F1 + (key - GLFW_KEY_F1);
    if (key >= GLFW_KEY_KP_0 && key <= GLFW_KEY_KP_9) return '0' + (key - GLFW_KEY_KP_0);
    /* Digits by place, since some layouts print other signs there; the rest by what is printed. */
    if (key >= GLFW_KEY_0 && key <= GLFW_KEY_9) return key;
    const char *name = glfwGetKeyName(key, scancode);
    int sign = name && name[0] && !name[1] ? (unsigned char)name[0] : key;
    if (sign >= 'a' && sign <= 'z') sign -= 'a' - 'A';
    return sign > ' ' && sign < 127 ? sign : ANG_KEY_NONE;
}

static ang_window *of(GLFWwindow *handle) { return glfwGetWindowUserPointer(handle); }

static void on_move(GLFWwindow *handle, double x, double y) {
    ang_window *window = of(handle);
    /* Where a window's units are not pixels. */
    int width, height, pixels_x, pixels_y;
    glfwGetWindowSize(handle, &width, &height);
    glfwGetFramebufferSize(handle, &pixels_x, &pixels_y);
    window->x = width > 0 ? x * pixels_x / width : x;
    window->y = height > 0 ? y * pixels_y / height : y;
    push(window, (ang_event){.kind = ANG_EVENT_MOVE, .x = window->x, .y = window->y});
}

static void on_button(GLFWwindow *handle, int button, int action, int modifiers) {
    ang_window *window = of(handle);
    window->modifiers = modifiers_of(modifiers);
    window->alt_alone = false;
    int code = button == GLFW_MOUSE_BUTTON_LEFT    ? ANG_BUTTON_LEFT
               : button == GLFW_MOUSE_BUTTON_RIGHT ? ANG_BUTTON_RIGHT
                                                   : ANG_BUTTON_MIDDLE;
    if (button > GLFW_MOUSE_BUTTON_MIDDLE) return;
    push(window,
         (ang_event){
             .kind = ANG_EVENT_BUTTON, .x = window->x, .y = window->y, .code = code, .down = action == GLFW_PRESS});
}

static void on_wheel(GLFWwindow *handle, double x, double y) {
    of(handle)->alt_alone = false;
    push(of(handle), (ang_event){.kind = ANG_EVENT_WHEEL, .x = x, .y = y});
}

static void on_key(GLFWwindow *handle, int key, int scancode, int action, int modifiers) {
    ang_window *window = of(handle);
    unsigned own = modifier_key(key);
    unsigned held = modifiers_of(modifiers);
    window->modifiers = action == GLFW_RELEASE ? held & ~own : held | own;
    window->repeats = action == GLFW_REPEAT;
    bool alone = window->alt_alone && own == ANG_MOD_ALT && action == GLFW_RELEASE;
    if (own == ANG_MOD_ALT && action == GLFW_PRESS)
        window->alt_alone = !(held & ~own);
    else if (own != ANG_MOD_ALT || action == GLFW_RELEASE)
        window->alt_alone = false;
    if (key == GLFW_KEY_UNKNOWN && !own) return;
    push(window, (ang_event){.kind = ANG_EVENT_KEY,
                             .code = own ? ANG_KEY_NONE : key_of(key, scancode),
                             .down = action != GLFW_RELEASE,
                             .repeat = action == GLFW_REPEAT});
    for (int down = 1; alone && down >= 0; down--)
        push(window, (ang_event){.kind = ANG_EVENT_KEY, .code = ANG_KEY_ALT, .down = down});
}

static void on_character(GLFWwindow *handle, unsigned character) {
    ang_window *window = of(handle);
    push(window, (ang_event){.kind = ANG_EVENT_CHARACTER, .code = (int)character, .repeat = window->repeats});
}

static void on_focus(GLFWwindow *handle, int focused) {
    ang_window *window = of(handle);
    if (focused) return;
    window->modifiers = 0;
    window->alt_alone = false;
    push(window, (ang_event){.kind = ANG_EVENT_FOCUS_LOST});
}

static void on_damage(GLFWwindow *handle) { of(handle)->damaged = true; }

static void on_size(GLFWwindow *handle, int width, int height) {
    (void)width;
    (void)height;
    of(handle)->damaged = true;
}

/* Of the screen that the window's middle is on. */
static void find_scale(ang_window *window) {
    float told_x = 1, told_y = 1;
    int count, x, y, width, height, mm = 0, mm_down, pixels = 0;
    GLFWmonitor **monitors = glfwGetMonitors(&count);
    glfwGetWindowContentScale(window->handle, &told_x, &told_y);
    glfwGetWindowPos(window->handle, &x, &y);
    glfwGetWindowSize(window->handle, &width, &height);
    for (int i = 0; i < count; i++) {
        int left, top;
        const GLFWvidmode *mode = glfwGetVideoMode(monitors[i]);
        glfwGetMonitorPos(monitors[i], &left, &top);
        if (!mode || x + width / 2 < left || x + width / 2 >= left + mode->width || y + height / 2 < top ||
            y + height / 2 >= top + mode->height)
            continue;
        pixels = mode->width;
        glfwGetMonitorPhysicalSize(monitors[i], &mm, &mm_down);
    }
    double scale = isnan(window->asked_scale) ? ang_screen_scale((double)told_x, pixels, mm) : window->asked_scale;
    if (scale < window->scale || scale > window->scale) window->damaged = true;
    window->scale = scale;
}

static void on_scale(GLFWwindow *handle, float x, float y) {
    (void)x;
    (void)y;
    find_scale(of(handle));
}

static void on_place(GLFWwindow *handle, int x, int y) {
    (void)x;
    (void)y;
    find_scale(of(handle));
}

static void forget_dropped(ang_window *window) {
    for (size_t i = 0; i < window->dropped_count; i++) free(window->dropped[i]);
    free(window->dropped);
    window->dropped = NULL;
    window->dropped_count = 0;
}

static void on_drop(GLFWwindow *handle, int count, const char **paths) {
    ang_window *window = of(handle);
    if (count < 1) return;
    forget_dropped(window);
    window->dropped = calloc((size_t)count, sizeof *window->dropped);
    for (int i = 0; i < count && window->dropped; i++) {
        char *path = strdup(paths[i]);
        if (path) window->dropped[window->dropped_count++] = path;
    }
    window->dropped_fresh = window->damaged = true;
}

static bool fail(ang_error *err, const char *what) {
    const char *words = NULL;
    glfwGetError(&words);
    return ang_fail(err, ANG_GL, "%s (%s); 'angioscope render' makes pictures without a window", what,
                    words ? words : "no reason given");
}

/* As large as the screen allows, but not so large that a big screen is covered. */
static void choose_size(int *width, int *height) {
    int x = 0, y = 0, screen_width = 1280, screen_height = 720;
    GLFWmonitor *monitor = glfwGetPrimaryMonitor();
    if (monitor) glfwGetMonitorWorkarea(monitor, &x, &y, &screen_width, &screen_height);
    if (*width < 1) *width = screen_width > 1920 ? screen_width * 4 / 5 : screen_width;
    if (*height < 1) *height = screen_height > 1200 ? screen_height * 4 / 5 : screen_height;
}

static void listen(GLFWwindow *handle) {
    glfwSetCursorPosCallback(handle, on_move);
    glfwSetMouseButtonCallback(handle, on_button);
    glfwSetScrollCallback(handle, on_wheel);
    glfwSetKeyCallback(handle, on_key);
    glfwSetCharCallback(handle, on_character);
    glfwSetWindowFocusCallback(handle, on_focus);
    glfwSetWindowRefreshCallback(handle, on_damage);
    glfwSetFramebufferSizeCallback(handle, on_size);
    glfwSetWindowContentScaleCallback(handle, on_scale);
    glfwSetWindowPosCallback(handle, on_place);
    glfwSetDropCallback(handle, on_drop);
}

ang_window *ang_window_create(const char *title, int width, int height, double scale, ang_error *err) {
    if (!glfwInit()) {
        fail(err, "no window can be opened");
        return NULL;
    }
    ang_window *window = ang_alloc(1, sizeof *window, "the window", err);
    if (!window) {
        glfwTerminate();
        return NULL;
    }
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 4);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    glfwWindowHint(GLFW_OPENGL_DEBUG_CONTEXT, GLFW_TRUE);
    glfwWindowHint(GLFW_DEPTH_BITS, 0);
    glfwWindowHint(GLFW_STENCIL_BITS, 0);
    choose_size(&width, &height);
    window->handle = glfwCreateWindow(width, height, title, NULL, NULL);
    if (!window->handle) {
        fail(err, "no window with OpenGL 4.3 can be opened");
        ang_window_destroy(window);
        return NULL;
    }
    glfwMakeContextCurrent(window->handle);
    window->gl = ang_gl_adopt((ang_gl_lookup)glfwGetProcAddress, "glfw", err);
    if (!window->gl) {
        ang_window_destroy(window);
        return NULL;
    }
    glfwSwapInterval(1);
    glfwSetWindowUserPointer(window->handle, window);
    glfwSetWindowSizeLimits(window->handle, 640, 400, GLFW_DONT_CARE, GLFW_DONT_CARE);
    listen(window->handle);
    window->asked_scale = scale;
    find_scale(window);
    window->damaged = true;
    return window;
}

void ang_window_destroy(ang_window *window) {
    if (!window) return;
    ang_gl_destroy(window->gl);
    for (int i = 0; i < ANG_CURSOR_COUNT; i++)
        if (window->cursors[i]) glfwDestroyCursor(window->cursors[i]);
    if (window->handle) glfwDestroyWindow(window->handle);
    glfwTerminate();
    forget_dropped(window);
    free(window);
}

ang_gl *ang_window_gl(ang_window *window) { return window->gl; }

bool ang_window_input(ang_window *window, ang_input *input) {
    glfwGetFramebufferSize(window->handle, &input->width, &input->height);
    input->scale = window->scale;
    input->time_seconds = ang_now_ms() / 1000;
    window->damaged = false;
    return ang_event_take(&window->queue, input);
}

void ang_window_hold_keys(ang_window *window, bool hold) { window->queue.keys_held_back = hold; }

void ang_window_wait(ang_window *window, double seconds) {
    window->asked = ang_now_ms() / 1000;
    if (window->queue.count > 0 || window->damaged || seconds <= 0)
        glfwPollEvents();
    else if (isfinite(seconds))
        glfwWaitEventsTimeout(seconds);
    else
        glfwWaitEvents();
    window->heard = ang_now_ms() / 1000;
}

bool ang_window_pending(ang_window *window) {
    ang_window_wait(window, 0);
    return ang_event_waits(&window->queue) || window->damaged || glfwWindowShouldClose(window->handle);
}

void ang_window_wake(void) { glfwPostEmptyEvent(); }

void ang_window_show(ang_window *window) { glfwSwapBuffers(window->handle); }

bool ang_window_closing(const ang_window *window) { return glfwWindowShouldClose(window->handle); }
void ang_window_close(ang_window *window) { glfwSetWindowShouldClose(window->handle, GLFW_TRUE); }

void ang_window_size(const ang_window *window, int *width, int *height) {
    glfwGetWindowSize(window->handle, width, height);
    if (!glfwGetWindowMonitor(window->handle)) return;
    *width = window->placed[2];
    *height = window->placed[3];
}

void ang_window_toggle_full_screen(ang_window *window) {
    int *placed = window->placed;
    if (glfwGetWindowMonitor(window->handle)) {
        glfwSetWindowMonitor(window->handle, NULL, placed[0], placed[1], placed[2], placed[3], GLFW_DONT_CARE);
        return;
    }
    GLFWmonitor *monitor = glfwGetPrimaryMonitor();
    const GLFWvidmode *mode = monitor ? glfwGetVideoMode(monitor) : NULL;
    if (!mode) return;
    glfwGetWindowPos(window->handle, &placed[0], &placed[1]);
    glfwGetWindowSize(window->handle, &placed[2], &placed[3]);
    glfwSetWindowMonitor(window->handle, monitor, 0, 0, mode->width, mode->height, mode->refreshRate);
}

size_t ang_window_dropped(ang_window *window, char ***paths) {
    *paths = window->dropped;
    bool fresh = window->dropped_fresh;
    window->dropped_fresh = false;
    return fresh ? window->dropped_count : 0;
}

void ang_window_cursor(ang_window *window, ang_cursor cursor) {
    static const int shapes[ANG_CURSOR_COUNT] = {GLFW_ARROW_CURSOR,   GLFW_IBEAM_CURSOR,   GLFW_HAND_CURSOR,
                                                 GLFW_HRESIZE_CURSOR, GLFW_VRESIZE_CURSOR, GLFW_CROSSHAIR_CURSOR};
    if (window->cursor == cursor) return;
    if (!window->cursors[cursor]) window->cursors[cursor] = glfwCreateStandardCursor(shapes[cursor]);
    glfwSetCursor(window->handle, window->cursors[cursor]);
    window->cursor = cursor;
}

const char *ang_window_clipboard(ang_window *window) {
    const char *text = glfwGetClipboardString(window->handle);
    return text ? text : "";
}

void ang_window_set_clipboard(ang_window *window, const char *text) { glfwSetClipboardString(window->handle, text); }
