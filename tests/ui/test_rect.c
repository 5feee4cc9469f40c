/* Lines that go around rectangles, beside a walk along them. */
#include "tests/core/fixtures.h"

#include "ui/toolkit/rect.h"

enum { STEPS = 4001, BOXES = 6 };

static bool inside(const ang_rect *box, double x, double y, double by) {
    return x > box->x + by && y > box->y + by && x < box->x + box->width - by && y < box->y + box->height - by;
}

/* Whether (x, y) is on one of the pieces. */
static bool on_piece(double pieces[][4], int count, double x, double y) {
    for (int i = 0; i < count; i++) {
        const double *p = pieces[i];
        double by[2] = {p[2] - p[0], p[3] - p[1]}, length = hypot(by[0], by[1]);
        double along = ((x - p[0]) * by[0] + (y - p[1]) * by[1]) / length;
        if (along >= -1e-9 && along <= length + 1e-9) return true;
    }
    return false;
}

static void a_line_goes_around_boxes(void **state) {
    (void)state;
    uint64_t seed = 9;
    for (int trial = 0; trial < 200; trial++) {
        ang_rect box[BOXES];
        double line[4], pieces[ANG_LINE_PIECES][4];
        for (int i = 0; i < BOXES; i++)
            box[i] = (ang_rect){100 * random_unit(&seed), 100 * random_unit(&seed), 1 + 40 * random_unit(&seed),
                                1 + 40 * random_unit(&seed)};
        for (int i = 0; i < 4; i++) line[i] = 140 * random_unit(&seed);
        if (trial % 4 == 0) line[2] = line[0]; /* upright */
        if (trial % 4 == 1) line[3] = line[1]; /* level */
        int count = ang_line_outside(line, box, BOXES, pieces);
        for (int k = 0; k < STEPS; k++) {
            double t = (double)k / (STEPS - 1);
            double x = line[0] + t * (line[2] - line[0]), y = line[1] + t * (line[3] - line[1]);
            bool covered = false, near = false;
            for (int i = 0; i < BOXES; i++) {
                covered = covered || inside(&box[i], x, y, 1e-6);
                near = near || inside(&box[i], x, y, -1e-6);
            }
            if (covered) assert_false(on_piece(pieces, count, x, y));
            if (!near) assert_true(on_piece(pieces, count, x, y));
        }
    }
}

static void a_line_without_boxes_stays_whole(void **state) {
    (void)state;
    double line[4] = {3, 4, 50, 60}, pieces[ANG_LINE_PIECES][4];
    assert_int_equal(ang_line_outside(line, NULL, 0, pieces), 1);
    for (int i = 0; i < 4; i++) assert_close(pieces[0][i], line[i], 1e-12);
    ang_rect all = {0, 0, 100, 100};
    assert_int_equal(ang_line_outside(line, &all, 1, pieces), 0);
}

static void an_inset_keeps_the_middle(void **state) {
    (void)state;
    ang_rect rect = ang_rect_inset((ang_rect){10, 20, 30, 40}, 2);
    assert_true(rect.x == 12 && rect.y == 22 && rect.x + rect.width == 38 && rect.y + rect.height == 58);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(an_inset_keeps_the_middle),
        cmocka_unit_test(a_line_goes_around_boxes),
        cmocka_unit_test(a_line_without_boxes_stays_whole),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
