/* What the hands did: events as they arrive, and what of them one frame may see. No window system in here. */
#ifndef ANG_UI_INPUT_H
#define ANG_UI_INPUT_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Keys: letters and digits by what is printed on them (upper case ASCII), others by name. */
typedef enum ang_key {
    ANG_KEY_NONE = 0,
    ANG_KEY_SPACE = ' ',
    /* '0' to '9', 'A' to 'Z', and other ASCII signs stand for themselves */
    ANG_KEY_ESCAPE = 128,
    ANG_KEY_ENTER,
    ANG_KEY_TAB,
    ANG_KEY_BACKSPACE,
    ANG_KEY_INSERT,
    ANG_KEY_DELETE,
    ANG_KEY_LEFT,
    ANG_KEY_RIGHT,
    ANG_KEY_UP,
    ANG_KEY_DOWN,
    ANG_KEY_PAGE_UP,
    ANG_KEY_PAGE_DOWN,
    ANG_KEY_HOME,
    ANG_KEY_END,
    ANG_KEY_F1,
    ANG_KEY_F2,
    ANG_KEY_F3,
    ANG_KEY_F4,
    ANG_KEY_F5,
    ANG_KEY_F6,
    ANG_KEY_F7,
    ANG_KEY_F8,
    ANG_KEY_F9,
    ANG_KEY_F10,
    ANG_KEY_F11,
    ANG_KEY_F12,
    ANG_KEY_ALT, /* pressed and released with nothing in between; else it is a modifier alone */
    ANG_KEY_COUNT = 256
} ang_key;

enum { ANG_MOD_SHIFT = 1, ANG_MOD_CONTROL = 2, ANG_MOD_ALT = 4 };
enum { ANG_BUTTON_LEFT, ANG_BUTTON_RIGHT, ANG_BUTTON_MIDDLE, ANG_BUTTON_COUNT };

typedef enum ang_event_kind {
    ANG_EVENT_MOVE,
    ANG_EVENT_BUTTON,
    ANG_EVENT_WHEEL,
    ANG_EVENT_KEY,
    ANG_EVENT_CHARACTER,
    ANG_EVENT_FOCUS_LOST
} ang_event_kind;

/* x, y: the pointer in pixels of the window for a move and a button; turns of the wheel. */
typedef struct ang_event {
    ang_event_kind kind;
    double x, y;
    int code;           /* button, key or character (Unicode) */
    bool down, repeat;  /* `repeat`: of a key that is held down, also of its character */
    unsigned modifiers; /* ANG_MOD_* held */
    double seconds;     /* steady clock */
} ang_event;

enum { ANG_INPUT_PRESSES = 8, ANG_INPUT_CHARACTERS = 16 };

/* What one frame sees. */
typedef struct ang_input {
    int width, height;    /* of the window, pixels */
    double scale;         /* pixels for each unit of length of the interface; 1 on an ordinary screen */
    double time_seconds;  /* steady clock */
    double since_seconds; /* when the first of the events of this frame came; 0: none came */
    double x, y;          /* the pointer, pixels from the left top corner */
    bool button[ANG_BUTTON_COUNT];
    bool double_click[ANG_BUTTON_COUNT]; /* went down in this frame, for the second time in a short while */
    double wheel_x, wheel_y;             /* turns; up and left positive */
    bool key[ANG_KEY_COUNT];
    unsigned modifiers; /* ANG_MOD_* */
    struct {
        int key;
        unsigned modifiers;
        bool repeat;
    } press[ANG_INPUT_PRESSES]; /* keys that went down, in order */
    int press_count;
    uint32_t characters[ANG_INPUT_CHARACTERS]; /* typed, Unicode */
    int character_count;
} ang_input;

enum { ANG_EVENT_CAPACITY = 1024 };

/* Events that no frame has seen yet. A program that draws slowly would miss clicks and short drags if a frame saw only
 * where things stand. Zero-initialise. */
typedef struct ang_event_queue {
    ang_event event[ANG_EVENT_CAPACITY];
    size_t first, count;
    ang_event last_press; /* the last button that went down */
    bool keys_held_back;  /* no frame sees a key go down */
} ang_event_queue;

/* Appends; a move after a move replaces it. Where the queue is full the event is dropped, except that keys and buttons
 * that go up push out the oldest that is no such event: nothing may stay held down. */
void ang_event_push(ang_event_queue *queue, const ang_event *event);
/* Takes what one frame may see into `input`, whose other fields stay: moves up to the first button or wheel event; at
 * most one button event, and none that goes up in the frame of a move; at most one edge of each key, and one key going
 * down besides modifiers, since what has the keyboard may change with it; and no key or modifier after a move, a button
 * or the wheel, since it is for what lies under the pointer then. True where events remain, which need another frame.
 */
bool ang_event_take(ang_event_queue *queue, ang_input *input);

/* Whether anything waits but letters that repeat because they are held down, with the characters that they give: these
 * ask for nothing new. */
bool ang_event_waits(const ang_event_queue *queue);

/* A key by its name in lists of shortcuts: "F1", "Page up", "A". */
const char *ang_key_name(int key, char buffer[8]);

#endif
