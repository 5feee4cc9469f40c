/* Pictures saved from a real window: all that were asked for, refined, without what is there for the hand. */
#include "tests/core/fixtures.h"

#define FOLDER ANG_TEST_TMP "/view_pictures"
#include "tests/app/viewer_hands.h"

static void wait_for_picture(const char *name) {
    char path[256];
    snprintf(path, sizeof path, PICTURES "/%s", name);
    for (int i = 0; i < 200; i++) {
        if (access(path, R_OK) == 0) return;
        nap(50);
    }
    fail_msg("%s is not saved", name);
}

static ang_image read_picture(const char *name) {
    char path[256];
    ang_image image;
    ang_error err = {0};
    snprintf(path, sizeof path, PICTURES "/%s", name);
    if (!ang_picture_read(path, &image, &err)) fail_msg("%s", err.message);
    return image;
}

/* While the volume is coarse three pictures are asked for; the window's has the refined volume, as the pane's has. */
static void all_that_are_asked_for_are_saved_refined(void **state) {
    (void)state;
    need_window();
    expect_text("phase", "ready");
    expect_flag("refined", true);
    go_to("volume");
    drag(1, 60, 20);
    hands("key ctrl+s key F12 key ctrl+shift+s");
    wait_for_picture("angioscope-volume-0001.png");
    wait_for_picture("angioscope-volume-seen-0001.png");
    expect_text("saved", "angioscope-window-0001.png");
    ang_image pane = read_picture("angioscope-volume-seen-0001.png");
    ang_image window = read_picture("angioscope-window-0001.png");
    cJSON *shown = read_state();
    int left = (int)number_at(shown, "panes.volume.0"), top = (int)number_at(shown, "panes.volume.1");
    cJSON_Delete(shown);
    assert_true(left + pane.width <= window.width && top + pane.height <= window.height);
    for (int y = 0; y < pane.height; y++)
        assert_memory_equal(pane.rgba + 4 * (size_t)y * (size_t)pane.width,
                            window.rgba + 4 * ((size_t)(top + y) * (size_t)window.width + (size_t)left),
                            4 * sizeof *pane.rgba * (size_t)pane.width);
    ang_image_clear(&pane);
    ang_image_clear(&window);
}

/* The bytes of a saved file. Free with free(). */
static unsigned char *bytes_of(const char *name, size_t *size) {
    char path[256];
    snprintf(path, sizeof path, PICTURES "/%s", name);
    FILE *file = fopen(path, "rb");
    assert_non_null(file);
    fseek(file, 0, SEEK_END);
    *size = (size_t)ftell(file);
    rewind(file);
    unsigned char *bytes = malloc(*size);
    assert_int_equal(fread(bytes, 1, *size, file), *size);
    fclose(file);
    return bytes;
}

/* A secondary capture ends with the pixels of the pane's picture; it has directions and no patient. */
static void check_capture(const char *pane, const char *orientation) {
    char name[2][64], stem[48];
    snprintf(stem, sizeof stem, "angioscope-%s-0001", pane);
    snprintf(name[0], sizeof name[0], "%s.png", stem);
    snprintf(name[1], sizeof name[1], "%s.dcm", stem);
    go_to(pane);
    if (strcmp(pane, "volume") != 0) hands("key ctrl+s"); /* that is there */
    wait_for_picture(name[0]);
    hands("key ctrl+d");
    expect_text("saved", name[1]);
    size_t size;
    unsigned char *file = bytes_of(name[1], &size);
    ang_image picture = read_picture(name[0]);
    size_t values = 3 * (size_t)picture.width * (size_t)picture.height, padded = (values + 1) / 2 * 2;
    assert_true(size > padded);
    for (size_t i = 0; i < values; i++)
        assert_int_equal(file[size - padded + i], lround(255 * (double)picture.rgba[4 * (i / 3) + i % 3]));
    size_t header = size - padded;
    assert_memory_equal(file + 128, "DICM", 4);
    assert_non_null(memmem(file, header, "Anonymous^", 10));
    assert_non_null(memmem(file, header, orientation, strlen(orientation)));
    free(file);
    ang_image_clear(&picture);
}

static void panes_are_saved_as_dicom(void **state) {
    (void)state;
    need_window();
    check_capture("axial", "L\\P");
    check_capture("coronal", "L\\F");
    check_capture("volume", "DERIVED");
}

/* The same picture whether the pointer, and with it the crosshair's handles, is in the pane or not. */
static void handles_are_in_no_picture(void **state) {
    (void)state;
    need_window();
    go_to("axial");
    hands("key F12");
    expect_text("saved", "angioscope-axial-seen-0001.png");
    hands("mousemove 700 8 key F12"); /* the bar of menus: keys are still the pane's */
    expect_text("saved", "angioscope-axial-seen-0002.png");
    assert_close(difference(PICTURES "/angioscope-axial-seen-0001.png", PICTURES "/angioscope-axial-seen-0002.png"), 0,
                 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(all_that_are_asked_for_are_saved_refined),
        cmocka_unit_test(panes_are_saved_as_dicom),
        cmocka_unit_test(handles_are_in_no_picture),
        cmocka_unit_test(it_ends_well),
    };
    return cmocka_run_group_tests(tests, open_phantom, close_display);
}
