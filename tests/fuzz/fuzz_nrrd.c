/* NRRD, with its voxels in the file or in one beside it. */
#include "tests/fuzz/fuzz.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    static const uint8_t voxels[512] = {1, 2, 3};
    fuzz_file("a.raw", voxels, sizeof voxels);
    const char *path = fuzz_file("a.nrrd", data, size);
    fuzz_load(&path, 1);
    return 0;
}
