/* What the plan leaves out changes nothing: every picture again with each part forced in. */
#include "tests/core/backends.h"
#include "tests/core/scenes.h"

#include "core/render/kept.h"
#include "core/render/volume_texture.h"

#include <glad/gl.h>
#include <string.h>

static const ang_render_options usual = {.step_voxels = 1, .termination = 0.999, .gradients = ANG_GRADIENTS_LOOKUPS};

static ang_image draw(const ang_method *method, ang_renderer *renderer, const ang_scene *scene,
                      const ang_render_options *options, ang_frame_stats *stats) {
    ang_error err = {0};
    ang_image image;
    assert_true(ang_image_create(&image, scene->width, scene->height, &err));
    if (!method->render(renderer, scene, options, &image, stats, NULL, &err)) fail_msg("%s", err.message);
    return image;
}

static ang_renderer *open_renderer(const ang_method *method, ang_gl *gl, const ang_volume *volume) {
    ang_error err = {0};
    ang_renderer *renderer = method->create(gl, volume, &usual, &err);
    if (!renderer) fail_msg("%s", err.message);
    return renderer;
}

/* Whether the forced part is used though it need not be. */
static bool is_forced(const ang_method *method, ang_renderer *renderer, const ang_scene *scene,
                      const ang_render_options *options) {
    ang_plan plan = {0};
    assert_true(method->explain(renderer, scene, options, &plan, NULL));
    bool found = false;
    for (size_t i = 0; i < plan.uses.count; i++) found = found || strstr(plan.uses.item[i].what, "by --force");
    ang_plan_clear(&plan);
    return found;
}

/* The greatest change that a part may make: where the same numbers are added in another order or rounded once more it
 * is rounding, else nothing. */
static double allowed(const ang_method *method, ang_part part) {
    static const double rounding = 1e-6;
    bool slices = method == &ang_method_slicing;
    if (part == ANG_PART_GRADIENTS || part == ANG_PART_COLOUR || part == ANG_PART_ROUNDING) return rounding;
    if (part == ANG_PART_DIRECTIONS || (part == ANG_PART_TERMINATION && slices)) return rounding;
    if (part == ANG_PART_DESCENT) return rounding; /* planes that share a polygon are composited first */
    return 0;
}

enum { TRANSFERS = 4 };
/* Several colours; one colour, of which no ray can become opaque; the same with a step; everything shows. */
static ang_transfer *make_transfer(int which) {
    static const ang_transfer_point ivory[] = {{.hu = 150, .colour = {0.9, 0.8, 0.7}, .opacity = 0},
                                               {.hu = 600, .colour = {0.9, 0.8, 0.7}, .opacity = 0.02}},
                                    step[] = {{.hu = 150, .colour = {0.9, 0.8, 0.7}, .opacity = 0},
                                              {.hu = 150, .colour = {0.9, 0.8, 0.7}, .opacity = 0.1},
                                              {.hu = 600, .colour = {0.3, 0.8, 0.7}, .opacity = 0.3}};
    if (which == 0) return vessels();
    if (which == 3) return constant_transfer(0.02, 0.25, 0.5, 1);
    return which == 1 ? ang_transfer_create(ivory, 2, 1, false, NULL, NULL)
                      : ang_transfer_create(step, 3, 1, false, NULL, NULL);
}

typedef struct tally {
    int forced[ANG_FORCIBLE];
    double worst[ANG_FORCIBLE];
} tally;

static void force_each(const ang_method *method, ang_renderer *renderer, const ang_scene *scene,
                       const ang_render_options *options, const char *what, tally *found) {
    ang_image plain = draw(method, renderer, scene, options, NULL);
    for (int part = 0; part < ANG_FORCIBLE; part++) {
        ang_render_options with = *options;
        with.forced = 1u << part;
        if (!is_forced(method, renderer, scene, &with)) continue;
        ang_image image = draw(method, renderer, scene, &with, NULL);
        double change = difference(&plain, &image);
        found->forced[part]++;
        found->worst[part] = fmax(found->worst[part], change);
        if (!(change <= allowed(method, (ang_part)part)))
            fail_msg("%s, %s, --force %s: %g", method->name, what, ang_part_name((ang_part)part), change);
    }
    ang_image_clear(&plain);
}

