/* The clip plane under the hand, against closed forms. */
#include "tests/ui/volumes.h"

#include "ui/state/clip_geometry.h"

static void assert_vector(ang_vec3 a, double x, double y, double z) {
    assert_close(a.x, x, 1e-9);
    assert_close(a.y, y, 1e-9);
    assert_close(a.z, z, 1e-9);
}

static void angles_are_those_of_a_camera_there(void **state) {
    (void)state;
    ang_volume *volume = cube();
    for (int i = 0; i < 12; i++) {
        ang_view view = {.azimuth_deg = 30 * i - 165, .elevation_deg = 15 * i - 85, .zoom = 1, .fov_deg = 30};
        ang_camera camera = ang_camera_for(volume, &view);
        ang_clip_plane plane = ang_clip_plane_through((ang_vec3){1, 2, 3}, ang_vec3_scale(camera.forward, -7));
        double azimuth, elevation;
        ang_clip_plane_angles(&plane, &azimuth, &elevation);
        assert_close(azimuth, view.azimuth_deg, 1e-9);
        assert_close(elevation, view.elevation_deg, 1e-9);
        ang_clip_plane same = ang_clip_plane_turned((ang_vec3){1, 2, 3}, azimuth, elevation);
        assert_close(same.offset_mm, plane.offset_mm, 1e-9);
        assert_vector(same.normal, plane.normal.x, plane.normal.y, plane.normal.z);
    }
    ang_volume_free(volume);
}

static void it_turns_over_and_moves_within_the_volume(void **state) {
    (void)state;
    ang_volume *volume = cube();
    assert_false(ang_clip_plane_given(&(ang_clip_plane){0}));
    ang_clip_plane plane = ang_clip_plane_through((ang_vec3){0, 0, 5}, (ang_vec3){0, 0, 2});
    assert_true(ang_clip_plane_given(&plane));
    assert_close(plane.offset_mm, 5, 0);
    ang_clip_plane over = ang_clip_plane_flip(&plane);
    assert_vector(over.normal, 0, 0, -1);
    assert_close(over.offset_mm, -5, 0);
    assert_vector(ang_clip_plane_foot(&over, (ang_vec3){3, 4, 17}), 3, 4, 5);
    assert_close(ang_clip_plane_moved(&plane, volume, -7).offset_mm, -2, 1e-12);
    assert_close(ang_clip_plane_moved(&plane, volume, 900).offset_mm, 20, 1e-9);
    assert_close(ang_clip_plane_moved(&plane, volume, -900).offset_mm, -20, 1e-9);
    ang_volume_free(volume);
}

/* The arrow's tip is under the pointer where the pointer is within its reach. */
static void the_tip_follows_the_pointer(void **state) {
    (void)state;
    ang_volume *volume = cube();
    for (int parallel = 0; parallel < 2; parallel++) {
        ang_view view = {.azimuth_deg = 20, .elevation_deg = 10, .zoom = 1, .fov_deg = 30};
        view.projection = (ang_projection)parallel;
        ang_camera camera = ang_camera_for(volume, &view);
        ang_pane_map map = ang_pane_map_of_camera(&camera, 400, 400);
        ang_vec3 pivot = {3, -4, 5};
        for (int i = 0; i < 60; i++) {
            ang_vec3 normal = {cos(i), sin(i) * cos(2 * i), sin(i) * sin(2 * i)};
            ang_vec3 tip = ang_vec3_along(pivot, normal, 8);
            double x, y;
            assert_true(ang_pane_map_point(&map, tip, &x, &y));
            bool near = ang_clip_tip_towards_eye(&map, pivot, tip);
            ang_vec3 found = ang_clip_normal_at(&map, pivot, 8, near, x, y);
            assert_close(ang_vec3_length(ang_vec3_sub(found, normal)), 0, 1e-6);
        }
        /* Far away it lies across the line of sight, on the pointer's side. */
        ang_vec3 right = ang_clip_normal_at(&map, pivot, 8, true, 4000, 200);
        assert_close(ang_vec3_length(right), 1, 1e-12);
        assert_true(ang_vec3_dot(right, map.right) > 0.9 || !parallel);
        ang_vec3 origin, direction;
        ang_pane_map_ray(&map, 4000, 200, &origin, &direction);
        assert_close(ang_vec3_dot(right, direction), 0, 1e-9);
    }
    ang_volume_free(volume);
}

static void a_slice_is_cut_in_a_line(void **state) {
    (void)state;
    ang_volume *volume = cube();
    ang_slice_view view = ang_slice_view_default;
    ang_slice_frame frame =
        ang_slice_frame_make(volume, &ang_turn_none, ANG_AXIAL, &view, (ang_vec3){0, 0, 3}, 600, 400);
    double ends[4]; /* 10 pixels a mm, the middle at (300, 200) */
    ang_clip_plane plane = ang_clip_plane_through((ang_vec3){5, 0, 0}, (ang_vec3){1, 0, 0});
    assert_true(ang_clip_line(&plane, &frame, ends)); /* the right is cut away: the way goes down */
    assert_close(ends[0], 350, 1e-9);
    assert_close(ends[1], 0, 1e-9);
    assert_close(ends[2], 350, 1e-9);
    assert_close(ends[3], 400, 1e-9);
    plane = ang_clip_plane_through((ang_vec3){0, 0, 3}, (ang_vec3){-1, 1, 0}); /* 45 degrees through the middle */
    assert_true(ang_clip_line(&plane, &frame, ends));
    assert_close(fabs(ends[2] - ends[0]), 400, 1e-6);
    assert_close(fabs(ends[3] - ends[1]), 400, 1e-6);
    for (int i = 0; i < 4; i += 2)
        assert_close(ang_vec3_dot(plane.normal, ang_slice_at(&frame, ends[i], ends[i + 1])), plane.offset_mm, 1e-9);
    plane = ang_clip_plane_through((ang_vec3){0, 0, 3}, (ang_vec3){1, 1, 5});
    assert_true(ang_clip_line(&plane, &frame, ends));
    for (int i = 0; i < 4; i += 2)
        assert_close(ang_vec3_dot(plane.normal, ang_slice_at(&frame, ends[i], ends[i + 1])), plane.offset_mm, 1e-9);
    plane = ang_clip_plane_through((ang_vec3){0, 0, 3}, (ang_vec3){0, 0, 1});
    assert_false(ang_clip_line(&plane, &frame, ends));
    plane = ang_clip_plane_through((ang_vec3){31, 0, 0}, (ang_vec3){1, 0, 0});
    assert_false(ang_clip_line(&plane, &frame, ends));
    ang_volume_free(volume);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(angles_are_those_of_a_camera_there),
        cmocka_unit_test(it_turns_over_and_moves_within_the_volume),
        cmocka_unit_test(the_tip_follows_the_pointer),
        cmocka_unit_test(a_slice_is_cut_in_a_line),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
