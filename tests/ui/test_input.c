/* What frames see of events: nothing that a hand did may be lost, however slow the frames. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
/* after them */
#include <cmocka.h>

#include "ui/toolkit/input.h"

#include <string.h>

static ang_event_queue queue;
static ang_input input;

static void start(void) {
    memset(&queue, 0, sizeof queue);
    memset(&input, 0, sizeof input);
}

static void move(double x, double y) { ang_event_push(&queue, &(ang_event){.kind = ANG_EVENT_MOVE, .x = x, .y = y}); }
static void button(int code, bool down, double x, double seconds) {
    ang_event_push(&queue,
                   &(ang_event){.kind = ANG_EVENT_BUTTON, .code = code, .down = down, .x = x, .seconds = seconds});
}
static void key(int code, bool down) {
    ang_event_push(&queue, &(ang_event){.kind = ANG_EVENT_KEY, .code = code, .down = down});
}

static void twenty_clicks_within_one_frame_all_arrive(void **state) {
    (void)state;
    start();
    for (int i = 0; i < 20; i++) {
        button(ANG_BUTTON_LEFT, true, 5, i);
        button(ANG_BUTTON_LEFT, false, 5, i);
    }
    int clicks = 0, frames = 0;
    bool more = true, was_down = false;
    while (more) {
        more = ang_event_take(&queue, &input);
        clicks += input.button[ANG_BUTTON_LEFT] && !was_down;
        was_down = input.button[ANG_BUTTON_LEFT];
        frames++;
    }
    assert_int_equal(clicks, 20);
    assert_int_equal(frames, 40);
    assert_false(was_down);
}

/* In their order, with what comes after them; what goes up does not wait. */
static void keys_wait_while_they_are_held_back(void **state) {
    (void)state;
    start();
    key('A', true);
    ang_event_take(&queue, &input);
    key('A', false);
    key('B', true);
    key('B', false);
    button(ANG_BUTTON_LEFT, true, 5, 0);
    queue.keys_held_back = true;
    for (int i = 0; i < 3; i++) {
        assert_true(ang_event_take(&queue, &input));
        assert_false(input.key['A'] || input.button[ANG_BUTTON_LEFT]);
        assert_int_equal(input.press_count, 0);
    }
    queue.keys_held_back = false;
    assert_true(ang_event_take(&queue, &input));
    assert_int_equal(input.press[0].key, 'B');
    assert_false(ang_event_take(&queue, &input));
    assert_true(input.button[ANG_BUTTON_LEFT]);
}

/* Press at 10, drag to 60, release: a frame must see the button down at 10, one at 60 still down, then up. */
static void a_fast_drag_keeps_its_ends(void **state) {
    (void)state;
    start();
    move(10, 0);
    button(ANG_BUTTON_LEFT, true, 10, 0);
    for (int x = 11; x <= 60; x++) move(x, 0);
    button(ANG_BUTTON_LEFT, false, 60, 0);
    assert_true(ang_event_take(&queue, &input));
    assert_true(input.button[ANG_BUTTON_LEFT] && input.x == 10);
    assert_true(ang_event_take(&queue, &input));
    assert_true(input.button[ANG_BUTTON_LEFT] && input.x == 60);
    assert_false(ang_event_take(&queue, &input));
    assert_true(!input.button[ANG_BUTTON_LEFT] && input.x == 60);
}

static void taps_of_a_key_are_not_swallowed(void **state) {
    (void)state;
    start();
    for (int i = 0; i < 10; i++) {
        key('A', true);
        key('A', false);
    }
    int taps = 0;
    bool more = true;
    while (more) {
        more = ang_event_take(&queue, &input);
        taps += input.press_count;
    }
    assert_int_equal(taps, 10);
    assert_false(input.key['A']);
}

/* An arrow, then Enter: the second is for where the first has led to. */
static void keys_go_down_one_by_one(void **state) {
    (void)state;
    start();
    key(ANG_KEY_DOWN, true);
    key(ANG_KEY_DOWN, false);
    key(ANG_KEY_ENTER, true);
    key(ANG_KEY_ENTER, false);
    int seen[2] = {0}, count = 0, frames = 0;
    bool more = true;
    for (; more && frames < 10; frames++) {
        more = ang_event_take(&queue, &input);
        assert_true(input.press_count <= 1);
        if (input.press_count == 1 && count < 2) seen[count++] = input.press[0].key;
    }
    assert_int_equal(count, 2);
    assert_int_equal(seen[0], ANG_KEY_DOWN);
    assert_int_equal(seen[1], ANG_KEY_ENTER);
    /* A modifier goes along with its key. */
    start();
    key(ANG_KEY_NONE, true);
    key('Z', true);
    assert_false(ang_event_take(&queue, &input));
    assert_int_equal(input.press_count, 2);
}

