#include "io/dicom/parse.h"

#include "core/base/memory.h"
#include "io/dicom/bytes.h"

#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>
#include <zlib.h>

enum { max_depth = 32 };

const uint8_t *ang_dicom_bytes(ang_dicom_reader *reader, uint64_t offset, size_t length) {
    if (length > ang_dicom_value_size || offset > reader->size || reader->size - offset < length) return NULL;
    if (reader->memory) return reader->memory + offset;
    if (offset < reader->window_at || offset - reader->window_at + length > reader->window_length) {
        reader->window_at = offset;
        reader->window_length = 0;
        while (reader->window_length < ang_dicom_window_size) {
            ssize_t got = pread(reader->fd, reader->window + reader->window_length,
                                ang_dicom_window_size - reader->window_length, (off_t)(offset + reader->window_length));
            if (got < 0 && errno == EINTR) continue;
            if (got <= 0) break;
            reader->window_length += (size_t)got;
        }
        if (reader->window_length < length) return NULL;
    }
    return reader->window + (offset - reader->window_at);
}

static bool is_vr(const uint8_t *p) { return p[0] >= 'A' && p[0] <= 'Z' && p[1] >= 'A' && p[1] <= 'Z'; }

static bool one_of(const uint8_t *vr, const char *list) {
    for (; *list; list += 2) {
        if (memcmp(vr, list, 2) == 0) return true;
    }
    return false;
}

/* PS3.5 7.1.2: these have two length bytes; every other VR, future ones too, has two reserved bytes and four. */
static bool is_short_vr(const uint8_t *vr) { return one_of(vr, "AEASATCSDADSDTFLFDISLOLTPNSHSLSSSTTMUIULUS"); }

/* The head of the element at reader->next, whose value starts at element->offset. */
static bool read_head(ang_dicom_reader *reader, bool is_explicit, bool big, uint64_t at, ang_dicom_element *element) {
    const uint8_t *p = ang_dicom_bytes(reader, at, 8);
    if (!p) return false;
    element->tag = ANG_DICOM_TAG(get16(p, big), get16(p + 2, big));
    element->vr[0] = 0;
    element->big_endian = big;
    element->offset = at + 8;
    element->length = get32(p + 4, big);
    if (element->tag >> 16 == 0xFFFE) return true;
    if (!is_explicit || !is_vr(p + 4)) return true;
    memcpy(element->vr, p + 4, 2);
    element->vr[2] = 0;
    if (is_short_vr(p + 4)) {
        element->length = get16(p + 6, big);
        return true;
    }
    p = ang_dicom_bytes(reader, at + 8, 4);
    if (!p) return false;
    element->length = get32(p, big);
    element->offset = at + 12;
    return true;
}

static uint64_t skip_sequence(ang_dicom_reader *reader, uint64_t at, bool is_explicit, bool big, int depth);

/* Steps over the elements of an item of undefined length; returns the offset behind its delimiter, or 0. */
static uint64_t skip_item(ang_dicom_reader *reader, uint64_t at, bool is_explicit, bool big, int depth) {
    for (;;) {
        ang_dicom_element inner;
        if (!read_head(reader, is_explicit, big, at, &inner)) return 0;
        at = inner.offset;
        if (inner.tag == ANG_DICOM_TAG(0xFFFE, 0xE00D)) return at;
        if (inner.length == ANG_DICOM_UNDEFINED) {
            bool unknown = strcmp(inner.vr, "UN") == 0; /* PS3.5 6.2.2: implicit little endian inside */
            at = skip_sequence(reader, at, is_explicit && !unknown, big && !unknown, depth + 1);
            if (!at) return 0;
        } else {
            if (inner.length > reader->size - at) return 0;
            at += inner.length;
        }
    }
}

