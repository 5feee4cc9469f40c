#include "io/voxels/byte_stream.h"

#include "core/base/memory.h"
#include "io/formats.h"
#include "io/voxels/decoder.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

enum { held_size = 1 << 16, small_read = 1 << 12 };

struct ang_byte_stream {
    const ang_byte_parts *parts;
    size_t next;                /* part to be opened next */
    uint64_t left;              /* of the bytes that count in the open part */
    FILE *file;                 /* NULL: no part is open */
    const ang_decoder *decoder; /* NULL: plain */
    void *decoding;
    size_t held_from, held_end; /* bytes read ahead, of the open part */
    uint8_t held[held_size];
};

static bool begins_like_gzip(FILE *file) {
    uint8_t start[2] = {0};
    bool is = fread(start, 1, 2, file) == 2 && start[0] == 0x1F && start[1] == 0x8B;
    rewind(file);
    return is;
}

static const ang_decoder *decoder_of(ang_coding coding, FILE *file) {
    switch (coding) {
    case ANG_CODING_AUTO:
        return begins_like_gzip(file) ? &ang_decoder_deflate : NULL;
    case ANG_CODING_DEFLATE:
        return &ang_decoder_deflate;
#ifdef ANG_WITH_BZIP2
    case ANG_CODING_BZIP2:
        return &ang_decoder_bzip2;
#endif
    case ANG_CODING_TEXT:
        return &ang_decoder_text;
    case ANG_CODING_HEX:
        return &ang_decoder_hex;
    case ANG_CODING_PICTURE:
        return &ang_decoder_picture;
    default:
        return NULL;
    }
}

/* The most unpacked bytes for each byte of a file. */
static double most_packed(const ang_byte_parts *parts, FILE *file) {
    switch (parts->coding) {
    case ANG_CODING_AUTO:
        return begins_like_gzip(file) ? 1032 : 1;
    case ANG_CODING_DEFLATE:
        return 1032; /* zlib's own bound */
    case ANG_CODING_BZIP2:
        return 1.5e6; /* 45 MB of one value in 45 bytes at the very best */
    case ANG_CODING_TEXT:
        return (double)ang_sample_size(parts->type) / 2; /* a digit and a blank */
    case ANG_CODING_HEX:
        return 0.5;
    case ANG_CODING_PICTURE:
        return 1e4; /* LZW reaches 2600, runs and tiles more */
    default:
        return 1;
    }
}

static bool check_part(const ang_byte_parts *parts, const ang_byte_part *part, const char *label, const char *what,
                       ang_error *err) {
    const char *name = ang_base_name(part->path);
    struct stat status;
    if (stat(part->path, &status) != 0 && errno == ENOENT && strcmp(name, label) != 0)
        return ang_fail(err, ANG_INPUT, "%s: its voxels should be in %s, which does not exist", label, name);
    errno = 0;
    FILE *file = stat(part->path, &status) == 0 && S_ISREG(status.st_mode) ? fopen(part->path, "rb") : NULL;
    if (!file) return ang_fail(err, ANG_INPUT, "%s: %s", name, errno ? strerror(errno) : "is no regular file");
    double most = most_packed(parts, file), size = (double)status.st_size - (double)part->offset;
    fclose(file);
    /* The last number of a text needs no blank. */
    double held = size * most + (parts->coding == ANG_CODING_TEXT ? most : 0);
    if ((double)parts->part_bytes + (double)parts->skip <= held) return true;
    if (parts->count == 1)
        return ang_fail(err, ANG_INPUT, "%s: %s do not fit a file of %lld bytes", name, what,
                        (long long)status.st_size);
    return ang_fail(err, ANG_INPUT, "%s: has %lld bytes, which do not hold one of %zu parts of %s", name,
                    (long long)status.st_size, parts->count, what);
}

bool ang_byte_parts_check(const ang_byte_parts *parts, const char *label, const char *what, ang_error *err) {
#ifndef ANG_WITH_BZIP2
    if (parts->coding == ANG_CODING_BZIP2)
        return ang_fail(err, ANG_INPUT, "%s: is packed by bzip2, which is left out of this build", label);
#endif
    for (size_t i = 0; i < parts->count; i++)
        if (!check_part(parts, &parts->part[i], label, what, err)) return false;
    return true;
}

static void close_part(ang_byte_stream *stream) {
    if (stream->decoding) stream->decoder->close(stream->decoding);
    if (stream->file) fclose(stream->file);
    stream->file = NULL;
    stream->decoder = NULL;
    stream->decoding = NULL;
    stream->held_from = stream->held_end = 0;
}

/* Up to `size` bytes of the open part, past what is held and whether they count or not; -1 with an error. */
static ptrdiff_t read_on(ang_byte_stream *stream, uint8_t *out, size_t size, ang_error *err) {
    if (stream->decoder) return stream->decoder->read(stream->decoding, out, size, err);
    size_t got = fread(out, 1, size, stream->file);
    if (got == size || !ferror(stream->file)) return (ptrdiff_t)got;
    ang_fail(err, ANG_INPUT, "%s: %s", ang_base_name(stream->parts->part[stream->next - 1].path), strerror(errno));
    return -1;
}