/* A key is for what the pointer has come to; a key before the move for where it was, in the same frame. */
static void keys_come_after_what_the_pointer_did(void **state) {
    (void)state;
    start();
    key('A', true);
    move(7, 0);
    key('A', false);
    key('B', true);
    assert_true(ang_event_take(&queue, &input));
    assert_true(input.press_count == 1 && input.press[0].key == 'A' && input.x == 7 && input.key['A']);
    assert_false(ang_event_take(&queue, &input));
    assert_true(input.press_count == 1 && input.press[0].key == 'B' && !input.key['A']);
    /* Ctrl is let go when the wheel has turned and the button has gone up. */
    const ang_event before[] = {{.kind = ANG_EVENT_WHEEL, .y = 1},
                                {.kind = ANG_EVENT_MOVE, .x = 9},
                                {.kind = ANG_EVENT_BUTTON, .code = ANG_BUTTON_LEFT, .modifiers = ANG_MOD_CONTROL}};
    for (size_t i = 0; i < sizeof before / sizeof *before; i++) {
        start();
        input.modifiers = ANG_MOD_CONTROL;
        ang_event_push(&queue, &before[i]);
        key(ANG_KEY_NONE, false);
        assert_true(ang_event_take(&queue, &input));
        assert_int_equal(input.modifiers, ANG_MOD_CONTROL);
        assert_false(ang_event_take(&queue, &input));
        assert_int_equal(input.modifiers, 0);
    }
}

static void wheel_turns_add_up_and_end_moves(void **state) {
    (void)state;
    start();
    for (int i = 0; i < 3; i++) ang_event_push(&queue, &(ang_event){.kind = ANG_EVENT_WHEEL, .y = 1});
    move(7, 0);
    assert_true(ang_event_take(&queue, &input));
    assert_true(input.wheel_y == 3 && input.x == 0);
    assert_false(ang_event_take(&queue, &input));
    assert_true(input.wheel_y == 0 && input.x == 7);
}

static void double_clicks_go_by_the_hand_not_by_frames(void **state) {
    (void)state;
    static const struct {
        double second, at;
        bool twice;
    } cases[] = {{0.2, 5, true}, {0.9, 5, false}, {0.2, 40, false}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        start();
        button(ANG_BUTTON_LEFT, true, 5, 10);
        button(ANG_BUTTON_LEFT, false, 5, 10.1);
        button(ANG_BUTTON_LEFT, true, cases[i].at, 10 + cases[i].second);
        ang_event_take(&queue, &input);
        assert_false(input.double_click[ANG_BUTTON_LEFT]);
        ang_event_take(&queue, &input);
        ang_event_take(&queue, &input);
        assert_int_equal(input.double_click[ANG_BUTTON_LEFT], cases[i].twice);
    }
}

static void releases_survive_a_full_queue(void **state) {
    (void)state;
    start();
    key('A', true);
    for (int i = 0; i < 2 * ANG_EVENT_CAPACITY; i++) {
        move(i, 0);
        key('B', i % 2 == 0);
    }
    key('A', false);
    bool more = true;
    while (more) more = ang_event_take(&queue, &input);
    assert_false(input.key['A']);
}

static void keys_go_up_where_the_focus_is_lost(void **state) {
    (void)state;
    start();
    key('A', true);
    ang_event_push(&queue, &(ang_event){.kind = ANG_EVENT_FOCUS_LOST});
    while (ang_event_take(&queue, &input)) {
    }
    assert_false(input.key['A']);
}

static void letters_held_down_ask_for_nothing_new(void **state) {
    (void)state;
    static ang_event_queue queue;
    queue = (ang_event_queue){0};
    assert_false(ang_event_waits(&queue));
    ang_event_push(&queue, &(ang_event){.kind = ANG_EVENT_KEY, .code = 'V', .down = true, .repeat = true});
    ang_event_push(&queue, &(ang_event){.kind = ANG_EVENT_CHARACTER, .code = 'v', .repeat = true});
    assert_false(ang_event_waits(&queue));
    ang_event_push(&queue, &(ang_event){.kind = ANG_EVENT_KEY, .code = ANG_KEY_UP, .down = true, .repeat = true});
    assert_true(ang_event_waits(&queue));
    queue = (ang_event_queue){0};
    ang_event_push(&queue, &(ang_event){.kind = ANG_EVENT_KEY, .code = 'V', .down = false});
    assert_true(ang_event_waits(&queue));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(twenty_clicks_within_one_frame_all_arrive),
        cmocka_unit_test(keys_wait_while_they_are_held_back),
        cmocka_unit_test(a_fast_drag_keeps_its_ends),
        cmocka_unit_test(taps_of_a_key_are_not_swallowed),
        cmocka_unit_test(keys_go_down_one_by_one),
        cmocka_unit_test(keys_come_after_what_the_pointer_did),
        cmocka_unit_test(wheel_turns_add_up_and_end_moves),
        cmocka_unit_test(double_clicks_go_by_the_hand_not_by_frames),
        cmocka_unit_test(releases_survive_a_full_queue),
        cmocka_unit_test(keys_go_up_where_the_focus_is_lost),
        cmocka_unit_test(letters_held_down_ask_for_nothing_new),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
