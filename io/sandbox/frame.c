/* Frames of DICOM. */
#include "io/sandbox/pool.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { page = 4096 };

static const char *stream_name(const ang_codec_frame *frame) {
    static const char jpeg[] = "1.2.840.10008.1.2.4.";
    if (strncmp(frame->transfer_syntax, jpeg, sizeof jpeg - 1) != 0) return "its compressed stream";
    int kind = atoi(frame->transfer_syntax + sizeof jpeg - 1);
    return kind < 80 ? "its JPEG stream" : kind < 90 ? "its JPEG-LS stream" : "its JPEG 2000 stream";
}

bool ang_sandbox_decode(ang_sandbox *sandbox, const uint8_t *stream, size_t length, const ang_codec_frame *frame,
                        void *pixels, size_t size, ang_error *err) {
    ang_worker *worker = ang_sandbox_take(sandbox, err);
    if (!worker) return false;
    ang_worker_request request = {.task = ANG_WORKER_FRAME,
                                  .length = length,
                                  .offset = (length + page - 1) / page * page,
                                  .size = size,
                                  .columns = frame->columns,
                                  .rows = frame->rows,
                                  .bits = frame->bits,
                                  .is_signed = frame->is_signed};
    snprintf(request.name, sizeof request.name, "%s", frame->transfer_syntax);
    ang_worker_reply reply;
    bool gone = !ang_worker_reserve(worker, request.offset + size, err), done = false;
    if (!gone) {
        request.total = worker->size;
        memcpy(worker->shared, stream, length);
        done = ang_sandbox_ask(worker, &request, (size_t)frame->columns * (size_t)frame->rows, stream_name(frame),
                               &reply, &gone, err);
    }
    if (done) memcpy(pixels, worker->shared + request.offset, size);
    if (gone)
        ang_worker_stop(worker);
    else
        ang_sandbox_give_back(sandbox, worker);
    return done;
}
