#include "io/image/annotate.h"
#include "io/image/image_io.h"
#include "io/replace.h"

#include <dirent.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

#include <cmocka.h>

#ifndef ANG_TEST_TMP
#define ANG_TEST_TMP "."
#endif

enum { W = 37, H = 23 };
static const double black[4] = {0, 0, 0, 1};
#ifdef ANG_WITH_OIIO
static const double none[4] = {0, 0, 0, 0};
#endif
static char folder[512];

static int setup(void **state) {
    (void)state;
    snprintf(folder, sizeof folder, ANG_TEST_TMP "/image_io-%ld", (long)getpid());
    ang_error err;
    return ang_folder_make(folder, &err) ? 0 : -1;
}

static int teardown(void **state) {
    (void)state;
    DIR *dir = opendir(folder);
    for (struct dirent *entry; dir && (entry = readdir(dir));) {
        char path[1024];
        snprintf(path, sizeof path, "%s/%s", folder, entry->d_name);
        if (entry->d_name[0] != '.' || strncmp(entry->d_name, ".ang", 4) == 0) remove(path);
    }
    if (dir) closedir(dir);
    return rmdir(folder);
}

static const char *at(const char *name) {
    static char path[1024];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    return path;
}

/* Premultiplied ramps; alpha too where asked for. */
static ang_image ramp(bool translucent) {
    ang_image image;
    ang_error err;
    assert_true(ang_image_create(&image, W, H, &err));
    for (int y = 0; y < H; y++) {
        for (int x = 0; x < W; x++) {
            float *p = image.rgba + 4 * ((size_t)y * W + (size_t)x);
            float a = translucent ? (float)(x + 1) / W : 1;
            p[0] = a * (float)x / (W - 1);
            p[1] = a * (float)y / (H - 1);
            p[2] = a * 0.3F;
            p[3] = a;
        }
    }
    return image;
}

static double largest_difference(const ang_image *a, const ang_image *b, int channels) {
    assert_int_equal(a->width, b->width);
    assert_int_equal(a->height, b->height);
    double largest = 0;
    for (size_t i = 0; i < 4 * (size_t)a->width * (size_t)a->height; i++) {
        if ((int)(i % 4) < channels) largest = fmax(largest, fabs((double)a->rgba[i] - (double)b->rgba[i]));
    }
    return largest;
}

static void round_trip(const char *name, bool translucent, const double background[4], double tolerance) {
    ang_image image = ramp(translucent), back;
    ang_error err = {0};
    if (!ang_image_write(at(name), &image, background, &err)) fail_msg("%s", err.message);
    if (!ang_picture_read(at(name), &back, &err)) fail_msg("%s", err.message);
    double difference = largest_difference(&image, &back, 4);
    if (difference > tolerance) fail_msg("%s: differs by %g", name, difference);
    ang_image_clear(&image);
    ang_image_clear(&back);
}

static void every_format_comes_back(void **state) {
    (void)state;
    round_trip("a.ppm", false, black, 0.5001 / 255);
    round_trip("a.pfm", false, black, 0);
#ifdef ANG_WITH_OIIO
    round_trip("a.png", false, black, 0.5001 / 255);
    round_trip("a.TIFF", false, black, 0.5001 / 255);
    round_trip("a.exr", false, black, 0);
    /* Alpha and the unassociated colour are each rounded to 8 bits. */
    round_trip("b.png", true, none, 1.01 / 255);
    round_trip("b.tif", true, none, 1.01 / 255);
    round_trip("b.exr", true, none, 0);
#endif
}

static void float_is_not_clipped_and_keeps_rows(void **state) {
    (void)state;
    const char *names[] = {"c.pfm", "c.exr"};
    for (size_t n = 0; n < 2; n++) {
#ifndef ANG_WITH_OIIO
        if (n == 1) break;
#endif
        ang_image image = ramp(false), back;
        image.rgba[0] = 7.5F;
        image.rgba[1] = -0.25F;
        ang_error err;
        assert_true(ang_image_write(at(names[n]), &image, black, &err));
        assert_true(ang_picture_read(at(names[n]), &back, &err));
        assert_true(back.rgba[0] == 7.5F && back.rgba[1] == -0.25F);
        assert_true(largest_difference(&image, &back, 4) == 0);
        ang_image_clear(&image);
        ang_image_clear(&back);
    }
}

