/* The viewer on a disk that is full for a while: nothing is half written, it goes on, and its end tells. */
#include "tests/core/fixtures.h"

#define FOLDER ANG_TEST_TMP "/view_writes"
#include "tests/app/viewer_hands.h"
#include "tests/io/bad_places.h"

#define FILLER FOLDER "/filler"
#define SAID   ANG_TEST_TMP "/view_writes.txt" /* on another disk */

/* The folder of all files becomes a small disk, seen by this program and the viewer alone. */
static int open_on_a_small_disk(void **state) {
    (void)state;
    if (open_display() != 0) return -1;
    if (!skipped && !make_small(FOLDER, 8192)) skipped = "this user may make no small disk";
    if (skipped) return 0;
    if (run("phantom -o " FOLDER "/phantom --dims 48x48x24 --quiet") != 0) return -1;
    start_viewer(FOLDER "/phantom --preset ct-bone 2>" SAID);
    return 0;
}

static void fill(void) {
    static const char page[4096];
    int filler = open(FILLER, O_WRONLY | O_CREAT, 0666);
    assert_true(filler >= 0);
    while (write(filler, page, sizeof page) > 0) continue;
    close(filler);
}

/* Waits until the viewer has said so often that the state cannot be written. */
static void expect_said(int times) {
    char text[4096] = "";
    for (int i = 0; i < 200; i++, nap(50)) {
        FILE *said = fopen(SAID, "r");
        assert_non_null(said);
        text[fread(text, 1, sizeof text - 1, said)] = '\0';
        fclose(said);
        int count = 0;
        for (const char *at = text; (at = strstr(at, STATE ": cannot be written (No space left on device)")); at++)
            count++;
        if (count == times) return;
    }
    fail_msg("it said: %s", text);
}

static void a_full_disk_costs_nothing_but_the_picture(void **state) {
    (void)state;
    need_window();
    expect_text("phase", "ready");
    expect_flag("refined", true);
    go_to("axial");
    double slice = number_now("axial.slice");
    assert_false(isnan(slice));
    fill();
    hands("key ctrl+shift+s");
    nap(1500);
    hands("key Up");
    expect_said(1);
    assert_false(exists(PICTURES "/angioscope-window-0001.png")); /* tried or not */
    assert_int_equal(hidden_files(PICTURES), 0);
    assert_int_equal(hidden_files(FOLDER), 0);
    assert_close(number_now("axial.slice"), slice, 0); /* the last state that was written, whole */
    assert_int_equal(unlink(FILLER), 0);
    hands("key Up");
    expect_number("axial.slice", slice + 2, 1e-9);
    hands("key ctrl+shift+s");
    for (int i = 0; i < 200 && !exists(PICTURES "/angioscope-window-0001.png"); i++) nap(50);
    assert_close(difference(PICTURES "/angioscope-window-0001.png", PICTURES "/angioscope-window-0001.png"), 0, 0);
}

static void its_end_tells(void **state) {
    (void)state;
    need_window();
    fill();
    hands("key Up");
    expect_said(2);
    hands("key ctrl+q");
    assert_int_equal(wait_for_end(), 7);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_full_disk_costs_nothing_but_the_picture),
        cmocka_unit_test(its_end_tells),
    };
    return cmocka_run_group_tests(tests, open_on_a_small_disk, close_display);
}
