/* Between the program and angioscope-decode, the process in which codecs run. Private to io/sandbox/.
 *
 * The socket (sequenced packets) carries one hello from the decoder, then a request and a reply for each frame. The
 * memory holds the compressed stream and, behind it, the pixels. Both are inherited under fixed numbers. */
#ifndef ANG_IO_SANDBOX_PROTOCOL_H
#define ANG_IO_SANDBOX_PROTOCOL_H

#include <stdint.h>

#define ANG_DECODER "angioscope-decode"

enum { ANG_DECODER_SOCKET = 3, ANG_DECODER_MEMORY = 4 };

typedef struct ang_decoder_hello {
    uint32_t version;
    uint32_t confined; /* the kernel lets nothing but decoding through */
    uint64_t memory;   /* bytes of address space before the first frame */
} ang_decoder_hello;
enum { ANG_DECODER_VERSION = 1 };

typedef struct ang_decoder_request {
    uint64_t total;  /* bytes of the memory */
    uint64_t length; /* of the stream, which begins it */
    uint64_t offset; /* of the pixels */
    uint64_t size;   /* of the pixels */
    int32_t columns, rows, bits, is_signed;
    char transfer_syntax[72];
} ang_decoder_request;

typedef struct ang_decoder_reply {
    uint32_t decoded;
    char message[256];
} ang_decoder_reply;

#endif
