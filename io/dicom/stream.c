#include "io/dicom/stream.h"

#include <string.h>

static uint32_t big32(const uint8_t *p) {
    return (uint32_t)p[0] << 24 | (uint32_t)p[1] << 16 | (uint32_t)p[2] << 8 | p[3];
}

/* SIZ of JPEG 2000 (ISO 15444-1 A.5.1), which follows SOC. */
static bool read_siz(const uint8_t *p, size_t length, ang_dicom_stream *out) {
    if (length < 44 || p[0] != 0xFF || p[1] != 0x4F || p[2] != 0xFF || p[3] != 0x51) return false;
    uint32_t width = big32(p + 8), height = big32(p + 12), left = big32(p + 16), top = big32(p + 20);
    if (width <= left || height <= top || width - left > 65535 || height - top > 65535) return false;
    *out = (ang_dicom_stream){.columns = (int)(width - left),
                              .rows = (int)(height - top),
                              .components = p[40] << 8 | p[41],
                              .precision = (p[42] & 0x7F) + 1,
                              .is_signed = p[42] >> 7,
                              .jpeg2000 = true};
    return true;
}

/* Start of frame: all of ISO 10918-1, and JPEG-LS (ISO 14495-1). */
static bool is_frame(int marker) {
    return (marker >= 0xC0 && marker <= 0xCF && marker != 0xC4 && marker != 0xC8 && marker != 0xCC) || marker == 0xF7;
}

bool ang_dicom_stream_header(const uint8_t *stream, size_t length, ang_dicom_stream *out) {
    if (length < 12) return false;
    if (read_siz(stream, length, out)) return true;
    if (memcmp(stream + 4, "jP  ", 4) == 0) { /* boxes of a JP2 file around the code stream, against PS3.5 A.4.4 */
        for (size_t at = 0; length - at >= 8;) {
            size_t box = big32(stream + at);
            if (memcmp(stream + at + 4, "jp2c", 4) == 0) return read_siz(stream + at + 8, length - at - 8, out);
            if (box < 8 || box > length - at) return false;
            at += box;
        }
        return false;
    }
    if (stream[0] != 0xFF || stream[1] != 0xD8) return false;
    for (size_t at = 2; length - at >= 12;) { /* ISO 10918-1 B.1.1.3: markers until a start of frame */
        if (stream[at] != 0xFF) return false;
        int marker = stream[at + 1];
        if (marker == 0xFF) {
            at++;
            continue;
        }
        if (is_frame(marker)) {
            *out = (ang_dicom_stream){.precision = stream[at + 4],
                                      .rows = stream[at + 5] << 8 | stream[at + 6],
                                      .columns = stream[at + 7] << 8 | stream[at + 8],
                                      .components = stream[at + 9]};
            return true;
        }
        size_t size = (size_t)(stream[at + 2] << 8 | stream[at + 3]);
        if (size < 2 || size + 2 > length - at) return false;
        at += 2 + size;
    }
    return false;
}

/* The offset of the first marker in entropy-coded data from `at` on that is neither stuffing nor a restart; `length`
 * where there is none. JPEG-LS stuffs a bit, not a byte: any value below 0x80 follows 0xFF there. */
static size_t next_marker(const uint8_t *stream, size_t at, size_t length, bool jpeg_ls) {
    while (at + 1 < length) {
        const uint8_t *found = memchr(stream + at, 0xFF, length - 1 - at);
        if (!found) return length;
        at = (size_t)(found - stream);
        int next = stream[at + 1];
        bool data = jpeg_ls ? next < 0x80 : next == 0;
        if (!data && next != 0xFF && !(next >= 0xD0 && next <= 0xD7)) return at;
        at += next == 0xFF ? 1 : 2;
    }
    return length;
}

bool ang_dicom_stream_sound(const uint8_t *stream, size_t length) {
    if (length < 4 || stream[0] != 0xFF || stream[1] != 0xD8) return length >= 4;
    int frame = 0, scans = 0;
    for (size_t at = 2; length - at >= 2;) {
        if (stream[at] != 0xFF) return false;
        int marker = stream[at + 1];
        if (marker == 0xFF) {
            at++;
            continue;
        }
        if (marker == 0xD9) return scans > 0;
        if (marker < 0xC0 || (marker >= 0xD0 && marker <= 0xD8) || length - at < 4) return false;
        size_t size = (size_t)(stream[at + 2] << 8 | stream[at + 3]);
        if (size < 2 || size + 2 > length - at) return false;
        if (is_frame(marker)) {
            if (frame || size != 11) return false; /* one frame, one component */
            frame = marker;
        }
        if (marker == 0xDA) {
            bool many = frame == 0xC2 || frame == 0xC6 || frame == 0xCA || frame == 0xCE; /* progressive */
            if (!frame || size != 8 || stream[at + 4] != 1 || (scans > 0 && !many)) return false;
            scans++;
            at = next_marker(stream, at + 2 + size, length, frame == 0xF7);
        } else {
            at += 2 + size;
        }
    }
    return false;
}
