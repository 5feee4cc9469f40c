#include "io/dicom/fragments.h"

#include "io/dicom/bytes.h"
#include "io/dicom/stream.h"

#include <stdlib.h>
#include <string.h>

/* The length of the item whose head is at `at`; false where there is no item, or one that reaches beyond the end. */
static bool item_at(ang_dicom_reader *reader, uint64_t at, uint32_t *length) {
    const uint8_t *head = ang_dicom_bytes(reader, at, 8);
    if (!head || get16(head, false) != 0xFFFE || get16(head + 2, false) != 0xE000) return false;
    *length = get32(head + 4, false);
    return *length <= reader->size - at - 8;
}

bool ang_dicom_first_fragment(ang_dicom_reader *reader, uint64_t *offset, const char *label, ang_error *err) {
    uint32_t table;
    if (!item_at(reader, *offset, &table))
        return ang_fail(err, ANG_INPUT, "%s: (7FE0,0010) PixelData holds no fragments", label);
    *offset += 8 + table;
    return true;
}

/* The heads of all fragments; start[count] is the end of the last. */
typedef struct fragments {
    uint64_t *start;
    size_t count;
} fragments;

static bool find_fragments(ang_dicom_reader *reader, uint64_t at, fragments *found, const char *label, ang_error *err) {
    size_t capacity = 0;
    uint32_t length = 0;
    for (;;) {
        bool more = item_at(reader, at, &length);
        if (found->count == capacity) {
            capacity = capacity ? 2 * capacity : 256;
            uint64_t *grown = realloc(found->start, capacity * sizeof *grown);
            if (!grown) return ang_fail(err, ANG_LIMIT, "%s: no memory for its list of fragments", label);
            found->start = grown;
        }
        found->start[found->count] = at;
        if (!more) break;
        found->count++;
        at += 8 + (uint64_t)length;
    }
    return found->count > 0 || ang_fail(err, ANG_INPUT, "%s: (7FE0,0010) PixelData holds no fragments", label);
}

static int compare_offsets(const void *left, const void *right) {
    uint64_t a = *(const uint64_t *)left, b = *(const uint64_t *)right;
    return a < b ? -1 : a > b;
}

/* Number of the fragment that starts at `at`; count where none does. */
static size_t fragment_at(const fragments *all, uint64_t at) {
    const uint64_t *found = bsearch(&at, all->start, all->count, sizeof at, compare_offsets);
    return found ? (size_t)(found - all->start) : all->count;
}

/* First fragments of the frames by a table of `bytes` a value at `at`, in `first`; false where it does not hold: each
 * must be a fragment behind the one before, the first the first. */
static bool by_table(ang_dicom_reader *reader, uint64_t at, uint64_t length, size_t bytes, bool big,
                     const fragments *all, size_t *first, size_t frames) {
    if (length != frames * bytes) return false;
    for (size_t i = 0; i < frames; i++) {
        const uint8_t *p = ang_dicom_bytes(reader, at + i * bytes, bytes);
        if (!p) return false;
        uint64_t offset = bytes == 8 ? get64(p, big) : get32(p, big);
        if (offset > reader->size) return false;
        first[i] = fragment_at(all, all->start[0] + offset);
        if (first[i] == all->count || (i == 0 ? first[i] != 0 : first[i] <= first[i - 1])) return false;
    }
    return true;
}

/* Whether a fragment is the beginning of a JPEG, JPEG-LS or JPEG 2000 stream. */
static bool begins_stream(ang_dicom_reader *reader, uint64_t start) {
    const uint8_t *p = ang_dicom_bytes(reader, start + 8, 12);
    return p && (memcmp(p, "\xFF\xD8\xFF", 3) == 0 || memcmp(p, "\xFF\x4F\xFF\x51", 4) == 0 ||
                 memcmp(p + 4, "jP  ", 4) == 0);
}

static bool by_beginnings(ang_dicom_reader *reader, const fragments *all, size_t *first, size_t frames) {
    size_t found = 0;
    if (all->count == frames) {
        for (size_t i = 0; i < frames; i++) first[i] = i;
        return true;
    }
    for (size_t i = 0; i < all->count; i++) {
        if (!begins_stream(reader, all->start[i])) continue;
        if (found == frames || (found == 0 && i > 0)) return false;
        first[found++] = i;
    }
    return found == frames;
}

bool ang_dicom_locate_frames(ang_dicom_reader *reader, const char *label, const ang_dicom_element *extended,
                             ang_dicom_slice *frames, int count, ang_error *err) {
    uint64_t table = frames[0].pixel_offset, at = table;
    uint32_t length = 0;
    fragments all = {0};
    size_t number = (size_t)count, *first = calloc(number, sizeof *first);
    bool ok = first != NULL || ang_fail(err, ANG_LIMIT, "%s: no memory for its frames", label);
    ok = ok && ang_dicom_first_fragment(reader, &at, label, err) && item_at(reader, table, &length) &&
         find_fragments(reader, at, &all, label, err);
    if (ok) {
        bool listed = extended->tag || length > 0;
        bool held = (extended->tag && by_table(reader, extended->offset, extended->length, 8, extended->big_endian,
                                               &all, first, number)) ||
                    (length > 0 && by_table(reader, table + 8, length, 4, false, &all, first, number));
        if (!held && !by_beginnings(reader, &all, first, number))
            ok = ang_fail(err, ANG_INPUT,
                          "%s: (7FE0,0010) PixelData: nothing says which of its %zu fragments belong to which of %d "
                          "frames",
                          label, all.count, count);
        for (size_t i = 0; ok && i < number; i++) {
            uint64_t end = all.start[i + 1 < number ? first[i + 1] : all.count];
            frames[i].pixel_offset = all.start[first[i]];
            frames[i].pixel_length = end - frames[i].pixel_offset;
            frames[i].wrong_offsets = listed && !held;
        }
    }
    free(all.start);
    free(first);
    return ok;
}

void ang_dicom_adopt_jpeg2000(ang_dicom_slice *s, ang_dicom_reader *reader) {
    uint64_t at = s->pixel_offset + 8;
    size_t length = 512;
    if (at >= reader->size) return;
    if (reader->size - at < length) length = (size_t)(reader->size - at);
    const uint8_t *stream = ang_dicom_bytes(reader, at, length);
    ang_dicom_stream header;
    if (!stream || !ang_dicom_stream_header(stream, length, &header) || !header.jpeg2000) return;
    if (header.precision > 16 || header.precision > s->bits_allocated) return;
    s->bits_stored = header.precision;
    s->high_bit = header.precision - 1;
    s->is_signed = s->is_signed || header.is_signed;
}
