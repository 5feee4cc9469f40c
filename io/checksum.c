#include "io/checksum.h"

#include <zlib.h>

#if defined(__x86_64__) && defined(__GNUC__)

#include <immintrin.h>

/* V. Gopal et al., "Fast CRC computation for generic polynomials using PCLMULQDQ", Intel 2009: folds four times 128
 * bits at once, then one, then reduces (Barrett). The constants are those of its section on the reflected polynomial
 * 0xEDB88320. `length` is a multiple of 16 and at least 64; `state` is the complement of the CRC. */
__attribute__((target("sse4.1,pclmul"))) static uint32_t fold(uint32_t state, const uint8_t *p, size_t length) {
    const __m128i by64 = _mm_set_epi64x(0x1c6e41596, 0x154442bd4), by16 = _mm_set_epi64x(0xccaa009e, 0x1751997d0);
    const __m128i last = _mm_set_epi64x(0, 0x163cd6124), barrett = _mm_set_epi64x(0x1f7011641, 0x1db710641);
    __m128i x[4];
    for (int i = 0; i < 4; i++) x[i] = _mm_loadu_si128((const void *)(p + 16 * i));
    x[0] = _mm_xor_si128(x[0], _mm_cvtsi32_si128((int)state));
    p += 64;
    length -= 64;
    for (; length >= 64; p += 64, length -= 64) {
        for (int i = 0; i < 4; i++) {
            __m128i low = _mm_clmulepi64_si128(x[i], by64, 0x00), high = _mm_clmulepi64_si128(x[i], by64, 0x11);
            x[i] = _mm_xor_si128(_mm_xor_si128(low, high), _mm_loadu_si128((const void *)(p + 16 * i)));
        }
    }
    __m128i a = x[0];
    for (int i = 1; i < 4; i++) {
        __m128i low = _mm_clmulepi64_si128(a, by16, 0x00), high = _mm_clmulepi64_si128(a, by16, 0x11);
        a = _mm_xor_si128(_mm_xor_si128(low, high), x[i]);
    }
    for (; length >= 16; p += 16, length -= 16) {
        __m128i low = _mm_clmulepi64_si128(a, by16, 0x00), high = _mm_clmulepi64_si128(a, by16, 0x11);
        a = _mm_xor_si128(_mm_xor_si128(low, high), _mm_loadu_si128((const void *)p));
    }
    const __m128i even = _mm_setr_epi32(-1, 0, -1, 0);
    a = _mm_xor_si128(_mm_srli_si128(a, 8), _mm_clmulepi64_si128(a, by16, 0x10));
    a = _mm_xor_si128(_mm_srli_si128(a, 4), _mm_clmulepi64_si128(_mm_and_si128(a, even), last, 0x00));
    __m128i q = _mm_and_si128(_mm_clmulepi64_si128(_mm_and_si128(a, even), barrett, 0x10), even);
    a = _mm_xor_si128(a, _mm_clmulepi64_si128(q, barrett, 0x00));
    return (uint32_t)_mm_extract_epi32(a, 1);
}

uint32_t ang_checksum(uint32_t crc, const void *bytes, size_t length) {
    const uint8_t *p = bytes;
    if (length >= 64 && __builtin_cpu_supports("pclmul") && __builtin_cpu_supports("sse4.1")) {
        size_t whole = length / 16 * 16;
        crc = ~fold(~crc, p, whole);
        p += whole;
        length -= whole;
    }
    return length ? (uint32_t)crc32_z(crc, p, length) : crc;
}

#else

uint32_t ang_checksum(uint32_t crc, const void *bytes, size_t length) { return (uint32_t)crc32_z(crc, bytes, length); }

#endif
