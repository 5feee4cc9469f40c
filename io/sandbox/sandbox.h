/* Codecs in processes of their own (angioscope-decode), which can do nothing but decode and only for so long: what goes
 * wrong in a codec costs one frame and one sentence. */
#ifndef ANG_IO_SANDBOX_SANDBOX_H
#define ANG_IO_SANDBOX_SANDBOX_H

#include "io/dicom/codec.h"

/* As many processes as frames are decoded at once, started when the first frame needs one. */
typedef struct ang_sandbox ang_sandbox;

/* NULL with ANG_LIMIT. Ends its processes in ang_sandbox_free; NULL is allowed there. */
ang_sandbox *ang_sandbox_create(ang_error *err);
void ang_sandbox_free(ang_sandbox *sandbox);

/* As ang_codec_decode. ANG_INPUT also where the worker crashes, tries what it must not, needs more than 1 s + 0.25 s
 * per million pixels of processor time (to the next second) or more than 64 MB + 64 bytes per pixel, or cannot be
 * started. Thread safe. */
bool ang_sandbox_decode(ang_sandbox *sandbox, const uint8_t *stream, size_t length, const ang_codec_frame *frame,
                        void *pixels, size_t size, ang_error *err);

/* A sentence where a process was started that the kernel does not confine; NULL else. */
const char *ang_sandbox_remark(ang_sandbox *sandbox);

#endif
