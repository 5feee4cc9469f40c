/* Planes and boxes of slicing, without OpenGL: every sample has one owner, in the order of view. */
#include "tests/core/fixtures.h"

#include "core/plan/boxes.h"

static double bumps(int x, int y, int z) {
    return 200 * sin(0.4 * x) * sin(0.5 * y + 1) * sin(0.3 * z) + 5 * ((x * 7 + y * 13 + z * 5) % 11) - 60;
}

static ang_transfer *above(double hu) {
    ang_transfer_point points[] = {{.hu = hu, .colour = {1, 1, 1}, .opacity = 0},
                                   {.hu = hu + 50, .colour = {1, 1, 1}, .opacity = 0.5}};
    return ang_transfer_create(points, 2, 1, false, NULL, NULL);
}

/* A picture to be sliced, with all that is decided about it. */
typedef struct setting {
    ang_volume *volume;
    ang_transfer *transfer;
    ang_transfer_tables *tables;
    ang_octree *octree;
    ang_scene scene;
    ang_ray_frame frame;
    ang_slice_planes planes;
    ang_clip_space space;
    ang_visibility visibility;
    ang_slice_cut cut;
    ang_slice_boxes boxes;
} setting;

static void make_boxes(setting *s, double step) {
    ang_error err = {0};
    assert_true(ang_ray_frame_make(s->volume, &s->scene, &s->frame, &err));
    s->planes = ang_slice_planes_make(&s->frame, step);
    s->space = ang_clip_space_make(&s->frame, s->scene.width, s->scene.height);
    s->visibility = ang_visibility_make(s->volume, &s->scene, s->tables);
    s->cut.margin = (ang_vec3){1.2, 1.2, 1.2};
    if (!ang_slice_boxes_make(&s->boxes, s->octree, &s->frame, &s->planes, &s->space, &s->cut, &err))
        fail_msg("%s", err.message);
}

static setting make_setting(const char *view_text, ang_projection projection, const int *leaf) {
    static const double spacing[3] = {0.7, 0.9, 1.3};
    setting s = {.volume = make_volume(45, 38, 29, spacing, bumps), .transfer = above(30)};
    s.volume->affine.m[1][2] = 0.4;
    s.tables = ang_tables_create(s.transfer, 1, -1024, s.volume->minimum, s.volume->maximum, 0, NULL);
    s.octree = ang_octree_build(s.volume, leaf, 1, 1, NULL);
    s.scene = ang_scene_default(s.volume);
    s.scene.transfer = s.transfer;
    ang_view view = ang_view_default;
    assert_true(ang_view_parse(view_text, &view, NULL));
    view.projection = projection;
    s.scene.camera = ang_camera_for(s.volume, &view);
    s.cut = (ang_slice_cut){.top_level = ANG_OCTREE_MAX_LEVELS, .group = 1, .polygon_cost = 30};
    return s;
}

static void clear_setting(setting *s) {
    ang_slice_boxes_clear(&s->boxes);
    ang_octree_free(s->octree);
    ang_tables_free(s->tables);
    ang_transfer_free(s->transfer);
    ang_volume_free(s->volume);
}

static bool owns(const ang_slice_box *box, ang_vec3 p) {
    for (int axis = 0; axis < 3; axis++) {
        double v = ang_vec3_at(p, axis);
        if (v < ang_vec3_at(box->owner_lower, axis) || v >= ang_vec3_at(box->owner_upper, axis)) return false;
    }
    return true;
}

/* Walks rays through the picture, plane by plane. What can be seen has one owner, whose planes and extent have it, and
 * owners come in the order of the list. */
static void check_rays(const setting *s, uint64_t *seed) {
    int visible = 0;
    for (int i = 0; i < 300; i++) {
        double x = random_unit(seed) * s->scene.width, y = random_unit(seed) * s->scene.height;
        ang_ray ray = ang_ray_through(&s->frame, x, y);
        double cosine = ang_vec3_dot(ray.direction_mm, s->frame.axis_mm);
        size_t last = 0;
        for (int k = 0; k < s->planes.count; k++) {
            double t = (s->planes.first + k * s->planes.distance) / cosine;
            if (t < ray.enter || t > ray.leave) continue;
            ang_vec3 p = ang_vec3_along(ray.origin, ray.direction, t);
            double stored = ang_volume_sample(s->volume, ang_vec3_add(p, s->frame.centre));
            bool shows = ang_transfer_opacity(s->transfer, ang_volume_hu(s->volume, stored)) > 0;
            int owners = 0;
            for (size_t b = 0; b < s->boxes.count; b++) {
                if (!owns(&s->boxes.box[b], p)) continue;
                const ang_slice_box *box = &s->boxes.box[b];
                owners++;
                assert_true(b >= last);
                last = b;
                assert_true(k >= box->begin && k < box->end);
                /* Away from the faces and the clip plane a ray has samples on both sides, but for the first and the
                 * last plane (slice_geometry.c). */
                double step = s->planes.distance / cosine;
                if (!box->faces && cosine > 0.9 && k > 0 && k < s->planes.count - 1)
                    assert_true(t - step >= ray.enter && t + step <= ray.leave);
                for (int axis = 0; axis < 3; axis++) {
                    assert_true(ang_vec3_at(p, axis) >= ang_vec3_at(box->lower, axis) - 1e-9);
                    assert_true(ang_vec3_at(p, axis) <= ang_vec3_at(box->upper, axis) + 1e-9);
                }
            }
            assert_true(owners <= 1);
            if (shows || !s->cut.visibility) assert_int_equal(owners, 1);
            visible += shows;
        }
    }
    assert_true(visible > 50);
}

