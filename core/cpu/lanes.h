/* Lanes: as many floats as one register holds, in the vector extensions of GCC and Clang. The one file with
 * instructions of a kind of processor; each of those has the same result to the bit as what stands beside it for all
 * others. Only for files that are compiled once for each width (core/CMakeLists.txt), without contraction to fused
 * operations, so that pictures are the same bits at every width. */
#ifndef ANG_CPU_LANES_H
#define ANG_CPU_LANES_H

#include <stddef.h>
#include <stdint.h>
#include <string.h>

#if defined(__AVX512F__)
#include <immintrin.h>
enum { LANES = 16 };
#elif defined(__AVX2__)
#include <immintrin.h>
enum { LANES = 8 };
#else
#if defined(__SSE2__)
#include <emmintrin.h>
#endif
enum { LANES = 4 };
#endif

typedef float lanes __attribute__((vector_size(4 * LANES)));
typedef int32_t lanes_int __attribute__((vector_size(4 * LANES))); /* as a mask: 0 or -1 */
typedef uint32_t lanes_uint __attribute__((vector_size(4 * LANES)));
typedef double lanes_double __attribute__((vector_size(8 * LANES)));
typedef int64_t lanes_long __attribute__((vector_size(8 * LANES)));
typedef int32_t quad __attribute__((vector_size(16)));

#define INLINE static inline __attribute__((always_inline))

/* x - 0 is x, which compilers know; x + 0 may be another zero. */
INLINE lanes lanes_all(float x) { return x - (lanes){0}; }
INLINE lanes_int lanes_all_int(int x) { return (lanes_int){0} + x; }
INLINE lanes lanes_load(const float *from) {
    lanes x;
    memcpy(&x, from, sizeof x);
    return x;
}
INLINE void lanes_store(float *to, lanes x) { memcpy(to, &x, sizeof x); }
INLINE lanes_int lanes_load_int(const int *from) {
    lanes_int x;
    memcpy(&x, from, sizeof x);
    return x;
}
INLINE void lanes_store_int(int *to, lanes_int x) { memcpy(to, &x, sizeof x); }
INLINE lanes_int lanes_number(void) {
    lanes_int x;
    for (int i = 0; i < LANES; i++) x[i] = i;
    return x;
}
/* Towards zero. */
INLINE lanes_int lanes_truncate(lanes x) { return __builtin_convertvector(x, lanes_int); }
INLINE lanes lanes_float(lanes_int x) { return __builtin_convertvector(x, lanes); }
INLINE lanes lanes_narrow(lanes_double x) { return __builtin_convertvector(x, lanes); }

INLINE lanes_int lanes_pick_int(lanes_int mask, lanes_int a, lanes_int b) { return (mask & a) | (~mask & b); }
INLINE lanes lanes_pick(lanes_int mask, lanes a, lanes b) {
    return (lanes)lanes_pick_int(mask, (lanes_int)a, (lanes_int)b);
}
INLINE lanes_double lanes_pick_double(lanes_long mask, lanes_double a, lanes_double b) {
    return (lanes_double)((mask & (lanes_long)a) | (~mask & (lanes_long)b));
}
INLINE lanes lanes_abs(lanes x) { return (lanes)((lanes_int)x & INT32_MAX); }

/* a < b ? a : b, and a > b ? a : b. */
INLINE lanes lanes_min(lanes a, lanes b) {
#if defined(__AVX512F__)
    return (lanes)_mm512_min_ps((__m512)a, (__m512)b);
#elif defined(__AVX2__)
    return (lanes)_mm256_min_ps((__m256)a, (__m256)b);
#elif defined(__SSE2__)
    return (lanes)_mm_min_ps((__m128)a, (__m128)b);
#else
    return lanes_pick(a < b, a, b);
#endif
}
INLINE lanes lanes_max(lanes a, lanes b) {
#if defined(__AVX512F__)
    return (lanes)_mm512_max_ps((__m512)a, (__m512)b);
#elif defined(__AVX2__)
    return (lanes)_mm256_max_ps((__m256)a, (__m256)b);
#elif defined(__SSE2__)
    return (lanes)_mm_max_ps((__m128)a, (__m128)b);
#else
    return lanes_pick(a > b, a, b);
#endif
}
INLINE lanes_double lanes_sqrt_double(lanes_double x) {
    for (int i = 0; i < LANES; i++) x[i] = __builtin_sqrt(x[i]);
    return x;
}
INLINE lanes lanes_sqrt(lanes x) {
#if defined(__AVX512F__)
    return (lanes)_mm512_sqrt_ps((__m512)x);
#elif defined(__AVX2__)
    return (lanes)_mm256_sqrt_ps((__m256)x);
#elif defined(__SSE2__)
    return (lanes)_mm_sqrt_ps((__m128)x);
#else
    for (int i = 0; i < LANES; i++) x[i] = __builtin_sqrtf(x[i]);
    return x;
#endif
}

