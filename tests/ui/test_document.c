/* Editing a transfer function, and taking it back. */
#include "tests/core/fixtures.h"

#include "ui/state/document.h"

#include <string.h>

static void start(ang_document *document) {
    static const ang_transfer_point points[] = {{.hu = -100, .opacity = 0},
                                                {.hu = 100, .colour = {1, 0, 0}, .opacity = 0},
                                                {.hu = 300, .colour = {1, 0.5, 0}, .opacity = 0.4},
                                                {.hu = 500, .colour = {1, 1, 1}, .opacity = 0.8}};
    ang_preset preset = {.name = "test", .mode = ANG_MODE_DVR, .iso_hu = NAN, .window_centre = 77, .window_width = 88};
    preset.transfer = ang_transfer_create(points, 4, 2, false, NULL, NULL);
    assert_non_null(preset.transfer);
    memset(document, 0, sizeof *document);
    document->view = ang_view_default;
    document->window_width = 400;
    ang_document_take_preset(document, &preset);
    ang_transfer_free(preset.transfer);
}

static void presets_come_over_whole(void **state) {
    (void)state;
    ang_document document;
    start(&document);
    assert_int_equal(document.count, 4);
    assert_false(document.edited);
    assert_close(document.window_width, 400, 0); /* the slices' window stays */
    ang_transfer *transfer = ang_document_transfer(&document, NULL);
    assert_close(ang_transfer_opacity(transfer, 200), 0.2, 1e-12);
    assert_close(ang_transfer_extinction(transfer, 500), -log1p(-0.8) / 2, 1e-12);
    ang_transfer_free(transfer);
}

static void a_new_point_changes_nothing_yet(void **state) {
    (void)state;
    ang_document document;
    start(&document);
    ang_transfer *before = ang_document_transfer(&document, NULL);
    assert_int_equal(ang_document_add_point(&document, 350), 3);
    assert_int_equal(ang_document_add_point(&document, -500), 0);
    assert_int_equal(ang_document_add_point(&document, 2000), 6);
    assert_true(document.edited);
    ang_transfer *after = ang_document_transfer(&document, NULL);
    for (double hu = -700; hu < 2500; hu += 13) {
        double a[3], b[3];
        assert_close(ang_transfer_opacity(after, hu), ang_transfer_opacity(before, hu), 1e-12);
        ang_transfer_colour(before, hu, a);
        ang_transfer_colour(after, hu, b);
        for (int i = 0; i < 3; i++) assert_close(b[i], a[i], 1e-12);
    }
    ang_transfer_free(before);
    ang_transfer_free(after);
    while (document.count < ANG_DOCUMENT_POINTS) assert_true(ang_document_add_point(&document, 400) >= 0);
    assert_int_equal(ang_document_add_point(&document, 400), -1);
}

static void points_keep_their_order_and_range(void **state) {
    (void)state;
    ang_document document;
    start(&document);
    ang_document_move_point(&document, 2, 900, 7);
    assert_close(document.points[2].hu, 500, 0);
    assert_close(document.points[2].opacity, 1, 0);
    ang_document_move_point(&document, 2, -900, -7);
    assert_close(document.points[2].hu, 100, 0);
    assert_close(document.points[2].opacity, 0, 0);
    for (int i = 0; i < 10; i++) ang_document_delete_point(&document, 0);
    assert_int_equal(document.count, 1);
    document.by_extinction = true;
    ang_document_move_point(&document, 0, 10, 0.75);
    assert_close(document.points[0].opacity, -log(0.25) / 2, 1e-12);
    assert_close(ang_document_opacity(&document, 0), 0.75, 1e-12);
    ang_document_move_point(&document, 0, 10, 1);
    ang_transfer *transfer = ang_document_transfer(&document, NULL);
    assert_non_null(transfer); /* opacity 1 is a value that is accepted */
    ang_transfer_free(transfer);
}

/* What shows begins at 100 and ends at 500: shift and stretch are about 300. */
static void bending_moves_and_widens_what_shows(void **state) {
    (void)state;
    ang_document document, bent;
    start(&document);
    document.iso_hu = 250;
    bent = document;
    ang_document_bend(&bent, &document, 50, 2);
    static const double expected[] = {-450, -50, 350, 750};
    for (int i = 0; i < 4; i++) assert_close(bent.points[i].hu, expected[i], 1e-9);
    assert_close(bent.iso_hu, 250, 1e-9);
    assert_close(bent.points[2].opacity, 0.4, 0);
    ang_document again = bent;
    ang_document_bend(&again, &bent, -50, 0.5);
    assert_close(again.shift_hu, 0, 1e-9);
    assert_close(again.stretch, 1, 1e-12);
    for (int i = 0; i < 4; i++) assert_close(again.points[i].hu, document.points[i].hu, 1e-9);
}