static void background_shows_through(void **state) {
    (void)state;
    ang_image image, back;
    ang_error err;
    assert_true(ang_image_create(&image, 3, 2, &err));
    for (int i = 0; i < 6; i++) {
        image.rgba[4 * i] = 0.5F; /* half transparent red */
        image.rgba[4 * i + 3] = 0.5F;
    }
    const double white[4] = {1, 1, 1, 1}, half[4] = {0, 1, 0, 0.5};
    assert_true(ang_image_write(at("d.ppm"), &image, white, &err));
    assert_true(ang_picture_read(at("d.ppm"), &back, &err));
    assert_true(fabsf(back.rgba[0] - 1) < 1e-6F && fabsf(back.rgba[1] - 128.0F / 255) < 1e-6F);
    ang_image_clear(&back);
#ifdef ANG_WITH_OIIO
    assert_true(ang_image_write(at("d.exr"), &image, half, &err));
    assert_true(ang_picture_read(at("d.exr"), &back, &err));
    assert_true(fabsf(back.rgba[0] - 0.5F) < 1e-6F && fabsf(back.rgba[1] - 0.25F) < 1e-6F);
    assert_true(fabsf(back.rgba[3] - 0.75F) < 1e-6F);
    ang_image_clear(&back);
#else
    (void)half;
#endif
    ang_image_clear(&image);
}

static int files_in_folder(void) {
    int count = 0;
    DIR *dir = opendir(folder);
    while (dir && readdir(dir)) count++;
    if (dir) closedir(dir);
    return count;
}

static void failures_name_the_file_and_leave_nothing(void **state) {
    (void)state;
    ang_image image = ramp(false);
    ang_error err = {0};
    assert_false(ang_image_write(at("e.jpg"), &image, black, &err));
    assert_int_equal(err.code, ANG_USAGE);
    assert_false(ang_image_writable(at("e"), &err));
    assert_true(ang_image_writable(at("e.ppm"), &err));
    assert_false(ang_image_write(at("no-folder/e.ppm"), &image, black, &err));
    assert_int_equal(err.code, ANG_OUTPUT);
    assert_non_null(strstr(err.message, "no-folder/e.ppm"));
    assert_non_null(strstr(err.message, "No such file"));
    assert_int_equal(mkdir(at("e.pfm"), 0777), 0);
    int before = files_in_folder();
    assert_false(ang_image_write(at("e.pfm"), &image, black, &err));
    assert_int_equal(err.code, ANG_OUTPUT);
    assert_int_equal(files_in_folder(), before);
    rmdir(at("e.pfm"));
    ang_image_clear(&image);
}

static void broken_pictures_are_refused(void **state) {
    (void)state;
    static const char *const names[] = {"f.ppm", "f.pfm", "f.png", "f.tif", "f.exr"};
    static const char *const contents[] = {
        "",      "P6\n3 3\n255\nabc",     "PF 99999999 99999999 -1\n", "\x89PNG\r\n\x1a\n",
        "II*\0", "PF\n65536 65536\n-1\n", "P6\n1x 1\n255\nabc"};
    for (size_t n = 0; n < sizeof names / sizeof *names; n++) {
        for (size_t c = 0; c < sizeof contents / sizeof *contents; c++) {
            ang_error err = {0};
            assert_true(ang_file_replace(at(names[n]), contents[c], strlen(contents[c]), &err));
            ang_image image;
            assert_false(ang_picture_read(at(names[n]), &image, &err));
            assert_true(err.code == ANG_INPUT || err.code == ANG_USAGE);
            assert_null(image.rgba);
        }
    }
}

/* No dates, paths or host names: the same picture gives the same bytes. */
static void files_hold_nothing_that_identifies(void **state) {
    (void)state;
#ifdef ANG_WITH_OIIO
    static const char *const names[] = {"g.png", "g.tif", "g.exr"};
    char year[16];
    time_t now = time(NULL);
    strftime(year, sizeof year, "%Y:", localtime(&now));
    const char *words[] = {year, "tIME", "HostComputer", "Artist", "owner", ANG_TEST_TMP};
    ang_image image = ramp(false);
    for (size_t n = 0; n < 3; n++) {
        ang_error err;
        assert_true(ang_image_write(at(names[n]), &image, black, &err));
        FILE *file = fopen(at(names[n]), "rb");
        static char bytes[65536];
        size_t size = fread(bytes, 1, sizeof bytes, file);
        fclose(file);
        for (size_t w = 0; w < sizeof words / sizeof *words; w++) {
            if (memmem(bytes, size, words[w], strlen(words[w]))) fail_msg("%s holds %s", names[n], words[w]);
        }
    }
    ang_image_clear(&image);
#endif
}

