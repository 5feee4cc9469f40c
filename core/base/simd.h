/* Loops that the compiler may build once for each width of SIMD and choose among at run time. */
#ifndef ANG_BASE_SIMD_H
#define ANG_BASE_SIMD_H

/* Before a function: variants for AVX2 and AVX-512 beside the baseline. Elsewhere than on x86-64, and under
 * AddressSanitizer (which is not ready when the choice is made) or with clang (whose version 14 gives the choice
 * another name), the baseline alone. */
#if defined(__x86_64__) && defined(__gnu_linux__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__)
#define ANG_SIMD __attribute__((target_clones("arch=x86-64-v4", "avx2", "default")))
#else
#define ANG_SIMD
#endif

#endif
