/* Pictures that need no library: PPM and PFM. */
#include "io/image/image_io.h"
#include "tests/fuzz/fuzz.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    static const char *const names[] = {"a.ppm", "a.pfm"};
    for (int i = 0; i < 2; i++) {
        ang_image image = {0};
        ang_error err = {0};
        bool read = ang_picture_read(fuzz_file(names[i], data, size), &image, &err);
        fuzz_expect(read || err.message[0], "refused without a reason");
        if (read) ang_image_clear(&image);
    }
    return 0;
}