/* The same with what is held. */
static ptrdiff_t read_part(ang_byte_stream *stream, uint8_t *out, size_t size, ang_error *err) {
    if (stream->held_from == stream->held_end && size >= small_read) return read_on(stream, out, size, err);
    if (stream->held_from == stream->held_end) {
        ptrdiff_t got = read_on(stream, stream->held, held_size, err);
        if (got <= 0) return got;
        stream->held_from = 0;
        stream->held_end = (size_t)got;
    }
    size_t there = stream->held_end - stream->held_from, length = size < there ? size : there;
    memcpy(out, stream->held + stream->held_from, length);
    stream->held_from += length;
    return (ptrdiff_t)length;
}

/* False where the part ends before, or with an error. */
static bool skip_part(ang_byte_stream *stream, uint64_t size, ang_error *err) {
    if (!stream->decoder && stream->held_from == stream->held_end)
        return size == 0 || fseeko(stream->file, (off_t)size, SEEK_CUR) == 0;
    while (size > 0) {
        if (stream->held_from == stream->held_end) {
            ptrdiff_t got = read_on(stream, stream->held, held_size, err);
            if (got <= 0) return false;
            stream->held_from = 0;
            stream->held_end = (size_t)got;
        }
        uint64_t there = stream->held_end - stream->held_from, length = size < there ? size : there;
        stream->held_from += (size_t)length;
        size -= length;
    }
    return true;
}

static bool open_part(ang_byte_stream *stream, ang_error *err) {
    const ang_byte_part *part = &stream->parts->part[stream->next++];
    const char *label = ang_base_name(part->path);
    ang_error why = {0};
    stream->file = fopen(part->path, "rb");
    if (!stream->file) return ang_fail(err, ANG_INPUT, "%s: %s", label, strerror(errno));
    stream->decoder = decoder_of(stream->parts->coding, stream->file);
    if (fseeko(stream->file, (off_t)part->offset, SEEK_SET) != 0)
        return ang_fail(err, ANG_INPUT, "%s: %s", label, strerror(errno));
    if (stream->decoder) {
        stream->decoding = stream->decoder->open(stream->file, stream->parts, part, err);
        if (!stream->decoding) return false;
    }
    stream->left = stream->parts->part_bytes;
    if (skip_part(stream, stream->parts->skip, &why)) return true;
    return ang_fail(err, ANG_INPUT, "%s", why.code ? why.message : "its voxels are cut off before they begin");
}

ang_byte_stream *ang_byte_stream_open(const ang_byte_parts *parts, ang_error *err) {
    ang_byte_stream *stream = ang_alloc(1, sizeof *stream, "voxels", err);
    if (!stream) return NULL;
    stream->parts = parts;
    if (open_part(stream, err)) return stream;
    ang_byte_stream_close(stream);
    return NULL;
}

void ang_byte_stream_close(ang_byte_stream *stream) {
    if (!stream) return;
    close_part(stream);
    free(stream);
}

/* False at the end of the last part, or with an error. */
static bool next_part(ang_byte_stream *stream, bool *ok, ang_error *err) {
    if (stream->next == stream->parts->count) return false;
    close_part(stream);
    *ok = open_part(stream, err);
    return *ok;
}

size_t ang_byte_stream_read(ang_byte_stream *stream, void *out, size_t size, bool *ok, ang_error *err) {
    size_t done = 0;
    *ok = true;
    while (done < size) {
        if (stream->left == 0 && !next_part(stream, ok, err)) break;
        size_t wanted = size - done < stream->left ? size - done : (size_t)stream->left;
        ptrdiff_t got = read_part(stream, (uint8_t *)out + done, wanted, err);
        *ok = got >= 0;
        if (got <= 0) break;
        done += (size_t)got;
        stream->left -= (uint64_t)got;
    }
    return done;
}

bool ang_byte_stream_skip(ang_byte_stream *stream, uint64_t size, bool *ok, ang_error *err) {
    const ang_byte_parts *parts = stream->parts;
    *ok = true;
    while (size > 0) {
        if (stream->left == 0) {
            /* Whole parts need not be opened. */
            for (; size >= parts->part_bytes && stream->next < parts->count; stream->next++) size -= parts->part_bytes;
            if (size == 0) return true;
            if (!next_part(stream, ok, err)) return false;
        }
        uint64_t length = size < stream->left ? size : stream->left;
        bool rest = length == stream->left && stream->next < parts->count;
        ang_error why = {0};
        if (!rest && !skip_part(stream, length, &why)) {
            *ok = why.code == ANG_OK;
            if (!*ok && err) *err = why;
            return false;
        }
        stream->left -= length;
        size -= length;
    }
    return true;
}

bool ang_byte_stream_more(ang_byte_stream *stream) {
    uint8_t byte;
    return stream->left == 0 && read_part(stream, &byte, 1, NULL) == 1;
}
