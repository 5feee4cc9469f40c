/* The loading rules over synthetic slice records: no files. Numbers are those of the rules they test. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "io/checksum.h"
#include "io/dicom/decode.h"
#include "io/dicom/geometry.h"
#include "io/dicom/mask.h"
#include "io/dicom/stored.h"
#include "io/dicom/stream.h"
#include "tests/io/slice_record.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <zlib.h>

enum { most = 64 };

typedef struct grid_case {
    ang_dicom_slice slices[most];
    size_t order[most];
    size_t count;
    ang_dicom_grid grid;
    ang_notes assumptions, warnings;
    ang_error err;
    bool ok;
} grid_case;

static void make_grid(grid_case *c) {
    for (size_t i = 0; i < c->count; i++) c->order[i] = i;
    ang_dicom_sort(c->slices, c->order, c->count, &c->assumptions);
    c->ok = ang_dicom_geometry(c->slices, c->order, c->count, &c->grid, &c->assumptions, &c->warnings, &c->err);
}

static void clear_grid(grid_case *c) {
    ang_dicom_grid_clear(&c->grid);
    ang_notes_clear(&c->assumptions);
    ang_notes_clear(&c->warnings);
}

static void test_order_is_by_position(void **state) {
    (void)state;
    double z[] = {5, -2.5, 0, 2.5};
    grid_case c = {.count = 4};
    for (int i = 0; i < 4; i++) c.slices[i] = slice_at(z[i], i + 1);
    make_grid(&c);
    assert_true(c.ok);
    size_t expected[] = {1, 2, 3, 0};
    assert_memory_equal(c.order, expected, sizeof expected);
    /* the first value of PixelSpacing is between rows: along y */
    assert_float_equal(c.grid.affine.m[0][0], 0.25, 1e-12);
    assert_float_equal(c.grid.affine.m[1][1], 0.5, 1e-12);
    assert_float_equal(c.grid.affine.m[2][2], 2.5, 1e-12);
    assert_float_equal(c.grid.affine.m[0][3], -10, 1e-12);
    assert_float_equal(c.grid.affine.m[1][3], -20, 1e-12);
    assert_float_equal(c.grid.affine.m[2][3], -2.5, 1e-12);
    assert_int_equal(c.grid.planes, 4);
    assert_false(c.grid.interpolates);
    assert_float_equal(c.grid.tilt_deg, 0, 1e-12);
    assert_int_equal(c.warnings.count, 0);
    clear_grid(&c);
}

static void test_spacing_ignores_thickness(void **state) {
    (void)state;
    grid_case c = {.count = 3};
    for (int i = 0; i < 3; i++) {
        c.slices[i] = slice_at(1.25 * i, i);
        c.slices[i].has_thickness = c.slices[i].has_slice_distance = true;
        c.slices[i].thickness = 5;
        c.slices[i].slice_distance = 7;
    }
    make_grid(&c);
    assert_true(c.ok);
    assert_float_equal(c.grid.affine.m[2][2], 1.25, 1e-12);
    clear_grid(&c);
}

static void test_order_without_positions(void **state) {
    (void)state;
    grid_case c = {.count = 3};
    for (int i = 0; i < 3; i++) {
        c.slices[i] = slice_at(0, 3 - i);
        c.slices[i].has_position = false;
        c.slices[i].has_slice_distance = true;
        c.slices[i].slice_distance = 4;
    }
    make_grid(&c);
    assert_true(c.ok);
    size_t expected[] = {2, 1, 0};
    assert_memory_equal(c.order, expected, sizeof expected);
    assert_float_equal(c.grid.affine.m[2][2], 4, 1e-12);
    assert_true(c.assumptions.count >= 2); /* the order, and the distance */
    assert_true(c.warnings.count >= 1);
    clear_grid(&c);
}