static void check_tally(const char *name, const tally *found, unsigned wanted) {
    for (int part = 0; part < ANG_FORCIBLE; part++) {
        if (wanted >> part & 1u && found->forced[part] == 0)
            fail_msg("%s never left out %s", name, ang_part_name((ang_part)part));
        if (found->forced[part] > 0)
            print_message("%s, %s: %d pictures, at most %g\n", name, ang_part_name((ang_part)part), found->forced[part],
                          found->worst[part]);
    }
}

static void forced_parts_change_nothing(void **state) {
    open_gl(state);
    enum {
        COMMON = 1u << ANG_PART_GRADIENTS | 1u << ANG_PART_EXPONENTIAL | 1u << ANG_PART_COLOUR |
                 1u << ANG_PART_ROUNDING | 1u << ANG_PART_TERMINATION | 1u << ANG_PART_CLIP_PLANE
    };
    static const struct {
        const ang_method *method;
        unsigned wanted;
    } methods[] = {
        {&ang_method_envelope, (COMMON & ~(1u << ANG_PART_TERMINATION)) | 1u << ANG_PART_SKIPPING |
                                   1u << ANG_PART_NEAR_PLANE | 1u << ANG_PART_BORDER},
        {&ang_method_raycast, COMMON | 1u << ANG_PART_SKIPPING | 1u << ANG_PART_DIRECTIONS},
        {&ang_method_slicing, COMMON | 1u << ANG_PART_SKIPPING | 1u << ANG_PART_DESCENT},
        {&ang_method_singlepass, COMMON & ~(1u << ANG_PART_TERMINATION)},
    };
    ang_volume *volume = sheared_volume(sparse_value);
    for (size_t m = 0; m < sizeof methods / sizeof *methods; m++) {
        const ang_method *method = methods[m].method;
        ang_renderer *renderer = open_renderer(method, gl, volume);
        tally found = {0};
        for (int t = 0; t < TRANSFERS; t++) {
            ang_transfer *transfer = make_transfer(t);
            for (int which = 0; which < SCENES; which++)
                for (int look = 0; look < 4; look++) {
                    bool seen = which == 0 ? look < 2 || t == 0 : look == 0 || (t == 0 && which == 3 && look == 2);
                    if (!seen || which == 2 || (which == 4 && t > 0)) continue;
                    ang_scene scene = make_scene(which, volume, transfer);
                    char what[80];
                    snprintf(what, sizeof what, "scene %d, transfer function %d, look %d", which, t, look);
                    scene.mode = look < 2 ? ANG_MODE_DVR : look == 2 ? ANG_MODE_MIP : ANG_MODE_ISO;
                    scene.shading = look == 1 ? ANG_SHADING_PHONG : ANG_SHADING_NONE;
                    ang_render_options options = usual;
                    /* Boxes of other sizes look for finished pixels elsewhere. */
                    if (method == &ang_method_slicing) options.termination = t == 1 ? 0.999 : 1;
                    force_each(method, renderer, &scene, &options, what, &found);
                }
            ang_transfer_free(transfer);
        }
        check_tally(method->name, &found, methods[m].wanted);
        method->destroy(renderer);
    }
    ang_volume_free(volume);
}

/* A blob at a corner, and a brighter one inside another: what shows grows with the transfer function. */
static double blobs(int x, int y, int z) {
    double a = (x - 12) * (x - 12) + (y - 9) * (y - 9) + 2.0 * (z - 7) * (z - 7);
    double b = (x - 31) * (x - 31) + (y - 28) * (y - 28) + 2.0 * (z - 20) * (z - 20);
    return a < 40 ? 400 + 3 * a : b < 60 ? 200 + b : -1000 + ((x + y + z) % 5);
}

static ang_transfer *from_hu(double hu) {
    const ang_transfer_point points[] = {{.hu = hu, .colour = {0.6, 0.1, 0.05}, .opacity = 0},
                                         {.hu = hu + 150, .colour = {1, 0.95, 0.9}, .opacity = 0.6}};
    return ang_transfer_create(points, 2, 1, false, NULL, NULL);
}

/* Of a renderer that uploads only what shows, with one transfer function after another, the pictures are those of one
 * that has everything. */
