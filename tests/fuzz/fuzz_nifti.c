/* NIfTI-1, gzipped or not, and the voxels of any number type behind it. */
#include "tests/fuzz/fuzz.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    const char *path = fuzz_file("a.nii", data, size);
    fuzz_load(&path, 1);
    return 0;
}