static void test_missing_slices(void **state) {
    (void)state;
    double z[] = {0, 2, 4, 10.1, 12.1}; /* 6.1 is within 5 % of three times 2 */
    grid_case c = {.count = 5};
    for (int i = 0; i < 5; i++) c.slices[i] = slice_at(z[i], i);
    make_grid(&c);
    assert_true(c.ok);
    assert_false(c.grid.resampled);
    assert_int_equal(c.grid.missing, 2);
    assert_int_equal(c.grid.planes, 7);
    assert_int_equal(c.grid.gap_count, 1);
    assert_int_equal(c.grid.gaps[0].after, 2);
    assert_int_equal(c.grid.gaps[0].missing, 2);
    assert_float_equal(c.grid.gaps[0].mm, 6.1, 1e-9);
    size_t below[] = {0, 1, 2, 2, 2, 3, 4};
    assert_memory_equal(c.grid.below, below, sizeof below);
    assert_float_equal(c.grid.weight[3], 1.0 / 3, 1e-6);
    assert_float_equal(c.grid.weight[4], 2.0 / 3, 1e-6);
    assert_float_equal(c.grid.weight[5], 0, 0);
    assert_int_equal(c.warnings.count, 1);
    clear_grid(&c);
}

static void test_small_deviations_are_regular(void **state) {
    (void)state;
    double z[] = {0, 2, 4.015, 6, 8};
    grid_case c = {.count = 5};
    for (int i = 0; i < 5; i++) c.slices[i] = slice_at(z[i], i);
    make_grid(&c);
    assert_true(c.ok);
    assert_int_equal(c.grid.gap_count, 0);
    assert_int_equal(c.grid.planes, 5);
    clear_grid(&c);
}

static void test_irregular_is_resampled(void **state) {
    (void)state;
    /* gaps 4, 4, 4, 1.1, 0.5, 7: the median is 4, 1.1 is the smallest of at least a quarter of it */
    double z[] = {0, 4, 8, 12, 13.1, 13.6, 20.6};
    grid_case c = {.count = 7};
    for (int i = 0; i < 7; i++) c.slices[i] = slice_at(z[i], i);
    make_grid(&c);
    assert_true(c.ok);
    assert_true(c.grid.resampled);
    assert_float_equal(c.grid.affine.m[2][2], 1.1, 1e-9);
    assert_int_equal(c.grid.planes, 19); /* 20.6 / 1.1 = 18.7 */
    assert_int_equal(c.grid.gap_count, 3);
    for (size_t p = 0; p < c.grid.planes; p++) {
        size_t i = c.grid.below[p];
        double w = (double)c.grid.weight[p], next = i + 1 < 7 ? z[i + 1] : z[i];
        assert_float_equal(z[i] + w * (next - z[i]), 1.1 * (double)p, 1e-5);
    }
    clear_grid(&c);
}

static void test_slices_without_order_are_refused(void **state) {
    (void)state;
    for (int what = 0; what < 3; what++) { /* InstanceNumber: one each, one missing, one twice */
        grid_case c = {.count = 5};
        for (int i = 0; i < 5; i++) {
            c.slices[i] = slice_at(i, 9 - i);
            c.slices[i].has_position = false;
        }
        if (what == 1) c.slices[2].has_instance_number = false;
        if (what == 2) c.slices[2].instance_number = c.slices[3].instance_number;
        make_grid(&c);
        assert_int_equal(c.ok, what == 0);
        if (what == 0) {
            for (size_t i = 0; i < 5; i++) assert_int_equal(c.order[i], 4 - i);
        } else {
            assert_int_equal(c.err.code, ANG_GEOMETRY);
            assert_non_null(strstr(c.err.message, "(0020,0013) InstanceNumber"));
        }
        clear_grid(&c);
    }
}

static void test_tilt_is_shear(void **state) {
    (void)state;
    double angle = 18.5 * acos(-1) / 180;
    grid_case c = {.count = 10};
    for (int i = 0; i < 10; i++) {
        c.slices[i] = slice_at(3.0 * i, i); /* the table moves along z, the plane is tilted */
        c.slices[i].column = (ang_vec3){0, cos(angle), -sin(angle)};
        c.slices[i].has_tilt = true;
        c.slices[i].tilt = -18.5; /* the vendor's sign is not ours */
    }
    make_grid(&c);
    assert_true(c.ok);
    assert_float_equal(c.grid.tilt_deg, 18.5, 1e-9);
    assert_float_equal(c.grid.affine.m[2][2], 3, 1e-12);
    assert_float_equal(c.grid.affine.m[1][2], 0, 1e-12);
    assert_float_equal(c.grid.median, 3 * cos(angle), 1e-12);
    assert_int_equal(c.grid.planes, 10);
    clear_grid(&c);
}

static void test_degenerate_orientation(void **state) {
    (void)state;
    grid_case c = {.count = 2};
    for (int i = 0; i < 2; i++) {
        c.slices[i] = slice_at(i, i);
        c.slices[i].column = c.slices[i].row;
    }
    make_grid(&c);
    assert_false(c.ok);
    assert_int_equal(c.err.code, ANG_GEOMETRY);
    clear_grid(&c);
}

