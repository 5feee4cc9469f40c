/* Films and secondary captures by the program: their frames are the pictures that it writes, and no half film is ever
 * there. Films are read back by ffmpeg, the program. */
#include "tests/core/fixtures.h"

#include "io/image/image_io.h"
#include "tests/app/program.h"

#include <signal.h>
#include <string.h>
#include <unistd.h>

#define FOLDER ANG_TEST_TMP "/render-movie"
#define DATA   FOLDER "/phantom"
#define SCENE  "render " DATA " -q --method cpu --size 64x48 --zoom 1.5 "

enum { W = 64, H = 48, FRAMES = 7, PIXELS = 3 * W * H };

#ifdef ANG_WITH_OPENCV
static bool can_read_films(void) {
    bool can = system("command -v ffmpeg >/dev/null 2>&1") == 0;
    if (!can) print_message("ffmpeg is missing: films are not read back\n");
    return can;
}

/* All frames of a film, as red, green and blue. */
static size_t read_film(const char *path, unsigned char *rgb, size_t room) {
    char command[1024];
    snprintf(command, sizeof command, "ffmpeg -v error -i %s -f rawvideo -pix_fmt rgb24 - 2>/dev/null", path);
    FILE *pipe = popen(command, "r");
    assert_non_null(pipe);
    size_t size = fread(rgb, 1, room, pipe);
    assert_int_equal(pclose(pipe), 0);
    return size;
}

/* The mean square difference of a film's frame from the picture OUT-000N.png, in levels. */
static double difference(const unsigned char *frame, int number, const char *name) {
    char path[512];
    ang_image image;
    double sum = 0;
    snprintf(path, sizeof path, FOLDER "/%s-%04d.png", name, number);
    assert_true(ang_picture_read(path, &image, NULL));
    assert_true(image.width == W && image.height == H);
    for (int i = 0; i < W * H; i++)
        for (int c = 0; c < 3; c++)
            sum += pow((double)frame[3 * i + c] - round(255 * (double)image.rgba[4 * i + c]), 2);
    ang_image_clear(&image);
    return sum / PIXELS;
}

static void compare(const char *film, const char *pictures, double allowed) {
    static unsigned char rgb[(FRAMES + 1) * PIXELS];
    char path[512];
    if (!can_read_films()) return;
    snprintf(path, sizeof path, FOLDER "/%s", film);
    assert_int_equal(read_film(path, rgb, sizeof rgb), FRAMES * PIXELS);
    for (int i = 0; i < FRAMES; i++) {
        double off = sqrt(difference(rgb + i * PIXELS, i + 1, pictures));
        if (off > allowed) fail_msg("%s, frame %d: RMS %g levels, not %g", film, i + 1, off, allowed);
    }
}

static void an_orbit_is_its_pictures(void **state) {
    (void)state;
    expect(0, SCENE "--preset cta-head --frames 7 --orbit 200 -o " FOLDER "/orbit.avi");
    expect(0, SCENE "--preset cta-head --frames 7 --orbit 200 --fps 10 -o " FOLDER "/orbit.mp4");
    expect(0, SCENE "--preset cta-head --frames 7 --orbit 200 -o " FOLDER "/orbit.png");
    compare("orbit.avi", "orbit", 0);
    compare("orbit.mp4", "orbit", 12);
}

/* The first and last frames are the presets' pictures, and the middle one the second's. */
static void a_sweep_goes_from_preset_to_preset(void **state) {
    (void)state;
    expect(0, SCENE "--sweep ct-skin,ct-bone,cta-head --frames 7 -o " FOLDER "/sweep.avi");
    expect(0, SCENE "--sweep ct-skin,ct-bone,cta-head --frames 7 -o " FOLDER "/sweep.png");
    compare("sweep.avi", "sweep", 0);
    static const char *const presets[] = {"ct-skin", "ct-bone", "cta-head"};
    for (int i = 0; i < 3; i++) {
        char command[1024];
        snprintf(command, sizeof command, SCENE "--preset %s -o " FOLDER "/still.ppm", presets[i]);
        expect(0, command);
        snprintf(command, sizeof command, "check " FOLDER "/still.ppm " FOLDER "/sweep-%04d.png", 1 + 3 * i);
        expect(0, command);
    }
    /* Each carries what it shows, though no file has that preset. */
    expect(0, "render " DATA " -q --state " FOLDER "/sweep-0003.png -o " FOLDER "/again.png");
    assert_int_equal(system("cmp -s " FOLDER "/again.png " FOLDER "/sweep-0003.png"), 0);
}

