/* A picture that sharpens level by level, and ends as the one drawn at once. */
#include "tests/core/backends.h"
#include "tests/core/scenes.h"

#include "core/render/progressive.h"

#include <string.h>

/* A method that draws a plane of values and remembers which pixels it drew, how often. */
enum { MOST = 64 };
struct ang_renderer {
    int drawn[MOST][MOST];
};

static bool draw_plane(ang_renderer *renderer, const ang_scene *scene, const ang_render_options *options,
                       ang_image *image, ang_frame_stats *stats, const ang_progress *progress, ang_error *err) {
    (void)options, (void)stats;
    const ang_sampling *at = &scene->sampling;
    int stride = at->stride > 0 ? at->stride : 1;
    for (int j = 0; j < scene->height; j++)
        for (int i = 0; i < scene->width; i++) {
            int x = at->first_x + i * stride, y = at->first_y + j * stride;
            renderer->drawn[y][x]++;
            for (int c = 0; c < 4; c++) image->rgba[4 * (j * image->width + i) + c] = (float)(c + 2 * x + 4 * y);
        }
    return ang_progress_update(progress, "drawing", 1) || ang_fail(err, ANG_INTERRUPTED, "interrupted");
}

static const ang_method plane = {.name = "plane", .splits = true, .render = draw_plane};

static bool step(ang_progressive *picture, ang_renderer *renderer, const ang_scene *scene,
                 const ang_progress *progress) {
    return ang_progressive_step(picture, &plane, renderer, scene, &ang_render_options_default, progress, NULL);
}

static int expected_at(int x, int y, int c) { return c + 2 * x + 4 * y; }

/* A plane is what bilinear filling gives back; beyond the last pixel that is there it stays as that is. */
static void check_plane(const ang_progressive *picture, const ang_renderer *renderer) {
    int stride = ang_progressive_stride(picture->level);
    int last_x = (picture->image.width - 1) / stride * stride, last_y = (picture->image.height - 1) / stride * stride;
    for (int y = 0; y < picture->image.height; y++)
        for (int x = 0; x < picture->image.width; x++) {
            assert_int_equal(renderer->drawn[y][x], x % stride == 0 && y % stride == 0);
            const float *pixel = picture->image.rgba + 4 * (y * picture->image.width + x);
            for (int c = 0; c < 4; c++)
                assert_close(pixel[c], expected_at(x < last_x ? x : last_x, y < last_y ? y : last_y, c), 0);
        }
}

static void each_level_adds_pixels_and_draws_none_twice(void **state) {
    (void)state;
    static const int sizes[][2] = {{64, 64}, {61, 48}, {8, 17}, {7, 3}, {1, 9}, {2, 1}, {1, 1}};
    for (size_t s = 0; s < sizeof sizes / sizeof *sizes; s++)
        for (int first = 1; first <= ANG_PROGRESSIVE_LEVELS; first++) {
            ang_renderer renderer = {0};
            ang_scene scene = {.width = sizes[s][0], .height = sizes[s][1]};
            ang_progressive picture = {0};
            assert_true(ang_progressive_start(&picture, &plane, &scene, first, NULL));
            for (int level = first; level <= ANG_PROGRESSIVE_LEVELS; level++) {
                assert_true(step(&picture, &renderer, &scene, NULL));
                assert_int_equal(picture.level, level);
                check_plane(&picture, &renderer);
            }
            assert_true(step(&picture, &renderer, &scene, NULL)); /* nothing more to do */
            check_plane(&picture, &renderer);
            ang_progressive_clear(&picture);
        }
}

/* Goes on as often as `context` counts. */
static bool some_more(void *context, const char *what, double fraction) {
    (void)what, (void)fraction;
    int *left = context;
    return (*left)-- > 0;
}

