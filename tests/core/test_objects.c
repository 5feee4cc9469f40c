/* Opaque geometry: its own closed forms, and every method against them and against the reference. */
#include "tests/core/backends.h"
#include "tests/core/scenes.h"

#include "core/cpu/reference.h"
#include "core/scene/annotation.h"
#include "core/scene/object_layer.h"

#include <string.h>

static const ang_render_options exact = {.step_voxels = 0.5, .termination = 1, .gradients = ANG_GRADIENTS_LOOKUPS};

static ang_volume *flat_volume(void) {
    static const double spacing[3] = {1, 1.5, 2};
    return make_volume(41, 31, 21, spacing, flat_value);
}

static ang_object ball(ang_vec3 at, double radius) {
    return (ang_object){.from = at, .to = at, .radius_mm = radius, .colour = {1, 0.5, 0.25}};
}

/* The eye at distance d from a ball of radius r sees it at d - r straight ahead, and as far as the cone that touches
 * it. */
static void balls_and_tubes_have_closed_forms(void **state) {
    (void)state;
    ang_volume *volume = flat_volume();
    ang_scene scene = ang_scene_default(volume);
    scene.width = scene.height = 201;
    ang_ray_frame frame;
    assert_true(ang_ray_frame_make(volume, &scene, &frame, NULL));
    ang_vec3 centre = ang_volume_centre(volume);
    double distance = scene.camera.focus_mm, radius = 7, t = INFINITY, colour[3];
    ang_object object = ball(centre, radius);
    /* t is 0 on the plane through the box's centre. */
    assert_true(ang_object_hit(&object, volume, &scene, &frame, 100.5, 100.5, &t, colour));
    assert_close(t, -radius, 1e-9);
    assert_close(colour[0], 1, 1e-9);
    assert_close(colour[2], 0.25, 1e-9);
    double pixel = 2 * distance * tan(15 * M_PI / 180) / 201;
    double edge = distance * tan(asin(radius / distance)) / pixel;
    t = INFINITY;
    assert_true(ang_object_hit(&object, volume, &scene, &frame, 100.5 + edge - 1e-6, 100.5, &t, colour));
    t = INFINITY;
    assert_false(ang_object_hit(&object, volume, &scene, &frame, 100.5 + edge + 1e-6, 100.5, &t, colour));
    /* From the front, a tube along left-right: its side. And one along the line of sight: its round end. */
    ang_object tube = object;
    tube.from.x -= 30;
    tube.to.x += 30;
    t = INFINITY;
    assert_true(ang_object_hit(&tube, volume, &scene, &frame, 160.5, 100.5, &t, colour));
    double slope = 60 * pixel / distance; /* of the ray, and how much of it is ahead */
    assert_close(t, (distance - radius) * sqrt(1 + slope * slope) - distance * sqrt(1 + slope * slope), 1e-9);
    ang_object towards = object;
    towards.from.y -= 30;
    t = INFINITY;
    assert_true(ang_object_hit(&towards, volume, &scene, &frame, 100.5, 100.5, &t, colour));
    assert_close(t, -30 - radius, 1e-9);
    /* Nearer than the near plane there is nothing. */
    ang_object near = ball(scene.camera.eye, 0.5 * scene.camera.near_mm);
    t = INFINITY;
    assert_false(ang_object_hit(&near, volume, &scene, &frame, 100.5, 100.5, &t, colour));
    ang_volume_free(volume);
}

static double ramp(int x, int y, int z) {
    (void)x, (void)z;
    return 10 * y;
}

