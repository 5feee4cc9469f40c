/* Where panes show places, and what a drag on them means, against rays and closed forms. */
#include "tests/ui/volumes.h"

#include "ui/state/pane_map.h"

/* 40 x 60 x 50 mm, askew in the patient. */
static ang_volume *body(void) {
    ang_volume *volume = make_volume(41, 31, 11, (double[]){1, 2, 5}, zero);
    volume->affine.m[0][2] = 1.5;
    volume->affine.m[1][3] = -77;
    volume->affine.m[2][3] = 300;
    return volume;
}

static const ang_view views[] = {
    {.zoom = 1.6, .fov_deg = 30},
    {.azimuth_deg = 33, .elevation_deg = -21, .roll_deg = 12, .zoom = 3, .fov_deg = 30, .pan_mm = {4, -7}},
    {.azimuth_deg = -120, .elevation_deg = 71, .zoom = 0.7, .projection = ANG_PARALLEL, .fov_deg = 30}};
enum { VIEWS = 3, WIDTH = 480, HEIGHT = 330 };

static ang_pane_map map_of(const ang_volume *volume, const ang_view *view) {
    ang_camera camera = ang_camera_for(volume, view);
    return ang_pane_map_of_camera(&camera, WIDTH, HEIGHT);
}

static void places_appear_where_their_ray_passes(void **state) {
    (void)state;
    ang_volume *volume = body();
    for (int v = 0; v < VIEWS; v++) {
        ang_scene scene = ang_scene_default(volume);
        scene.width = WIDTH;
        scene.height = HEIGHT;
        scene.camera = ang_camera_for(volume, &views[v]);
        ang_ray_frame frame;
        assert_true(ang_ray_frame_make(volume, &scene, &frame, NULL));
        ang_pane_map map = map_of(volume, &views[v]);
        for (int i = 0; i < 30; i++) {
            double x = 16.5 * i, y = 11.0 * i + 3, at_x, at_y;
            ang_ray ray = ang_ray_through(&frame, x, y);
            ang_vec3 index = ang_vec3_add(ang_vec3_along(ray.origin, ray.direction, i - 12.0), frame.centre);
            ang_vec3 mm = ang_mat4_point(&volume->affine, index);
            assert_true(ang_pane_map_point(&map, mm, &at_x, &at_y));
            assert_close(at_x, x, 1e-8);
            assert_close(at_y, y, 1e-8);
            ang_vec3 origin, direction;
            ang_pane_map_ray(&map, x, y, &origin, &direction);
            assert_close(ang_vec3_length(ang_vec3_sub(direction, ray.direction_mm)), 0, 1e-10);
            assert_close(ang_vec3_length(ang_vec3_cross(ang_vec3_sub(mm, origin), direction)), 0, 1e-8);
        }
    }
    ang_volume_free(volume);
}

static void slices_are_maps_too(void **state) {
    (void)state;
    ang_volume *volume = body();
    ang_slice_view view = {.zoom = 1.3, .pan_mm = {4, -9}};
    for (int i = 0; i < ANG_ORIENTATIONS; i++) {
        ang_slice_frame frame = ang_slice_frame_make(volume, &ang_turn_none, (ang_orientation)i, &view,
                                                     (ang_vec3){3, -50, 320}, WIDTH, HEIGHT);
        ang_pane_map map = ang_pane_map_of_slice(&frame);
        double x, y;
        assert_true(ang_pane_map_point(&map, ang_slice_at(&frame, 123, 45), &x, &y));
        assert_close(x, 123, 1e-9);
        assert_close(y, 45, 1e-9);
        assert_close(ang_pane_map_scale(&map, frame.corner) * frame.mm_per_pixel, 1, 1e-12);
    }
    ang_volume_free(volume);
}

/* A drag undoes the projection: what has gone t steps has gone t steps, wherever beside its line the hand is. */
static void a_drag_goes_as_far_as_it_appears(void **state) {
    (void)state;
    ang_volume *volume = body();
    ang_vec3 from = ang_vec3_add(ang_volume_centre(volume), (ang_vec3){5, -6, 7});
    for (int v = 0; v < VIEWS; v++) {
        ang_pane_map map = map_of(volume, &views[v]);
        for (int i = 0; i < 40; i++) {
            ang_vec3 along = {cos(i), sin(i) * cos(3 * i), 1.3 * sin(i) * sin(3 * i)};
            double x0, y0, x, y, steps = 0.4 * (i - 20);
            ang_vec3 sight = ang_pane_map_sight(&map, from);
            if (ang_vec3_length(ang_vec3_cross(sight, along)) < 0.11 * ang_vec3_length(along)) continue;
            assert_true(ang_pane_map_point(&map, from, &x0, &y0));
            assert_true(ang_pane_map_point(&map, ang_vec3_along(from, along, steps), &x, &y));
            assert_close(ang_pane_map_drag(&map, from, along, x, y), steps, 1e-7);
            double beside_x = -(y - y0), beside_y = x - x0;
            assert_close(ang_pane_map_drag(&map, from, along, x + beside_x, y + beside_y), steps, 1e-7);
        }
    }
    ang_volume_free(volume);
}

