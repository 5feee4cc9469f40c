#include "ui/toolkit/input.h"

#include <math.h>
#include <string.h>

static const double double_click_seconds = 0.4, double_click_pixels = 6;

static ang_event *at(ang_event_queue *queue, size_t i) {
    return &queue->event[(queue->first + i) % ANG_EVENT_CAPACITY];
}

static void remove_at(ang_event_queue *queue, size_t i) {
    for (size_t k = i; k + 1 < queue->count; k++) *at(queue, k) = *at(queue, k + 1);
    queue->count--;
}

static bool is_release(const ang_event *event) {
    return (event->kind == ANG_EVENT_KEY || event->kind == ANG_EVENT_BUTTON) && !event->down;
}

void ang_event_push(ang_event_queue *queue, const ang_event *event) {
    if (event->kind == ANG_EVENT_MOVE && queue->count > 0 && at(queue, queue->count - 1)->kind == ANG_EVENT_MOVE) {
        *at(queue, queue->count - 1) = *event;
        return;
    }
    if (queue->count == ANG_EVENT_CAPACITY) {
        size_t i = 0;
        while (i < queue->count && is_release(at(queue, i))) i++;
        if (!is_release(event) || i == queue->count) return;
        remove_at(queue, i);
    }
    *at(queue, queue->count++) = *event;
}

/* What the events taken so far forbid those after them. */
typedef struct taken {
    bool moved, button, wheel, pressed;
    bool edge[ANG_KEY_COUNT];
} taken;

static bool fits(const ang_event_queue *queue, const ang_event *event, const taken *so_far, const ang_input *input) {
    switch (event->kind) {
    case ANG_EVENT_MOVE:
        return !so_far->button && !so_far->wheel;
    case ANG_EVENT_BUTTON:
        return !so_far->button && !so_far->wheel && (event->down || !so_far->moved);
    case ANG_EVENT_WHEEL:
        return !so_far->button;
    case ANG_EVENT_KEY:
        return !so_far->moved && !so_far->button && !so_far->wheel && !(queue->keys_held_back && event->down) &&
               !so_far->edge[event->code] && !(event->down && event->code != ANG_KEY_NONE && so_far->pressed) &&
               input->press_count < ANG_INPUT_PRESSES;
    case ANG_EVENT_CHARACTER:
        return input->character_count < ANG_INPUT_CHARACTERS;
    case ANG_EVENT_FOCUS_LOST:
        return !so_far->button && !so_far->moved;
    }
    return true;
}

/* By when the hand did it: frames may be slower than fingers. */
static void note_press(ang_event_queue *queue, const ang_event *event, ang_input *input) {
    const ang_event *last = &queue->last_press;
    bool again = last->down && last->code == event->code && event->seconds - last->seconds < double_click_seconds &&
                 hypot(event->x - last->x, event->y - last->y) < double_click_pixels;
    input->double_click[event->code] = again;
    queue->last_press = *event;
    if (again) queue->last_press.down = false; /* a third click begins anew */
}

static void apply(ang_event_queue *queue, const ang_event *event, taken *so_far, ang_input *input) {
    switch (event->kind) {
    case ANG_EVENT_MOVE:
        input->x = event->x;
        input->y = event->y;
        so_far->moved = true;
        break;
    case ANG_EVENT_BUTTON:
        input->button[event->code] = event->down;
        input->modifiers = event->modifiers;
        so_far->button = true;
        if (event->down) note_press(queue, event, input);
        break;
    case ANG_EVENT_WHEEL:
        input->wheel_x += event->x;
        input->wheel_y += event->y;
        so_far->wheel = true;
        break;
    case ANG_EVENT_KEY:
        input->key[event->code] = event->down;
        input->modifiers = event->modifiers;
        so_far->edge[event->code] = true;
        if (!event->down) break;
        so_far->pressed = so_far->pressed || event->code != ANG_KEY_NONE;
        input->press[input->press_count].key = event->code;
        input->press[input->press_count].modifiers = event->modifiers;
        input->press[input->press_count++].repeat = event->repeat;
        break;
    case ANG_EVENT_CHARACTER:
        input->characters[input->character_count++] = (uint32_t)event->code;
        break;
    case ANG_EVENT_FOCUS_LOST:
        /* Keys that go up elsewhere are never heard of. */
        memset(input->key, 0, sizeof input->key);
        input->modifiers = 0;
        break;
    }
}

bool ang_event_take(ang_event_queue *queue, ang_input *input) {
    taken so_far = {0};
    input->wheel_x = input->wheel_y = 0;
    input->press_count = input->character_count = 0;
    input->since_seconds = queue->count > 0 ? at(queue, 0)->seconds : 0;
    memset(input->double_click, 0, sizeof input->double_click);
    while (queue->count > 0 && fits(queue, at(queue, 0), &so_far, input)) {
        apply(queue, at(queue, 0), &so_far, input);
        queue->first = (queue->first + 1) % ANG_EVENT_CAPACITY;
        queue->count--;
    }
    return queue->count > 0;
}

bool ang_event_waits(const ang_event_queue *queue) {
    for (size_t i = 0; i < queue->count; i++) {
        const ang_event *event = &queue->event[(queue->first + i) % ANG_EVENT_CAPACITY];
        bool letter = event->kind == ANG_EVENT_CHARACTER ||
                      (event->kind == ANG_EVENT_KEY && event->code >= 'A' && event->code <= 'Z');
        if (!letter || !event->repeat) return true;
    }
    return false;
}

const char *ang_key_name(int key, char buffer[8]) {
    static const char *const names[] = {"Esc",   "Enter", "Tab",  "Backspace", "Insert",    "Delete", "Left",
                                        "Right", "Up",    "Down", "Page up",   "Page down", "Home",   "End"};
    if (key == ANG_KEY_SPACE) return "Space";
    if (key >= ANG_KEY_ESCAPE && key <= ANG_KEY_END) return names[key - ANG_KEY_ESCAPE];
    if (key >= ANG_KEY_F1 && key <= ANG_KEY_F12) {
        int number = key - ANG_KEY_F1 + 1;
        char *to = buffer;
        *to++ = 'F';
        if (number >= 10) *to++ = '1';
        *to++ = (char)('0' + number % 10);
        *to = '\0';
        return buffer;
    }
    buffer[0] = (char)key;
    buffer[1] = '\0';
    return buffer;
}