/* A coronal plane seen from the front shows one value, at its depth. */
static void planes_show_their_voxels(void **state) {
    (void)state;
    static const double spacing[3] = {1, 1.5, 2};
    ang_volume *volume = make_volume(41, 31, 21, spacing, ramp);
    ang_scene scene = ang_scene_default(volume);
    scene.window_centre = 150;
    scene.window_width = 300;
    ang_objects objects = {0};
    assert_true(ang_objects_add_cut_planes(&objects, volume, "coronal:9", NULL));
    assert_int_equal(objects.object[0].axis, 1);
    assert_close(objects.object[0].index, 6, 1e-12); /* 9 mm of 1.5 each */
    ang_ray_frame frame;
    assert_true(ang_ray_frame_make(volume, &scene, &frame, NULL));
    double t, colour[3];
    assert_true(ang_objects_hit(&objects, volume, &scene, &frame, 256, 256, &t, colour));
    assert_close(t, (6 - 15) * 1.5, 1e-9);
    assert_close(colour[1], 60.0 / 300, 1e-12);
    assert_false(ang_objects_hit(&objects, volume, &scene, &frame, 2, 256, &t, colour));
    ang_objects_clear(&objects);
    static const char *const bad[] = {"",          "saggital",  "axial:", "axial:101%", "axial:-1",
                                      "axial:nan", "axial:5%x", "axial,", "axial:1e9",  "axial 5"};
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        ang_error err = {0};
        if (ang_objects_add_cut_planes(&objects, volume, bad[i], &err)) fail_msg("'%s' is taken", bad[i]);
        assert_int_equal(err.code, ANG_USAGE);
        ang_objects_clear(&objects);
    }
    assert_true(ang_objects_add_cut_planes(&objects, volume, "axial:100%,sagittal,coronal:0", NULL));
    assert_int_equal(objects.count, 3);
    assert_close(objects.object[0].index, 20, 1e-12);
    assert_close(objects.object[1].index, 20, 1e-12);
    assert_int_equal(objects.object[1].axis, 0);
    ang_objects_clear(&objects);
    ang_volume_free(volume);
}

/* Axes, a mark and planes about the sheared volume. */
static ang_objects all_objects(const ang_volume *volume) {
    ang_objects objects = {0};
    ang_vec3 centre = ang_volume_centre(volume);
    assert_true(ang_objects_add_axes(&objects, volume, NULL));
    assert_true(ang_objects_add_mark(&objects, volume, centre, ang_vec3_add(centre, (ang_vec3){9, -14, 12}), NULL));
    assert_true(ang_objects_add_cut_planes(&objects, volume, "axial:35%,sagittal:70%", NULL));
    return objects;
}

/* The layer looks only where an object may be. */
static void the_layer_leaves_no_pixel_out(void **state) {
    (void)state;
    ang_volume *volume = sheared_volume(sparse_value);
    ang_transfer *transfer = vessels();
    ang_objects objects = all_objects(volume);
    ang_object_layer layer = {0};
    int met = 0;
    for (int which = 0; which < SCENES; which++) {
        ang_scene scene = make_scene(which, volume, transfer);
        scene.objects = &objects;
        ang_ray_frame frame;
        assert_true(ang_ray_frame_make(volume, &scene, &frame, NULL));
        assert_true(ang_object_layer_make(&layer, volume, &scene, &frame, 2, NULL));
        for (int i = 0; i < width * height; i++) {
            double t, colour[3];
            bool hit = ang_objects_hit(&objects, volume, &scene, &frame, i % width + 0.5, i / width + 0.5, &t, colour);
            assert_int_equal(layer.limit_mm[i] < ANG_NO_LIMIT, hit);
            if (!hit) continue;
            met++;
            assert_close((double)layer.limit_mm[i], t, 1e-6 * fabs(t) + 1e-6);
            for (int c = 0; c < 3; c++) assert_close((double)layer.colour[3 * i + c], colour[c], 1e-6);
        }
    }
    assert_true(met > width * height);
    ang_object_layer_clear(&layer);
    ang_objects_clear(&objects);
    ang_transfer_free(transfer);
    ang_volume_free(volume);
}

