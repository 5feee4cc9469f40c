#include "io/dicom/stored.h"

#include <math.h>
#include <string.h>

ang_dicom_words ang_dicom_words_of(const ang_dicom_slice *slice) {
    return (ang_dicom_words){.bytes = slice->bits_allocated / 8,
                             .bits_stored = slice->bits_stored,
                             .high_bit = slice->high_bit,
                             .is_signed = slice->is_signed,
                             .big_endian = slice->coding == ANG_DICOM_BIG_ENDIAN};
}

/* Where a word's stored bits lie. */
typedef struct field {
    int shift;
    uint32_t mask, sign, bias, all; /* of the shifted value, and all bits of a word */
} field;

/* Sets bits of *other where the word has some that the value does not account for. */
static inline uint16_t convert_word(uint32_t word, field f, uint32_t *other) {
    uint32_t bits = word >> f.shift & f.mask;
    uint32_t value = (bits ^ f.sign) - f.sign; /* two's complement: flips the sign bit, then takes it off */
    uint32_t plain = (bits << f.shift ^ word) & f.all, extended = (value << f.shift ^ word) & f.all;
    *other |= plain < extended ? plain : extended; /* 0 if either is */
    return (uint16_t)(value + f.bias);
}

bool ang_dicom_convert(const void *raw, size_t count, ang_dicom_words words, uint16_t *out) {
    const field f = {.shift = words.high_bit - words.bits_stored + 1,
                     .mask = (UINT32_C(1) << words.bits_stored) - 1,
                     .sign = words.is_signed ? UINT32_C(1) << (words.bits_stored - 1) : 0,
                     .bias = words.is_signed ? 32768 : 0,
                     .all = UINT32_MAX >> (32 - 8 * words.bytes)};
    const uint8_t *p = raw;
    uint32_t other = 0;
    bool little = true;
#if __BYTE_ORDER__ == __ORDER_BIG_ENDIAN__
    little = false;
#endif
    if (words.bytes == 2 && !words.big_endian && little) {
        if (f.mask == 0xFFFF && !f.sign) {
            if (raw != out) memmove(out, raw, count * 2);
            return false;
        }
        if (raw == out) { /* the common case, in place: the compiler makes vector code of it */
            for (size_t i = 0; i < count; i++) out[i] = convert_word(out[i], f, &other);
            return other != 0;
        }
    }
    for (size_t i = 0; i < count; i++) {
        uint32_t word = 0;
        const uint8_t *q = p + i * (size_t)words.bytes;
        for (int b = 0; b < words.bytes; b++)
            word |= (uint32_t)q[words.big_endian ? words.bytes - 1 - b : b] << (8 * b);
        out[i] = convert_word(word, f, &other);
    }
    return other != 0;
}

ang_dicom_map ang_dicom_map_of(const ang_dicom_slice *slice) {
    ang_dicom_map map = {slice->has_slope && slice->slope != 0 ? slice->slope : 1,
                         slice->has_intercept ? slice->intercept : 0};
    if (slice->is_signed) map.intercept -= 32768 * map.slope;
    return map;
}

ang_raw_slice ang_dicom_raw_slice(const ang_dicom_slice *slice, const uint16_t *values) {
    ang_dicom_map map = ang_dicom_map_of(slice);
    bool sized = slice->has_spacing && slice->column_spacing > 0 && slice->row_spacing > 0;
    return (ang_raw_slice){.values = values,
                           .width = slice->columns,
                           .height = slice->rows,
                           .slope = map.slope,
                           .intercept = map.intercept,
                           .hounsfield = strcmp(slice->modality, "CT") == 0,
                           .window_centre = slice->has_window ? slice->window_centre : NAN,
                           .window_width = slice->has_window ? slice->window_width : NAN,
                           .pixel_aspect = sized ? slice->row_spacing / slice->column_spacing : 1,
                           .count = 1};
}

/* False where the two bytes are no value of `bits` bits. */
static bool padding_value(uint16_t bytes, int bits, bool is_signed, int *value) {
    /* The representation decides, not the VR: 63536 is -2000 where pixels are signed (rule 10). */
    *value = is_signed ? (int16_t)bytes : bytes;
    int low = is_signed ? -(1 << (bits - 1)) : 0, high = low + (1 << bits) - 1;
    return *value >= low && *value <= high;
}