static void slabs_follow_the_transfer_function(void **state) {
    open_gl(state);
    static const ang_method *const methods[] = {&ang_method_envelope, &ang_method_raycast};
    static const double from[] = {350, 900, 150, -1100, 350};
    ang_volume *volume = sheared_volume(blobs);
    for (size_t m = 0; m < 2; m++)
        for (int shading = 0; shading < 2; shading++) {
            ang_renderer *part = open_renderer(methods[m], gl, volume), *whole = open_renderer(methods[m], gl, volume);
            for (size_t i = 0; i < sizeof from / sizeof *from; i++)
                for (int which = 0; which < SCENES; which++) {
                    ang_transfer *transfer = from_hu(from[i]);
                    ang_scene scene = make_scene(which, volume, transfer);
                    scene.shading = (ang_shading)shading;
                    if (i == 2 && shading == 0) scene.mode = ANG_MODE_MIP;
                    ang_render_options options = usual, all = usual;
                    options.pass_steps = all.pass_steps = m == 1 ? 4 : 0;
                    all.forced = 1u << ANG_PART_SLABS;
                    ang_image truth = draw(methods[m], whole, &scene, &all, NULL);
                    ang_image image = draw(methods[m], part, &scene, &options, NULL);
                    double far = difference(&truth, &image);
                    if (i == 0) assert_true(is_forced(methods[m], whole, &scene, &all));
                    if (far > 0) fail_msg("%s, from %g HU, scene %d: %g", methods[m]->name, from[i], which, far);
                    ang_image_clear(&truth);
                    ang_transfer_free(transfer);
                }
            methods[m]->destroy(part);
            methods[m]->destroy(whole);
        }
    ang_volume_free(volume);
}

/* However boxes grow, every voxel inside what is held is there. */
static void boxes_are_uploaded_whole(void **state) {
    open_gl(state);
    const double spacing[3] = {1, 1, 1};
    ang_volume *volume = make_volume(23, 17, 11, spacing, sparse_value);
    uint64_t random = 11;
    for (int n = 0; n < 40; n++) {
        ang_volume_texture texture = {0};
        assert_true(ang_volume_texture_reserve(&texture, gl, volume, NULL));
        for (int grow = 0; grow < 4; grow++) {
            int first[3], end[3];
            for (int axis = 0; axis < 3; axis++) {
                first[axis] = (int)((volume->dims[axis] + 4) * random_unit(&random)) - 4;
                end[axis] = first[axis] + (int)(12 * random_unit(&random));
            }
            assert_true(ang_volume_texture_hold(&texture, gl, volume, first, end, NULL));
        }
        uint16_t *data = malloc(ang_volume_count(volume) * sizeof *data);
        glPixelStorei(GL_PACK_ALIGNMENT, 1);
        glBindTexture(GL_TEXTURE_3D, texture.values);
        glGetTexImage(GL_TEXTURE_3D, 0, GL_RED, GL_UNSIGNED_SHORT, data);
        const int *from = texture.held_first, *to = texture.held_end;
        for (int z = from[2]; z < to[2]; z++)
            for (int y = from[1]; y < to[1]; y++)
                for (int x = from[0]; x < to[0]; x++) {
                    size_t i = (size_t)x + 23 * ((size_t)y + 17 * (size_t)z);
                    assert_int_equal(data[i], volume->data[i]);
                }
        free(data);
        ang_volume_texture_destroy(&texture);
    }
    ang_volume_free(volume);
}