/* One bit a lane of a mask. */
INLINE unsigned lanes_bits(lanes_int mask) {
#if defined(__AVX512F__)
    __mmask16 shorter = _mm512_cmplt_epi32_mask((__m512i)mask, _mm512_setzero_si512());
    /* Said to the compiler, since GCC 12 may store a mask's 16 bits and load 32 where it widens one by itself. */
    unsigned bits;
    __asm__("kmovw %1, %0" : "=r"(bits) : "k"(shorter));
    return bits;
#elif defined(__AVX2__)
    return (unsigned)_mm256_movemask_ps((__m256)mask);
#elif defined(__SSE2__)
    return (unsigned)_mm_movemask_ps((__m128)mask);
#else
    unsigned bits = 0;
    for (int i = 0; i < LANES; i++) bits |= (unsigned)(mask[i] & 1) << i;
    return bits;
#endif
}

INLINE int lanes_count(unsigned bits) {
#if defined(__POPCNT__)
    return __builtin_popcount(bits);
#else
    bits -= bits >> 1 & 0x5555;
    bits = (bits & 0x3333) + (bits >> 2 & 0x3333);
    bits = (bits + (bits >> 4)) & 0x0f0f;
    return (int)((bits + (bits >> 8)) & 31);
#endif
}

/* Stores the lanes whose bits are set one after the other; what lies in the LANES places from `to` on is lost. */
INLINE void lanes_pack(float *to, lanes x, unsigned bits) {
#if defined(__AVX512F__)
    _mm512_storeu_ps(to, _mm512_maskz_compress_ps((__mmask16)bits, (__m512)x));
#else
    float all[LANES];
    lanes_store(all, x);
    for (; bits; bits &= bits - 1) *to++ = all[__builtin_ctz(bits)];
#endif
}

/* Every fourth of `x`, four to a group, as groups of four lanes: group g of the result is x[g * stride]. */
INLINE lanes_int lanes_join(const quad *x, int stride) {
#if defined(__AVX512F__)
    __m256i low = _mm256_inserti128_si256(_mm256_castsi128_si256((__m128i)x[0]), (__m128i)x[stride], 1);
    __m256i high = _mm256_inserti128_si256(_mm256_castsi128_si256((__m128i)x[2 * stride]), (__m128i)x[3 * stride], 1);
    return (lanes_int)_mm512_inserti64x4(_mm512_castsi256_si512(low), high, 1);
#elif defined(__AVX2__)
    return (lanes_int)_mm256_inserti128_si256(_mm256_castsi128_si256((__m128i)x[0]), (__m128i)x[stride], 1);
#else
    (void)stride;
    return (lanes_int)x[0];
#endif
}

/* Within groups of four lanes: a0 b0 a1 b1, a2 b2 a3 b3; a0 a1 b0 b1, a2 a3 b2 b3; a0 a2 b0 b2, a1 a3 b1 b3. */
#if defined(__AVX512F__)
#define SHUFFLE(a, b, i, j, k, l)                                                                                      \
    __builtin_shufflevector(a, b, SHUFFLE_1(i), SHUFFLE_1(j), SHUFFLE_1(k), SHUFFLE_1(l), SHUFFLE_1(i) + 4,            \
                            SHUFFLE_1(j) + 4, SHUFFLE_1(k) + 4, SHUFFLE_1(l) + 4, SHUFFLE_1(i) + 8, SHUFFLE_1(j) + 8,  \
                            SHUFFLE_1(k) + 8, SHUFFLE_1(l) + 8, SHUFFLE_1(i) + 12, SHUFFLE_1(j) + 12,                  \
                            SHUFFLE_1(k) + 12, SHUFFLE_1(l) + 12)