/* A mark is labelled with its length, axes with the patient's letters where the camera shows their ends. */
static void labels_lie_at_their_places(void **state) {
    (void)state;
    ang_volume *volume = flat_volume();
    ang_scene scene = ang_scene_default(volume);
    ang_objects objects = {0};
    ang_vec3 centre = ang_volume_centre(volume);
    assert_true(ang_objects_add_mark(&objects, volume, ang_vec3_add(centre, (ang_vec3){-3, 0, 12}),
                                     ang_vec3_add(centre, (ang_vec3){3, 0, 20}), NULL));
    assert_true(ang_objects_add_axes(&objects, volume, NULL));
    ang_error err = {0};
    assert_false(ang_objects_add_mark(&objects, volume, centre, (ang_vec3){NAN, 0, 0}, &err));
    scene.objects = &objects;
    ang_annotation a = ang_annotation_of_objects(&scene);
    assert_string_equal(a.label[0].text, "10.0 mm");
    assert_close(a.label[0].x, 256, 1e-9);
    double pixel = 2 * scene.camera.focus_mm * tan(15 * M_PI / 180) / 512;
    assert_close(a.label[0].y, 256 - 16 / pixel + 1.6 * 512 / 40, 1e-9);
    /* From the front the patient's right is on the left, the head at the top. */
    for (int i = 1; i < a.labels; i++) {
        const ang_annotation_label *label = &a.label[i];
        if (strcmp(label->text, "R") == 0) assert_true(label->x < 200);
        if (strcmp(label->text, "L") == 0) assert_true(label->x > 312);
        if (strcmp(label->text, "H") == 0) assert_true(label->y < 200);
        if (strcmp(label->text, "F") == 0) assert_true(label->y > 312);
    }
    /* Anterior and posterior are one before the other: the near one is written. */
    assert_int_equal(a.labels, 6);
    bool anterior = false;
    for (int i = 1; i < a.labels; i++) {
        assert_string_not_equal(a.label[i].text, "P");
        anterior |= strcmp(a.label[i].text, "A") == 0;
    }
    assert_true(anterior);
    /* Marks at one place have their lengths below one another. */
    ang_objects marks = {0};
    for (int k = 1; k <= 3; k++)
        assert_true(ang_objects_add_mark(&marks, volume, ang_vec3_add(centre, (ang_vec3){-k, 0, 0}),
                                         ang_vec3_add(centre, (ang_vec3){k, 0, 0}), NULL));
    scene.objects = &marks;
    a = ang_annotation_of_objects(&scene);
    assert_int_equal(a.labels, 3);
    assert_true(a.label[1].y > a.label[0].y + 12 && a.label[2].y > a.label[1].y + 12);
    ang_objects_clear(&marks);
    ang_objects_clear(&objects);
    ang_volume_free(volume);
}

static ang_image draw(const ang_method *method, ang_renderer *renderer, const ang_scene *scene,
                      const ang_render_options *options) {
    ang_error err = {0};
    ang_image image;
    assert_true(ang_image_create(&image, scene->width, scene->height, &err));
    if (!method->render(renderer, scene, options, &image, NULL, NULL, &err)) fail_msg("%s", err.message);
    for (int i = 0; i < 4 * image.width * image.height; i++) assert_true(isfinite(image.rgba[i]));
    return image;
}

static ang_renderer *open_renderer(ang_gl *gl, const ang_method *method, const ang_volume *volume) {
    ang_error err = {0};
    ang_renderer *renderer = method->create(gl, volume, &exact, &err);
    if (!renderer) fail_msg("%s", err.message);
    return renderer;
}

/* A homogeneous medium before a plane: 1 - exp(-kappa d) of the medium, the rest of the plane. */
static void a_plane_ends_a_homogeneous_medium(void **state) {
    open_gl(state);
    ang_volume *volume = flat_volume();
    static const double kappas[] = {1e-3, 0.05, 10};
    for (size_t k = 0; k < 3; k++) {
        ang_transfer *transfer = constant_transfer(kappas[k], 0.2, 0.4, 0.8);
        ang_objects objects = {0};
        assert_true(ang_objects_add_cut_planes(&objects, volume, "coronal:22", NULL));
        ang_scene scene = ang_scene_default(volume);
        scene.transfer = transfer;
        scene.objects = &objects;
        scene.width = 40, scene.height = 36;
        scene.window_centre = 100, scene.window_width = 400; /* the volume is half grey */
        ang_ray_frame frame;
        assert_true(ang_ray_frame_make(volume, &scene, &frame, NULL));
        for (size_t m = 0; ang_methods()[m]; m++) {
            const ang_method *method = ang_methods()[m];
            ang_renderer *renderer = open_renderer(gl, method, volume);
            for (int step = 0; step < 3; step++) {
                static const double steps[] = {0.37, 2, 50};
                ang_render_options options = exact;
                options.step_voxels = steps[step];
                ang_image image = draw(method, renderer, &scene, &options);
                for (int i = 0; i < 40 * 36; i++) {
                    double t, grey[3];
                    if (!ang_objects_hit(&objects, volume, &scene, &frame, i % 40 + 0.5, i / 40 + 0.5, &t, grey))
                        continue;
                    ang_ray ray = ang_ray_through(&frame, i % 40 + 0.5, i / 40 + 0.5);
                    double opacity = -expm1(-kappas[k] * fmax(t - ray.enter, 0));
                    double wanted = 0.8 * opacity + (1 - opacity) * 0.5;
                    double made = (double)image.rgba[4 * i + 2];
                    if (!(fabs(made - wanted) <= 3e-6))
                        fail_msg("%s, extinction %g, step %g, pixel %d: %.9g, not %.9g", method->name, kappas[k],
                                 steps[step], i, made, wanted);
                    assert_close((double)image.rgba[4 * i + 3], 1, 0);
                }
                ang_image_clear(&image);
            }
            method->destroy(renderer);
        }
        ang_objects_clear(&objects);
        ang_transfer_free(transfer);
    }
    ang_volume_free(volume);
}

