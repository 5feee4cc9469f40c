/* Measures in a document, and where their marks and labels lie in a pane. */
#include "tests/core/fixtures.h"
#include "tests/core/regions.h"

#include "ui/state/document.h"
#include "ui/state/measure_marks.h"

/* Undo knows every change; the volume rendering only those of lengths that are shown. */
static void undo_and_the_volume_see_what_concerns_them(void **state) {
    (void)state;
    ang_document *a = calloc(1, sizeof *a), *b = calloc(1, sizeof *b);
    assert_non_null(a);
    assert_non_null(b);
    a->count = b->count = 1;
    a->view = b->view = ang_view_default;
    ang_history history = {0};
    ang_history_note(&history, a, 0);
    ang_measurement r = axial_region(ANG_MEASURE_RECTANGLE, 0, 0, 3, 4, 0);
    ang_measures_add(&b->measures, &r);
    assert_true(ang_document_same_rendering(a, b));
    ang_history_note(&history, b, 10);
    ang_measurement length = {.kind = ANG_MEASURE_LENGTH, .point = {{0, 0, 0}, {1, 0, 0}}};
    ang_measures_add(&b->measures, &length);
    assert_false(ang_document_same_rendering(a, b));
    ang_history_note(&history, b, 20);
    *a = *b;
    b->measures.item[1].label_placed = true;
    b->measures.item[1].label_mm[0] = 3;
    assert_true(ang_document_same_rendering(a, b));
    ang_history_note(&history, b, 30);
    b->measures.item[1].point[1].x = 2;
    assert_false(ang_document_same_rendering(a, b));
    ang_history_note(&history, b, 40);
    a->measures.hidden = b->measures.hidden = true;
    assert_true(ang_document_same_rendering(a, b));
    assert_int_equal(history.count, 5);
    ang_history_undo(&history, a);
    assert_close(a->measures.item[1].point[1].x, 1, 0);
    assert_true(a->measures.item[1].label_placed);
    ang_history_undo(&history, a);
    assert_false(a->measures.item[1].label_placed);
    ang_history_undo(&history, a);
    assert_int_equal(a->measures.count, 1);
    ang_history_undo(&history, a);
    assert_int_equal(a->measures.count, 0);
    ang_history_clear(&history);
    free(a);
    free(b);
}

/* An axial pane of 20 x 15 mm. */
static ang_slice_frame frame_of(double z) {
    return (ang_slice_frame){.axes = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                             .corner = {-0.25, -0.25, z},
                             .mm_per_pixel = 0.05,
                             .width = 400,
                             .height = 300};
}

static void marks_belong_to_their_slice(void **state) {
    (void)state;
    ang_measurement r = axial_region(ANG_MEASURE_ELLIPSE, 2, 3, 10, 9, 4);
    ang_slice_frame here = frame_of(4), beside = frame_of(5), next = frame_of(6);
    assert_int_equal(ang_mark_presence(&r, &here, 2), ANG_PRESENCE_WITHIN);
    assert_int_equal(ang_mark_presence(&r, &beside, 2), ANG_PRESENCE_NEAR);
    assert_int_equal(ang_mark_presence(&r, &next, 2), ANG_PRESENCE_NONE);
    ang_measurement through = {.kind = ANG_MEASURE_LENGTH, .point = {{2, 3, 0}, {10, 7, 8}}};
    assert_int_equal(ang_mark_presence(&through, &next, 2), ANG_PRESENCE_CROSSES);
    double at[2], x, y;
    ang_mark_crossing(&through, &next, at);
    ang_slice_locate(&next, (ang_vec3){8, 6, 6}, &x, &y);
    assert_close(at[0], x, 1e-9);
    assert_close(at[1], y, 1e-9);
    through.point[1].z = 3;
    assert_int_equal(ang_mark_presence(&through, &next, 2), ANG_PRESENCE_NONE);
}