static void test_absurd_distances(void **state) {
    (void)state;
    grid_case c = {.count = 4};
    double z[] = {0, 1, 2, 1e9};
    for (int i = 0; i < 4; i++) c.slices[i] = slice_at(z[i], i);
    make_grid(&c);
    assert_false(c.ok);
    assert_int_equal(c.err.code, ANG_LIMIT);
    clear_grid(&c);
}

static void test_one_position_twice(void **state) {
    (void)state;
    grid_case c = {.count = 3};
    for (int i = 0; i < 3; i++) c.slices[i] = slice_at(i == 2 ? 1 : i, 40 + i);
    make_grid(&c);
    assert_false(c.ok);
    assert_int_equal(c.err.code, ANG_GEOMETRY);
    assert_non_null(strstr(c.err.message, "(0020,0032) ImagePositionPatient"));
    assert_non_null(strstr(c.err.message, "41 and 42"));
    assert_non_null(strstr(c.err.message, "out of the folder"));
    clear_grid(&c);
}

static void test_convert(void **state) {
    (void)state;
    uint16_t out[4];
    const uint8_t overlay[] = {0xFF, 0xFF, 0x00, 0xF8, 0x34, 0xA2, 0xFF, 0x07}; /* bits above HighBit 11 */
    ang_dicom_words words = {2, 12, 11, false, false};
    assert_true(ang_dicom_convert(overlay, 4, words, out));
    assert_int_equal(out[0], 0xFFF);
    assert_int_equal(out[1], 0x800);
    assert_int_equal(out[2], 0x234);
    assert_int_equal(out[3], 0x7FF);
    words.is_signed = true;
    assert_true(ang_dicom_convert(overlay, 4, words, out));
    assert_int_equal(out[0], 32768 - 1);
    assert_int_equal(out[1], 32768 - 2048);
    assert_int_equal(out[2], 32768 + 0x234);
    assert_int_equal(out[3], 32768 + 2047);
    /* The sign once, or in all bits above it, is no other bit; 0x0800 is -2048 written short. */
    const uint8_t both[] = {0x00, 0x08, 0x00, 0xF8, 0xFF, 0x07};
    assert_false(ang_dicom_convert(both, 3, words, out));
    const uint8_t half[] = {0x00, 0x78};
    assert_true(ang_dicom_convert(half, 1, words, out));
    assert_int_equal(out[0], 32768 - 2048);
    words = (ang_dicom_words){2, 12, 15, false, false}; /* pixels in the high bits */
    const uint8_t high[] = {0xF5, 0xFF, 0x15, 0x00};
    assert_true(ang_dicom_convert(high, 2, words, out)); /* the 5 below */
    assert_int_equal(out[0], 0xFFF);
    assert_int_equal(out[1], 0x001);
    words = (ang_dicom_words){2, 16, 15, true, true};
    const uint8_t big[] = {0x80, 0x00, 0x00, 0x01, 0xFF, 0xFF};
    assert_false(ang_dicom_convert(big, 3, words, out));
    assert_int_equal(out[0], 0);
    assert_int_equal(out[1], 32769);
    assert_int_equal(out[2], 32767);
    words = (ang_dicom_words){1, 8, 7, false, false};
    ang_dicom_convert(big, 2, words, out);
    assert_int_equal(out[0], 0x80);
    uint16_t place[] = {0x0000, 0x8000, 0xFFFF};
    assert_false(ang_dicom_convert(place, 3, (ang_dicom_words){2, 16, 15, true, false}, place));
    assert_int_equal(place[0], 32768);
    assert_int_equal(place[1], 0);
    assert_int_equal(place[2], 32767);
}

static void test_padding_value(void **state) {
    (void)state;
    ang_dicom_slice s = slice_at(0, 0);
    uint16_t first, last;
    s.bits_stored = 16;
    s.high_bit = 15;
    assert_false(ang_dicom_padding(&s, &first, &last));
    s.has_padding = true;
    s.padding = 63536;
    s.is_signed = true; /* whatever the VR says, it is -2000 */
    assert_true(ang_dicom_padding(&s, &first, &last));
    assert_int_equal(first, 32768 - 2000);
    assert_int_equal(last, first);
    s.has_padding_limit = true;
    s.padding_limit = (uint16_t)-2010;
    assert_true(ang_dicom_padding(&s, &first, &last));
    assert_int_equal(first, 32768 - 2010);
    assert_int_equal(last, 32768 - 2000);
    s.is_signed = false;
    s.bits_stored = 12; /* cannot occur: masking it would hit tissue */
    assert_false(ang_dicom_padding(&s, &first, &last));
}

