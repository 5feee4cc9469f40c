/* For targets that need no codec. */
#include "io/dicom/codec.h"

bool ang_codec_decode(const uint8_t *stream, size_t length, const ang_codec_frame *frame, void *pixels, size_t size,
                      ang_error *err) {
    (void)stream, (void)length, (void)frame, (void)pixels, (void)size;
    return ang_fail(err, ANG_INPUT, "no codec here");
}
