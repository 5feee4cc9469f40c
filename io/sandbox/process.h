/* One process of the sandbox, as the program sees it. Private to io/sandbox/. */
#ifndef ANG_IO_SANDBOX_PROCESS_H
#define ANG_IO_SANDBOX_PROCESS_H

#include "core/base/error.h"
#include "io/sandbox/protocol.h"

#include <stddef.h>
#include <sys/types.h>

typedef struct ang_decoder {
    pid_t pid;
    int socket, memory;
    uint8_t *shared; /* `size` bytes of `memory` */
    size_t size;
    ang_decoder_hello hello;
    struct ang_decoder *next; /* for the owner */
} ang_decoder;

/* Starts one with the codecs of a module (a plain name) and waits for its hello. NULL with ANG_INPUT, ANG_LIMIT. */
ang_decoder *ang_decoder_start(const char *module, ang_error *err);
/* At least `size` bytes of shared memory, zero where new. False with ANG_LIMIT. */
bool ang_decoder_reserve(ang_decoder *decoder, size_t size, ang_error *err);

/* How one request ended. */
typedef enum ang_decoder_end {
    ANG_DECODER_REPLIED,
    ANG_DECODER_CRASHED,
    ANG_DECODER_FORBIDDEN, /* tried what it must not */
    ANG_DECODER_SLOW,      /* more than `seconds` of processor time, or far more without it */
} ang_decoder_end;
/* Sends a request and waits; `bytes` and `seconds` are what it may take. Where it does not reply the process is gone.
 */
ang_decoder_end ang_decoder_ask(ang_decoder *decoder, const ang_decoder_request *request, size_t bytes, double seconds,
                                ang_decoder_reply *reply);
/* Ends the process and frees. */
void ang_decoder_stop(ang_decoder *decoder);

#endif
