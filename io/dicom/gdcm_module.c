/* Opens the GDCM module when compressed pixels are read or DICOM is written. */
#include "io/dicom/codec.h"
#include "io/dicom/encode.h"
#include "io/module.h"

bool ang_codec_decode(const uint8_t *stream, size_t length, const ang_codec_frame *frame, void *pixels, size_t size,
                      ang_error *err) {
    ang_codec_function *const *decode =
        ang_module_symbol(ANG_GDCM_MODULE, ANG_GDCM_DECODE, "compressed DICOM files", ANG_INPUT, err);
    return decode && (*decode)(stream, length, frame, pixels, size, err);
}

bool ang_gdcm_encode(const ang_dicom_text *texts, size_t count, int rows, int columns, const uint16_t *pixels,
                     unsigned char **out, size_t *size, ang_error *err) {
    ang_dicom_function *const *encode =
        ang_module_symbol(ANG_GDCM_MODULE, ANG_GDCM_ENCODE, "writing DICOM files", ANG_OUTPUT, err);
    return encode && (*encode)(texts, count, rows, columns, pixels, out, size, err);
}
