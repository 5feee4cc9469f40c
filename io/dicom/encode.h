/* One DICOM file in memory: between write.c, which knows the series, and gdcm_write.cpp, which knows GDCM. Private to
 * io/dicom/. */
#ifndef ANG_IO_DICOM_ENCODE_H
#define ANG_IO_DICOM_ENCODE_H

#include "core/base/error.h"

#include <stddef.h>
#include <stdint.h>

/* A text element: tag as 0xGGGGEEEE, two letters of VR, value in DICOM's text form ("" is allowed for type 2). */
typedef struct ang_dicom_text {
    uint32_t tag;
    const char *vr;
    const char *value;
} ang_dicom_text;

/* Encodes one object: text elements in any order, US elements and the pixels. `*out` is freed with free(). False with
 * ANG_OUTPUT or ANG_LIMIT. Thread safe. */
bool ang_gdcm_encode(const ang_dicom_text *texts, size_t count, int rows, int columns, const uint16_t *pixels,
                     unsigned char **out, size_t *size, ang_error *err);

/* The module of codec.h exports under the name ANG_GDCM_ENCODE a pointer to a function like this. */
typedef bool ang_dicom_function(const ang_dicom_text *texts, size_t count, int rows, int columns,
                                const uint16_t *pixels, unsigned char **out, size_t *size, ang_error *err);
#define ANG_GDCM_ENCODE "ang_gdcm_encoder"

#endif