static void what_is_under_the_pointer_is_found(void **state) {
    (void)state;
    ang_slice_frame frame = frame_of(4);
    ang_measurement m = {.kind = ANG_MEASURE_LENGTH,
                         .point = {ang_slice_at(&frame, 50, 60), ang_slice_at(&frame, 250, 60)}};
    assert_int_equal(ang_mark_hit(&m, &frame, 53, 63, 7), 0);
    assert_int_equal(ang_mark_hit(&m, &frame, 246, 57, 7), 1);
    assert_int_equal(ang_mark_hit(&m, &frame, 150, 65, 7), ANG_MARK_LINE);
    assert_int_equal(ang_mark_hit(&m, &frame, 150, 70, 7), ANG_MARK_NOTHING);
    ang_measurement e = region(ANG_MEASURE_ELLIPSE, ang_slice_at(&frame, 50, 60), ang_slice_at(&frame, 250, 160),
                               frame.axes.right, frame.axes.down);
    assert_int_equal(ang_mark_hit(&e, &frame, 150, 61, 7), ANG_MARK_LINE);
    assert_int_equal(ang_mark_hit(&e, &frame, 150, 110, 7), ANG_MARK_NOTHING); /* the inside is free to draw in */
    assert_int_equal(ang_mark_hit(&e, &frame, 248, 62, 7), 1);
    assert_int_equal(ang_mark_hit(&e, &frame, 52, 158, 7), 2);
}

static bool covers(const ang_mark_box *box, double x, double y) {
    return x > box->left && x < box->right && y > box->top && y < box->bottom;
}

/* Wherever a mark lies, its label lies in the pane, as large as it is, and not over its ends. */
static void labels_never_cover_the_ends(void **state) {
    (void)state;
    ang_slice_frame frame = frame_of(4);
    uint64_t seed = 7;
    for (int round = 0; round < 4000; round++) {
        ang_measurement m = {.kind = (ang_measure_kind)(round % ANG_MEASURE_KINDS)};
        /* Ends anywhere but within the label's size of the edges, where there may be room nowhere. */
        for (int i = 0; i < 3; i++)
            m.point[i] = ang_slice_at(&frame, 90 + 220 * random_unit(&seed), 60 + 180 * random_unit(&seed));
        if (ang_measure_is_region(m.kind)) m.right = frame.axes.right, m.down = frame.axes.down;
        ang_mark_box box = ang_mark_label(&m, &frame, 70, 40, 6, NULL, 0);
        assert_close(box.right - box.left, 70, 1e-9);
        assert_close(box.bottom - box.top, 40, 1e-9);
        assert_true(box.left >= 0 && box.top >= 0 && box.right <= frame.width && box.bottom <= frame.height);
        ang_vec3 handle[ANG_MEASURE_HANDLES];
        int count = ang_measurement_handles(&m, handle);
        for (int i = 0; i < count; i++) {
            double x, y;
            ang_slice_locate(&frame, handle[i], &x, &y);
            assert_false(covers(&box, x, y));
        }
        /* What is taken is left free. */
        ang_mark_box other = ang_mark_label(&m, &frame, 70, 40, 6, &box, 1);
        double x = (other.left + other.right) / 2, y = (other.top + other.bottom) / 2;
        assert_false(covers(&box, x, y));
        /* Put by hand it goes where it was put, whatever is there. */
        m.label_placed = true;
        m.label_mm[0] = 12 * frame.mm_per_pixel, m.label_mm[1] = -9 * frame.mm_per_pixel;
        ang_slice_locate(&frame, ang_measurement_middle(&m), &x, &y);
        box = ang_mark_label(&m, &frame, 20, 10, 6, &other, 1);
        assert_close((box.left + box.right) / 2, x + 12, 1e-9);
        assert_close((box.top + box.bottom) / 2, y - 9, 1e-9);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(undo_and_the_volume_see_what_concerns_them),
        cmocka_unit_test(marks_belong_to_their_slice),
        cmocka_unit_test(what_is_under_the_pointer_is_found),
        cmocka_unit_test(labels_never_cover_the_ends),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