/* Ray methods agree to their usual bits, slicing with and without bricks. */
static void methods_agree_with_objects(void **state) {
    open_gl(state);
    ang_volume *volume = sheared_volume(sparse_value);
    ang_transfer *transfer = vessels();
    ang_objects objects = all_objects(volume);
    ang_renderer *single = open_renderer(gl, &ang_method_singlepass, volume);
    ang_renderer *envelope = open_renderer(gl, &ang_method_envelope, volume);
    ang_renderer *raycast = open_renderer(gl, &ang_method_raycast, volume);
    ang_renderer *slicing = open_renderer(gl, &ang_method_slicing, volume);
    for (int which = 0; which < SCENES; which++)
        for (int mode = ANG_MODE_DVR; mode <= ANG_MODE_ISO; mode++)
            for (int shading = 0; shading < 2; shading++) {
                ang_scene scene = make_scene(which, volume, transfer);
                scene.mode = (ang_mode)mode;
                scene.shading = (ang_shading)shading;
                scene.objects = &objects;
                ang_image truth = draw(&ang_method_singlepass, single, &scene, &exact);
                ang_image image = draw(&ang_method_envelope, envelope, &scene, &exact);
                double far = difference(&truth, &image);
                if (far > 0) fail_msg("envelope, scene %d, mode %d, shading %d: %g", which, mode, shading, far);
                image = draw(&ang_method_raycast, raycast, &scene, &exact);
                far = difference(&truth, &image);
                /* A surface's place is halved from another pair of samples: as in test_raycast.c. */
                if (far > (mode == ANG_MODE_ISO ? 2e-5 : 1e-6))
                    fail_msg("raycast, scene %d, mode %d, shading %d: %g", which, mode, shading, far);
                ang_image_clear(&truth);
                ang_render_options bricks = exact, none = exact;
                bricks.bricks[0] = 5, bricks.bricks[1] = 4, bricks.bricks[2] = 7;
                none.no_skip = true;
                truth = draw(&ang_method_slicing, slicing, &scene, &none);
                image = draw(&ang_method_slicing, slicing, &scene, &bricks);
                far = difference(&truth, &image);
                if (far > 1e-6) fail_msg("bricks, scene %d, mode %d, shading %d: %g", which, mode, shading, far);
                ang_image_clear(&truth);
            }
    ang_method_singlepass.destroy(single);
    ang_method_envelope.destroy(envelope);
    ang_method_raycast.destroy(raycast);
    ang_method_slicing.destroy(slicing);
    ang_objects_clear(&objects);
    ang_transfer_free(transfer);
    ang_volume_free(volume);
}

/* RMS in levels of 255. */
static double rms(const ang_image *a, ang_image *b) {
    double sum = 0;
    int values = 4 * a->width * a->height;
    for (int i = 0; i < values; i++) sum += pow(255 * ((double)a->rgba[i] - (double)b->rgba[i]), 2);
    ang_image_clear(b);
    return sqrt(sum / values);
}

