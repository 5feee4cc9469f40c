#include "core/base/memory.h"

#include <stdlib.h>

void *ang_alloc(size_t count, size_t size, const char *what, ang_error *err) {
    void *memory = calloc(count ? count : 1, size ? size : 1);
    if (!memory) {
        ang_fail(err, ANG_LIMIT,
                 "%s: %.0f MB of memory are not to be had; close other programs or use a smaller volume", what,
                 (double)count * (double)size / 1e6);
    }
    return memory;
}

size_t ang_product3(size_t a, size_t b, size_t c) {
    size_t ab, abc;
    if (__builtin_mul_overflow(a, b, &ab) || __builtin_mul_overflow(ab, c, &abc)) return 0;
    return abc;
}
