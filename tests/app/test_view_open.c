/* Opening in a real window: by the file browser with the keyboard, series by series, by dropping; loading that is
 * cancelled, and files that cannot be read. */
#include "tests/core/fixtures.h"

#include <zlib.h>

#define FOLDER ANG_TEST_TMP "/view_open"
#include "tests/app/viewer_hands.h"

enum { LONG_SLICES = 2000 }; /* of 512 x 512 bytes */

/* A volume of zeros that takes long to read and little room: one compressed piece, again and again. */
static void write_long_volume(void) {
    enum { piece = 1 << 20 };
    gzFile file = gzopen(FOLDER "/piece.gz", "wb9");
    char *zeros = calloc(1, piece), packed[8192];
    assert_true(file && zeros);
    assert_int_equal(gzwrite(file, zeros, piece), piece);
    gzclose(file);
    free(zeros);
    FILE *in = fopen(FOLDER "/piece.gz", "rb"), *out = fopen(FOLDER "/long.raw.gz", "wb");
    assert_true(in && out);
    size_t length = fread(packed, 1, sizeof packed, in);
    assert_true(length > 0 && length < sizeof packed);
    for (int i = 0; i < LONG_SLICES / 4; i++) assert_int_equal(fwrite(packed, 1, length, out), length);
    fclose(in);
    fclose(out);
    write_file(FOLDER "/long.json", "{\"dims\": [512, 512, 2000], \"type\": \"u8\", \"spacing\": [1, 1, 1]}");
}

/* study/a has 24 slices, study/b 20 and a name that needs escapes; broken is a with a file that is cut off and one that
 * is no picture. */
static int opening(void **state) {
    (void)state;
    if (open_display() != 0) return -1;
    if (skipped) return 0;
    if (run("phantom -o " FOLDER "/study/a --dims 64x64x24 --quiet") != 0 ||
        run("phantom -o '" FOLDER "/study/b ü%' --dims 48x48x20 --quiet") != 0 ||
        system("cp -r " FOLDER "/study/a " FOLDER "/broken && truncate -s 3000 " FOLDER "/broken/IM0003.dcm") != 0)
        return -1;
    write_file(FOLDER "/broken/notes.txt", "no picture");
    write_file(FOLDER "/nothing.dcm", "no picture");
    if (system("mkdir -p " FOLDER "/.more && cd '" FOLDER "/study/b ü%' && python3 -m zipfile -c " FOLDER
               "/.more/b.zip *.dcm") != 0)
        return -1;
    write_long_volume();
    return 0;
}

/* Waits until a number is there, whatever else is shown. */
static void expect_count(const char *path, double expected) {
    double value = NAN;
    for (int i = 0; i < 200; i++) {
        cJSON *state = read_state();
        value = number_at(state, path);
        cJSON_Delete(state);
        if (fabs(value - expected) < 0.5) return;
        nap(50);
    }
    fail_msg("%s is %g, not %g", path, value, expected);
}

/* Letter by letter, as fast as a hand can be. */
static void type(const char *text) { hands("type --delay 12 '%s'", text); }

static void drop(const char *paths) {
#ifdef ANG_DROP_FILES
    char command[1024];
    snprintf(command, sizeof command, "%s %s", ANG_DROP_FILES, paths);
    assert_int_equal(system(command), 0);
#else
    (void)paths;
    print_message("skipped: no X11 to drop files with\n");
    skip();
#endif
}

static void without_a_path_the_file_browser_opens(void **state) {
    (void)state;
    need_window();
    start_viewer("");
    expect_text("phase", "empty");
    expect_text("open", "files");
    /* Esc closes it, Ctrl+O brings it back. */
    hands("key Escape");
    expect_text("open", "");
    hands("key ctrl+o");
    expect_text("open", "files");
}

/* Where the keyboard goes, the list follows: a path typed to its folder, names picked out by their beginnings. */
static void the_keyboard_finds_and_opens_a_folder(void **state) {
    (void)state;
    need_window();
    type(FOLDER "/");                /* behind the folder that is there: a whole path begins anew */
    expect_count("files.listed", 4); /* broken, study, long.raw.gz, nothing.dcm */
    expect_count("files.chosen", -1);
    type("st");
    expect_count("files.listed", 1);
    expect_count("files.chosen", 0);
    hands("key Return"); /* it holds folders: into it */
    expect_count("files.listed", 2);
    hands("key BackSpace"); /* out of it, where it is chosen */
    expect_count("files.listed", 4);
    expect_count("files.chosen", 1);
    hands("key Up");
    expect_count("files.chosen", 0);
    type("stu");
    hands("key Tab"); /* completed, with its slash */
    expect_count("files.listed", 2);
    hands("key Down Down");
    expect_count("files.chosen", 1);
    hands("key Return"); /* it holds pictures alone: open */
    expect_text("phase", "ready");
    expect_text("open", "");
    expect_number("axial.slices", 20, 0);
    hands("key ctrl+o"); /* it remembers the folder */
    expect_count("files.listed", 2);
    hands("key ctrl+Return"); /* all below it */
    expect_number("axial.slices", 24, 0);
}

static void the_second_series_is_chosen_by_hand(void **state) {
    (void)state;
    need_window();
    hands("key F3");
    expect_text("open", "series");
    expect_count("series.listed", 2);
    expect_count("series.looked_at", 2);
    expect_number("series.shown", 2, 0); /* the larger */
    expect_number("series.chosen", 1, 0);
    hands("key Up Return");
    expect_number("series.shown", 1, 0);
    expect_number("axial.slices", 20, 0);
    expect_text("open", "series"); /* to choose on */
    hands("mousemove 100 230 click 1");
    expect_number("series.shown", 2, 0);
    expect_number("axial.slices", 24, 0);
    hands("key F3");
    expect_text("open", "");
}

