/* One method's renderer and its pictures, which must be finite. */
#ifndef ANG_TESTS_CASTING_H
#define ANG_TESTS_CASTING_H

#include "tests/core/scenes.h"

#include "core/render/method.h"

static const ang_render_options exact = {.step_voxels = 0.5, .termination = 1};

static inline ang_renderer *open_renderer(const ang_method *method, ang_gl *gl, const ang_volume *volume) {
    ang_error err = {0};
    ang_renderer *renderer = method->create(gl, volume, &exact, &err);
    if (!renderer) fail_msg("%s: %s", method->name, err.message);
    return renderer;
}

static inline ang_image draw(const ang_method *method, ang_renderer *renderer, const ang_scene *scene,
                             const ang_render_options *options, ang_frame_stats *stats) {
    ang_error err = {0};
    ang_image image;
    assert_true(ang_image_create(&image, scene->width, scene->height, &err));
    if (!method->render(renderer, scene, options, &image, stats, NULL, &err))
        fail_msg("%s: %s", method->name, err.message);
    for (int i = 0; i < 4 * image.width * image.height; i++) assert_true(isfinite(image.rgba[i]));
    return image;
}

#endif
