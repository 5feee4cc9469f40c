/* Between the program and angioscope-decode, the process in which codecs run. Private to io/sandbox/.
 *
 * The socket (sequenced packets) carries one hello from the worker, then a request and a reply for each frame. The
 * memory holds the compressed stream and, behind it, the pixels. Both are inherited under fixed numbers. */
#ifndef ANG_IO_SANDBOX_PROTOCOL_H
#define ANG_IO_SANDBOX_PROTOCOL_H

#include <stdint.h>

#define ANG_WORKER_PROGRAM "angioscope-decode"

enum { ANG_WORKER_SOCKET = 3, ANG_WORKER_MEMORY = 4 };

typedef struct ang_worker_hello {
    uint32_t version;
    uint32_t confined; /* the kernel lets nothing but decoding through */
    uint64_t memory;   /* bytes of address space before the first frame */
} ang_worker_hello;
enum { ANG_WORKER_VERSION = 1 };

typedef enum ang_worker_task {
    ANG_WORKER_FRAME, /* a frame of DICOM to pixels */
    ANG_WORKER_OPEN,  /* a picture file to its form; it stays open until the next */
    ANG_WORKER_PAGE,  /* a page of the file that is open to pixels */
} ang_worker_task;

typedef struct ang_worker_request {
    uint64_t total;  /* bytes of the memory */
    uint64_t length; /* of the stream or the file, which begins it */
    uint64_t offset; /* of the pixels */
    uint64_t size;   /* of the pixels */
    int32_t task;
    int32_t columns, rows, bits, is_signed; /* of a frame */
    int32_t page;
    char name[256]; /* transfer syntax of a frame, name of a file */
} ang_worker_request;

typedef struct ang_worker_reply {
    uint32_t done;
    int32_t width, height, pages, type; /* ang_grey_form of a file that was opened */
    char message[512];                  /* where it was not done */
} ang_worker_reply;

#endif