static void what_cannot_be_filmed_is_said(void **state) {
    (void)state;
    expect(2, SCENE "-o " FOLDER "/x.avi 2>&1");
    assert_non_null(strstr(output, "--frames"));
    expect(2, SCENE "--size 63x48 --frames 2 --orbit 9 -o " FOLDER "/x.mp4 2>&1");
    assert_non_null(strstr(output, "64x48"));
    expect(7, SCENE "--frames 2 --orbit 9 -o " FOLDER "/none/x.mp4 2>&1");
    expect(2, SCENE "--frames 2 --sweep ct-bone -o " FOLDER "/x.mp4 2>&1");
    expect(2, SCENE "--frames 2 --sweep ct-bone,ct-mip -o " FOLDER "/x.mp4 2>&1");
    assert_non_null(strstr(output, "mode mip"));
    expect(2, SCENE "--frames 2 --preset ct-bone --sweep ct-bone,ct-skin -o " FOLDER "/x.mp4 2>&1");
    expect(2, SCENE "--sweep ct-bone,ct-skin -o " FOLDER "/x.png 2>&1");
    assert_int_equal(system("ls -A " FOLDER " | grep -q '^x\\|part'"), 256);
}

/* Stopped in the middle, politely or not, it leaves the old file; politely, nothing else either. */
static void a_film_is_whole_or_not_there(void **state) {
    (void)state;
    static const int signals[] = {SIGINT, SIGKILL};
    for (int i = 0; i < 2; i++) {
        char command[1024];
        assert_int_equal(system("rm -rf " FOLDER "/stop && mkdir " FOLDER "/stop && echo old > " FOLDER "/stop/a.avi"),
                         0);
        snprintf(command, sizeof command,
                 ANG_PROGRAM " " SCENE "--frames 100000 --orbit 360 -o " FOLDER "/stop/a.avi & program=$!\n"
                             "until ls -A " FOLDER "/stop | grep -q part; do sleep 0.05; done\n"
                             "kill -%d $program; wait $program",
                 signals[i]);
        FILE *script = fopen(FOLDER "/stop.sh", "w");
        assert_non_null(script);
        fputs(command, script);
        fclose(script);
        int status = system("sh " FOLDER "/stop.sh 2>/dev/null");
        assert_true(WIFEXITED(status));
        assert_int_equal(WEXITSTATUS(status), signals[i] == SIGINT ? 130 : 128 + SIGKILL);
        assert_int_equal(system("grep -qx old " FOLDER "/stop/a.avi"), 0);
        if (signals[i] == SIGINT) assert_int_equal(system("ls -A " FOLDER "/stop | grep -q part"), 256);
    }
}
#else
static void films_are_left_out(void **state) {
    (void)state;
    expect(2, SCENE "--frames 2 --orbit 9 -o " FOLDER "/x.mp4 2>&1");
    assert_non_null(strstr(output, "ANG_WITH_OPENCV"));
}
#endif

static void captures_are_the_pictures(void **state) {
    (void)state;
    static unsigned char bytes[1 << 16];
    expect(0, SCENE "--preset cta-head --frames 2 --orbit 90 -o " FOLDER "/c.dcm");
    expect(0, SCENE "--preset cta-head --frames 2 --orbit 90 -o " FOLDER "/c.ppm");
    for (int i = 1; i <= 2; i++) {
        char path[512];
        ang_image image;
        snprintf(path, sizeof path, FOLDER "/c-%04d.dcm", i);
        FILE *in = fopen(path, "rb");
        assert_non_null(in);
        size_t size = fread(bytes, 1, sizeof bytes, in);
        fclose(in);
        assert_true(size > PIXELS && size < sizeof bytes);
        assert_null(memmem(bytes, size, "Phantom", 7));
        assert_null(memmem(bytes, size, "cta-head", 8)); /* as own presets may be called anything */
        snprintf(path, sizeof path, FOLDER "/c-%04d.ppm", i);
        assert_true(ang_picture_read(path, &image, NULL));
        for (int p = 0; p < PIXELS; p++)
            assert_int_equal(bytes[size - PIXELS + (size_t)p], lround(255 * (double)image.rgba[4 * (p / 3) + p % 3]));
        ang_image_clear(&image);
    }
    expect(0, SCENE "--preset cta-head --keep-phi -o " FOLDER "/kept.dcm");
    assert_int_equal(system("grep -q Phantom^Angioscope " FOLDER "/kept.dcm"), 0);
    assert_int_equal(system("grep -q 'preset cta-head' " FOLDER "/kept.dcm"), 0);
    expect(2, SCENE "-o " DATA "/IM0001.dcm 2>&1");
}

int main(void) {
    if (system("rm -rf " FOLDER " && mkdir -p " FOLDER) != 0 || run("phantom -q --dims 48x48x24 -o " DATA) != 0)
        return 1;
    const struct CMUnitTest tests[] = {
#ifdef ANG_WITH_OPENCV
        cmocka_unit_test(an_orbit_is_its_pictures),      cmocka_unit_test(a_sweep_goes_from_preset_to_preset),
        cmocka_unit_test(what_cannot_be_filmed_is_said), cmocka_unit_test(a_film_is_whole_or_not_there),
#else
        cmocka_unit_test(films_are_left_out),
#endif
        cmocka_unit_test(captures_are_the_pictures),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
