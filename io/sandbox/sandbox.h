/* Codecs and readers of pictures in processes of their own (angioscope-decode), which can do nothing but decode and
 * only for so long: what goes wrong in a codec costs one frame and one sentence. */
#ifndef ANG_IO_SANDBOX_SANDBOX_H
#define ANG_IO_SANDBOX_SANDBOX_H

#include "io/dicom/codec.h"
#include "io/image/encode.h"

/* As many processes as frames are decoded at once, started when the first frame needs one. */
typedef struct ang_sandbox ang_sandbox;

/* For the codecs of one module, ANG_GDCM_MODULE or ANG_OIIO_MODULE, a string that stays. NULL with ANG_LIMIT. Ends its
 * processes in ang_sandbox_free; NULL is allowed there. */
ang_sandbox *ang_sandbox_create(const char *module, ang_error *err);
void ang_sandbox_free(ang_sandbox *sandbox);

/* As ang_codec_decode. ANG_INPUT also where the worker crashes, tries what it must not, needs more than 1 s + 0.25 s
 * per million pixels of processor time (to the next second) or more than 256 MB + 64 bytes per pixel, or cannot be
 * started. Thread safe. */
bool ang_sandbox_decode(ang_sandbox *sandbox, const uint8_t *stream, size_t length, const ang_codec_frame *frame,
                        void *pixels, size_t size, ang_error *err);

/* As ang_oiio_grey_open, ang_oiio_grey_read and ang_oiio_grey_close, which they are where `sandbox` is NULL, under the
 * same limits for each page, and at most 1 GB of file. The sandbox must outlive the handle. */
void *ang_sandbox_grey_open(ang_sandbox *sandbox, const char *path, ang_grey_form *form, ang_error *err);
bool ang_sandbox_grey_read(void *handle, int page, void *out, ang_error *err);
void ang_sandbox_grey_close(void *handle);

/* A sentence where a process was started that the kernel does not confine; NULL else. */
const char *ang_sandbox_remark(ang_sandbox *sandbox);

#endif
