/* The crop box under the hand, against closed forms. */
#include "tests/ui/volumes.h"

#include "ui/state/crop_geometry.h"

static ang_crop_box whole(const ang_volume *volume) {
    ang_crop_box box;
    ang_volume_box(volume, &box.lower, &box.upper);
    return box;
}

static void a_face_stops_at_the_volume_and_a_voxel_before_the_other(void **state) {
    (void)state;
    ang_volume *volume = cube();
    ang_crop_box box = whole(volume);
    assert_true(ang_crop_box_whole(&box, volume));
    ang_crop_face_move(&box, volume, 0, 12.25);
    assert_close(box.lower.x, 12.25, 0);
    assert_false(ang_crop_box_whole(&box, volume));
    ang_crop_face_move(&box, volume, 1, -7);
    assert_close(box.upper.x, 13.25, 0);
    ang_crop_face_move(&box, volume, 0, 900);
    assert_close(box.lower.x, 12.25, 0);
    ang_crop_face_move(&box, volume, 0, -INFINITY);
    ang_crop_face_move(&box, volume, 1, INFINITY);
    assert_true(ang_crop_box_whole(&box, volume));
    ang_volume_free(volume);
    /* A single slice keeps its thickness. */
    volume = make_volume(5, 5, 1, (double[]){1, 1, 3}, zero);
    box = whole(volume);
    ang_crop_face_move(&box, volume, 4, 0.2);
    ang_crop_face_move(&box, volume, 5, 0.2);
    assert_true(ang_crop_box_whole(&box, volume));
    ang_volume_free(volume);
}

static void edges_join_the_faces_that_they_name(void **state) {
    (void)state;
    ang_volume *volume = cube();
    ang_crop_box box = {{4, 2, 1}, {14, 12, 5}}; /* 10 x 20 x 20 mm */
    int seen[ANG_CROP_FACES] = {0};
    static const double length[3] = {10, 20, 20};
    for (int i = 0; i < ANG_CROP_EDGES; i++) {
        ang_crop_edge edge = ang_crop_edge_of(&box, volume, i);
        assert_close(ang_vec3_length(ang_vec3_sub(edge.ends[1], edge.ends[0])), length[i / 4], 1e-12);
        for (int k = 0; k < 2; k++) {
            int face = edge.faces[k];
            double at = ang_crop_face_at(&box, face) * ang_volume_spacing(volume, face / 2) - 20;
            for (int end = 0; end < 2; end++) assert_close(ang_vec3_at(edge.ends[end], face / 2), at, 1e-12);
            seen[face]++;
        }
    }
    for (int i = 0; i < ANG_CROP_FACES; i++) assert_int_equal(seen[i], 4);
    ang_vec3 middle = ang_crop_face_middle(&box, volume, 3);
    assert_close(middle.x, 9 - 20, 1e-12);
    assert_close(middle.y, 24 - 20, 1e-12);
    assert_close(middle.z, 15 - 20, 1e-12);
    ang_volume_free(volume);
}

static void outlines_are_those_of_the_box(void **state) {
    (void)state;
    ang_volume *volume = cube();
    ang_crop_box box = whole(volume);
    ang_crop_side sides[ANG_CROP_FACES];
    /* Across the diagonal through the middle of a cube: a regular hexagon. */
    ang_vec3 diagonal = ang_vec3_unit((ang_vec3){1, 1, 1});
    assert_int_equal(ang_crop_outline(&box, volume, diagonal, 0, sides), 6);
    for (int i = 0; i < 6; i++) {
        assert_close(ang_vec3_length(ang_vec3_sub(sides[i].ends[1], sides[i].ends[0])), 40 / sqrt(2), 1e-9);
        assert_close(ang_vec3_at(sides[i].ends[0], sides[i].face / 2), sides[i].face % 2 ? 20 : -20, 1e-9);
    }
    assert_int_equal(ang_crop_outline(&box, volume, diagonal, 34, sides), 3);
    assert_int_equal(ang_crop_outline(&box, volume, diagonal, 35, sides), 0);
    /* Also in the faces themselves, the first and the last slice. */
    for (int z = -20; z <= 20; z += 20) {
        assert_int_equal(ang_crop_outline(&box, volume, (ang_vec3){0, 0, 1}, z, sides), 4);
        for (int i = 0; i < 4; i++)
            assert_close(ang_vec3_length(ang_vec3_sub(sides[i].ends[1], sides[i].ends[0])), 40, 1e-3);
    }
    assert_int_equal(ang_crop_outline(&box, volume, (ang_vec3){0, 0, 1}, 20.1, sides), 0);
    ang_volume_free(volume);
}