/* What is read back is off by no more than the format is said to round, and by more than half of that. */
static void formats_round_as_they_say(void **state) {
    (void)state;
    static const char *const names[] = {"r.ppm", "r.pfm", "r.png", "r.tif", "r.exr"};
    enum { side = 64 };
    ang_image image;
    ang_error err;
    assert_true(ang_image_create(&image, side, side, &err));
    uint32_t seed = 7;
    for (int i = 0; i < side * side; i++) {
        float *p = image.rgba + 4 * (size_t)i;
        for (int c = 3; c >= 0; c--) {
            seed = seed * 1664525U + 1013904223U;
            p[c] = (c < 3 ? p[3] : 1) * (float)((double)(seed >> 8) / (1 << 24));
        }
    }
    for (size_t n = 0; n < sizeof names / sizeof *names; n++)
        for (int opaque = 0; opaque < 2; opaque++) {
            const double background[4] = {0.2, 0.5, 0.7, opaque};
            if (strcmp(names[n], "r.ppm") == 0 && !opaque) continue; /* keeps no alpha */
            if (strcmp(names[n], "r.pfm") == 0 && !opaque) continue;
            ang_image back;
            if (!ang_image_write(at(names[n]), &image, background, &err)) {
                assert_int_equal(err.code, ANG_USAGE); /* left out of this build */
                continue;
            }
            if (!ang_picture_read(at(names[n]), &back, &err)) fail_msg("%s", err.message);
            double most = 0, rounding = ang_image_rounding(names[n], background);
            for (int i = 0; i < side * side; i++)
                for (int c = 0; c < 4; c++) {
                    const float *p = image.rgba + 4 * (size_t)i;
                    double behind = opaque * (1 - (double)p[3]), base = c < 3 ? background[c] : 1;
                    most =
                        fmax(most, fabs((double)back.rgba[4 * (size_t)i + (size_t)c] - (double)p[c] - behind * base));
                }
            if (!(255 * most <= rounding + 1e-4) || !(255 * most >= rounding / 2))
                fail_msg("%s over alpha %d: off by %g levels, said %g", names[n], opaque, 255 * most, rounding);
            ang_image_clear(&back);
        }
    ang_image_clear(&image);
}

/* Letters, caption and bar, or none of them: a bar without its length says nothing. */
static void annotations_are_whole_or_not_there(void **state) {
    (void)state;
    ang_annotation annotation = {.left = {"R"},
                                 .bar_mm = 50,
                                 .bar_pixels = 40,
                                 .bar_label = "50 mm",
                                 .caption = "cta-head, dvr",
                                 .remark = "error about 24 levels, 1234 ms"};
    ang_image image;
    ang_notes warnings = {0};
    ang_error err;
    assert_true(ang_image_create(&image, 200, 160, &err));
    assert_true(ang_image_annotate(&image, &annotation, &warnings, &err));
    bool drawn = false;
    for (size_t i = 0; i < 4 * 200 * 160; i++) drawn = drawn || image.rgba[i] > 0;
#ifdef ANG_WITH_OIIO
    assert_int_equal(drawn, warnings.count == 0);
#else
    assert_false(drawn);
    assert_int_equal(warnings.count, 1);
#endif
    if (warnings.count > 0) assert_non_null(strstr(warnings.text[0], "letters, caption and bar are left out"));
    ang_notes_clear(&warnings);
    ang_image_clear(&image);
}

static void a_png_in_memory_is_that_of_the_file(void **state) {
    (void)state;
    ang_image image;
    ang_error err = {0};
    assert_true(ang_image_create(&image, W, H, &err));
    for (int i = 0; i < 4 * W * H; i++) image.rgba[i] = (float)(i % 97) / 96;
    unsigned char *data = NULL;
    size_t size = 0;
    static unsigned char file_data[1 << 16];
    char path[600];
    snprintf(path, sizeof path, "%s/memory.png", folder);
    assert_true(ang_image_png(&image, black, NULL, &data, &size, &err) && ang_image_write(path, &image, black, &err));
    FILE *file = fopen(path, "rb");
    assert_non_null(file);
    assert_int_equal(fread(file_data, 1, sizeof file_data, file), size);
    fclose(file);
    assert_memory_equal(file_data, data, size);
    free(data);
    ang_image_clear(&image);
}

/* A chunk of PNG at `out`; returns its bytes. Sums are left 0: readers of texts need not look at them. */
static size_t put_chunk(unsigned char *out, const char *type, const void *data, size_t size, size_t claimed) {
    for (int i = 0; i < 4; i++) out[i] = (unsigned char)(claimed >> (24 - 8 * i));
    memcpy(out + 4, type, 4);
    memcpy(out + 8, data, size);
    memset(out + 8 + size, 0, 4);
    return size + 12;
}

static void expect_state(const char *name, const unsigned char *bytes, size_t size, const char *text,
                         const char *needle) {
    char path[512];
    snprintf(path, sizeof path, "%s/%s", ANG_TEST_TMP, name);
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(bytes, 1, size, file), size);
    fclose(file);
    ang_error err = {0};
    char *found = ang_image_state(path, &err);
    if (text && !found) fail_msg("%s", err.message);
    if (text) assert_string_equal(found, text);
    if (!text) assert_null(found);
    if (!text && !strstr(err.message, needle)) fail_msg("%s", err.message);
    free(found);
    unlink(path);
}