/* Against the reference, falling with the step like pictures without objects. */
static void pictures_with_objects_converge(void **state) {
    open_gl(state);
    ang_volume *volume = sheared_volume(sparse_value);
    ang_transfer *transfer = vessels();
    ang_objects objects = all_objects(volume);
    ang_renderer *reference = open_renderer(gl, &ang_method_reference, volume);
    for (int which = 0; which < SCENES; which++) {
        ang_scene scene = make_scene(which, volume, transfer);
        scene.objects = &objects;
        ang_image truth = draw(&ang_method_reference, reference, &scene, &exact);
        for (size_t m = 0; ang_methods()[m] != &ang_method_reference; m++) {
            const ang_method *method = ang_methods()[m];
            ang_renderer *renderer = open_renderer(gl, method, volume);
            double far[2];
            for (int k = 0; k < 2; k++) {
                ang_render_options options = exact;
                options.step_voxels = k ? 0.125 : 0.5;
                ang_image image = draw(method, renderer, &scene, &options);
                far[k] = rms(&truth, &image);
            }
            /* Order 1.5 at the least; the orders of whole pictures are in docs/measured.md. */
            if (!(far[1] < 0.15 && far[1] < far[0] / 8))
                fail_msg("%s, scene %d: RMS %g levels at 1/2 voxel, %g at 1/8", method->name, which, far[0], far[1]);
            method->destroy(renderer);
        }
        ang_image_clear(&truth);
    }
    ang_method_reference.destroy(reference);
    ang_objects_clear(&objects);
    ang_transfer_free(transfer);
    ang_volume_free(volume);
}

/* What cannot be seen changes no bit; a projection is drawn over. */
static void only_what_is_seen_shows(void **state) {
    open_gl(state);
    ang_volume *volume = sheared_volume(sparse_value);
    ang_transfer *transfer = vessels();
    ang_objects far_away = {0};
    ang_vec3 centre = ang_volume_centre(volume);
    ang_vec3 off = ang_vec3_add(centre, (ang_vec3){1e5, 0, 0});
    assert_true(ang_objects_add_mark(&far_away, volume, off, ang_vec3_add(off, (ang_vec3){0, 0, 5}), NULL));
    ang_object yellow = ball(centre, 4);
    yellow.colour[1] = 1, yellow.colour[2] = 0;
    const ang_objects mark = {.object = &yellow, .count = 1};
    for (size_t m = 0; ang_methods()[m]; m++) {
        const ang_method *method = ang_methods()[m];
        ang_renderer *renderer = open_renderer(gl, method, volume);
        ang_scene scene = make_scene(0, volume, transfer);
        ang_image truth = draw(method, renderer, &scene, &exact);
        scene.objects = &far_away;
        ang_image image = draw(method, renderer, &scene, &exact);
        assert_close(difference(&truth, &image), 0, method == &ang_method_slicing ? 1e-6 : 0);
        ang_image_clear(&truth);
        scene.mode = ANG_MODE_MIP;
        scene.objects = &mark;
        image = draw(method, renderer, &scene, &exact);
        const float *middle = image.rgba + 4 * ((size_t)(height / 2) * width + width / 2);
        assert_true(middle[0] > 0.6F && middle[2] == 0); /* yellow, whatever lies before it */
        ang_image_clear(&image);
        method->destroy(renderer);
    }
    ang_objects_clear(&far_away);
    ang_transfer_free(transfer);
    ang_volume_free(volume);
}

int main(void) {
    const struct CMUnitTest shapes[] = {
        cmocka_unit_test(balls_and_tubes_have_closed_forms), cmocka_unit_test(planes_show_their_voxels),
        cmocka_unit_test(the_layer_leaves_no_pixel_out), cmocka_unit_test(labels_lie_at_their_places)};
    const struct CMUnitTest pictures[] = {
        cmocka_unit_test(a_plane_ends_a_homogeneous_medium), cmocka_unit_test(methods_agree_with_objects),
        cmocka_unit_test(pictures_with_objects_converge), cmocka_unit_test(only_what_is_seen_shows)};
    return cmocka_run_group_tests(shapes, NULL, NULL) + run_on_backends(pictures);
}
