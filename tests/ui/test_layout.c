/* The window's parts tile it without overlap at every size, and gaps follow the hand. */
#include "tests/core/fixtures.h"

#include "ui/state/layout.h"

static const ang_layout_frame hd = {1280, 720, 27, 24, 1, -1};

static double right_of(ang_rect rect) { return rect.x + rect.width; }
static double below(ang_rect rect) { return rect.y + rect.height; }

static double overlap(ang_rect a, ang_rect b) {
    double width = fmin(right_of(a), right_of(b)) - fmax(a.x, b.x);
    double height = fmin(below(a), below(b)) - fmax(a.y, b.y);
    return width > 0 && height > 0 ? width * height : 0;
}

static bool whole(ang_rect rect) {
    return rect.x == floor(rect.x) && rect.y == floor(rect.y) && rect.width == floor(rect.width) &&
           rect.height == floor(rect.height);
}

/* What is covered and the gaps are the window; nothing is covered twice. */
static void expect_tiling(const ang_layout *layout, const ang_layout_frame *frame) {
    ang_layout_places places = ang_layout_place(layout, frame);
    ang_rect all[6] = {places.pane[0], places.pane[1], places.pane[2], places.pane[3], places.panel, places.status};
    double area = frame->top * frame->width;
    for (int i = 0; i < 6; i++) {
        assert_true(whole(all[i]));
        assert_true(all[i].x >= 0 && all[i].y >= 0 && all[i].width >= 0 && all[i].height >= 0);
        assert_true(right_of(all[i]) <= frame->width && below(all[i]) <= frame->height);
        for (int k = 0; k < i; k++) assert_true(overlap(all[i], all[k]) <= 0);
        area += all[i].width * all[i].height;
    }
    double gap = round(4 * frame->scale), panes_wide = places.panes.width, panes_tall = places.panes.height;
    double gaps = layout->panel_hidden ? 0 : gap * panes_tall;
    if (frame->maximised < 0) gaps += gap * panes_wide + gap * panes_tall - gap * gap;
    assert_close(area + gaps, frame->width * frame->height, 1e-6);
}

static void the_parts_tile_the_window(void **state) {
    (void)state;
    static const double sizes[][2] = {{1280, 720}, {1920, 1080}, {3840, 2160}, {1281, 777}, {2560, 1440}};
    static const double scales[] = {1, 1.25, 1.5, 2};
    for (int size = 0; size < 5; size++)
        for (int scale = 0; scale < 4; scale++)
            for (int share = 1; share < 10; share++)
                for (int large = -1; large < 4; large++) {
                    ang_layout layout = {share / 10.0, 1 - share / 10.0, 300 + 30 * share, share % 2};
                    double s = scales[scale];
                    ang_layout_frame frame = {sizes[size][0], sizes[size][1], round(27 * s), round(24 * s), s, large};
                    expect_tiling(&layout, &frame);
                }
}

static void at_first_the_panes_are_equal(void **state) {
    (void)state;
    ang_layout_places places = ang_layout_place(&ang_layout_default, &hd);
    assert_close(places.panel.width, 320, 0);
    for (int i = 1; i < 4; i++) {
        assert_close(places.pane[i].width, places.pane[0].width, 1);
        assert_close(places.pane[i].height, places.pane[0].height, 1);
    }
    /* 1280 - 320 - 4 for the panel's gap, less one gap, halved */
    assert_close(places.pane[0].width, (1280 - 324 - 4) / 2, 1);
    assert_close(places.pane[0].height, (720 - 27 - 24 - 4) / 2.0, 1);
}

static void a_gap_follows_the_hand(void **state) {
    (void)state;
    ang_layout_places before = ang_layout_place(&ang_layout_default, &hd);
    ang_layout moved = ang_layout_drag(&ang_layout_default, &hd, ANG_GRIP_CROSS, 70, -45);
    ang_layout_places after = ang_layout_place(&moved, &hd);
    assert_close(after.pane[0].width, before.pane[0].width + 70, 0);
    assert_close(after.pane[0].height, before.pane[0].height - 45, 0);
    assert_close(after.grip[ANG_GRIP_CROSS].x, before.grip[ANG_GRIP_CROSS].x + 70, 0);
    moved = ang_layout_drag(&ang_layout_default, &hd, ANG_GRIP_ACROSS, -33, 99);
    assert_close(moved.down, ang_layout_default.down, 0);
    after = ang_layout_place(&moved, &hd);
    assert_close(after.pane[2].width, before.pane[2].width - 33, 0);
    moved = ang_layout_drag(&ang_layout_default, &hd, ANG_GRIP_DOWN, 50, 21);
    assert_close(moved.across, ang_layout_default.across, 0);
    assert_close(ang_layout_place(&moved, &hd).pane[1].height, before.pane[1].height + 21, 0);
    moved = ang_layout_drag(&ang_layout_default, &hd, ANG_GRIP_PANEL, 60, 5);
    assert_close(moved.panel, 380, 0);
    assert_close(ang_layout_place(&moved, &hd).panel.width, 380, 0);
}

