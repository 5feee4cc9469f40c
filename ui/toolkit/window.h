/* The window: its OpenGL, its events, the clipboard. The only place that knows the window system. */
#ifndef ANG_UI_WINDOW_H
#define ANG_UI_WINDOW_H

#include "core/base/error.h"
#include "core/render/context.h"
#include "ui/toolkit/input.h"

typedef struct ang_window ang_window;

/* Opens a window of width x height pixels, or, where they are 0, most of the screen, with OpenGL current on the calling
 * thread, which must be the first of the program and make all other calls but ang_window_wake. One window a process.
 * `scale`: pixels for each unit of length of the interface, NaN: as suits the screen (scale.h).
 * NULL with ANG_GL and the window system's words where there is no screen or no OpenGL 4.3. */
ang_window *ang_window_create(const char *title, int width, int height, double scale, ang_error *err);
void ang_window_destroy(ang_window *window);

/* Owned by the window. */
ang_gl *ang_window_gl(ang_window *window);

/* Gives `input`, which must be the one of the last call or zero, what the next frame may see (ang_event_take), size and
 * scale included. True where events remain. */
bool ang_window_input(ang_window *window, ang_input *input);
/* Whether keys that go down, and all that comes after them, wait for a later frame. */
void ang_window_hold_keys(ang_window *window, bool hold);
/* Sleeps until something happens, at most `seconds` (infinite: no limit); returns at once where events remain. */
void ang_window_wait(ang_window *window, double seconds);
/* Looks for events without sleeping: whether something has happened that a frame should see,
 * other than letters that repeat. */
bool ang_window_pending(ang_window *window);
/* Ends a wait. From any thread. */
void ang_window_wake(void);
/* Shows what has been drawn. */
void ang_window_show(ang_window *window);

/* Whether the window is to be closed, by its frame or by ang_window_close. */
bool ang_window_closing(const ang_window *window);
void ang_window_close(ang_window *window);
/* Its size in pixels, as it is when it does not fill the screen. */
void ang_window_size(const ang_window *window, int *width, int *height);
void ang_window_toggle_full_screen(ang_window *window);
/* The paths that have been dropped on the window last, and since the last call; their number. The window's until the
 * next drop. */
size_t ang_window_dropped(ang_window *window, char ***paths);

/* The pointer's shape. */
typedef enum ang_cursor {
    ANG_CURSOR_ARROW,
    ANG_CURSOR_TEXT,
    ANG_CURSOR_HAND,
    ANG_CURSOR_ACROSS,
    ANG_CURSOR_UP_DOWN,
    ANG_CURSOR_CROSS,
    ANG_CURSOR_COUNT
} ang_cursor;
void ang_window_cursor(ang_window *window, ang_cursor cursor);

/* Text, UTF-8; valid until the next call. */
const char *ang_window_clipboard(ang_window *window);
void ang_window_set_clipboard(ang_window *window, const char *text);

#endif