/* A folder, several files, names with spaces, per cents and letters beyond ASCII. */
static void what_is_dropped_opens(void **state) {
    (void)state;
    need_window();
    drop("'" FOLDER "/study/b ü%'");
    expect_number("axial.slices", 20, 0);
    drop(FOLDER "/study/a/IM000[1-7].dcm");
    expect_number("axial.slices", 7, 0);
    drop(FOLDER "/study");
    expect_number("axial.slices", 24, 0);
    drop(FOLDER "/.more/b.zip");
    expect_number("axial.slices", 20, 0);
    hands("key F3"); /* its series are looked at too */
    expect_count("series.looked_at", 1);
    hands("key F3");
    drop(FOLDER "/study");
    expect_number("axial.slices", 24, 0);
}

/* The study before stays, whatever becomes of what was asked for. */
static void loading_is_cancelled_or_replaced(void **state) {
    (void)state;
    need_window();
    double before = number_now("slices_previewed");
    drop(FOLDER "/long.raw.gz");
    expect_text("phase", "loading");
    for (int i = 0; i < 200 && number_now("slices_previewed") <= before; i++) nap(10);
    assert_true(number_now("slices_previewed") > before);
    hands("key Escape");
    expect_text("phase", "ready");
    expect_number("axial.slices", 24, 0);
    drop(FOLDER "/long.raw.gz");
    expect_text("phase", "loading");
    drop("'" FOLDER "/study/b ü%'");
    expect_text("phase", "ready");
    expect_number("axial.slices", 20, 0);
    drop(FOLDER "/nothing.dcm");
    expect_text("phase", "failed");
    expect_number("axial.slices", 20, 0);
    hands("key F3"); /* of the study that is shown: in what was asked for there is no series */
    expect_count("series.listed", 1);
    expect_count("series.looked_at", 1);
    hands("key F3");
    expect_text("open", "");
    hands("key Return"); /* its first button */
    expect_text("open", "files");
    hands("key --delay 150 Escape Escape");
    expect_text("phase", "ready");
}

/* Presets of 3D Slicer are imported where other files are opened; what is shown stays. */
static void a_preset_file_is_imported(void **state) {
    (void)state;
    need_window();
    FILE *file = fopen(FOLDER "/theirs.xml", "w");
    assert_non_null(file);
    fputs("<MRML><VolumeProperty name='CT-Theirs' scalarOpacity='4 100 0 300 0.5' colorTransfer='4 100 1 0 0'/></MRML>",
          file);
    fclose(file);
    double slices = number_now("axial.slices");
    drop(FOLDER "/theirs.xml");
    expect_text("preset.name", "CT-Theirs");
    expect_number("preset.points.1.opacity", 0.5, 0);
    expect_number("axial.slices", slices, 0);
    assert_true(exists(FOLDER "/config/angioscope/presets/CT-Theirs.json"));
    /* Once more: the first is not written over. By keys. */
    hands("key ctrl+o");
    expect_text("open", "files");
    type(FOLDER "/theirs.xml");
    hands("key --delay 150 Return");
    expect_text("preset.name", "CT-Theirs 2");
    expect_text("open", "");
}

/* The slice that is missing is interpolated, and all is said. */
static void one_broken_file_costs_a_warning(void **state) {
    (void)state;
    need_window();
    expect_count("warnings", 0);
    drop(FOLDER "/broken");
    expect_number("warnings", 2, 0); /* the file, and the gap it leaves */
    expect_number("axial.slices", 24, 0);
    hands("key F2");
    expect_text("open", "report");
    hands("key Escape");
    expect_text("open", "");
    hands("key ctrl+q");
    assert_int_equal(wait_for_end(), 0);
}

/* In the first pane, where there is no study yet: which slice of how many is written in its corner. */
static void slices_show_in_a_pane_as_they_arrive(void **state) {
    (void)state;
    need_window();
    start_viewer(FOLDER "/long.raw.gz");
    for (int i = 0; i < 500 && !(number_now("slices_previewed") > 0); i++) nap(10);
    hands("key ctrl+shift+s");
    expect_text("saved", "angioscope-window-0001.png");
    expect_text("phase", "loading");
    hands("key Escape");
    expect_text("phase", "empty");
    ang_image image;
    assert_true(ang_picture_read(PICTURES "/angioscope-window-0001.png", &image, NULL));
    double corner = 0;
    for (int y = 330; y < 358; y++)
        for (int x = 330; x < 400; x++) corner = fmax(corner, (double)image.rgba[4 * (y * image.width + x)]);
    assert_true(image.width == 1280 && corner > 0.5);
    ang_image_clear(&image);
    hands("key ctrl+q");
    assert_int_equal(wait_for_end(), 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(without_a_path_the_file_browser_opens),
        cmocka_unit_test(the_keyboard_finds_and_opens_a_folder),
        cmocka_unit_test(the_second_series_is_chosen_by_hand),
        cmocka_unit_test(what_is_dropped_opens),
        cmocka_unit_test(loading_is_cancelled_or_replaced),
        cmocka_unit_test(a_preset_file_is_imported),
        cmocka_unit_test(one_broken_file_costs_a_warning),
        cmocka_unit_test(slices_show_in_a_pane_as_they_arrive),
    };
    return cmocka_run_group_tests(tests, opening, close_display);
}
