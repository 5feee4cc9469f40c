#include "io/sandbox/sandbox.h"

#include "core/base/memory.h"
#include "io/sandbox/pool.h"
#include "io/text.h"

#include <pthread.h>
#include <stdlib.h>

/* What one frame may take. */
static const double least_seconds = 1, pixels_per_second = 4e6;
enum { least_bytes = 256 << 20, bytes_per_pixel = 64 };

struct ang_sandbox {
    pthread_mutex_t lock;
    const char *module;
    ang_worker *idle;
    bool unconfined;
};

ang_sandbox *ang_sandbox_create(const char *module, ang_error *err) {
    ang_sandbox *sandbox = ang_alloc(1, sizeof *sandbox, "decoders", err);
    if (!sandbox) return NULL;
    pthread_mutex_init(&sandbox->lock, NULL);
    sandbox->module = module;
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

ang_worker *ang_sandbox_take(ang_sandbox *sandbox, ang_error *err) {
    pthread_mutex_lock(&sandbox->lock);
    ang_worker *worker = sandbox->idle;
    if (worker) sandbox->idle = worker->next;
    pthread_mutex_unlock(&sandbox->lock);
    if (worker) return worker;
    worker = ang_worker_start(sandbox->module, err);
    if (!worker || worker->hello.confined) return worker;
    pthread_mutex_lock(&sandbox->lock);
    sandbox->unconfined = true;
    pthread_mutex_unlock(&sandbox->lock);
    return worker;
}

void ang_sandbox_give_back(ang_sandbox *sandbox, ang_worker *worker) {
    pthread_mutex_lock(&sandbox->lock);
    worker->next = sandbox->idle;
    sandbox->idle = worker;
    pthread_mutex_unlock(&sandbox->lock);
}

bool ang_sandbox_ask(ang_worker *worker, const ang_worker_request *request, size_t pixels, const char *what,
                     ang_worker_reply *reply, bool *gone, ang_error *err) {
    ang_worker_end end = ang_worker_ask(worker, request, least_bytes + bytes_per_pixel * pixels,
                                        least_seconds + (double)pixels / pixels_per_second, reply);
    *gone = end != ANG_WORKER_REPLIED;
    if (*gone)
        return ang_fail(err, ANG_INPUT, "%s %s", what,
                        end == ANG_WORKER_SLOW        ? "keeps the decoder busy for too long"
                        : end == ANG_WORKER_FORBIDDEN ? "made the decoder try what it must not do"
                                                      : "made the decoder crash");
    if (reply->done) return true;
    ang_text_clean(reply->message);
    return ang_fail(err, ANG_INPUT, "%s", reply->message); /* whatever the code: one frame is no reason to stop */
}

const char *ang_sandbox_remark(ang_sandbox *sandbox) {
    pthread_mutex_lock(&sandbox->lock);
    bool unconfined = sandbox->unconfined;
    pthread_mutex_unlock(&sandbox->lock);
    return unconfined ? "compressed pixels are decoded in a process of its own, which the kernel here does not confine"
                      : NULL;
}
