/* The JSON beside a raw volume. */
#include "tests/fuzz/fuzz.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    static uint8_t voxels[4096];
    for (size_t i = 0; i < sizeof voxels; i++) voxels[i] = (uint8_t)(i * 37);
    const char *path = fuzz_file("a.raw", voxels, sizeof voxels);
    fuzz_file("a.json", data, size);
    fuzz_load(&path, 1);
    return 0;
}