/* Light that went through is what is left of the power of what went through before. */
static void strengthening_multiplies_extinction(void **state) {
    (void)state;
    ang_document document, other;
    start(&document);
    document.points[3].opacity = 1;
    other = document;
    ang_document_strengthen(&other, &document, 2);
    assert_close(other.points[1].opacity, 0, 0);
    assert_close(other.points[2].opacity, 1 - 0.6 * 0.6, 1e-12);
    assert_close(other.points[3].opacity, 1, 0);
    assert_true(other.edited);
    ang_document_strengthen(&other, &other, 0.5);
    assert_close(other.points[2].opacity, 0.4, 1e-12);
    document.by_extinction = true;
    document.points[3].opacity = 7;
    ang_document_strengthen(&other, &document, 3);
    assert_close(other.points[2].opacity, 0.4 * 3, 1e-12);
    assert_close(other.points[3].opacity, 21, 1e-12);
}

/* Only what shows makes a new picture. */
static void renderings_are_told_apart(void **state) {
    (void)state;
    ang_document document, other;
    start(&document);
    other = document;
    other.window_width = 1;
    other.slab_mm = 3;
    other.iso_hu = 5;
    other.edited = true;
    other.turn = ang_turn_none;
    assert_true(ang_document_same_rendering(&document, &other));
    document.mode = other.mode = ANG_MODE_MIP;
    assert_false(ang_document_same_rendering(&document, &other));
    other.window_width = document.window_width;
    other.points[1].opacity = 0.5;
    assert_true(ang_document_same_rendering(&document, &other));
    document.mode = other.mode = ANG_MODE_ISO;
    assert_false(ang_document_same_rendering(&document, &other));
    other = document;
    other.view.roll_deg = 1e-9;
    assert_false(ang_document_same_rendering(&document, &other));
    other = document;
    other.phong.power++;
    assert_false(ang_document_same_rendering(&document, &other));
    other = document;
    other.view.pan_mm[1] = -1;
    assert_false(ang_document_same_rendering(&document, &other));
}

static void what_cuts_the_volume_shows_only_while_it_does(void **state) {
    (void)state;
    ang_document document, other;
    start(&document);
    other = document;
    other.crop_upper = (ang_vec3){9, 9, 9};
    assert_true(ang_document_same_rendering(&document, &other)); /* the box is off in both */
    document.crop = other.crop = true;
    assert_false(ang_document_same_rendering(&document, &other));
    other.crop_upper = document.crop_upper;
    assert_true(ang_document_same_rendering(&document, &other));
    other.crop = false;
    assert_false(ang_document_same_rendering(&document, &other));
    other = document;
    other.clip = (ang_clip_plane){{0, 0, 1}, 0};
    assert_false(ang_document_same_rendering(&document, &other));
    document.clip = (ang_clip_plane){{0, 0, 1}, 1};
    assert_false(ang_document_same_rendering(&document, &other));
}

/* Also a box that is off is a step that can be taken back. */
static void crop_and_clip_are_undone(void **state) {
    (void)state;
    ang_history history = {0};
    ang_document document;
    start(&document);
    ang_history_note(&history, &document, 0);
    document.crop_lower.y = 3;
    ang_history_note(&history, &document, 1);
    document.crop = true;
    ang_history_note(&history, &document, 2);
    document.clip = (ang_clip_plane){{1, 0, 0}, 7};
    ang_history_note(&history, &document, 3);
    assert_true(ang_history_undo(&history, &document));
    assert_close(document.clip.normal.x, 0, 0);
    assert_true(document.crop);
    assert_true(ang_history_undo(&history, &document));
    assert_false(document.crop);
    assert_close(document.crop_lower.y, 3, 0);
    assert_true(ang_history_undo(&history, &document));
    assert_close(document.crop_lower.y, 0, 0);
    assert_false(ang_history_undo(&history, &document));
    ang_history_clear(&history);
}

static void undo_and_redo_walk_the_states(void **state) {
    (void)state;
    ang_history history = {0};
    ang_document document;
    start(&document);
    ang_history_note(&history, &document, 0);
    assert_false(ang_history_can_undo(&history));
    for (int i = 1; i <= 3; i++) {
        ang_document_move_point(&document, 3, 500 + 10 * i, 0.8);
        ang_history_note(&history, &document, i * 0.1);
        ang_history_note(&history, &document, i * 0.1); /* nothing new */
    }
    for (int i = 2; i >= 0; i--) {
        assert_true(ang_history_undo(&history, &document));
        assert_close(document.points[3].hu, 500 + 10 * i, 0);
    }
    assert_false(ang_history_undo(&history, &document));
    assert_true(ang_history_redo(&history, &document));
    assert_close(document.points[3].hu, 510, 0);
    ang_history_note(&history, &document, 5); /* what is shown is known */
    assert_true(ang_history_can_redo(&history));
    ang_document_delete_point(&document, 0);
    ang_history_note(&history, &document, 6);
    assert_false(ang_history_can_redo(&history));
    assert_true(ang_history_undo(&history, &document));
    assert_int_equal(document.count, 4);
    ang_history_clear(&history);
}