static ang_pane_map map_of(const ang_volume *volume, double azimuth, double elevation, ang_projection projection) {
    ang_view view = {.azimuth_deg = azimuth, .elevation_deg = elevation, .zoom = 1, .fov_deg = 30};
    view.projection = projection;
    ang_camera camera = ang_camera_for(volume, &view);
    return ang_pane_map_of_camera(&camera, 400, 400);
}

static void faces_are_seen_from_their_side(void **state) {
    (void)state;
    ang_volume *volume = cube();
    ang_crop_box box = whole(volume);
    static const struct {
        double azimuth, elevation;
        unsigned seen;
    } cases[] = {{0, 0, 1 << 2},   /* the front is the lower y */
                 {180, 0, 1 << 3}, /* the back */
                 {90, 0, 1 << 1},  /* the patient's left is the greater x */
                 {0, 90, 1 << 5},  /* from the head */
                 {45, 35, 1 << 2 | 1 << 1 | 1 << 5}};
    for (int parallel = 0; parallel < 2; parallel++)
        for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
            ang_pane_map map = map_of(volume, cases[i].azimuth, cases[i].elevation, (ang_projection)parallel);
            unsigned seen = 0;
            for (int face = 0; face < ANG_CROP_FACES; face++)
                if (ang_crop_face_seen(&box, volume, face, &map)) seen |= 1u << face;
            assert_int_equal(seen, cases[i].seen);
        }
    /* The same with an axis turned round: only the numbers of its faces change. */
    volume->affine.m[2][2] = -5;
    volume->affine.m[2][3] = 20;
    ang_pane_map map = map_of(volume, 0, 90, ANG_PERSPECTIVE);
    assert_true(ang_crop_face_seen(&box, volume, 4, &map));
    assert_false(ang_crop_face_seen(&box, volume, 5, &map));
    ang_volume_free(volume);
}

static void handles_are_found_where_they_appear(void **state) {
    (void)state;
    ang_volume *volume = cube();
    ang_crop_box box = {{4, 2, 1}, {34, 17, 7}};
    for (int parallel = 0; parallel < 2; parallel++) {
        ang_pane_map map = map_of(volume, 35, 25, (ang_projection)parallel);
        for (int face = 0; face < ANG_CROP_FACES; face++) {
            double x, y;
            assert_true(ang_pane_map_point(&map, ang_crop_face_middle(&box, volume, face), &x, &y));
            assert_int_equal(ang_crop_pick(&box, volume, &map, x + 2, y - 2, 9), 1u << face);
        }
        assert_int_equal(ang_crop_pick(&box, volume, &map, 5, 5, 9), 0);
        /* From the front the handles of front and back lie over one another: the front's is taken. */
        map = map_of(volume, 0, 0, (ang_projection)parallel);
        ang_crop_box middle = whole(volume);
        assert_int_equal(ang_crop_pick(&middle, volume, &map, 200, 200, 9), 1u << 2);
    }
    ang_volume_free(volume);
}

/* In parallel projection from the front a pixel is 2 half diagonals / 400 mm across. */
static void a_handle_goes_with_the_pointer(void **state) {
    (void)state;
    ang_volume *volume = cube();
    ang_crop_box before = whole(volume);
    ang_pane_map map = map_of(volume, 0, 0, ANG_PARALLEL);
    double mm = 2 * ang_volume_half_diagonal(volume) / 400;
    ang_crop_box box = ang_crop_drag(&before, volume, 1 << 0, &map, 30, 11); /* the lower x, to the right */
    assert_close(box.lower.x, 30 * mm, 1e-9);
    assert_close(box.upper.x, 40, 0);
    box = ang_crop_drag(&before, volume, 1 << 5, &map, 30, 40); /* the head's end, down */
    assert_close(box.upper.z, 8 - 40 * mm / 5, 1e-9);
    assert_close(box.lower.z, 0, 0);
    /* In perspective the handle itself is then under the pointer, beside its line at the nearest place of it. */
    map = map_of(volume, 40, 30, ANG_PERSPECTIVE);
    for (int face = 0; face < ANG_CROP_FACES; face++) {
        double x, y, to_x, to_y;
        ang_crop_box inner = {{10, 5, 2}, {30, 15, 6}}, wanted = inner;
        ang_crop_face_move(&wanted, volume, face, ang_crop_face_at(&inner, face) + (face % 2 ? -1.7 : 1.3));
        ang_pane_map_point(&map, ang_crop_face_middle(&inner, volume, face), &x, &y);
        ang_pane_map_point(&map, ang_crop_face_middle(&wanted, volume, face), &to_x, &to_y);
        box = ang_crop_drag(&inner, volume, 1u << face, &map, to_x - x, to_y - y);
        assert_close(ang_crop_face_at(&box, face), ang_crop_face_at(&wanted, face), 1e-9);
    }
    ang_volume_free(volume);
}

