#include "io/dicom/mask.h"

#include "core/base/simd.h"

#include <string.h>

/* Loops are built for wide vectors too: plain x86-64 has no instruction for the lesser of two unsigned words. */
enum { block = 64 };

void ang_mask_set(uint64_t *mask, size_t index) {
    __atomic_fetch_or(&mask[index / 64], UINT64_C(1) << (index % 64), __ATOMIC_RELAXED);
}

ANG_SIMD
void ang_mask_extent(const uint16_t *data, size_t count, uint16_t *least, uint16_t *greatest) {
    uint16_t low = UINT16_MAX, high = 0;
    for (size_t i = 0; i < count; i++) {
        low = data[i] < low ? data[i] : low;
        high = data[i] > high ? data[i] : high;
    }
    *least = low;
    *greatest = high;
}

ANG_SIMD
size_t ang_mask_count(const uint16_t *data, size_t count, ang_mask_range range, uint16_t *least, uint16_t *greatest) {
    uint16_t low = UINT16_MAX, high = 0, span = (uint16_t)(range.last - range.first);
    size_t found = 0;
    for (size_t begin = 0; begin < count; begin += 32768) {
        size_t length = count - begin < 32768 ? count - begin : 32768;
        uint16_t inside = 0; /* 16 bits wide like the values: that makes one vector loop of it */
        for (size_t i = 0; i < length; i++) {
            uint16_t v = data[begin + i], is = (uint16_t)(v - range.first) <= span ? UINT16_MAX : 0;
            inside = (uint16_t)(inside - is);
            uint16_t up = v | is, down = (uint16_t)(v & ~is);
            low = up < low ? up : low;
            high = down > high ? down : high;
        }
        found += inside;
    }
    *least = low;
    *greatest = high;
    if (found == count) {
        *least = UINT16_MAX;
        *greatest = 0;
    }
    return found;
}

static ang_mask_result mark_one(uint16_t *v, size_t index, ang_mask_range range, uint64_t *mask,
                                ang_mask_result result) {
    if (*v >= range.first && *v <= range.last) {
        *v = range.fill;
        ang_mask_set(mask, index);
        result.count++;
    } else {
        result.least = *v < result.least ? *v : result.least;
        result.greatest = *v > result.greatest ? *v : result.greatest;
    }
    return result;
}

ANG_SIMD
ang_mask_result ang_mask_mark(uint16_t *data, size_t count, size_t base, ang_mask_range range, uint64_t *mask) {
    ang_mask_result result = {0, UINT16_MAX, 0};
    size_t i = 0;
    for (; i < count && (base + i) % 64; i++) result = mark_one(&data[i], base + i, range, mask, result);
    uint16_t span = (uint16_t)(range.last - range.first), low = result.least, high = result.greatest;
    for (; count - i >= block; i += block) {
        uint16_t *p = data + i;
        uint8_t is[block];
        for (int k = 0; k < block; k++) {
            uint16_t v = p[k], inside = (uint16_t)(v - range.first) <= span ? UINT16_MAX : 0;
            uint16_t up = v | inside, down = (uint16_t)(v & ~inside);
            low = up < low ? up : low;
            high = down > high ? down : high;
            p[k] = (uint16_t)(down | (range.fill & inside));
            is[k] = (uint8_t)(inside & 1);
        }
        uint64_t bits = 0;
        for (int k = 0; k < 8; k++) {
            uint64_t bytes = 0;
            for (int b = 0; b < 8; b++) bytes |= (uint64_t)is[8 * k + b] << (8 * b);
            bits |= (bytes * UINT64_C(0x0102040810204080)) >> 56 << (8 * k); /* the eight low bits, side by side */
        }
        if (!bits) continue;
        mask[(base + i) / 64] = bits;
        result.count += (size_t)__builtin_popcountll(bits);
    }
    result.least = low;
    result.greatest = high;
    for (; i < count; i++) result = mark_one(&data[i], base + i, range, mask, result);
    if (result.count == count) {
        result.least = UINT16_MAX;
        result.greatest = 0;
    }
    return result;
}