/* Steps over the items of a sequence of undefined length; returns the offset behind its delimiter, or 0. */
static uint64_t skip_sequence(ang_dicom_reader *reader, uint64_t at, bool is_explicit, bool big, int depth) {
    if (depth > max_depth) return 0;
    for (;;) {
        ang_dicom_element item;
        if (!read_head(reader, is_explicit, big, at, &item)) return 0;
        at = item.offset;
        if (item.tag == ANG_DICOM_TAG(0xFFFE, 0xE0DD)) return at;
        if (item.tag != ANG_DICOM_TAG(0xFFFE, 0xE000)) return 0;
        if (item.length == ANG_DICOM_UNDEFINED) {
            at = skip_item(reader, at, is_explicit, big, depth);
            if (!at) return 0;
        } else {
            if (item.length > reader->size - at) return 0;
            at += item.length;
        }
    }
}

bool ang_dicom_next(ang_dicom_reader *reader, ang_dicom_element *element) {
    bool is_explicit = reader->in_meta || reader->is_explicit, big = !reader->in_meta && reader->big_endian;
    for (;;) {
        if (reader->next >= reader->size) return false;
        if (!read_head(reader, is_explicit, big, reader->next, element)) {
            reader->truncated = reader->size - reader->next >= 8;
            return false;
        }
        if (element->tag >> 16 != 0xFFFE) break;
        reader->next = element->offset; /* a stray delimiter */
    }
    if (element->tag == ANG_DICOM_TAG(0x7FE0, 0x0010) || element->tag == ANG_DICOM_TAG(0x7FE0, 0x0008) ||
        element->tag == ANG_DICOM_TAG(0x7FE0, 0x0009)) {
        reader->next = reader->size; /* the pixels end what the rules need */
        return true;
    }
    if (element->length == ANG_DICOM_UNDEFINED) {
        bool unknown = strcmp(element->vr, "UN") == 0;
        uint64_t after = skip_sequence(reader, element->offset, is_explicit && !unknown, big && !unknown, 0);
        if (!after) {
            reader->truncated = true;
            reader->next = reader->size;
            return false;
        }
        reader->next = after;
    } else if (element->length > reader->size - element->offset) {
        reader->truncated = true;
        reader->next = reader->size;
        return false;
    } else {
        reader->next = element->offset + element->length;
    }
    return true;
}

ang_dicom_range ang_dicom_sequence(const ang_dicom_reader *reader, const ang_dicom_element *element) {
    bool unknown = strcmp(element->vr, "UN") == 0;
    bool whole = element->length != ANG_DICOM_UNDEFINED && element->length <= reader->size - element->offset;
    return (ang_dicom_range){.next = element->offset,
                             .end = whole ? element->offset + element->length : reader->size,
                             .is_explicit = element->vr[0] && !unknown,
                             .big_endian = element->big_endian && !unknown};
}

bool ang_dicom_next_item(ang_dicom_reader *reader, ang_dicom_range *sequence, ang_dicom_range *item) {
    ang_dicom_element head;
    if (sequence->next >= sequence->end ||
        !read_head(reader, sequence->is_explicit, sequence->big_endian, sequence->next, &head) ||
        head.tag != ANG_DICOM_TAG(0xFFFE, 0xE000))
        return false;
    *item = *sequence;
    item->next = head.offset;
    if (head.length != ANG_DICOM_UNDEFINED) {
        if (head.length > sequence->end - head.offset) return false;
        item->end = sequence->next = head.offset + head.length;
        return true;
    }
    uint64_t after = skip_item(reader, head.offset, sequence->is_explicit, sequence->big_endian, 0);
    if (!after || after > sequence->end) return false;
    sequence->next = item->end = after;
    return true;
}

