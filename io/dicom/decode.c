#include "io/dicom/decode.h"

#include "core/base/memory.h"
#include "io/dicom/codec.h"
#include "io/dicom/parse.h"
#include "io/dicom/stored.h"
#include "io/dicom/stream.h"

#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static uint32_t little32(const uint8_t *p) {
    return (uint32_t)p[3] << 24 | (uint32_t)p[2] << 16 | (uint32_t)p[1] << 8 | p[0];
}

static bool read_all(int fd, void *out, size_t length, uint64_t offset) {
    for (size_t done = 0; done < length;) {
        ssize_t got = pread(fd, (char *)out + done, length - done, (off_t)(offset + done));
        if (got < 0 && errno == EINTR) continue;
        if (got <= 0) return false;
        done += (size_t)got;
    }
    return true;
}

bool ang_dicom_rle(const uint8_t *stream, size_t length, size_t count, int bytes, uint8_t *out) {
    if (length < 64 || little32(stream) != (uint32_t)bytes) return false;
    for (int segment = 0; segment < bytes; segment++) {
        size_t begin = little32(stream + 4 + 4 * segment);
        size_t end = segment + 1 < bytes ? little32(stream + 8 + 4 * segment) : length;
        if (begin < 64 || begin > end || end > length) return false;
        const uint8_t *p = stream + begin, *stop = stream + end;
        size_t step = (size_t)bytes, done = 0;
        uint8_t *to = out + (bytes - 1 - segment); /* the most significant byte comes first (G.2) */
        while (done < count) {
            if (p >= stop) return false;
            int control = *p < 128 ? *p : *p - 256;
            p++;
            if (control >= 0) {
                size_t run = (size_t)control + 1;
                if ((size_t)(stop - p) < run) return false;
                for (size_t i = 0; i < run && done < count; i++) to[step * done++] = p[i];
                p += run;
            } else if (control != -128) {
                size_t run = (size_t)(1 - control);
                if (p >= stop) return false;
                for (size_t i = 0; i < run && done < count; i++) to[step * done++] = *p;
                p++;
            }
        }
    }
    return true;
}

/* The fragments of the frame, joined (PS3.5 annex A.4). */
static uint8_t *read_fragments(int fd, const ang_dicom_slice *slice, uint64_t file_size, size_t *length,
                               const char *label, ang_error *err) {
    uint8_t *stream = NULL, head[8];
    uint64_t at = slice->pixel_offset, end = at + slice->pixel_length;
    *length = 0;
    while (at < end) {
        if (at > file_size || file_size - at < 8 || !read_all(fd, head, 8, at)) break; /* no delimiter: what there is */
        uint32_t size = little32(head + 4);
        if (head[0] != 0xFE || head[1] != 0xFF || head[2] != 0x00 || head[3] != 0xE0) break;
        at += 8;
        if (size > file_size - at) {
            ang_fail(err, ANG_INPUT, "%s: (7FE0,0010) PixelData is cut off", label);
            goto failed;
        }
        if (size > 0) {
            uint8_t *grown = *length + size < UINT32_MAX ? realloc(stream, *length + size + 1) : NULL;
            if (!grown) {
                ang_fail(err, ANG_LIMIT, "%s: no memory for its compressed pixels", label);
                goto failed;
            }
            stream = grown;
            if (!read_all(fd, stream + *length, size, at)) {
                ang_fail(err, ANG_INPUT, "%s: (7FE0,0010) PixelData is cut off", label);
                goto failed;
            }
            *length += size;
        }
        at += size;
    }
    if (*length > 0) return stream;
    ang_fail(err, ANG_INPUT, "%s: (7FE0,0010) PixelData holds no fragments", label);
failed:
    free(stream);
    return NULL;
}

static bool decode_rle(const uint8_t *stream, size_t length, const ang_dicom_slice *slice, uint16_t *out, bool *masked,
                       const char *label, ang_error *err) {
    ang_dicom_words words = ang_dicom_words_of(slice);
    size_t count = (size_t)slice->rows * (size_t)slice->columns;
    uint8_t *raw = ang_alloc(count, (size_t)words.bytes, "a slice", err);
    if (!raw) return false;
    bool ok = ang_dicom_rle(stream, length, count, words.bytes, raw);
    if (ok)
        *masked = ang_dicom_convert(raw, count, words, out);
    else
        ang_fail(err, ANG_INPUT, "%s: (7FE0,0010) PixelData: its run lengths are damaged", label);
    free(raw);
    return ok;
}