/* It stays under the pointer, in perspective too, at its distance from the eye. */
static void a_corner_goes_across_the_line_of_sight(void **state) {
    (void)state;
    ang_volume *volume = cube();
    volume->affine.m[1][2] = 1.25;
    for (int parallel = 0; parallel < 2; parallel++) {
        ang_pane_map map = map_of(volume, 35, 25, (ang_projection)parallel);
        ang_crop_box before = {{10, 5, 2}, {30, 15, 6}};
        for (int corner = 0; corner < ANG_CROP_CORNERS; corner++) {
            double x, y, to_x, to_y;
            ang_vec3 from = ang_crop_corner(&before, volume, corner);
            unsigned faces = ang_crop_corner_faces(corner);
            assert_true(ang_pane_map_point(&map, from, &x, &y));
            bool seen = ang_crop_corner_seen(&before, volume, corner, &map);
            assert_int_equal(ang_crop_pick(&before, volume, &map, x + 1, y - 2, 5), seen ? faces : 0);
            ang_crop_box box = ang_crop_drag(&before, volume, faces, &map, 7, -4);
            ang_vec3 to = ang_crop_corner(&box, volume, corner);
            assert_true(ang_pane_map_point(&map, to, &to_x, &to_y));
            assert_close(to_x, x + 7, 1e-9);
            assert_close(to_y, y - 4, 1e-9);
            assert_close(ang_vec3_dot(ang_vec3_sub(to, from), map.forward), 0, 1e-9);
            ang_vec3 opposite = ang_crop_corner(&before, volume, 7 - corner);
            assert_close(ang_vec3_length(ang_vec3_sub(ang_crop_corner(&box, volume, 7 - corner), opposite)), 0, 1e-12);
        }
    }
    ang_volume_free(volume);
}

/* A tilted gantry shears: the index of a face is that of the place to which the hand has taken it. */
static void in_slices_faces_go_with_the_place_under_the_pointer(void **state) {
    (void)state;
    ang_volume *volume = cube();
    volume->affine.m[1][2] = 1.25; /* each slice 1.25 mm further back */
    ang_crop_box before = whole(volume);
    ang_vec3 from = {3, -20, 4};
    ang_crop_box box = ang_crop_drag_slice(&before, volume, 1 << 2 | 1 << 1, from, (ang_vec3){-3, -9, 4});
    assert_close(box.lower.y, 11.0 / 2, 1e-9);
    assert_close(box.upper.x, 40 - 6, 1e-9);
    /* Two slices up the same place is nearer to the front by 2.5 mm. */
    box = ang_crop_drag_slice(&before, volume, 1 << 2 | 1 << 4, from, (ang_vec3){3, -9, 14});
    assert_close(box.lower.z, 2, 1e-9);
    assert_close(box.lower.y, (11 - 2.5) / 2, 1e-9);
    ang_volume_free(volume);
}

static void sides_and_corners_are_found_in_slices(void **state) {
    (void)state;
    ang_volume *volume = cube();
    ang_slice_view view = ang_slice_view_default;
    ang_slice_frame frame =
        ang_slice_frame_make(volume, &ang_turn_none, ANG_AXIAL, &view, (ang_vec3){0, 0, 0}, 400, 400);
    ang_pane_map map = ang_pane_map_of_slice(&frame); /* 10 pixels a mm */
    ang_crop_box box = {{10, 5, 1}, {30, 15, 7}};
    ang_crop_side sides[ANG_CROP_FACES];
    int count = ang_crop_outline(&box, volume, frame.axes.inward, 0, sides);
    assert_int_equal(count, 4);
    assert_int_equal(ang_crop_pick_side(sides, count, &map, 102, 180, 5), 1 << 0);
    assert_int_equal(ang_crop_pick_side(sides, count, &map, 200, 303, 5), 1 << 3);
    assert_int_equal(ang_crop_pick_side(sides, count, &map, 303, 98, 5), 1 << 1 | 1 << 2);
    assert_int_equal(ang_crop_pick_side(sides, count, &map, 200, 200, 5), 0);
    ang_volume_free(volume);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_face_stops_at_the_volume_and_a_voxel_before_the_other),
        cmocka_unit_test(edges_join_the_faces_that_they_name),
        cmocka_unit_test(outlines_are_those_of_the_box),
        cmocka_unit_test(faces_are_seen_from_their_side),
        cmocka_unit_test(handles_are_found_where_they_appear),
        cmocka_unit_test(a_handle_goes_with_the_pointer),
        cmocka_unit_test(a_corner_goes_across_the_line_of_sight),
        cmocka_unit_test(in_slices_faces_go_with_the_place_under_the_pointer),
        cmocka_unit_test(sides_and_corners_are_found_in_slices),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
