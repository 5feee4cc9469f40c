#include "io/sandbox/sandbox.h"

#include "core/base/memory.h"
#include "io/sandbox/worker.h"
#include "io/text.h"

#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* What one frame may take. */
static const double least_seconds = 1, pixels_per_second = 4e6;
enum { least_bytes = 64 << 20, bytes_per_pixel = 64, page = 4096 };

struct ang_sandbox {
    pthread_mutex_t lock;
    ang_worker *idle;
    bool unconfined;
};

ang_sandbox *ang_sandbox_create(ang_error *err) {
    ang_sandbox *sandbox = ang_alloc(1, sizeof *sandbox, "decoders", err);
    if (sandbox) pthread_mutex_init(&sandbox->lock, NULL);
    return sandbox;
}

void ang_sandbox_free(ang_sandbox *sandbox) {
    if (!sandbox) return;
    for (ang_worker *worker = sandbox->idle, *next; worker; worker = next) {
        next = worker->next;
        ang_worker_stop(worker);
    }
    pthread_mutex_destroy(&sandbox->lock);
    free(sandbox);
}

static ang_worker *take(ang_sandbox *sandbox, ang_error *err) {
    pthread_mutex_lock(&sandbox->lock);
    ang_worker *worker = sandbox->idle;
    if (worker) sandbox->idle = worker->next;
    pthread_mutex_unlock(&sandbox->lock);
    if (worker) return worker;
    worker = ang_worker_start(ANG_GDCM_MODULE, err);
    if (!worker || worker->hello.confined) return worker;
    pthread_mutex_lock(&sandbox->lock);
    sandbox->unconfined = true;
    pthread_mutex_unlock(&sandbox->lock);
    return worker;
}

static void give_back(ang_sandbox *sandbox, ang_worker *worker) {
    pthread_mutex_lock(&sandbox->lock);
    worker->next = sandbox->idle;
    sandbox->idle = worker;
    pthread_mutex_unlock(&sandbox->lock);
}

static const char *codec_name(const ang_codec_frame *frame) {
    static const char jpeg[] = "1.2.840.10008.1.2.4.";
    if (strncmp(frame->transfer_syntax, jpeg, sizeof jpeg - 1) != 0) return "compressed";
    int kind = atoi(frame->transfer_syntax + sizeof jpeg - 1);
    return kind < 80 ? "JPEG" : kind < 90 ? "JPEG-LS" : "JPEG 2000";
}

static bool say_why(ang_worker_end end, const ang_codec_frame *frame, ang_error *err) {
    const char *what = end == ANG_WORKER_SLOW        ? "keeps the decoder busy for too long"
                       : end == ANG_WORKER_FORBIDDEN ? "made the decoder try what it must not do"
                                                     : "made the decoder crash";
    return ang_fail(err, ANG_INPUT, "its %s stream %s", codec_name(frame), what);
}

bool ang_sandbox_decode(ang_sandbox *sandbox, const uint8_t *stream, size_t length, const ang_codec_frame *frame,
                        void *pixels, size_t size, ang_error *err) {
    ang_worker *worker = take(sandbox, err);
    if (!worker) return false;
    size_t offset = (length + page - 1) / page * page, count = (size_t)frame->columns * (size_t)frame->rows;
    ang_worker_request request = {.length = length,
                                  .offset = offset,
                                  .size = size,
                                  .columns = frame->columns,
                                  .rows = frame->rows,
                                  .bits = frame->bits,
                                  .is_signed = frame->is_signed};
    snprintf(request.transfer_syntax, sizeof request.transfer_syntax, "%s", frame->transfer_syntax);
    if (!ang_worker_reserve(worker, offset + size, err)) {
        ang_worker_stop(worker);
        return false;
    }
    request.total = worker->size;
    memcpy(worker->shared, stream, length);
    ang_worker_reply reply;
    ang_worker_end end = ang_worker_ask(worker, &request, least_bytes + bytes_per_pixel * count,
                                        least_seconds + (double)count / pixels_per_second, &reply);
    if (end != ANG_WORKER_REPLIED) {
        ang_worker_stop(worker);
        return say_why(end, frame, err);
    }
    if (reply.decoded) {
        memcpy(pixels, worker->shared + offset, size);
    } else {
        ang_text_clean(reply.message);
        ang_fail(err, ANG_INPUT, "%s", reply.message); /* whatever the code: one frame is no reason to stop */
    }
    give_back(sandbox, worker);
    return reply.decoded;
}

const char *ang_sandbox_remark(ang_sandbox *sandbox) {
    pthread_mutex_lock(&sandbox->lock);
    bool unconfined = sandbox->unconfined;
    pthread_mutex_unlock(&sandbox->lock);
    return unconfined ? "compressed pixels are decoded in a process of its own, which the kernel here does not confine"
                      : NULL;
}
