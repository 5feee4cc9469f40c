/* Previews of slices: sizes, greys under the window, means over areas. */
#include "tests/core/fixtures.h"

#include "core/volume/raw_slice.h"

#include <stdlib.h>

static ang_raw_slice slice_of(const uint16_t *values, int width, int height) {
    return (ang_raw_slice){.values = values,
                           .width = width,
                           .height = height,
                           .slope = 1,
                           .hounsfield = true,
                           .window_centre = NAN,
                           .window_width = NAN,
                           .pixel_aspect = 1,
                           .count = 1};
}

static void small_slices_keep_their_pixels(void **state) {
    (void)state;
    /* Greys by hand: 255 * ((value - 1024 - 40) / 400 + 1/2), cut off at 0 and 255. */
    const uint16_t values[] = {0, 864, 964, 1064, 1164, 1264};
    const int greys[] = {0, 0, 64, 128, 191, 255};
    ang_preview *preview = malloc(sizeof *preview);
    assert_non_null(preview);
    ang_raw_slice slice = slice_of(values, 3, 2);
    slice.intercept = -1024;
    ang_preview_make(&slice, ANG_PREVIEW_SIDE, preview);
    assert_int_equal(preview->width, 3);
    assert_int_equal(preview->height, 2);
    for (int i = 0; i < 6; i++) assert_int_equal(preview->grey[i], greys[i]);
    /* A negative slope turns the picture over; the file's window is in its values. */
    slice.slope = -1;
    slice.intercept = 0;
    slice.window_centre = -1064;
    slice.window_width = 400;
    ang_preview_make(&slice, ANG_PREVIEW_SIDE, preview);
    for (int i = 0; i < 6; i++) assert_true(abs(preview->grey[i] - (255 - greys[i])) <= 1);
    /* Values that are no HU: from the least to the greatest. */
    slice = slice_of(values, 3, 2);
    slice.hounsfield = false;
    ang_preview_make(&slice, ANG_PREVIEW_SIDE, preview);
    for (int i = 0; i < 6; i++) assert_int_equal(preview->grey[i], (int)lround(255.0 * values[i] / 1264));
    free(preview);
}

static void pixels_are_square_and_means(void **state) {
    (void)state;
    enum { width = 512, height = 128 };
    uint16_t *values = malloc(sizeof *values * width * height);
    ang_preview *preview = malloc(sizeof *preview);
    assert_true(values && preview);
    for (int i = 0; i < width * height; i++) values[i] = i % 2 ? 0 : 200; /* stripes, whose mean is 100 */
    ang_raw_slice slice = slice_of(values, width, height);
    slice.window_centre = 100;
    slice.window_width = 1000;
    slice.pixel_aspect = 2; /* twice as high as wide: 512 x 256 mm */
    ang_preview_make(&slice, 64, preview);
    assert_int_equal(preview->width, 64);
    assert_int_equal(preview->height, 32);
    for (int i = 0; i < 64 * 32; i++) assert_int_equal(preview->grey[i], 128);
    /* Never larger than the slice. */
    ang_preview_make(&slice, ANG_PREVIEW_SIDE, preview);
    assert_true(preview->width <= width && preview->height <= height && preview->width == 2 * preview->height);
    /* A slice of one colour without a window divides nothing by 0. */
    for (int i = 0; i < width * height; i++) values[i] = 7;
    slice = slice_of(values, width, 1);
    slice.hounsfield = false;
    ang_preview_make(&slice, 1, preview);
    assert_int_equal(preview->width, 1);
    assert_int_equal(preview->height, 1);
    free(values);
    free(preview);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(small_slices_keep_their_pixels),
        cmocka_unit_test(pixels_are_square_and_means),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
