/* What frames and pictures share of the sandbox. Private to io/sandbox/. */
#ifndef ANG_IO_SANDBOX_POOL_H
#define ANG_IO_SANDBOX_POOL_H

#include "io/sandbox/sandbox.h"
#include "io/sandbox/worker.h"

/* An idle process or a new one; to be given back, or stopped where it does not reply. NULL with ANG_INPUT, ANG_LIMIT.
 */
ang_worker *ang_sandbox_take(ang_sandbox *sandbox, ang_error *err);
void ang_sandbox_give_back(ang_sandbox *sandbox, ang_worker *worker);

/* Asks for `pixels` pixels under the limits of sandbox.h. False with ANG_INPUT: what went wrong with `what` ("its JPEG
 * stream"), or what the process says; `*gone` where it is to be stopped. */
bool ang_sandbox_ask(ang_worker *worker, const ang_worker_request *request, size_t pixels, const char *what,
                     ang_worker_reply *reply, bool *gone, ang_error *err);

#endif
