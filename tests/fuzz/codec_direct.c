/* GDCM's codecs in the process that is fuzzed, not behind the wall: to find what is wrong in them. */
#include "io/sandbox/sandbox.h"

ang_sandbox *fuzz_sandbox(void);

extern ang_codec_function *const ang_gdcm_decode;

bool ang_codec_decode(const uint8_t *stream, size_t length, const ang_codec_frame *frame, void *pixels, size_t size,
                      ang_error *err) {
    return ang_gdcm_decode(stream, length, frame, pixels, size, err);
}

ang_sandbox *fuzz_sandbox(void) { return NULL; }