static void test_rescale(void **state) {
    (void)state;
    /* Slopes of 1e308 overflow: whatever comes, no value is made of what is no number. */
    assert_int_equal(ang_dicom_remap(7, (ang_dicom_map){1e308, 0}, (ang_dicom_map){INFINITY, -INFINITY}), 0);
    ang_dicom_slice s = slice_at(0, 0);
    s.slope = 0;
    assert_float_equal(ang_dicom_map_of(&s).slope, 1, 0);
    s.has_slope = s.has_intercept = false;
    assert_float_equal(ang_dicom_map_of(&s).slope, 1, 0);
    assert_float_equal(ang_dicom_map_of(&s).intercept, 0, 0);
    s.is_signed = true;
    assert_float_equal(ang_dicom_map_of(&s).intercept, -32768, 0);

    ang_dicom_map maps[] = {{1, -1024}, {1, -1024}};
    uint16_t first[] = {0, 10}, last[] = {4000, 3000};
    assert_true(ang_dicom_merge(maps, first, last, 2).same);
    maps[1].intercept = -1000; /* whole steps apart: stays exact */
    ang_dicom_common common = ang_dicom_merge(maps, first, last, 2);
    assert_false(common.same);
    assert_float_equal(common.error_hu, 0, 0);
    for (int v = 10; v <= 3000; v += 13) {
        double hu = common.map.slope * ang_dicom_remap((uint16_t)v, maps[1], common.map) + common.map.intercept;
        assert_float_equal(hu, v - 1000, 1e-9);
    }
    maps[1].slope = 1.7; /* off the lattice: at most half a step */
    common = ang_dicom_merge(maps, first, last, 2);
    assert_false(common.same);
    assert_true(common.error_hu > 0 && common.error_hu <= 0.5 * (1.7 * 3000 + 1024) / 65535 + 1e-9); /* 16 bits of it */
    maps[1] = maps[0];
    maps[0].slope = maps[1].slope = -1;
    common = ang_dicom_merge(maps, first, last, 2);
    assert_false(common.same);
    assert_true(common.map.slope > 0);
    assert_float_equal(common.error_hu, 0, 0);
}

static void test_masks(void **state) {
    (void)state;
    enum { count = 1000 };
    for (int offset = 0; offset < 70; offset += 23) {
        uint16_t data[count], copy[count];
        uint64_t mask[(count + 200) / 64] = {0};
        uint32_t random = 12345;
        for (int i = 0; i < count; i++) {
            random = random * 1664525 + 1013904223;
            data[i] = copy[i] = (uint16_t)(random >> 16 & 0xFF);
        }
        ang_mask_range range = {20, 60, 7};
        uint16_t least, greatest;
        size_t counted = ang_mask_count(data, count, range, &least, &greatest);
        ang_mask_result result = ang_mask_mark(data, count, (size_t)offset, range, mask);
        size_t expected = 0;
        uint16_t low = 65535, high = 0;
        for (int i = 0; i < count; i++) {
            bool is = copy[i] >= 20 && copy[i] <= 60;
            size_t bit = (size_t)i + (size_t)offset;
            assert_int_equal(mask[bit / 64] >> (bit % 64) & 1, is);
            assert_int_equal(data[i], is ? 7 : copy[i]);
            expected += is;
            if (!is && copy[i] < low) low = copy[i];
            if (!is && copy[i] > high) high = copy[i];
        }
        assert_int_equal(counted, expected);
        assert_int_equal(result.count, expected);
        assert_int_equal(least, low);
        assert_int_equal(result.least, low);
        assert_int_equal(greatest, high);
        assert_int_equal(result.greatest, high);
    }
}

