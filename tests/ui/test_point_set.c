/* Several points of a transfer function at once. */
#include "tests/core/fixtures.h"

#include "ui/state/point_set.h"

#include <string.h>

static void start(ang_document *document) {
    static const ang_transfer_point points[] = {{.hu = -100, .opacity = 0},
                                                {.hu = 100, .opacity = 0.04},
                                                {.hu = 300, .opacity = 0.36},
                                                {.hu = 500, .opacity = 0.64},
                                                {.hu = 900, .opacity = 0.2}};
    *document = (ang_document){.count = 5, .unit_distance = 1, .stretch = 1};
    memcpy(document->points, points, sizeof points);
}

static void a_box_chooses_what_lies_in_it(void **state) {
    (void)state;
    ang_document document;
    ang_point_set set = {0};
    start(&document);
    /* Heights are square roots: 0.2, 0.6 and 0.8 for the points in the middle. Corners in any order. */
    ang_point_set_add_box(&set, &document, (double[]){600, 50}, (double[]){0.7, 0.1});
    assert_int_equal(ang_point_set_count(&set, &document), 2);
    assert_true(set.has[1] && set.has[2]);
    assert_int_equal(ang_point_set_first(&set, &document), 1);
    ang_point_set_add_box(&set, &document, (double[]){500, 500}, (double[]){0.8, 0.8});
    assert_true(set.has[1] && set.has[2] && set.has[3]);
    ang_point_set_all(&set, &document);
    assert_int_equal(ang_point_set_count(&set, &document), 5);
    ang_point_set_only(&set, -1);
    assert_int_equal(ang_point_set_first(&set, &document), -1);
}

static void points_move_together_and_stop_at_others(void **state) {
    (void)state;
    ang_document from, document;
    ang_point_set set = {0};
    start(&from);
    set.has[1] = set.has[2] = true;
    ang_points_move(&document, &from, &set, (ang_point_shift){.hu = 50, .opacity = 0.1});
    assert_close(document.points[1].hu, 150, 1e-12);
    assert_close(document.points[2].hu, 350, 1e-12);
    assert_close(document.points[1].opacity, 0.14, 1e-12);
    assert_close(document.points[2].opacity, 0.46, 1e-12);
    assert_close(document.points[3].hu, 500, 0);
    assert_true(document.edited);
    /* The one in front meets a point that stays; the one behind keeps its distance. */
    ang_points_move(&document, &from, &set, (ang_point_shift){.hu = 1000});
    assert_close(document.points[2].hu, 500, 1e-12);
    assert_close(document.points[1].hu, 300, 1e-12);
    ang_points_move(&document, &from, &set, (ang_point_shift){.hu = -1000, .opacity = -1});
    assert_close(document.points[1].hu, -100, 1e-12);
    assert_close(document.points[2].hu, 100, 1e-12);
    assert_close(document.points[1].opacity, 0, 1e-12);
    assert_close(document.points[2].opacity, 0.32, 1e-12);
    ang_points_move(&document, &from, &set, (ang_point_shift){.height = 5});
    assert_close(document.points[2].opacity, 1, 1e-12);
    assert_close(document.points[1].opacity, 0.36, 1e-12); /* as much higher: 0.2 + 0.4, squared */
    /* Not next to one another: each has its own neighbours. */
    set = (ang_point_set){0};
    set.has[0] = set.has[3] = true;
    ang_points_move(&document, &from, &set, (ang_point_shift){.hu = 1e9});
    assert_close(document.points[0].hu, 100, 1e-12);
    assert_close(document.points[3].hu, 700, 1e-12);
    ang_point_set_all(&set, &from);
    ang_points_move(&document, &from, &set, (ang_point_shift){.hu = 12345});
    for (int i = 0; i < from.count; i++) assert_close(document.points[i].hu, from.points[i].hu + 12345, 1e-9);
}

/* Any moves in any order leave points that rise, with opacities that may be. */
static void order_is_kept(void **state) {
    (void)state;
    uint64_t seed = 7;
    for (int trial = 0; trial < 2000; trial++) {
        ang_document from, document;
        ang_point_set set = {0};
        start(&from);
        from.points[2].hu = from.points[1].hu; /* a step */
        for (int i = 0; i < from.count; i++) {
            seed = seed * 6364136223846793005u + 1442695040888963407u;
            set.has[i] = seed >> 63;
        }
        double across = (double)(int64_t)(seed >> 20) / 1e10 - 900, up = (double)(seed >> 40) / 1e7 - 0.8;
        ang_points_move(&document, &from, &set,
                        (ang_point_shift){.hu = across, .opacity = trial % 2 ? up : 0, .height = trial % 2 ? 0 : up});
        for (int i = 0; i < from.count; i++) {
            if (i > 0) assert_true(document.points[i].hu >= document.points[i - 1].hu);
            assert_true(document.points[i].opacity >= 0 && document.points[i].opacity <= 1);
            if (!set.has[i]) assert_memory_equal(&document.points[i], &from.points[i], sizeof from.points[i]);
        }
    }
}

static void extinctions_stay_what_they_are(void **state) {
    (void)state;
    ang_document from, document;
    ang_point_set set = {0};
    start(&from);
    from.by_extinction = true;
    from.points[2].opacity = 3.7; /* per mm */
    set.has[2] = true;
    ang_points_move(&document, &from, &set, (ang_point_shift){.hu = 10});
    assert_close(document.points[2].opacity, 3.7, 0);
    ang_points_move(&document, &from, &set, (ang_point_shift){.opacity = -0.1});
    assert_close(ang_document_opacity(&document, 2), -expm1(-3.7) - 0.1, 1e-12);
}

static void the_last_point_is_never_deleted(void **state) {
    (void)state;
    ang_document document;
    ang_point_set set = {0};
    start(&document);
    set.has[1] = set.has[3] = true;
    ang_points_colour(&document, &set, (double[]){0.1, 0.2, 0.3});
    assert_close(document.points[3].colour[1], 0.2, 0);
    assert_close(document.points[2].colour[1], 0, 0);
    ang_points_delete(&document, &set);
    assert_int_equal(document.count, 3);
    assert_close(document.points[1].hu, 300, 0);
    assert_int_equal(ang_point_set_count(&set, &document), 0);
    ang_point_set_all(&set, &document);
    ang_points_delete(&document, &set);
    assert_int_equal(document.count, 1);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_box_chooses_what_lies_in_it),
        cmocka_unit_test(points_move_together_and_stop_at_others),
        cmocka_unit_test(order_is_kept),
        cmocka_unit_test(extinctions_stay_what_they_are),
        cmocka_unit_test(the_last_point_is_never_deleted),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
