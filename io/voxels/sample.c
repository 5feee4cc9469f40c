#include "io/voxels/sample.h"

#include <math.h>
#include <string.h>

size_t ang_sample_size(ang_sample type) {
    static const unsigned char size[] = {1, 1, 2, 2, 4, 4, 8, 8, 4, 8};
    return size[type];
}

ang_sample ang_sample_signed(ang_sample type) {
    switch (type) {
    case ANG_SAMPLE_U8:
        return ANG_SAMPLE_I8;
    case ANG_SAMPLE_U16:
        return ANG_SAMPLE_I16;
    case ANG_SAMPLE_U32:
        return ANG_SAMPLE_I32;
    case ANG_SAMPLE_U64:
        return ANG_SAMPLE_I64;
    default:
        return type;
    }
}

double ang_sample_get(const uint8_t *bytes, ang_sample type, bool big_endian) {
    size_t size = ang_sample_size(type);
    uint64_t bits = 0;
    for (size_t i = 0; i < size; i++) bits |= (uint64_t)bytes[big_endian ? size - 1 - i : i] << (8 * i);
    switch (type) {
    case ANG_SAMPLE_I8:
        return (int8_t)bits;
    case ANG_SAMPLE_I16:
        return (int16_t)bits;
    case ANG_SAMPLE_I32:
        return (int32_t)bits;
    case ANG_SAMPLE_I64:
        return (double)(int64_t)bits;
    case ANG_SAMPLE_F32: {
        uint32_t word = (uint32_t)bits;
        float value;
        memcpy(&value, &word, sizeof value);
        return (double)value;
    }
    case ANG_SAMPLE_F64: {
        double value;
        memcpy(&value, &bits, sizeof value);
        return value;
    }
    default:
        return (double)bits;
    }
}

/* The bits of a whole number; false where `type` does not hold it. */
static bool whole_bits(ang_sample type, double value, uint64_t *bits) {
    int width = 8 * (int)ang_sample_size(type);
    bool is_signed =
        type == ANG_SAMPLE_I8 || type == ANG_SAMPLE_I16 || type == ANG_SAMPLE_I32 || type == ANG_SAMPLE_I64;
    double most = ldexp(1, is_signed ? width - 1 : width), least = is_signed ? -most : 0;
    if (!(value >= least && value < most) || value != nearbyint(value)) return false;
    *bits = value < 0 ? (uint64_t)(int64_t)value : (uint64_t)value;
    return true;
}

bool ang_sample_put(uint8_t *bytes, ang_sample type, double value) {
    size_t size = ang_sample_size(type);
    uint64_t bits = 0;
    if (type == ANG_SAMPLE_F32) {
        float single = (float)value;
        uint32_t word;
        memcpy(&word, &single, sizeof word);
        bits = word;
    } else if (type == ANG_SAMPLE_F64) {
        memcpy(&bits, &value, sizeof bits);
    } else if (!whole_bits(type, value, &bits)) {
        return false;
    }
    for (size_t i = 0; i < size; i++) bytes[i] = (uint8_t)(bits >> (8 * i));
    return true;
}
