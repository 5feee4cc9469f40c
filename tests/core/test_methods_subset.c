/* A subset of a picture's pixels is those pixels of the picture, whatever the method. */
#include "tests/core/backends.h"
#include "tests/core/scenes.h"

#include "core/plan/planes.h"
#include "core/scene/annotation.h"

enum { stride = 5, first_x = 3, first_y = 1 };

/* Rays reach the shaders in floats: of a subset they are others by some 4e-6 of a voxel, over which values change by up
 * to 200 HU a voxel and opacity by up to 1 / 500 a HU, on every sample that shows. 2e-5 is 0.005 levels. */
static const double rounding = 2e-5;

static void draw(const ang_method *method, ang_renderer *renderer, const ang_scene *scene, ang_image *image) {
    ang_error err = {0};
    assert_true(ang_image_create(image, scene->width, scene->height, &err));
    if (!method->render(renderer, scene, &ang_render_options_default, image, NULL, NULL, &err))
        fail_msg("%s: %s", method->name, err.message);
}

/* The greatest difference of a pixel from the same one in the whole picture. */
static double greatest_difference(const ang_image *part, const ang_image *whole) {
    double greatest = 0;
    for (int j = 0; j < part->height; j++)
        for (int i = 0; i < part->width; i++)
            for (int c = 0; c < 4; c++) {
                int at = 4 * ((first_y + stride * j) * whole->width + first_x + stride * i) + c;
                double difference = fabs((double)part->rgba[4 * (j * part->width + i) + c] - whole->rgba[at]);
                greatest = fmax(greatest, difference);
            }
    return greatest;
}

static void check_planes(const ang_volume *volume, const ang_scene *scene, const ang_scene *subset) {
    ang_ray_frame whole, part;
    assert_true(ang_ray_frame_make(volume, scene, &whole, NULL));
    assert_true(ang_ray_frame_make(volume, subset, &part, NULL));
    ang_slice_planes a = ang_slice_planes_make(&whole, 0.4), b = ang_slice_planes_make(&part, 0.4);
    assert_int_equal(a.count, b.count);
    assert_close(b.first, a.first, 1e-10);
    assert_close(b.distance, a.distance, 0);
}

static void check_method(const ang_method *method, ang_gl *gl, const ang_volume *volume, const ang_transfer *transfer) {
    static const ang_mode modes[] = {ANG_MODE_DVR, ANG_MODE_MIP, ANG_MODE_MEAN, ANG_MODE_ISO};
    ang_error err = {0};
    ang_renderer *renderer = method->create(gl, volume, &ang_render_options_default, &err);
    if (!renderer) fail_msg("%s", err.message);
    for (int which = 0; which < SCENES; which++)
        for (size_t mode = 0; mode < sizeof modes / sizeof *modes; mode++) {
            ang_scene scene = make_scene(which, volume, transfer);
            scene.mode = modes[mode];
            scene.shading = which % 2 ? ANG_SHADING_NONE : ANG_SHADING_PHONG;
            ang_scene subset = ang_scene_subset(&scene, stride, first_x, first_y);
            check_planes(volume, &scene, &subset);
            ang_image whole, part;
            draw(method, renderer, &scene, &whole);
            draw(method, renderer, &subset, &part);
            double difference = greatest_difference(&part, &whole);
            print_message("%-10s scene %d %-5s: %.2g\n", method->name, which, ang_mode_name(scene.mode), difference);
            assert_true(difference <= (method->needs_gl ? rounding : 0));
            ang_image_clear(&part);
            ang_image_clear(&whole);
        }
    method->destroy(renderer);
}

static void a_subset_shows_the_pixels_of_the_picture(void **state) {
    open_gl(state);
    ang_volume *volume = sheared_volume(sparse_value);
    ang_transfer *transfer = vessels();
    for (const ang_method *const *method = ang_methods(); *method; method++)
        check_method(*method, (*method)->needs_gl ? gl : NULL, volume, transfer);
    ang_transfer_free(transfer);
    ang_volume_free(volume);
}

static void a_pixel_of_a_subset_is_as_many_larger(void **state) {
    (void)state;
    ang_volume *volume = sheared_volume(flat_value);
    ang_scene scene = make_scene(0, volume, NULL), subset = ang_scene_subset(&scene, stride, first_x, first_y);
    double whole = ang_annotation_make(&scene, NULL).mm_per_pixel;
    assert_close(ang_annotation_make(&subset, NULL).mm_per_pixel, stride * whole, 1e-12);
    ang_volume_free(volume);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(a_subset_shows_the_pixels_of_the_picture)};
    const struct CMUnitTest plain[] = {cmocka_unit_test(a_pixel_of_a_subset_is_as_many_larger)};
    return run_on_backends(tests) + cmocka_run_group_tests(plain, NULL, NULL);
}