/* Ten parts in all; what a stop throws away is the part that it stopped. */
static void what_was_drawn_before_a_stop_is_kept(void **state) {
    (void)state;
    enum { PARTS = 10 };
    ang_scene scene = {.width = 40, .height = 33};
    for (int parts = 0; parts < PARTS; parts++) {
        ang_renderer renderer = {0};
        ang_progressive picture = {0};
        int left = parts;
        ang_progress progress = {some_more, &left};
        assert_true(ang_progressive_start(&picture, &plane, &scene, 1, NULL));
        while (step(&picture, &renderer, &scene, &progress)) assert_true(picture.level < ANG_PROGRESSIVE_LEVELS);
        assert_int_equal(picture.level, (parts + 2) / 3);
        int before = picture.level;
        while (picture.level < ANG_PROGRESSIVE_LEVELS) assert_true(step(&picture, &renderer, &scene, NULL));
        assert_true(before < ANG_PROGRESSIVE_LEVELS);
        int twice = 0;
        for (int y = 0; y < scene.height; y++)
            for (int x = 0; x < scene.width; x++) {
                assert_in_range(renderer.drawn[y][x], 1, 2);
                twice += renderer.drawn[y][x] == 2;
                assert_close(picture.image.rgba[4 * (y * scene.width + x)], expected_at(x, y, 0), 0);
            }
        /* The first of each level's parts begins in row 0, beside the first column. */
        assert_true(twice > 0 && twice <= 20 * 17);
        ang_progressive_clear(&picture);
    }
}

/* Another picture, of another size, begins from nothing. */
static void a_new_picture_forgets_the_one_before(void **state) {
    (void)state;
    ang_progressive picture = {0};
    ang_scene scenes[] = {{.width = 30, .height = 20}, {.width = 20, .height = 30}};
    for (int i = 0; i < 4; i++) {
        ang_renderer renderer = {0};
        const ang_scene *scene = &scenes[i / 2];
        assert_true(ang_progressive_start(&picture, &plane, scene, 1, NULL));
        assert_int_equal(picture.level, 0);
        for (int level = 0; level < 2 + i; level++) assert_true(step(&picture, &renderer, scene, NULL));
        check_plane(&picture, &renderer);
    }
    ang_progressive_clear(&picture);
    assert_null(picture.image.rgba);
}

static void draw_levels(const ang_method *method, ang_renderer *renderer, const ang_scene *scene,
                        const ang_image *whole) {
    ang_progressive picture = {0};
    ang_error err = {0};
    assert_true(ang_progressive_start(&picture, method, scene, 1, &err));
    int steps = 0;
    while (picture.level < ANG_PROGRESSIVE_LEVELS) {
        if (!ang_progressive_step(&picture, method, renderer, scene, &ang_render_options_default, NULL, &err))
            fail_msg("%s: %s", method->name, err.message);
        int stride = ang_progressive_stride(picture.level);
        steps++;
        for (int y = 0; y < scene->height; y += stride)
            for (int x = 0; x < scene->width; x += stride) {
                size_t at = 4 * ((size_t)y * (size_t)scene->width + (size_t)x);
                assert_memory_equal(picture.image.rgba + at, whole->rgba + at, 4 * sizeof(float));
            }
    }
    assert_int_equal(steps, method->splits ? ANG_PROGRESSIVE_LEVELS : 1);
    ang_progressive_clear(&picture);
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
            ang_image whole;
            assert_true(ang_image_create(&whole, scene.width, scene.height, &err));
            assert_true(method->render(renderer, &scene, &ang_render_options_default, &whole, NULL, NULL, &err));
            draw_levels(method, renderer, &scene, &whole);
            ang_image_clear(&whole);
        }
    method->destroy(renderer);
}

static void the_last_level_is_the_picture_to_the_bit(void **state) {
    open_gl(state);
    ang_volume *volume = sheared_volume(sparse_value);
    ang_transfer *transfer = vessels();
    for (const ang_method *const *method = ang_methods(); *method; method++)
        check_method(*method, (*method)->needs_gl ? gl : NULL, volume, transfer);
    ang_transfer_free(transfer);
    ang_volume_free(volume);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(the_last_level_is_the_picture_to_the_bit)};
    const struct CMUnitTest plain[] = {
        cmocka_unit_test(each_level_adds_pixels_and_draws_none_twice),
        cmocka_unit_test(what_was_drawn_before_a_stop_is_kept),
        cmocka_unit_test(a_new_picture_forgets_the_one_before),
    };
    return cmocka_run_group_tests(plain, NULL, NULL) + run_on_backends(tests);
}