bool ang_dicom_padding(const ang_dicom_slice *slice, uint16_t *first, uint16_t *last) {
    int value, limit;
    if (!slice->has_padding || !padding_value(slice->padding, slice->bits_stored, slice->is_signed, &value))
        return false;
    limit = value;
    if (slice->has_padding_limit && !padding_value(slice->padding_limit, slice->bits_stored, slice->is_signed, &limit))
        limit = value;
    int bias = slice->is_signed ? 32768 : 0;
    *first = (uint16_t)((value < limit ? value : limit) + bias);
    *last = (uint16_t)((value < limit ? limit : value) + bias);
    return true;
}

uint16_t ang_dicom_remap(uint16_t value, ang_dicom_map from, ang_dicom_map to) {
    double hu = from.slope * value + from.intercept, stored = nearbyint((hu - to.intercept) / to.slope);
    return !(stored > 0) ? 0 : stored >= 65535 ? 65535 : (uint16_t)stored;
}

/* The largest error in HU of values first[i] to last[i] under maps[i] when they are taken over to `to`. */
static double rounding_error(const ang_dicom_map *maps, const uint16_t *first, const uint16_t *last, size_t count,
                             ang_dicom_map to) {
    double error = 0;
    for (size_t i = 0; i < count; i++) {
        for (uint32_t v = first[i]; v <= last[i]; v++) {
            double hu = maps[i].slope * v + maps[i].intercept;
            uint16_t there = ang_dicom_remap((uint16_t)v, maps[i], to);
            error = fmax(error, fabs(to.slope * there + to.intercept - hu));
        }
    }
    return error;
}

ang_dicom_common ang_dicom_merge(const ang_dicom_map *maps, const uint16_t *first, const uint16_t *last, size_t count) {
    ang_dicom_common common = {.same = true, .map = {1, 0}};
    if (count == 0) return common;
    common.map = maps[0];
    for (size_t i = 0; i < count; i++) {
        if (maps[i].slope != maps[0].slope || maps[i].intercept != maps[0].intercept || maps[i].slope <= 0)
            common.same = false;
    }
    if (common.same) return common;

    double low = INFINITY, high = -INFINITY, slope = INFINITY;
    for (size_t i = 0; i < count; i++) {
        if (first[i] > last[i]) continue;
        double a = maps[i].slope * first[i] + maps[i].intercept, b = maps[i].slope * last[i] + maps[i].intercept;
        low = fmin(low, fmin(a, b));
        high = fmax(high, fmax(a, b));
        slope = fmin(slope, fabs(maps[i].slope));
    }
    if (!(low <= high)) return common; /* nothing but padding */
    /* -1000 HU, what padding becomes, must have a value too. */
    low = fmin(low, -1000);
    /* On the lattice of integers where all maps are on it: slopes of 1 with whole intercepts stay exact. */
    if (slope == 1) low = floor(low);
    common.map = (ang_dicom_map){slope, low};
    common.error_hu = rounding_error(maps, first, last, count, common.map);
    /* Where no lattice of the least slope holds all values, the finest that 16 bits allow is nearer to them. */
    ang_dicom_map finest = {(high - low) / 65535, low};
    bool fits = (high - low) / slope <= 65535;
    if (finest.slope > 0 && (!fits || common.error_hu > 1e-9)) {
        double error_hu = rounding_error(maps, first, last, count, finest);
        if (!fits || error_hu < common.error_hu) {
            common.map = finest;
            common.error_hu = error_hu;
        }
    }
    return common;
}

void ang_dicom_make_room(ang_dicom_common *common, const uint16_t *last, size_t count) {
    if (!common->same) return; /* ang_dicom_merge has seen to it */
    double offset = ceil((common->map.intercept + 1000) / common->map.slope - 0.5), greatest = 0;
    for (size_t i = 0; i < count; i++) greatest = fmax(greatest, last[i]);
    if (!(offset > 0) || greatest + offset > 65535) return;
    common->map.intercept -= offset * common->map.slope;
    common->same = false;
}