bool ang_dicom_next_in(ang_dicom_reader *reader, ang_dicom_range *range, ang_dicom_element *element) {
    if (range->next >= range->end || !read_head(reader, range->is_explicit, range->big_endian, range->next, element) ||
        element->tag >> 16 == 0xFFFE)
        return false;
    if (element->length == ANG_DICOM_UNDEFINED) {
        bool unknown = strcmp(element->vr, "UN") == 0;
        range->next =
            skip_sequence(reader, element->offset, range->is_explicit && !unknown, range->big_endian && !unknown, 0);
        return range->next != 0 && range->next <= range->end;
    }
    if (element->length > range->end - element->offset) return false;
    range->next = element->offset + element->length;
    return true;
}

/* Whether a data set may start at `at`: a tag of group 2 or 8 with a length that fits, then another, greater tag. */
static bool plausible(ang_dicom_reader *reader, uint64_t at, bool is_explicit, bool big) {
    uint32_t last = 0;
    for (int i = 0; i < 3; i++) {
        ang_dicom_element element;
        if (at == reader->size && i > 0) return true;
        if (!read_head(reader, is_explicit, big, at, &element)) return false;
        uint32_t group = element.tag >> 16;
        if (i == 0 && group != 0x0002 && group != 0x0008) return false;
        if (element.tag <= last || (is_explicit && !element.vr[0])) return false;
        if (element.length == ANG_DICOM_UNDEFINED) return i > 0;
        if (element.length > reader->size - element.offset) return false;
        last = element.tag;
        at = element.offset + element.length;
    }
    return true;
}

/* Finds explicit or implicit VR and the byte order by looking (no transfer syntax, or a wrong one). */
static bool guess_coding(ang_dicom_reader *reader) {
    for (int i = 0; i < 4; i++) {
        bool is_explicit = i % 2 == 0, big = i / 2 == 1;
        if (!plausible(reader, reader->next, is_explicit, big)) continue;
        reader->is_explicit = is_explicit;
        reader->big_endian = big;
        return true;
    }
    return false;
}

static void read_meta(ang_dicom_reader *reader) {
    reader->in_meta = true;
    for (;;) {
        uint64_t at = reader->next;
        const uint8_t *p = ang_dicom_bytes(reader, at, 8);
        ang_dicom_element element;
        if (!p || get16(p, false) != 2 || !ang_dicom_next(reader, &element)) break;
        if (element.tag == ANG_DICOM_TAG(2, 0x0002))
            ang_dicom_text(reader, &element, reader->media_class, sizeof reader->media_class);
        if (element.tag == ANG_DICOM_TAG(2, 0x0010))
            ang_dicom_text(reader, &element, reader->transfer_syntax, sizeof reader->transfer_syntax);
    }
    reader->in_meta = false;
}

ang_dicom_found ang_dicom_open_meta(ang_dicom_reader *reader, const char *path, const char *label, ang_error *err) {
    reader->memory = NULL;
    reader->size = reader->next = reader->window_at = 0;
    reader->window_length = 0;
    reader->big_endian = reader->in_meta = reader->truncated = reader->overruled = false;
    reader->is_explicit = true;
    reader->transfer_syntax[0] = reader->media_class[0] = 0;
    reader->fd = open(path, O_RDONLY | O_CLOEXEC | O_NONBLOCK);
    struct stat status;
    if (reader->fd < 0 || fstat(reader->fd, &status) != 0) {
        ang_fail(err, ANG_INPUT, "%s: %s", label, strerror(errno));
        return ANG_DICOM_BROKEN;
    }
    if (!S_ISREG(status.st_mode)) return ANG_DICOM_FOREIGN;
    reader->size = (uint64_t)status.st_size;

    const uint8_t *magic = ang_dicom_bytes(reader, 128, 4);
    bool has_magic = magic && memcmp(magic, "DICM", 4) == 0;
    if (has_magic) reader->next = 132;
    const uint8_t *start = has_magic ? NULL : ang_dicom_bytes(reader, 0, 4);
    if (start && memcmp(start, "DICM", 4) == 0) { /* the preamble is missing, its magic is not */
        has_magic = true;
        reader->next = 4;
    }
    const uint8_t *first = ang_dicom_bytes(reader, reader->next, 8);
    if (!first) {
        if (!has_magic) return ANG_DICOM_FOREIGN;
        ang_fail(err, ANG_INPUT, "%s: ends after its DICOM preamble", label);
        return ANG_DICOM_BROKEN;
    }
    if (!has_magic && !guess_coding(reader)) return ANG_DICOM_FOREIGN;
    if (get16(first, false) == 2) read_meta(reader);
    return ANG_DICOM_FOUND;
}