/* States in all kinds of text that PNG has, and what claims more than the file holds. */
static void test_texts_of_png(void **state) {
    (void)state;
    static const char start[] = "\x89PNG\r\n\x1a\n";
    /* "packed state" by zlib */
    static const char packed[] = "\x78\x9c\x2b\x48\x4c\xce\x4e\x4d\x51\x28\x2e\x49\x2c\x49\x05\x00\x1e\x3b\x04\xaa";
    static const struct {
        const char *type, *data;
        size_t size, more; /* bytes claimed and not there */
        const char *text, *needle;
    } cases[] = {
        {"tEXt", "angioscope_state\0a state", 24, 0, "a state", NULL},
        {"tEXt", "angioscope_states\0a state", 25, 0, NULL, "carries no text angioscope_state"},
        {"tEXt", "angioscope_state", 16, 0, NULL, "carries no text angioscope_state"},
        {"iTXt", "angioscope_state\0\0\0en\0name\0a state", 34, 0, "a state", NULL},
        {"iTXt", "angioscope_state\0\0\0en", 21, 0, NULL, "is damaged or no PNG file"},
        {"tEXt", "angioscope_state\0a state", 24, 1000, NULL, "damaged or too long"},
        {"tEXt", "angioscope_state\0a state", 24, 0xFFFFFF00, NULL, "damaged or too long"},
        {"IDAT", "x", 1, 0xFFFFFF00, NULL, "is damaged or no PNG file"},
    };
    unsigned char bytes[256];
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        size_t size = 8;
        memcpy(bytes, start, 8);
        size += put_chunk(bytes + size, "tEXt", "other\0text", 10, 10);
        size += put_chunk(bytes + size, cases[i].type, cases[i].data, cases[i].size, cases[i].size + cases[i].more);
        size += put_chunk(bytes + size, "IEND", "", 0, 0);
        expect_state("texts.png", bytes, size, cases[i].text, cases[i].needle);
    }
    unsigned char data[64] = "angioscope_state";
    memcpy(data + 18, packed, sizeof packed - 1);
    memcpy(bytes, start, 8);
    size_t size = 8 + put_chunk(bytes + 8, "zTXt", data, 18 + sizeof packed - 1, 18 + sizeof packed - 1);
    expect_state("packed.png", bytes, size, "packed state", NULL);
    bytes[8 + 8 + 18 + 6] ^= 0xFF;
    expect_state("packed.png", bytes, size, NULL, "damaged or too long");
    expect_state("cut.png", bytes, 4, NULL, "is damaged or no PNG file");
}

/* An OpenEXR header whose attributes claim more than there is. */
static void test_texts_of_exr(void **state) {
    (void)state;
    static const char sound[] =
        "\x76\x2f\x31\x01\2\0\0\0other\0string\0\2\0\0\0xyangioscope_state\0string\0\7\0\0\0a state\0";
    unsigned char bytes[sizeof sound];
    memcpy(bytes, sound, sizeof sound);
    expect_state("texts.exr", bytes, sizeof sound, "a state", NULL);
    bytes[8 + 6 + 7 + 3] = 0x69; /* the first attribute's size */
    expect_state("texts.exr", bytes, sizeof sound, NULL, "is damaged or no EXR file");
    memcpy(bytes, sound, sizeof sound);
    bytes[8 + 6 + 7 + 4 + 2 + 17 + 7 + 3] = 0x69; /* the state's */
    expect_state("texts.exr", bytes, sizeof sound, NULL, "damaged or too long");
    memcpy(bytes, sound, sizeof sound);
    bytes[8] = '\0';
    expect_state("texts.exr", bytes, sizeof sound, NULL, "carries no text angioscope_state");
    expect_state("texts.exr", bytes, 20, NULL, "carries no text angioscope_state");
    expect_state("texts.exr", (const unsigned char *)sound, 20, NULL, "is damaged or no EXR file");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_format_comes_back),
        cmocka_unit_test(float_is_not_clipped_and_keeps_rows),
        cmocka_unit_test(background_shows_through),
        cmocka_unit_test(failures_name_the_file_and_leave_nothing),
        cmocka_unit_test(annotations_are_whole_or_not_there),
        cmocka_unit_test(broken_pictures_are_refused),
        cmocka_unit_test(a_png_in_memory_is_that_of_the_file),
        cmocka_unit_test(files_hold_nothing_that_identifies),
        cmocka_unit_test(formats_round_as_they_say),
        cmocka_unit_test(test_texts_of_png),
        cmocka_unit_test(test_texts_of_exr),
    };
    return cmocka_run_group_tests(tests, setup, teardown);
}