static void beyond_the_vanishing_point_a_drag_goes_to_the_end(void **state) {
    (void)state;
    ang_volume *volume = body();
    ang_view view = {.azimuth_deg = 40, .zoom = 1, .fov_deg = 30};
    ang_pane_map map = map_of(volume, &view);
    ang_vec3 from = ang_volume_centre(volume),
             along = {0, 1, 0}; /* from the front towards the back: away from the eye */
    /* Its vanishing point: where the ray along it appears. */
    double end = WIDTH / 2.0 + map.focal * ang_vec3_dot(along, map.right) / ang_vec3_dot(along, map.forward);
    assert_true(end > WIDTH / 2.0);
    assert_true(ang_pane_map_drag(&map, from, along, end - 1, HEIGHT / 2.0) > 1000);
    assert_true(isinf(ang_pane_map_drag(&map, from, along, end + 1, HEIGHT / 2.0)));
    assert_true(ang_pane_map_drag(&map, from, along, end + 1, HEIGHT / 2.0) > 0);
    assert_true(ang_pane_map_drag(&map, from, ang_vec3_scale(along, -1), end + 1, HEIGHT / 2.0) < 0);
    ang_volume_free(volume);
}

/* Seen end on there is no way across: up is away from the eye. */
static void end_on_up_is_away(void **state) {
    (void)state;
    ang_volume *volume = body();
    for (int parallel = 0; parallel < 2; parallel++) {
        ang_view view = {.zoom = 1, .fov_deg = 30, .projection = parallel ? ANG_PARALLEL : ANG_PERSPECTIVE};
        ang_pane_map map = map_of(volume, &view);
        ang_vec3 from = ang_volume_centre(volume);
        double mm = 10 / ang_pane_map_scale(&map, from);
        double x = WIDTH / 2.0 + 33, y = HEIGHT / 2.0 - 10;
        assert_close(ang_pane_map_drag(&map, from, (ang_vec3){0, 2, 0}, x, y), mm / 2, 1e-9);
        assert_close(ang_pane_map_drag(&map, from, (ang_vec3){0, -2, 0}, x, y), -mm / 2, 1e-9);
    }
    ang_volume_free(volume);
}

static void what_is_behind_the_eye_does_not_show(void **state) {
    (void)state;
    ang_volume *volume = body();
    ang_pane_map map = map_of(volume, &views[0]);
    double x, y, ends[4];
    ang_vec3 before = ang_vec3_along(map.eye, map.forward, 10);
    before = ang_vec3_along(before, map.right, 3);
    ang_vec3 behind = ang_vec3_along(map.eye, map.forward, -10);
    assert_false(ang_pane_map_point(&map, behind, &x, &y));
    assert_false(ang_pane_map_line(&map, behind, ang_vec3_along(behind, map.right, 5), ends));
    assert_true(ang_pane_map_line(&map, behind, before, ends));
    assert_close(ends[2], WIDTH / 2.0 + 0.3 * map.focal, 1e-9);
    double part = (10 + map.near_mm) / 20; /* of the way, where it comes out of the near plane */
    assert_close(ends[0], WIDTH / 2.0 + 3 * part / map.near_mm * map.focal, 1e-6);
    assert_close(ends[1], HEIGHT / 2.0, 1e-6);
    ang_volume_free(volume);
}

/* Near and far: everything under the pointer stays there, in perspective too. */
static void zooming_is_about_the_pointer_at_every_depth(void **state) {
    (void)state;
    ang_volume *volume = body();
    for (int v = 0; v < VIEWS; v++) {
        ang_view view = views[v];
        ang_pane_map before = map_of(volume, &view);
        ang_vec3 origin, direction;
        double x = 400, y = 77, at_x, at_y;
        ang_pane_map_ray(&before, x, y, &origin, &direction);
        ang_view_zoom(&view, volume, WIDTH, HEIGHT, x, y, 1.7);
        ang_pane_map after = map_of(volume, &view);
        double centre = ang_vec3_dot(ang_vec3_sub(ang_volume_centre(volume), origin), direction);
        for (int i = -1; i <= 1; i++) {
            ang_vec3 place = ang_vec3_along(origin, direction, centre + 15 * i);
            assert_true(ang_pane_map_point(&after, place, &at_x, &at_y));
            assert_close(at_x, x, 1e-7);
            assert_close(at_y, y, 1e-7);
        }
        assert_close(view.zoom, 1.7 * views[v].zoom, 1e-12);
        ang_view_zoom(&view, volume, WIDTH, HEIGHT, x, y, 1e9);
        assert_close(view.zoom, 100, 0);
    }
    ang_volume_free(volume);
}

/* The hand turns the volume about what it has picked. */
static void what_is_turned_about_stays_where_it_appears(void **state) {
    (void)state;
    ang_volume *volume = body();
    ang_vec3 place = ang_vec3_add(ang_volume_centre(volume), (ang_vec3){9, -17, 14});
    for (int v = 0; v < VIEWS; v++) {
        ang_view view = views[v], plain = views[v];
        ang_pane_map map = map_of(volume, &view);
        double x, y, now_x, now_y;
        assert_true(ang_pane_map_point(&map, place, &x, &y));
        for (int i = 0; i < 30; i++) {
            ang_view_turn_about(&view, volume, place, 7, i - 9);
            ang_view_turn(&plain, 7, i - 9);
            map = map_of(volume, &view);
            assert_true(ang_pane_map_point(&map, place, &now_x, &now_y));
            assert_close(now_x, x, 1e-6);
            assert_close(now_y, y, 1e-6);
        }
        assert_close(view.azimuth_deg, plain.azimuth_deg, 0);
        assert_close(view.roll_deg, plain.roll_deg, 0);
    }
    ang_volume_free(volume);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(places_appear_where_their_ray_passes),
        cmocka_unit_test(slices_are_maps_too),
        cmocka_unit_test(a_drag_goes_as_far_as_it_appears),
        cmocka_unit_test(beyond_the_vanishing_point_a_drag_goes_to_the_end),
        cmocka_unit_test(end_on_up_is_away),
        cmocka_unit_test(what_is_behind_the_eye_does_not_show),
        cmocka_unit_test(what_is_turned_about_stays_where_it_appears),
        cmocka_unit_test(zooming_is_about_the_pointer_at_every_depth),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