/* Who asks for the same picture again gets it without drawing, and never another. */
static void same_pictures_are_kept(void **state) {
    open_gl(state);
    ang_volume *volume = sheared_volume(sparse_value);
    ang_transfer *transfer = vessels(), *other = from_hu(200);
    ang_renderer *renderer = open_renderer(&ang_method_envelope, gl, volume);
    ang_scene scene = make_scene(0, volume, transfer);
    ang_kept kept = {0};
    ang_image image, truth = draw(&ang_method_envelope, renderer, &scene, &usual, NULL);
    assert_true(ang_image_create(&image, width, height, NULL));
    ang_frame_stats stats = {0}, again = {0};
    ang_render_options options = usual;
#define ask(stats_) ang_kept_render(&kept, &ang_method_envelope, renderer, &scene, &options, &image, stats_, NULL, NULL)
    assert_true(ask(&stats) && !kept.given);
    memset(image.rgba, 0, 4 * sizeof *image.rgba * width * height);
    assert_true(ask(&again) && kept.given);
    assert_int_equal(stats.samples, again.samples);
    assert_memory_equal(image.rgba, truth.rgba, 4 * sizeof *image.rgba * width * height);
    /* The same points elsewhere in memory are the same transfer function. */
    ang_transfer *copy = vessels();
    scene.transfer = copy;
    assert_true(ask(NULL) && kept.given);
    options.forced = 1u << ANG_PART_REDRAW;
    assert_true(ask(&stats) && !kept.given);
    assert_true(ask(&stats) && !kept.given);
    assert_memory_equal(image.rgba, truth.rgba, 4 * sizeof *image.rgba * width * height);
    options.forced = 0;
    assert_true(ask(NULL) && !kept.given);
    scene.transfer = other;
    assert_true(ask(NULL) && !kept.given);
    assert_memory_not_equal(image.rgba, truth.rgba, 4 * sizeof *image.rgba * width * height);
    options.step_voxels = 0.7;
    assert_true(ask(NULL) && !kept.given);
    scene.camera.near_mm += 1;
    assert_true(ask(NULL) && !kept.given);
    assert_true(ask(&stats) && !kept.given); /* nobody has counted yet */
    assert_true(ask(&stats) && kept.given);
    float counts[width * height];
    stats.counts = counts;
    assert_true(ask(&stats) && !kept.given);
#undef ask
    ang_kept_clear(&kept);
    ang_image_clear(&image);
    ang_image_clear(&truth);
    ang_method_envelope.destroy(renderer);
    ang_transfer_free(transfer);
    ang_transfer_free(other);
    ang_transfer_free(copy);
    ang_volume_free(volume);
}

static bool draw_nothing(ang_renderer *renderer, const ang_scene *scene, const ang_render_options *options,
                         ang_image *image, ang_frame_stats *stats, const ang_progress *progress, ang_error *err) {
    (void)renderer, (void)scene, (void)options, (void)image, (void)stats, (void)progress, (void)err;
    return true;
}

/* Of how many of the `size` bytes at `bytes`, part of the scene or the options, a change is not noticed. */
static int unnoticed(void *bytes, size_t size, const ang_scene *scene, const ang_render_options *options) {
    static const ang_method nothing = {.render = draw_nothing};
    ang_kept kept = {0};
    ang_image image;
    assert_true(ang_image_create(&image, 2, 2, NULL));
    int found = 0;
    for (size_t i = 0; i < size; i++) {
        unsigned char *byte = (unsigned char *)bytes + i;
        assert_true(ang_kept_render(&kept, &nothing, NULL, scene, options, &image, NULL, NULL, NULL));
        *byte ^= 1; /* true becomes false */
        assert_true(ang_kept_render(&kept, &nothing, NULL, scene, options, &image, NULL, NULL, NULL));
        found += kept.given;
        *byte ^= 1;
    }
    ang_kept_clear(&kept);
    ang_image_clear(&image);
    return found;
}

/* Whatever field changes, the picture is drawn again; bytes between the fields mean nothing. */
static void each_field_counts(void **state) {
    (void)state;
    enum { SCENE_PADDING = 4 + 4, OPTIONS_PADDING = 2 + 6 + 3 + 4 }; /* where a pointer has 8 bytes */
    if (sizeof(void *) != 8) skip();
    ang_scene scene = {.width = 2, .height = 2};
    ang_render_options options = usual;
    size_t borrowed = offsetof(ang_scene, transfer), after = offsetof(ang_scene, background);
    assert_int_equal(after - borrowed, sizeof scene.transfer + sizeof scene.objects);
    int before = unnoticed(&scene, borrowed, &scene, &options);
    assert_int_equal(before + unnoticed((char *)&scene + after, sizeof scene - after, &scene, &options), SCENE_PADDING);
    assert_int_equal(unnoticed(&options, sizeof options, &scene, &options), OPTIONS_PADDING);
}

int main(void) {
    /* Many programs: on one backend, the others differ in how they open. */
    const struct CMUnitTest all[] = {cmocka_unit_test(forced_parts_change_nothing)};
    int failed = cmocka_run_group_tests_name("osmesa", all, open_osmesa, close_backend);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(slabs_follow_the_transfer_function),
        cmocka_unit_test(boxes_are_uploaded_whole),
        cmocka_unit_test(same_pictures_are_kept),
        cmocka_unit_test(each_field_counts),
    };
    return failed + run_on_backends(tests);
}
