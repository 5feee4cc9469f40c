#include "core/base/memory.h"
#include "io/formats.h"
#include "io/voxels/decoder.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <zlib.h>

typedef struct inflating {
    FILE *file;
    const char *label;
    z_stream z;
    bool ended;
    uint8_t packed[1 << 16];
} inflating;

static void *start(FILE *file, const ang_byte_parts *parts, const ang_byte_part *part, ang_error *err) {
    (void)parts;
    inflating *self = ang_alloc(1, sizeof *self, "voxels", err);
    if (!self) return NULL;
    self->file = file;
    self->label = ang_base_name(part->path);
    if (inflateInit2(&self->z, 15 + 32) == Z_OK) return self; /* gzip or zlib, as it begins */
    free(self);
    ang_fail(err, ANG_LIMIT, "no memory to unpack voxels");
    return NULL;
}

/* False at the end of the file. */
static bool refill(inflating *self) {
    if (self->z.avail_in > 0) return true;
    self->z.next_in = self->packed;
    self->z.avail_in = (unsigned)fread(self->packed, 1, sizeof self->packed, self->file);
    return self->z.avail_in > 0;
}

/* Another gzip member follows; anything else behind a stream is not ours. */
static bool next_member(inflating *self) {
    return refill(self) && self->z.next_in[0] == 0x1F && inflateReset(&self->z) == Z_OK;
}

static ptrdiff_t unpack(void *context, uint8_t *out, size_t size, ang_error *err) {
    inflating *self = context;
    size_t wanted = size < 1U << 30 ? size : 1U << 30;
    self->z.next_out = out;
    self->z.avail_out = (unsigned)wanted;
    while (!self->ended && self->z.avail_out > 0 && refill(self)) {
        int code = inflate(&self->z, Z_NO_FLUSH);
        if (code == Z_STREAM_END) {
            self->ended = !next_member(self);
        } else if (code != Z_OK && code != Z_BUF_ERROR) {
            ang_fail(err, ANG_INPUT, "%s: its packed voxels are damaged (%s)", self->label,
                     self->z.msg ? self->z.msg : "deflate");
            return -1;
        }
    }
    if (ferror(self->file)) {
        ang_fail(err, ANG_INPUT, "%s: %s", self->label, strerror(errno));
        return -1;
    }
    return (ptrdiff_t)(wanted - self->z.avail_out);
}

static void end(void *context) {
    inflating *self = context;
    inflateEnd(&self->z);
    free(self);
}

const ang_decoder ang_decoder_deflate = {start, unpack, end};