#elif defined(__AVX2__)
#define SHUFFLE(a, b, i, j, k, l)                                                                                      \
    __builtin_shufflevector(a, b, SHUFFLE_1(i), SHUFFLE_1(j), SHUFFLE_1(k), SHUFFLE_1(l), SHUFFLE_1(i) + 4,            \
                            SHUFFLE_1(j) + 4, SHUFFLE_1(k) + 4, SHUFFLE_1(l) + 4)
#else
#define SHUFFLE(a, b, i, j, k, l) __builtin_shufflevector(a, b, i, j, k, l)
#endif
#define SHUFFLE_1(i) ((i) < 4 ? (i) : (i)-4 + LANES) /* 0..3: of a, 4..7: of b */

/* The four numbers of every lane, x[lane], as four lanes. */
INLINE void lanes_transpose(const quad x[LANES], lanes_int out[4]) {
    lanes_int a = lanes_join(x, 4), b = lanes_join(x + 1, 4), c = lanes_join(x + 2, 4), d = lanes_join(x + 3, 4);
    lanes_int ab = SHUFFLE(a, b, 0, 4, 1, 5), ab2 = SHUFFLE(a, b, 2, 6, 3, 7);
    lanes_int cd = SHUFFLE(c, d, 0, 4, 1, 5), cd2 = SHUFFLE(c, d, 2, 6, 3, 7);
    out[0] = SHUFFLE(ab, cd, 0, 1, 4, 5);
    out[1] = SHUFFLE(ab, cd, 2, 3, 6, 7);
    out[2] = SHUFFLE(ab2, cd2, 0, 1, 4, 5);
    out[3] = SHUFFLE(ab2, cd2, 2, 3, 6, 7);
}

/* Four lanes as the four numbers of every lane. */
INLINE void lanes_transpose_back(const lanes in[4], float out[4 * LANES]) {
    lanes ab = SHUFFLE(in[0], in[1], 0, 4, 1, 5), ab2 = SHUFFLE(in[0], in[1], 2, 6, 3, 7);
    lanes cd = SHUFFLE(in[2], in[3], 0, 4, 1, 5), cd2 = SHUFFLE(in[2], in[3], 2, 6, 3, 7);
    lanes part[4] = {SHUFFLE(ab, cd, 0, 1, 4, 5), SHUFFLE(ab, cd, 2, 3, 6, 7), SHUFFLE(ab2, cd2, 0, 1, 4, 5),
                     SHUFFLE(ab2, cd2, 2, 3, 6, 7)};
    for (int i = 0; i < 4; i++) {
        float one[LANES];
        lanes_store(one, part[i]);
        for (int group = 0; group < LANES / 4; group++)
            memcpy(out + 4 * (4 * group + i), one + 4 * group, 4 * sizeof *out);
    }
}

/* Keeps the compiler from taking the numbers out of the register one by one, which is slower than to store them all. */
#define LANES_IN_MEMORY(places) __asm__("" : "+m"(places))

/* Keeps the compiler from putting off the loads that make `x`, with all their addresses, to where it is used. Not where
 * LANES_PUT_OFF is defined before this file is included: where much else is held in registers that is faster. */
#if defined(LANES_PUT_OFF)
#define LANES_LOADED(x) (void)(x)
#elif defined(__AVX512F__)
#define LANES_LOADED(x) __asm__("" : "+v"(x))
#elif defined(__SSE2__)
#define LANES_LOADED(x) __asm__("" : "+x"(x))
#else
#define LANES_LOADED(x) (void)(x)
#endif

