/* A renderer with its method, and pictures by it in which every value is finite. */
#ifndef ANG_TESTS_CORE_DRAWER_H
#define ANG_TESTS_CORE_DRAWER_H

#include "tests/core/fixtures.h"

#include "core/render/method.h"

typedef struct drawer {
    const ang_method *method;
    ang_renderer *renderer;
} drawer;

/* The renderer's memory is not limited; the caller destroys it. */
static inline drawer open_drawer(ang_gl *gl, const ang_method *method, const ang_volume *volume) {
    ang_error err = {0};
    drawer d = {method, method->create(gl, volume, &ang_render_options_default, &err)};
    if (!d.renderer) fail_msg("%s", err.message);
    return d;
}

static inline ang_image draw(const drawer *d, const ang_scene *scene, const ang_render_options *options,
                             ang_frame_stats *stats) {
    ang_error err = {0};
    ang_image image;
    assert_true(ang_image_create(&image, scene->width, scene->height, &err));
    if (!d->method->render(d->renderer, scene, options, &image, stats, NULL, &err))
        fail_msg("%s: %s", d->method->name, err.message);
    for (int i = 0; i < 4 * image.width * image.height; i++) assert_true(isfinite(image.rgba[i]));
    return image;
}

#endif
