/* Bytes in order from the parts of a file, or of several files, as a format's header says where they are and how they
 * are packed. Private to io/. */
#ifndef ANG_VOXELS_BYTE_STREAM_H
#define ANG_VOXELS_BYTE_STREAM_H

#include "core/base/error.h"
#include "io/sandbox/sandbox.h"
#include "io/voxels/sample.h"

#include <stddef.h>
#include <stdint.h>

/* How bytes are packed. */
typedef enum ang_coding {
    ANG_CODING_AUTO,    /* plain, or gzip where the file begins like it */
    ANG_CODING_PLAIN,   /* as they are */
    ANG_CODING_DEFLATE, /* gzip (several members too) or zlib */
    ANG_CODING_BZIP2,   /* refused where the build leaves it out */
    ANG_CODING_TEXT,    /* numbers as text; they become samples of `type`, little endian */
    ANG_CODING_HEX,     /* two hexadecimal digits a byte */
    ANG_CODING_PICTURE, /* pages of a picture file in grey; their samples, of `type`, rows from the top */
} ang_coding;

/* One part: a file or a piece of one. */
typedef struct ang_byte_part {
    const char *path;
    uint64_t offset; /* bytes of the file before the part, packed */
} ang_byte_part;

/* All parts, each of the same number of bytes. */
typedef struct ang_byte_parts {
    const ang_byte_part *part; /* borrowed */
    size_t count;              /* >= 1 */
    ang_coding coding;
    uint64_t skip;        /* bytes before the first that counts, in each part, unpacked */
    uint64_t part_bytes;  /* that count, in each part, unpacked */
    ang_sample type;      /* of text and pictures */
    int width, height;    /* of pages */
    ang_sandbox *sandbox; /* in which pictures are read; NULL: in this process */
} ang_byte_parts;

typedef struct ang_byte_stream ang_byte_stream;

/* Whether each part can hold its bytes, told by the sizes of the files, before anything is allocated for them:
 * `what` says what does not fit ("4 x 4 x 4 voxels of 2 bytes"). False with ANG_INPUT, also where a file is missing,
 * cannot be read or is no regular file. */
bool ang_byte_parts_check(const ang_byte_parts *parts, const char *label, const char *what, ang_error *err);

/* A stream at its begin; borrows `parts`. NULL with ANG_INPUT, ANG_LIMIT. Close with ang_byte_stream_close. */
ang_byte_stream *ang_byte_stream_open(const ang_byte_parts *parts, ang_error *err);
void ang_byte_stream_close(ang_byte_stream *stream);
/* The next `size` bytes into `out`, fewer where the stream ends. `*ok` false, with ANG_INPUT, where a file cannot be
 * read or is damaged. Errors name the file by its base name. */
size_t ang_byte_stream_read(ang_byte_stream *stream, void *out, size_t size, bool *ok, ang_error *err);
/* Passes over `size` bytes. False as above, or, without an error, where the stream ends before. */
bool ang_byte_stream_skip(ang_byte_stream *stream, uint64_t size, bool *ok, ang_error *err);
/* Whether something follows the bytes that count in the last part. */
bool ang_byte_stream_more(ang_byte_stream *stream);

#endif