static void every_sample_has_one_owner_in_the_order_of_view(void **state) {
    (void)state;
    static const char *const views[] = {"anterior", "33,21,10", "-120,-70", "superior", "0,45"};
    static const int leaves[][3] = {{8, 8, 8}, {4, 9, 3}, {45, 38, 29}};
    uint64_t seed = 7;
    for (size_t v = 0; v < sizeof views / sizeof *views; v++)
        for (int k = 0; k < 24; k++) {
            setting s = make_setting(views[v], k & 1 ? ANG_PARALLEL : ANG_PERSPECTIVE, leaves[k / 8]);
            s.cut.visibility = k & 2 ? &s.visibility : NULL;
            s.cut.to_leaves = k & 4;
            if (v == 1) assert_true(ang_scene_clip_parse("10%,90%,5%,80%,30%,75%", s.volume, &s.scene, NULL));
            if (v == 2) {
                ang_vec3 normal = ang_vec3_unit((ang_vec3){-0.4, 0.7, 0.5});
                double middle = ang_vec3_dot(normal, ang_volume_centre(s.volume));
                s.scene.clip_plane = (ang_clip_plane){normal, middle + 6};
            }
            if (v == 4) {
                s.scene.camera.eye = ang_vec3_along(ang_volume_centre(s.volume), s.scene.camera.forward, 2);
                s.scene.camera.fov_deg = 100;
            }
            make_boxes(&s, 0.6);
            check_rays(&s, &seed);
            clear_setting(&s);
        }
}

static void descent_stops_where_it_does_not_pay(void **state) {
    (void)state;
    setting s = make_setting("33,21", ANG_PERSPECTIVE, (const int[3]){4, 4, 4});
    s.cut.visibility = &s.visibility;
    s.cut.polygon_cost = 0; /* polygons for nothing: all that is invisible is left out */
    make_boxes(&s, 0.5);
    size_t fine = s.boxes.blocks, drawn = s.boxes.leaves_drawn;
    assert_true(drawn < s.boxes.leaves_total);
    s.cut.polygon_cost = 1e9; /* fragments for nothing */
    make_boxes(&s, 0.5);
    assert_int_equal(s.boxes.blocks, 1);
    assert_int_equal(s.boxes.leaves_drawn, s.boxes.leaves_total);
    s.cut.polygon_cost = 100;
    make_boxes(&s, 0.5);
    assert_in_range(s.boxes.blocks, 2, fine);
    assert_true(s.boxes.leaves_drawn >= drawn);
    double cost = s.boxes.samples + 100 * s.boxes.polygons;
    /* Every forced cut costs more than the one that was chosen. */
    s.cut.to_leaves = true;
    make_boxes(&s, 0.5);
    assert_int_equal(s.boxes.leaves_drawn, drawn);
    assert_true(s.boxes.samples + 100 * s.boxes.polygons >= cost);
    s.cut.visibility = NULL;
    make_boxes(&s, 0.5);
    assert_int_equal(s.boxes.blocks, s.boxes.leaves_total);
    clear_setting(&s);
}

static void boxes_out_of_the_picture_are_left_out(void **state) {
    (void)state;
    setting s = make_setting("33,21", ANG_PERSPECTIVE, NULL);
    s.cut.to_leaves = true;
    make_boxes(&s, 0.5);
    size_t all = s.boxes.blocks;
    ang_view view = ang_view_default;
    view.zoom = 8;
    s.scene.camera = ang_camera_for(s.volume, &view);
    make_boxes(&s, 0.5);
    assert_in_range(s.boxes.blocks, 1, all / 3);
    uint64_t seed = 3;
    check_rays(&s, &seed);
    s.scene.camera.eye = ang_vec3_along(s.scene.camera.eye, s.scene.camera.forward, 1e4); /* all of it behind */
    make_boxes(&s, 0.5);
    assert_int_equal(s.boxes.blocks, 0);
    assert_int_equal(s.planes.count, 0);
    clear_setting(&s);
}

