/* Elements in both codings and sequences, for files of tests. Define FOLDER before including this. */
#ifndef ANG_TESTS_IO_DICOM_SEQUENCES_H
#define ANG_TESTS_IO_DICOM_SEQUENCES_H

#include "tests/io/small_dicom.h"

static bool implicit; /* how add() and sequences are coded */

static inline void raw(dicom_file *f, const void *bytes, size_t length) {
    assert_true(f->size + length <= sizeof f->bytes);
    memcpy(f->bytes + f->size, bytes, length);
    f->size += length;
}

static inline void raw32(dicom_file *f, uint32_t value) {
    uint8_t bytes[4] = {(uint8_t)value, (uint8_t)(value >> 8), (uint8_t)(value >> 16), (uint8_t)(value >> 24)};
    raw(f, bytes, 4);
}

static inline void tag(dicom_file *f, uint16_t group, uint16_t element) { raw32(f, (uint32_t)element << 16 | group); }

/* An element as the file's coding has it. */
static inline void add(dicom_file *f, uint16_t group, uint16_t element, const char *vr, const void *value,
                       size_t length) {
    if (!implicit) {
        put(f, group, element, vr, value, length);
        return;
    }
    tag(f, group, element);
    raw32(f, (uint32_t)(length + length % 2));
    raw(f, value, length);
    if (length % 2) raw(f, " ", 1);
}

static inline void add_text(dicom_file *f, uint16_t group, uint16_t element, const char *vr, const char *text) {
    add(f, group, element, vr, text, strlen(text));
}

static inline void add_word(dicom_file *f, uint16_t group, uint16_t element, int value) {
    add(f, group, element, "US", (uint8_t[]){(uint8_t)value, (uint8_t)(value >> 8)}, 2);
}

static inline void add_long(dicom_file *f, uint16_t group, uint16_t element, uint32_t value) {
    add(f, group, element, "UL",
        (uint8_t[]){(uint8_t)value, (uint8_t)(value >> 8), (uint8_t)(value >> 16), (uint8_t)(value >> 24)}, 4);
}

/* Opens a sequence, returns where its length stands. Lengths are undefined until close_length() writes them. */
static inline size_t open_sequence(dicom_file *f, uint16_t group, uint16_t element) {
    tag(f, group, element);
    if (!implicit) raw(f, "SQ\0\0", 4);
    raw32(f, 0xFFFFFFFFu);
    return f->size - 4;
}

static inline size_t open_item(dicom_file *f) {
    tag(f, 0xFFFE, 0xE000);
    raw32(f, 0xFFFFFFFFu);
    return f->size - 4;
}

static inline void close_length(dicom_file *f, size_t at, uint16_t delimiter, bool defined) {
    uint32_t length = (uint32_t)(f->size - at - 4);
    if (!defined) {
        tag(f, 0xFFFE, delimiter);
        raw32(f, 0);
        return;
    }
    for (int i = 0; i < 4; i++) f->bytes[at + (size_t)i] = (uint8_t)(length >> (8 * i));
}

#endif
