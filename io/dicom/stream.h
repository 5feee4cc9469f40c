/* What compressed pixel data say of themselves, before a codec sees them. */
#ifndef ANG_DICOM_STREAM_H
#define ANG_DICOM_STREAM_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* What a JPEG, JPEG-LS or JPEG 2000 stream says of itself. */
typedef struct ang_dicom_stream {
    int columns, rows, components;
    int precision; /* bits */
    bool is_signed;
    bool jpeg2000;
} ang_dicom_stream;

/* Reads the stream's own header; false where there is none. */
bool ang_dicom_stream_header(const uint8_t *stream, size_t length, ang_dicom_stream *out);

/* Whether the markers of a whole JPEG or JPEG-LS stream are in order up to its end. GDCM's JPEG codecs end the process
 * on some that are not, and fill what is cut off with zeros. JPEG 2000 streams pass: their codec checks them itself. */
bool ang_dicom_stream_sound(const uint8_t *stream, size_t length);

#endif