/* At scale 2 the hand's pixels are half as much of the panel's width. */
static void the_panel_is_measured_at_scale_1(void **state) {
    (void)state;
    ang_layout_frame frame = {3840, 2160, 54, 48, 2, -1};
    ang_layout moved = ang_layout_drag(&ang_layout_default, &frame, ANG_GRIP_PANEL, 60, 0);
    assert_close(moved.panel, 350, 0);
    assert_close(ang_layout_place(&moved, &frame).panel.width, 700, 0);
}

static void nothing_is_dragged_away(void **state) {
    (void)state;
    for (int sign = -1; sign <= 1; sign += 2) {
        ang_layout moved = ang_layout_drag(&ang_layout_default, &hd, ANG_GRIP_CROSS, sign * 5000, sign * 5000);
        ang_layout_places places = ang_layout_place(&moved, &hd);
        assert_true(ang_layout_valid(&moved));
        for (int i = 0; i < 4; i++) assert_true(places.pane[i].width >= 180 && places.pane[i].height >= 120);
        moved = ang_layout_drag(&ang_layout_default, &hd, ANG_GRIP_PANEL, sign * 5000, 0);
        assert_true(ang_layout_valid(&moved));
        places = ang_layout_place(&moved, &hd);
        assert_true(places.panel.width >= 280);
        for (int i = 0; i < 4; i++) assert_true(places.pane[i].width >= 180);
    }
    /* A window too small for all least sizes: the panel gives way to its least, then the panes share what is left. */
    ang_layout_frame tiny = {640, 300, 27, 24, 1, -1};
    ang_layout wide = {0.5, 0.5, 500, false};
    ang_layout_places places = ang_layout_place(&wide, &tiny);
    assert_close(places.panel.width, 280, 0);
    for (int i = 0; i < 4; i++) assert_true(places.pane[i].width > 150 && places.pane[i].height > 110);
    expect_tiling(&wide, &tiny);
}

static void a_double_click_evens(void **state) {
    (void)state;
    ang_layout odd = {0.3, 0.7, 400, true};
    ang_layout even = ang_layout_even(&odd, ANG_GRIP_ACROSS);
    assert_true(even.across == 0.5 && even.down == 0.7 && even.panel == 400 && even.panel_hidden);
    even = ang_layout_even(&odd, ANG_GRIP_CROSS);
    assert_true(even.across == 0.5 && even.down == 0.5 && even.panel == 400);
    even = ang_layout_even(&odd, ANG_GRIP_PANEL);
    assert_true(even.across == 0.3 && even.panel == 320);
}

static void hidden_and_maximised_parts_cannot_be_held(void **state) {
    (void)state;
    ang_layout hidden = ang_layout_default;
    hidden.panel_hidden = true;
    ang_layout_places places = ang_layout_place(&hidden, &hd);
    assert_true(places.panel.width == 0 && places.grip[ANG_GRIP_PANEL].width == 0 && places.panes.x == 0);
    ang_layout_frame large = hd;
    large.maximised = 2;
    places = ang_layout_place(&ang_layout_default, &large);
    assert_true(places.grip[ANG_GRIP_CROSS].width == 0 && places.grip[ANG_GRIP_DOWN].width == 0);
    assert_true(places.grip[ANG_GRIP_PANEL].width > 0);
    assert_true(places.pane[0].width == 0 && places.pane[2].width == places.panes.width);
}

static void numbers_of_a_file_are_judged(void **state) {
    (void)state;
    assert_true(ang_layout_valid(&ang_layout_default));
    assert_false(ang_layout_valid(&(ang_layout){0, 0.5, 320, false}));
    assert_false(ang_layout_valid(&(ang_layout){0.5, 1.5, 320, false}));
    assert_false(ang_layout_valid(&(ang_layout){0.5, NAN, 320, false}));
    assert_false(ang_layout_valid(&(ang_layout){0.5, 0.5, 12, false}));
    assert_false(ang_layout_valid(&(ang_layout){0.5, 0.5, 1e9, false}));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_parts_tile_the_window),
        cmocka_unit_test(at_first_the_panes_are_equal),
        cmocka_unit_test(a_gap_follows_the_hand),
        cmocka_unit_test(the_panel_is_measured_at_scale_1),
        cmocka_unit_test(nothing_is_dragged_away),
        cmocka_unit_test(a_double_click_evens),
        cmocka_unit_test(hidden_and_maximised_parts_cannot_be_held),
        cmocka_unit_test(numbers_of_a_file_are_judged),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
