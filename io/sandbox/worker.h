/* One process of the sandbox, as the program sees it. Private to io/sandbox/. */
#ifndef ANG_IO_SANDBOX_WORKER_H
#define ANG_IO_SANDBOX_WORKER_H

#include "core/base/error.h"
#include "io/sandbox/protocol.h"

#include <stddef.h>
#include <sys/types.h>

typedef struct ang_worker {
    pid_t pid;
    int socket, memory;
    uint8_t *shared; /* `size` bytes of `memory` */
    size_t size;
    ang_worker_hello hello;
    struct ang_worker *next; /* for the owner */
} ang_worker;

/* Starts one with the codecs of a module (a plain name) and waits for its hello. NULL with ANG_INPUT, ANG_LIMIT. */
ang_worker *ang_worker_start(const char *module, ang_error *err);
/* At least `size` bytes of shared memory, zero where new, the same where not. False with ANG_LIMIT. */
bool ang_worker_reserve(ang_worker *worker, size_t size, ang_error *err);

/* How one request ended. */
typedef enum ang_worker_end {
    ANG_WORKER_REPLIED,
    ANG_WORKER_CRASHED,
    ANG_WORKER_FORBIDDEN, /* tried what it must not */
    ANG_WORKER_SLOW,      /* more than `seconds` of processor time, or far more without it */
} ang_worker_end;
/* Sends a request and waits; `bytes` and `seconds` are what it may take. Where it does not reply the process is gone.
 */
ang_worker_end ang_worker_ask(ang_worker *worker, const ang_worker_request *request, size_t bytes, double seconds,
                              ang_worker_reply *reply);
/* Ends the process and frees. */
void ang_worker_stop(ang_worker *worker);

#endif
