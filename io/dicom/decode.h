/* The pixels of one slice: from its file to 16-bit values. */
#ifndef ANG_DICOM_DECODE_H
#define ANG_DICOM_DECODE_H

#include "core/base/error.h"
#include "io/dicom/slice.h"
#include "io/sandbox/sandbox.h"

/* Reads the slice's pixels from `path` (`label` names it in errors) into `out`, rows x columns values as
 * ang_dicom_convert writes them. Native pixels go straight there; otherwise one slice's compressed and decoded bytes
 * are held meanwhile. *masked, where it is not NULL, says whether bits that are not stored ones were set. Codecs run in
 * `sandbox`, or in this process where it is NULL. ANG_INPUT where the file cannot be decoded, ANG_LIMIT. Thread safe.
 */
bool ang_dicom_decode(const char *path, const char *label, const ang_dicom_slice *slice, ang_sandbox *sandbox,
                      uint16_t *out, bool *masked, ang_error *err);

/* Run lengths of one frame (PS3.5 annex G) become `bytes` little-endian bytes for each of `count` words. False where
 * the stream is damaged or too short. */
bool ang_dicom_rle(const uint8_t *stream, size_t length, size_t count, int bytes, uint8_t *out);

#endif
