/* Ways of packing, one file each, behind ang_byte_stream. Private to io/voxels/. */
#ifndef ANG_VOXELS_DECODER_H
#define ANG_VOXELS_DECODER_H

#include "io/voxels/byte_stream.h"

#include <stdio.h>

typedef struct ang_decoder {
    /* Starts at the file's present place; what it returns goes to the others. NULL with an error. */
    void *(*open)(FILE *file, const ang_byte_parts *parts, const ang_byte_part *part, ang_error *err);
    /* Up to `size` unpacked bytes; 0 at the end; -1 with an error. */
    ptrdiff_t (*read)(void *self, uint8_t *out, size_t size, ang_error *err);
    void (*close)(void *self);
} ang_decoder;

extern const ang_decoder ang_decoder_deflate, ang_decoder_text, ang_decoder_hex, ang_decoder_picture;
#ifdef ANG_WITH_BZIP2
extern const ang_decoder ang_decoder_bzip2;
#endif

#endif