/* Turns of the wheel in a row are one step back; what comes later or is something else is another. */
static void one_gesture_is_one_step(void **state) {
    (void)state;
    ang_history history = {0};
    ang_document document;
    start(&document);
    ang_history_note(&history, &document, 0);
    for (int i = 0; i < 10; i++) {
        document.view.zoom *= 1.5;
        document.view.pan_mm[1] += 2;
        ang_history_note(&history, &document, 1 + 0.1 * i);
    }
    document.view.zoom = 90;
    ang_history_note(&history, &document, 10);
    document.window_centre = 5;
    ang_history_note(&history, &document, 10.1);
    document.window_centre = 6;
    ang_history_note(&history, &document, 10.2);
    assert_true(ang_history_undo(&history, &document));
    assert_close(document.window_centre, 5, 0);
    assert_true(ang_history_undo(&history, &document));
    assert_close(document.window_centre, 0, 0);
    assert_close(document.view.zoom, 90, 0);
    assert_true(ang_history_undo(&history, &document));
    assert_close(document.view.pan_mm[1], 20, 1e-12);
    assert_true(ang_history_undo(&history, &document));
    assert_close(document.view.zoom, 1, 0);
    assert_false(ang_history_can_undo(&history));
    ang_history_clear(&history);
}

/* Scrolling for however long is one step; after an undo it is none and leaves what can be redone. */
static void looking_around_is_one_step(void **state) {
    (void)state;
    ang_history history = {0};
    ang_document document;
    start(&document);
    ang_history_note(&history, &document, 0);
    document.points[3].hu = 600;
    ang_history_note(&history, &document, 1);
    for (int i = 1; i <= 50; i++) {
        document.crosshair.z = i;
        ang_history_note(&history, &document, 1 + 3 * i);
    }
    document.points[3].hu = 700;
    ang_history_note(&history, &document, 200);
    assert_true(ang_history_undo(&history, &document));
    assert_close(document.points[3].hu, 600, 0);
    assert_close(document.crosshair.z, 50, 0);
    document.crosshair.z = 7;
    ang_history_note(&history, &document, 201);
    assert_true(ang_history_redo(&history, &document));
    assert_close(document.points[3].hu, 700, 0);
    assert_true(ang_history_undo(&history, &document));
    assert_close(document.crosshair.z, 7, 0);
    assert_true(ang_history_undo(&history, &document));
    assert_close(document.crosshair.z, 0, 0);
    assert_close(document.points[3].hu, 600, 0);
    assert_true(ang_history_undo(&history, &document));
    assert_false(ang_history_undo(&history, &document));
    ang_history_clear(&history);
}

/* Zoom and pan of slices go with those of the volume; the method is a step. */
static void slices_and_method_are_undone(void **state) {
    (void)state;
    ang_history history = {0};
    ang_document document;
    start(&document);
    ang_history_note(&history, &document, 0);
    for (int i = 1; i <= 3; i++) {
        document.slice_view[1].zoom = 1 + i;
        document.slice_view[2].pan_mm[0] = 5 * i;
        document.crosshair.x = i;
        ang_history_note(&history, &document, 0.3 * i);
    }
    document.method = 2;
    ang_history_note(&history, &document, 1);
    document.slice_view[0].zoom = 9;
    ang_history_note(&history, &document, 1.1);
    assert_true(ang_history_undo(&history, &document));
    assert_int_equal(document.method, 2);
    assert_true(document.slice_view[0].zoom < 9);
    assert_true(ang_history_undo(&history, &document));
    assert_int_equal(document.method, 0);
    assert_close(document.slice_view[1].zoom, 4, 0);
    assert_close(document.slice_view[2].pan_mm[0], 15, 0);
    assert_true(ang_history_undo(&history, &document));
    assert_true(document.slice_view[1].zoom < 4);
    assert_close(document.slice_view[2].pan_mm[0], 0, 0);
    assert_close(document.crosshair.x, 0, 0);
    assert_false(ang_history_undo(&history, &document));
    ang_history_clear(&history);
}

static void old_states_are_forgotten_not_new_ones(void **state) {
    (void)state;
    ang_history history = {0};
    ang_document document;
    start(&document);
    for (int i = 0; i < 700; i++) {
        document.points[3].hu = 1000 + i;
        ang_history_note(&history, &document, i);
    }
    int steps = 0;
    while (ang_history_undo(&history, &document)) steps++;
    assert_int_equal(steps, 499);
    assert_close(document.points[3].hu, 1200, 0);
    ang_history_clear(&history);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_cuts_the_volume_shows_only_while_it_does),
        cmocka_unit_test(crop_and_clip_are_undone),
        cmocka_unit_test(presets_come_over_whole),
        cmocka_unit_test(a_new_point_changes_nothing_yet),
        cmocka_unit_test(points_keep_their_order_and_range),
        cmocka_unit_test(bending_moves_and_widens_what_shows),
        cmocka_unit_test(strengthening_multiplies_extinction),
        cmocka_unit_test(renderings_are_told_apart),
        cmocka_unit_test(undo_and_redo_walk_the_states),
        cmocka_unit_test(one_gesture_is_one_step),
        cmocka_unit_test(looking_around_is_one_step),
        cmocka_unit_test(slices_and_method_are_undone),
        cmocka_unit_test(old_states_are_forgotten_not_new_ones),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