static bool decode_stream(const uint8_t *stream, size_t length, const ang_dicom_slice *slice, ang_sandbox *sandbox,
                          uint16_t *out, bool *masked, const char *label, ang_error *err) {
#ifdef ANG_WITH_GDCM
    ang_dicom_stream header;
    if (!ang_dicom_stream_header(stream, length, &header))
        return ang_fail(err, ANG_INPUT, "%s: (7FE0,0010) PixelData is no JPEG, JPEG-LS or JPEG 2000 stream", label);
    if (header.columns != slice->columns || header.rows != slice->rows || header.components != 1)
        return ang_fail(err, ANG_INPUT, "%s: (7FE0,0010) PixelData is %d x %d x %d, the header says %d x %d x 1", label,
                        header.columns, header.rows, header.components, slice->columns, slice->rows);
    if (header.precision < 1 || header.precision > 16)
        return ang_fail(err, ANG_INPUT, "%s: (7FE0,0010) PixelData has %d bits a pixel", label, header.precision);

    if (!ang_dicom_stream_sound(stream, length))
        return ang_fail(err, ANG_INPUT, "%s: (7FE0,0010) PixelData: its JPEG stream is damaged or cut off", label);
    ang_codec_frame frame = {slice->transfer_syntax, slice->columns, slice->rows, header.precision, header.is_signed};
    ang_dicom_words words = ang_dicom_words_of(slice);
    words.bytes = header.precision <= 8 ? 1 : 2;
    words.big_endian = __BYTE_ORDER__ == __ORDER_BIG_ENDIAN__;
    /* The record holds a JPEG 2000 stream's own precision already; other streams may be narrower than the header. */
    if (words.bits_stored > header.precision || words.high_bit >= 8 * words.bytes) {
        words.bits_stored = header.precision;
        words.high_bit = header.precision - 1;
    }
    size_t count = (size_t)slice->rows * (size_t)slice->columns, size = count * (size_t)words.bytes;
    void *raw = words.bytes == 2 ? out : ang_alloc(count, 1, "a slice", err);
    if (!raw) return false;
    ang_error why = {0};
    bool ok = sandbox ? ang_sandbox_decode(sandbox, stream, length, &frame, raw, size, &why)
                      : ang_codec_decode(stream, length, &frame, raw, size, &why);
    if (ok)
        *masked = ang_dicom_convert(raw, count, words, out);
    else
        ang_fail(err, why.code, "%s: %s", label, why.message);
    if (raw != out) free(raw);
    return ok;
#else
    (void)stream, (void)length, (void)sandbox, (void)out, (void)masked;
    return ang_fail(err, ANG_INPUT, "%s: compressed pixels (transfer syntax %s): this build has no GDCM to decode them",
                    label, slice->transfer_syntax);
#endif
}

static bool decode_native(int fd, const ang_dicom_slice *slice, uint16_t *out, bool *masked, const char *label,
                          ang_error *err) {
    ang_dicom_words words = ang_dicom_words_of(slice);
    size_t count = (size_t)slice->rows * (size_t)slice->columns, size = count * (size_t)words.bytes;
    void *raw = words.bytes == 2 ? out : ang_alloc(count, (size_t)words.bytes, "a slice", err);
    if (!raw) return false;
    bool ok = read_all(fd, raw, size, slice->pixel_offset);
    if (ok)
        *masked = ang_dicom_convert(raw, count, words, out);
    else
        ang_fail(err, ANG_INPUT, "%s: (7FE0,0010) PixelData is cut off", label);
    if (raw != out) free(raw);
    return ok;
}

/* Walks to the pixels of a deflated data set anew: keeping them since the header was read would cost a volume. */
static bool decode_deflated(const char *path, const ang_dicom_slice *slice, uint16_t *out, bool *masked,
                            const char *label, ang_error *err) {
    ang_dicom_reader *reader = ang_alloc(1, sizeof *reader, "a file's header", err);
    if (!reader) return false;
    bool ok = ang_dicom_open(reader, path, label, err) == ANG_DICOM_FOUND;
    ang_dicom_words words = ang_dicom_words_of(slice);
    size_t count = (size_t)slice->rows * (size_t)slice->columns, size = count * (size_t)words.bytes;
    if (ok && (!reader->memory || slice->pixel_offset > reader->size || reader->size - slice->pixel_offset < size))
        ok = ang_fail(err, ANG_INPUT, "%s: (7FE0,0010) PixelData is cut off", label);
    if (ok) *masked = ang_dicom_convert(reader->memory + slice->pixel_offset, count, words, out);
    ang_dicom_close(reader);
    free(reader);
    return ok;
}

bool ang_dicom_decode(const char *path, const char *label, const ang_dicom_slice *slice, ang_sandbox *sandbox,
                      uint16_t *out, bool *masked, ang_error *err) {
    bool unasked;
    if (!masked) masked = &unasked;
    *masked = false;
    if (slice->coding == ANG_DICOM_DEFLATED) return decode_deflated(path, slice, out, masked, label, err);
    int fd = open(path, O_RDONLY | O_CLOEXEC);
    if (fd < 0) return ang_fail(err, ANG_INPUT, "%s: %s", label, strerror(errno));
    bool ok;
    if (slice->coding == ANG_DICOM_NATIVE || slice->coding == ANG_DICOM_BIG_ENDIAN) {
        ok = decode_native(fd, slice, out, masked, label, err);
    } else {
        struct stat status;
        size_t length = 0;
        uint64_t size = fstat(fd, &status) == 0 ? (uint64_t)status.st_size : 0;
        uint8_t *stream = read_fragments(fd, slice, size, &length, label, err);
        ok = stream &&
             (slice->coding == ANG_DICOM_RLE ? decode_rle(stream, length, slice, out, masked, label, err)
                                             : decode_stream(stream, length, slice, sandbox, out, masked, label, err));
        free(stream);
    }
    close(fd);
    return ok;
}