static void planes_fill_the_box_from_near_to_far(void **state) {
    (void)state;
    setting s = make_setting("anterior", ANG_PARALLEL, NULL);
    assert_true(ang_ray_frame_make(s.volume, &s.scene, &s.frame, NULL));
    double least, greatest, depth;
    s.planes = ang_slice_planes_make(&s.frame, 0.25);
    ang_slice_depths(&s.planes, s.frame.lower, s.frame.upper, &least, &greatest);
    depth = 37 * 0.9 + 28 * 0.4; /* along y, with the shear */
    assert_close(greatest - least, depth, 1e-9);
    assert_close(s.planes.first - least, 0.125, 1e-9);
    assert_int_equal(s.planes.count, (int)ceil(depth / 0.25));
    static const double steps[] = {100, 44.53, 44.5299999, 30, 1e-5};
    for (size_t i = 0; i < sizeof steps / sizeof *steps; i++) {
        s.planes = ang_slice_planes_make(&s.frame, steps[i]);
        double last = s.planes.first + (s.planes.count - 1) * s.planes.distance;
        assert_in_range(s.planes.count, 1, ANG_SLICE_MOST_PLANES);
        assert_true(s.planes.first > least && last < greatest + 0.5001 * s.planes.distance);
        assert_true(greatest - last < 0.5001 * s.planes.distance || s.planes.count == 1);
        if (steps[i] > depth) assert_close(s.planes.first, (least + greatest) / 2, 1e-9);
    }
    clear_setting(&s);
}

/* The linear forms against the rays: the point under a pixel lies at that pixel. */
static void clip_space_agrees_with_rays(void **state) {
    (void)state;
    uint64_t seed = 11;
    for (int projection = 0; projection < 2; projection++) {
        setting s = make_setting("33,21,77", (ang_projection)projection, NULL);
        s.scene.width = 70;
        s.scene.height = 50;
        make_boxes(&s, 0.5);
        for (int i = 0; i < 1000; i++) {
            double x = random_unit(&seed) * 70, y = random_unit(&seed) * 50;
            ang_ray ray = ang_ray_through(&s.frame, x, y);
            ang_vec3 p = ang_vec3_along(ray.origin, ray.direction, 40 * random_unit(&seed) - 20);
            const ang_linear_form *forms[] = {&s.space.x, &s.space.y, &s.space.w};
            double v[3];
            for (int f = 0; f < 3; f++) v[f] = ang_vec3_dot(forms[f]->gradient, p) + forms[f]->constant;
            assert_close((v[0] / v[2] + 1) / 2 * 70, x, 1e-9);
            assert_close((v[1] / v[2] + 1) / 2 * 50, y, 1e-9);
        }
        clear_setting(&s);
    }
}

static void modes_see_what_can_change_a_pixel(void **state) {
    (void)state;
    setting s = make_setting("anterior", ANG_PARALLEL, NULL);
    s.scene.window_centre = 100;
    s.scene.window_width = 200; /* 0..200 HU */
    s.scene.iso_hu = 150;
    static const struct {
        ang_mode mode;
        int low, high; /* HU */
        bool visible, all;
    } cases[] = {{ANG_MODE_DVR, -50, 30, false, false},    {ANG_MODE_DVR, -50, 31, true, false},
                 {ANG_MODE_DVR, 70, 90, true, true},       {ANG_MODE_MIP, -300, -1, false, false},
                 {ANG_MODE_MIP, -300, 1, true, false},     {ANG_MODE_MIP, 5, 900, true, true},
                 {ANG_MODE_MINIP, 201, 900, false, false}, {ANG_MODE_MINIP, 199, 900, true, false},
                 {ANG_MODE_ISO, 0, 149, false, false},     {ANG_MODE_ISO, 0, 150, true, false},
                 {ANG_MODE_MEAN, -1000, -900, true, true}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        s.scene.mode = cases[i].mode;
        ang_visibility visibility = ang_visibility_make(s.volume, &s.scene, s.tables);
        ang_minmax range = {(uint16_t)(cases[i].low + 1024), (uint16_t)(cases[i].high + 1024)};
        assert_int_equal(ang_visibility_of(&visibility, range), cases[i].visible);
        assert_int_equal(ang_visibility_of_all(&visibility, range), cases[i].all);
    }
    clear_setting(&s);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_sample_has_one_owner_in_the_order_of_view),
        cmocka_unit_test(descent_stops_where_it_does_not_pay),
        cmocka_unit_test(boxes_out_of_the_picture_are_left_out),
        cmocka_unit_test(planes_fill_the_box_from_near_to_far),
        cmocka_unit_test(clip_space_agrees_with_rays),
        cmocka_unit_test(modes_see_what_can_change_a_pixel),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
