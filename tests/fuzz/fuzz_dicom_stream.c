/* What is read of compressed pixels before a codec sees them, and run lengths, which need none. */
#include "io/dicom/decode.h"
#include "io/dicom/stream.h"
#include "tests/fuzz/fuzz.h"

#include <stdlib.h>
#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    if (size < 2) return 0;
    /* A copy of its own, so that what is read behind the end is seen. */
    size_t length = size - 2;
    uint8_t *stream = malloc(length ? length : 1);
    fuzz_expect(stream != NULL, "no memory");
    memcpy(stream, data + 2, length);
    ang_dicom_stream header;
    if (ang_dicom_stream_header(stream, length, &header))
        fuzz_expect(header.columns >= 0 && header.rows >= 0 && header.precision >= 0, "a negative size");
    ang_dicom_stream_sound(stream, length);
    size_t count = data[0];
    int bytes = 1 + data[1] % 4;
    uint8_t *out = malloc(count * (size_t)bytes + 1);
    fuzz_expect(out != NULL, "no memory");
    ang_dicom_rle(stream, length, count, bytes, out);
    free(out);
    free(stream);
    return 0;
}