/* Loads lane by lane: measured faster than gather instructions (docs/measured.md). */
INLINE int load_word(const uint16_t *from) {
    int word;
    memcpy(&word, from, sizeof word);
    return word;
}
/* Of every lane the pairs of neighbours at base[0][place], base[1][place], ...: the lower half of a word lies first. */
INLINE void lanes_words(const uint16_t *const base[4], const int place[LANES], lanes_int out[4]) {
    quad x[LANES];
    for (int l = 0; l < LANES; l++) {
        x[l] = (quad){load_word(base[0] + place[l]), load_word(base[1] + place[l]), load_word(base[2] + place[l]),
                      load_word(base[3] + place[l])};
        LANES_LOADED(x[l]);
    }
    lanes_transpose(x, out);
}
/* Eight bytes from each. */
INLINE quad load_halves(const void *first, const void *second) {
#if defined(__SSE2__)
    __m128 low = _mm_loadl_pi(_mm_setzero_ps(), first);
    return (quad)_mm_loadh_pi(low, second);
#else
    quad x;
    memcpy(&x, first, 8);
    memcpy((char *)&x + 8, second, 8);
    return x;
#endif
}
/* Of every lane the four neighbours at base[0][place - 1] and base[1][place - 1], two to a word. */
INLINE void lanes_rows_of_four(const uint16_t *const base[2], const int place[LANES], lanes_int out[4]) {
    quad x[LANES];
    for (int l = 0; l < LANES; l++) {
        x[l] = load_halves(base[0] + place[l] - 1, base[1] + place[l] - 1);
        LANES_LOADED(x[l]);
    }
    lanes_transpose(x, out);
}
/* Of every lane the pairs at base[a], base[a + offset], base[b], base[b + offset]. */
INLINE void lanes_two_words(const uint16_t *base, lanes_int a, lanes_int b, ptrdiff_t offset, lanes_int out[4]) {
    int place[2][LANES];
    quad x[LANES];
    lanes_store_int(place[0], a);
    lanes_store_int(place[1], b);
    LANES_IN_MEMORY(place);
    for (int l = 0; l < LANES; l++) {
        const uint16_t *first = base + place[0][l], *second = base + place[1][l];
        x[l] = (quad){load_word(first), load_word(first + offset), load_word(second), load_word(second + offset)};
        LANES_LOADED(x[l]);
    }
    lanes_transpose(x, out);
}
/* The numbers base[at]. */
INLINE lanes lanes_floats(const float *base, lanes_int at) {
    int place[LANES];
    typedef float four __attribute__((vector_size(16)));
    quad x[LANES / 4];
    lanes_store_int(place, at);
    LANES_IN_MEMORY(place);
    for (int l = 0; l < LANES; l += 4) {
        x[l / 4] = (quad)(four){base[place[l]], base[place[l + 1]], base[place[l + 2]], base[place[l + 3]]};
        LANES_LOADED(x[l / 4]);
    }
    return (lanes)lanes_join(x, 1);
}
INLINE lanes_int lanes_ints(const void *base, lanes_int at) { return (lanes_int)lanes_floats(base, at); }
/* The bytes base[at]. */
INLINE lanes_int lanes_bytes(const uint8_t *base, lanes_int at) {
    int place[LANES];
    quad x[LANES / 4];
    lanes_store_int(place, at);
    LANES_IN_MEMORY(place);
    for (int l = 0; l < LANES; l += 4) {
        x[l / 4] = (quad){base[place[l]], base[place[l + 1]], base[place[l + 2]], base[place[l + 3]]};
        LANES_LOADED(x[l / 4]);
    }
    return lanes_join(x, 1);
}
/* The pairs base[2 at], base[2 at + 1]. */
INLINE void lanes_pairs(const float *base, lanes_int at, lanes *first, lanes *second) {
    int place[LANES];
    quad x[LANES / 2];
    lanes_store_int(place, at);
    LANES_IN_MEMORY(place);
    for (int l = 0; l < LANES; l += 2) {
        x[l / 2] = load_halves(base + 2 * (ptrdiff_t)place[l], base + 2 * (ptrdiff_t)place[l + 1]);
        LANES_LOADED(x[l / 2]);
    }
    lanes a = (lanes)lanes_join(x, 2), b = (lanes)lanes_join(x + 1, 2);
    *first = SHUFFLE(a, b, 0, 2, 4, 6);
    *second = SHUFFLE(a, b, 1, 3, 5, 7);
}
/* The fours base[4 at], ... */
INLINE void lanes_fours(const float *base, lanes_int at, lanes out[4]) {
    int place[LANES];
    quad x[LANES];
    lanes_int four[4];
    lanes_store_int(place, at);
    LANES_IN_MEMORY(place);
    for (int l = 0; l < LANES; l++) {
        memcpy(&x[l], base + 4 * (ptrdiff_t)place[l], sizeof *x);
        LANES_LOADED(x[l]);
    }
    lanes_transpose(x, four);
    for (int i = 0; i < 4; i++) out[i] = (lanes)four[i];
}

#endif
