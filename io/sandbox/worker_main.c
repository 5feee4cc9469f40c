/* angioscope-decode: decodes for the program, which starts it with a socket and memory (protocol.h), until the socket
 * is closed. Of no use by itself. */
#include "io/dicom/codec.h"
#include "io/image/encode.h"
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

/* What it decodes with: one of the two. */
typedef struct codecs {
    ang_codec_function *frame;
    const ang_oiio_functions *picture;
    void *open; /* picture file */
} codecs;

static bool open_codecs(const char *module, codecs *codecs, ang_error *err) {
    if (strcmp(module, ANG_OIIO_MODULE) == 0) {
        codecs->picture = ang_module_symbol(module, ANG_OIIO_SYMBOL, "picture files", ANG_INPUT, err);
        if (codecs->picture) codecs->picture->grey_settle();
        return codecs->picture != NULL;
    }
    ang_codec_function *const *frame =
        ang_module_symbol(module, ANG_GDCM_DECODE, "compressed DICOM files", ANG_INPUT, err);
    if (frame) codecs->frame = *frame;
    return frame != NULL;
}

static bool decode_frame(const codecs *codecs, const ang_worker_request *request, ang_error *err) {
    ang_codec_frame frame = {.transfer_syntax = request->name,
                             .columns = request->columns,
                             .rows = request->rows,
                             .bits = request->bits,
                             .is_signed = request->is_signed != 0};
    return codecs->frame(shared.at, request->length, &frame, shared.at + request->offset, request->size, err);
}

static bool open_picture(codecs *codecs, const ang_worker_request *request, ang_worker_reply *reply, ang_error *err) {
    ang_grey_form form = {0};
    codecs->open = codecs->picture->grey_open(request->name, shared.at, request->length, &form, err);
    reply->width = form.width;
    reply->height = form.height;
    reply->pages = form.pages;
    reply->type = form.type;
    return codecs->open != NULL;
}

static void serve(codecs *codecs, ang_worker_request *request, ang_worker_reply *reply) {
    ang_error err = {.code = ANG_LIMIT, .message = "no memory to decode its pixels"};
    *reply = (ang_worker_reply){0};
    request->name[sizeof request->name - 1] = '\0';
    /* What is open refers to the memory, which may be about to move. */
    if (request->task != ANG_WORKER_PAGE && codecs->open) codecs->picture->grey_close(codecs->open);
    if (request->task != ANG_WORKER_PAGE) codecs->open = NULL;
    if (map_shared(request->total)) {
        if (request->task == ANG_WORKER_FRAME && codecs->frame)
            reply->done = decode_frame(codecs, request, &err);
        else if (request->task == ANG_WORKER_OPEN && codecs->picture)
            reply->done = open_picture(codecs, request, reply, &err);
        else if (request->task == ANG_WORKER_PAGE && codecs->open)
            reply->done = codecs->picture->grey_read(codecs->open, request->page, shared.at + request->offset, &err);
    }
    if (!reply->done)
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
    /* Arenas of threads would take address space that is counted to the frames. */
    mallopt(M_ARENA_MAX, 1);
    codecs codecs = {0};
    if (!open_codecs(argv[1], &codecs, &err)) return ANG_INPUT;
    /* Frames are alike: the memory of one is kept for the next, so that its pages need not be cleared again. */
    mallopt(M_MMAP_THRESHOLD, 1 << 30);
    mallopt(M_TRIM_THRESHOLD, INT_MAX);
    ang_worker_hello hello = {.version = ANG_WORKER_VERSION, .memory = address_space()};
    hello.confined = ang_confine();
    if (write(ANG_WORKER_SOCKET, &hello, sizeof hello) != (ssize_t)sizeof hello) return ANG_OUTPUT;
    ang_worker_request request;
    while (receive(&request, sizeof request) == (ssize_t)sizeof request) {
        ang_worker_reply reply;
        serve(&codecs, &request, &reply);
        if (write(ANG_WORKER_SOCKET, &reply, sizeof reply) != (ssize_t)sizeof reply) return ANG_OUTPUT;
    }
    return ANG_OK;
}