static void test_rle(void **state) {
    (void)state;
    uint8_t stream[64 + 12] = {2, 0, 0, 0, 64, 0, 0, 0, 68, 0, 0, 0};
    const uint8_t high[] = {0xFD, 0x12, 0x00, 0x34}; /* 4 x 0x12, 1 x 0x34 */
    const uint8_t low[] = {0x04, 1, 2, 3, 4, 5, 0x80, 0x80};
    memcpy(stream + 64, high, sizeof high);
    memcpy(stream + 68, low, sizeof low);
    uint8_t out[10];
    assert_true(ang_dicom_rle(stream, sizeof stream, 5, 2, out));
    const uint8_t expected[] = {1, 0x12, 2, 0x12, 3, 0x12, 4, 0x12, 5, 0x34};
    assert_memory_equal(out, expected, sizeof expected);
    assert_false(ang_dicom_rle(stream, 70, 5, 2, out));
    assert_false(ang_dicom_rle(stream, sizeof stream, 5, 1, out));
    assert_false(ang_dicom_rle(stream, 10, 5, 2, out));
    stream[8] = 200;
    assert_false(ang_dicom_rle(stream, sizeof stream, 5, 2, out));
}

static void test_stream_markers(void **state) {
    (void)state;
    uint8_t jpeg[] = {0xFF, 0xD8, 0xFF, 0xC3, 0, 11, 16, 2, 0, 1, 0,    1, 1, 0x11, 0,    0xFF, 0xDA,
                      0,    8,    1,    1,    0, 1,  0,  0, 7, 9, 0xFF, 0, 1, 0xFF, 0xD9, 0};
    ang_dicom_stream header;
    assert_true(ang_dicom_stream_header(jpeg, sizeof jpeg, &header));
    assert_int_equal(header.rows, 512);
    assert_int_equal(header.columns, 256);
    assert_int_equal(header.precision, 16);
    assert_int_equal(header.components, 1);
    assert_true(ang_dicom_stream_sound(jpeg, sizeof jpeg));
    assert_false(ang_dicom_stream_sound(jpeg, sizeof jpeg - 2)); /* no end */
    jpeg[15] = 0xEF;
    assert_false(ang_dicom_stream_sound(jpeg, sizeof jpeg)); /* no scan */
    jpeg[15] = 0xFF;
    jpeg[28] = 0xC4;
    assert_false(ang_dicom_stream_sound(jpeg, sizeof jpeg)); /* a marker in the data */
}

static void test_checksum(void **state) {
    (void)state;
    uint8_t bytes[1000];
    for (int i = 0; i < 1000; i++) bytes[i] = (uint8_t)(i * i * 7 + i / 3);
    for (size_t begin = 0; begin < 20; begin += 3) {
        for (size_t length = 0; begin + length <= 1000; length = length * 5 / 4 + 1) {
            uLong expected = crc32(crc32(0, NULL, 0), bytes + begin, (uInt)length);
            assert_int_equal(ang_checksum(0, bytes + begin, length), expected);
            expected = crc32(0xDEADBEEF, bytes + begin, (uInt)length);
            assert_int_equal(ang_checksum(0xDEADBEEF, bytes + begin, length), expected);
        }
    }
}

static void test_image_type_values(void **state) {
    (void)state;
    char text[9];
    ang_dicom_value("ORIGINAL\\PRIMARY\\AXIAL ", 2, text, sizeof text);
    assert_string_equal(text, "AXIAL");
    ang_dicom_value("ORIGINAL\\PRIMARY", 2, text, sizeof text);
    assert_string_equal(text, "");
    ang_dicom_value("ABCDEFGHIJKLMNOP", 0, text, sizeof text);
    assert_string_equal(text, "ABCDEFGH");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_order_is_by_position),
        cmocka_unit_test(test_spacing_ignores_thickness),
        cmocka_unit_test(test_order_without_positions),
        cmocka_unit_test(test_missing_slices),
        cmocka_unit_test(test_small_deviations_are_regular),
        cmocka_unit_test(test_irregular_is_resampled),
        cmocka_unit_test(test_slices_without_order_are_refused),
        cmocka_unit_test(test_tilt_is_shear),
        cmocka_unit_test(test_degenerate_orientation),
        cmocka_unit_test(test_absurd_distances),
        cmocka_unit_test(test_one_position_twice),
        cmocka_unit_test(test_convert),
        cmocka_unit_test(test_padding_value),
        cmocka_unit_test(test_rescale),
        cmocka_unit_test(test_masks),
        cmocka_unit_test(test_rle),
        cmocka_unit_test(test_stream_markers),
        cmocka_unit_test(test_checksum),
        cmocka_unit_test(test_image_type_values),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
