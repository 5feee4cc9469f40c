/* Several DICOM files as one input: grouping, geometry, padding, resampling. The input is up to 12 files, each after
 * its length as two bytes, least first; the last may be cut. */
#include "tests/fuzz/fuzz.h"

#include <stdio.h>

enum { MOST = 12 };

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    const char *paths[MOST];
    size_t count = 0;
    while (size > 2 && count < MOST) {
        size_t length = (size_t)data[0] | (size_t)data[1] << 8;
        data += 2;
        size -= 2;
        if (length > size) length = size;
        char name[8];
        snprintf(name, sizeof name, "%zu", count);
        paths[count++] = fuzz_file(name, data, length);
        data += length;
        size -= length;
    }
    if (count) fuzz_load(paths, count);
    return 0;
}
