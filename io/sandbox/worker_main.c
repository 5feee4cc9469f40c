/* angioscope-decode: decodes for the program, which starts it with a socket and memory (protocol.h), until the socket
 * is closed. Of no use by itself. */
#include "io/dicom/codec.h"
#include "io/module.h"
#include "io/sandbox/confine.h"
#include "io/sandbox/protocol.h"

#include <errno.h>
#include <limits.h>
#include <malloc.h>
#include <stdio.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <unistd.h>

/* The memory that the program shares, mapped as far as it needs to be. */
static struct {
    uint8_t *at;
    size_t size;
} shared;

static bool map_shared(size_t size) {
    if (size <= shared.size) return true;
    if (shared.size > 0) munmap(shared.at, shared.size);
    void *at = mmap(NULL, size, PROT_READ | PROT_WRITE, MAP_SHARED, ANG_WORKER_MEMORY, 0);
    shared.size = at == MAP_FAILED ? 0 : size;
    shared.at = at;
    return at != MAP_FAILED;
}

/* Bytes of address space, before files can no longer be opened; 0 where the system does not say. */
static uint64_t address_space(void) {
    unsigned long long pages = 0;
    FILE *file = fopen("/proc/self/statm", "r");
    if (!file) return 0;
    if (fscanf(file, "%llu", &pages) != 1) pages = 0;
    fclose(file);
    return pages * (uint64_t)sysconf(_SC_PAGESIZE);
}

static void decode(ang_codec_function *codec, ang_worker_request *request, ang_worker_reply *reply) {
    ang_error err = {.code = ANG_LIMIT, .message = "no memory to decode its pixels"};
    request->transfer_syntax[sizeof request->transfer_syntax - 1] = '\0';
    ang_codec_frame frame = {.transfer_syntax = request->transfer_syntax,
                             .columns = request->columns,
                             .rows = request->rows,
                             .bits = request->bits,
                             .is_signed = request->is_signed != 0};
    *reply = (ang_worker_reply){
        .decoded = map_shared(request->total) &&
                   codec(shared.at, request->length, &frame, shared.at + request->offset, request->size, &err)};
    if (reply->decoded) return;
    snprintf(reply->message, sizeof reply->message, "%.*s", (int)sizeof reply->message - 1, err.message);
}

static ssize_t receive(void *out, size_t size) {
    ssize_t got;
    do got = read(ANG_WORKER_SOCKET, out, size);
    while (got < 0 && errno == EINTR);
    return got;
}

int main(int argc, char **argv) {
    int kind = 0;
    socklen_t length = sizeof kind;
    if (argc != 2 || getsockopt(ANG_WORKER_SOCKET, SOL_SOCKET, SO_TYPE, &kind, &length) != 0) {
        fprintf(stderr, ANG_WORKER_PROGRAM " is started by angioscope itself\n");
        return ANG_USAGE;
    }
    close_range(ANG_WORKER_MEMORY + 1, ~0U, 0);
    ang_error err = {0};
    ang_codec_function *const *codec =
        ang_module_symbol(argv[1], ANG_GDCM_DECODE, "compressed DICOM files", ANG_INPUT, &err);
    if (!codec) return ANG_INPUT;
    /* Frames are alike: the memory of one is kept for the next, so that its pages need not be cleared again. */
    mallopt(M_MMAP_THRESHOLD, 1 << 30);
    mallopt(M_TRIM_THRESHOLD, INT_MAX);
    ang_worker_hello hello = {.version = ANG_WORKER_VERSION, .memory = address_space()};
    hello.confined = ang_confine();
    if (write(ANG_WORKER_SOCKET, &hello, sizeof hello) != (ssize_t)sizeof hello) return ANG_OUTPUT;
    ang_worker_request request;
    while (receive(&request, sizeof request) == (ssize_t)sizeof request) {
        ang_worker_reply reply;
        decode(*codec, &request, &reply);
        if (write(ANG_WORKER_SOCKET, &reply, sizeof reply) != (ssize_t)sizeof reply) return ANG_OUTPUT;
    }
    return ANG_OK;
}
