/* The codecs of GDCM behind a C interface; C++ includes it inside extern "C". */
#ifndef ANG_DICOM_CODEC_H
#define ANG_DICOM_CODEC_H

#include "core/base/error.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* One frame as its stream describes it. */
typedef struct ang_codec_frame {
    const char *transfer_syntax; /* UID */
    int columns, rows;
    int bits;       /* precision of the stream, 1 to 16 */
    bool is_signed; /* of the stream */
} ang_codec_frame;

/* Decodes `length` bytes at `stream` into `size` bytes at `pixels`: columns x rows words of one byte where bits <= 8,
 * else of two in the machine's order. No rescale, no mask. ANG_INPUT with a message without the file's name. Thread
 * safe; prints nothing. */
bool ang_codec_decode(const uint8_t *stream, size_t length, const ang_codec_frame *frame, void *pixels, size_t size,
                      ang_error *err);

/* GDCM lies in a module of its own, opened at the first call: its dictionaries take 20 ms to set up. It exports under
 * the name ANG_GDCM_DECODE a pointer to a function like ang_codec_decode. */
typedef bool ang_codec_function(const uint8_t *stream, size_t length, const ang_codec_frame *frame, void *pixels,
                                size_t size, ang_error *err);
#define ANG_GDCM_MODULE "angioscope-gdcm.so"
#define ANG_GDCM_DECODE "ang_gdcm_decode"

#endif
