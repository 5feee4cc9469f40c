/* Scenes that methods must draw to the bit: a sparse sheared volume seen in four ways. */
#ifndef ANG_TESTS_CORE_SCENES_H
#define ANG_TESTS_CORE_SCENES_H

#include "tests/core/fixtures.h"

#include "core/render/method.h"

enum { width = 61, height = 48 };

static inline double flat_value(int x, int y, int z) {
    (void)x, (void)y, (void)z;
    return 100;
}

/* Vessels, as it were: a third of the volume is invisible at 150 HU. */
static inline double sparse_value(int x, int y, int z) {
    double wave = sin(0.35 * x + 0.5 * sin(0.2 * z)) * cos(0.31 * y) * sin(0.23 * z + 0.4);
    return wave > 0.2 ? 100 + 500 * wave : -50 + 3 * ((x + 2 * y + 3 * z) % 7);
}

static inline ang_transfer *vessels(void) {
    static const ang_transfer_point points[] = {{.hu = 150, .colour = {0.6, 0.1, 0.05}, .opacity = 0},
                                                {.hu = 300, .colour = {0.9, 0.4, 0.2}, .opacity = 0.15},
                                                {.hu = 600, .colour = {1, 0.95, 0.9}, .opacity = 0.6}};
    return ang_transfer_create(points, 3, 1, false, NULL, NULL);
}

/* The greatest difference of two pictures; clears the second. */
static inline double difference(const ang_image *a, ang_image *b) {
    double greatest = 0;
    for (int i = 0; i < 4 * a->width * a->height; i++) greatest = fmax(greatest, fabs((double)a->rgba[i] - b->rgba[i]));
    ang_image_clear(b);
    return greatest;
}

static inline ang_volume *sheared_volume(double (*value)(int, int, int)) {
    static const double spacing[3] = {0.8, 0.9, 1.4};
    ang_volume *volume = make_volume(44, 39, 30, spacing, value);
    volume->affine.m[1][2] = 0.5;
    return volume;
}

enum { SCENES = 6 };
/* Perspective, parallel along an axis, clipped, from inside, from inside looking out beside a face, and cut by an
 * oblique plane through the middle. */
static inline ang_scene make_scene(int which, const ang_volume *volume, const ang_transfer *transfer) {
    static const char *const views[SCENES] = {"33,21,10", "left", "-140,-35", "20,5", "100,40", "130,20"};
    ang_scene scene = ang_scene_default(volume);
    ang_view view = ang_view_default;
    assert_true(ang_view_parse(views[which], &view, NULL));
    if (which == 1) view.projection = ANG_PARALLEL;
    scene.camera = ang_camera_for(volume, &view);
    if (which == 2) assert_true(ang_scene_clip_parse("20%,90%,10%,80%,30%,75%", volume, &scene, NULL));
    if (which == 3) {
        scene.camera.eye = ang_vec3_along(ang_volume_centre(volume), scene.camera.forward, 1.5);
        scene.camera.fov_deg = 80;
    }
    if (which == 4) {
        scene.camera.eye = ang_vec3_along(ang_volume_centre(volume), scene.camera.forward, -21);
        scene.camera.fov_deg = 120;
    }
    if (which == 5) {
        ang_vec3 normal = ang_vec3_unit((ang_vec3){0.8, -0.5, 0.6});
        scene.clip_plane = (ang_clip_plane){normal, ang_vec3_dot(normal, ang_volume_centre(volume)) + 2.5};
    }
    scene.width = width;
    scene.height = height;
    scene.transfer = transfer;
    scene.iso_hu = 220;
    scene.window_centre = 300;
    scene.window_width = 500;
    return scene;
}

#endif