ang_dicom_found ang_dicom_open(ang_dicom_reader *reader, const char *path, const char *label, ang_error *err) {
    ang_dicom_found found = ang_dicom_open_meta(reader, path, label, err);
    if (found != ANG_DICOM_FOUND) return found;
    const char *syntax = reader->transfer_syntax;
    if (strcmp(syntax, "1.2.840.10008.1.2.1.99") == 0) {
        uint64_t size;
        uint8_t *memory = ang_dicom_inflate(reader->fd, reader->next, reader->size, &size, label, err);
        if (!memory) return ANG_DICOM_BROKEN;
        reader->memory = memory;
        reader->size = size;
        reader->next = 0;
    }
    bool big = strcmp(syntax, "1.2.840.10008.1.2.2") == 0, implicit = strcmp(syntax, "1.2.840.10008.1.2") == 0;
    /* Where neither the transfer syntax nor a guess fits an odd first element, what the syntax says stands. */
    if ((syntax[0] && plausible(reader, reader->next, !implicit, big)) || !guess_coding(reader)) {
        reader->is_explicit = !implicit;
        reader->big_endian = big;
    }
    reader->overruled = syntax[0] && (reader->is_explicit == implicit || reader->big_endian != big);
    return ANG_DICOM_FOUND;
}

void ang_dicom_close(ang_dicom_reader *reader) {
    if (reader->fd >= 0) close(reader->fd);
    free(reader->memory);
    reader->fd = -1;
    reader->memory = NULL;
}

uint8_t *ang_dicom_inflate(int fd, uint64_t offset, uint64_t file_size, uint64_t *size, const char *label,
                           ang_error *err) {
    enum { chunk = 65536 };
    uint64_t limit = UINT64_C(1) << 28; /* 256 MB: no slice is as large */
    uint8_t *in = ang_alloc(chunk, 1, "compressed bytes", err), *out = NULL;
    if (!in) return NULL;
    z_stream stream = {0};
    bool ok = inflateInit2(&stream, -MAX_WBITS) == Z_OK;
    uint64_t capacity = 0, length = 0;
    int state = Z_OK;
    while (ok && state == Z_OK) {
        if (stream.avail_in == 0) {
            ssize_t got = offset < file_size ? pread(fd, in, chunk, (off_t)offset) : 0;
            if (got <= 0) break;
            offset += (uint64_t)got;
            stream.next_in = in;
            stream.avail_in = (uInt)got;
        }
        if (length == capacity) {
            capacity = capacity ? capacity * 2 : 4 * chunk;
            uint8_t *grown = capacity <= limit ? realloc(out, capacity) : NULL;
            if (!grown) {
                ang_fail(err, ANG_LIMIT, "%s: its deflated data set is too large", label);
                ok = false;
                break;
            }
            out = grown;
        }
        stream.next_out = out + length;
        stream.avail_out = (uInt)(capacity - length);
        state = inflate(&stream, Z_NO_FLUSH);
        length = capacity - stream.avail_out;
    }
    inflateEnd(&stream);
    free(in);
    if (ok && state != Z_STREAM_END && state != Z_OK) {
        ang_fail(err, ANG_INPUT, "%s: its deflated data set is damaged", label);
        ok = false;
    }
    if (ok && length == 0) {
        ang_fail(err, ANG_INPUT, "%s: its deflated data set is empty", label);
        ok = false;
    }
    if (!ok) {
        free(out);
        return NULL;
    }
    *size = length;
    return out;
}
