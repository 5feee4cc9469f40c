#include "core/base/memory.h"
#include "io/formats.h"
#include "io/voxels/decoder.h"

#include <bzlib.h>
#include <errno.h>
#include <stdlib.h>
#include <string.h>

typedef struct unzipping {
    FILE *file;
    const char *label;
    bz_stream b;
    bool ended;
    char packed[1 << 16];
} unzipping;

static void *start(FILE *file, const ang_byte_parts *parts, const ang_byte_part *part, ang_error *err) {
    (void)parts;
    unzipping *self = ang_alloc(1, sizeof *self, "voxels", err);
    if (!self) return NULL;
    self->file = file;
    self->label = ang_base_name(part->path);
    if (BZ2_bzDecompressInit(&self->b, 0, 0) == BZ_OK) return self;
    free(self);
    ang_fail(err, ANG_LIMIT, "no memory to unpack voxels");
    return NULL;
}

static bool refill(unzipping *self) {
    if (self->b.avail_in > 0) return true;
    self->b.next_in = self->packed;
    self->b.avail_in = (unsigned)fread(self->packed, 1, sizeof self->packed, self->file);
    return self->b.avail_in > 0;
}

/* Several streams in a row are one file, as the program bzip2 has it. */
static bool next_stream(unzipping *self) {
    if (!refill(self) || self->b.next_in[0] != 'B') return false;
    char *in = self->b.next_in, *out = self->b.next_out;
    unsigned in_left = self->b.avail_in, out_left = self->b.avail_out;
    BZ2_bzDecompressEnd(&self->b);
    self->b = (bz_stream){0};
    if (BZ2_bzDecompressInit(&self->b, 0, 0) != BZ_OK) return false;
    self->b.next_in = in;
    self->b.avail_in = in_left;
    self->b.next_out = out;
    self->b.avail_out = out_left;
    return true;
}

static ptrdiff_t unpack(void *context, uint8_t *out, size_t size, ang_error *err) {
    unzipping *self = context;
    size_t wanted = size < 1U << 30 ? size : 1U << 30;
    self->b.next_out = (char *)out;
    self->b.avail_out = (unsigned)wanted;
    while (!self->ended && self->b.avail_out > 0 && refill(self)) {
        int code = BZ2_bzDecompress(&self->b);
        if (code == BZ_STREAM_END) {
            self->ended = !next_stream(self);
        } else if (code != BZ_OK) {
            ang_fail(err, ANG_INPUT, "%s: its packed voxels are damaged (bzip2)", self->label);
            return -1;
        }
    }
    if (ferror(self->file)) {
        ang_fail(err, ANG_INPUT, "%s: %s", self->label, strerror(errno));
        return -1;
    }
    return (ptrdiff_t)(wanted - self->b.avail_out);
}

static void end(void *context) {
    unzipping *self = context;
    BZ2_bzDecompressEnd(&self->b);
    free(self);
}

const ang_decoder ang_decoder_bzip2 = {start, unpack, end};
