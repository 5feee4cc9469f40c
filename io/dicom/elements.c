#include "io/dicom/elements.h"

#include <stdlib.h>
#include <string.h>
#include <sys/random.h>

static void append(ang_dicom_elements *to, const void *bytes, size_t size) {
    if (to->failed || size == 0) return;
    if (size > to->room - to->size) {
        size_t room = 2 * to->room + size;
        unsigned char *grown = realloc(to->data, room);
        if (!grown) {
            to->failed = true;
            return;
        }
        to->data = grown;
        to->room = room;
    }
    memcpy(to->data + to->size, bytes, size);
    to->size += size;
}

static void append_number(ang_dicom_elements *to, uint32_t value, size_t size) {
    const unsigned char bytes[4] = {(unsigned char)value, (unsigned char)(value >> 8), (unsigned char)(value >> 16),
                                    (unsigned char)(value >> 24)};
    append(to, bytes, size);
}

static void append_tag(ang_dicom_elements *to, uint32_t tag) {
    append_number(to, tag >> 16, 2);
    append_number(to, tag & 0xFFFF, 2);
}

/* Tag, VR and a length of four bytes. */
static void append_long(ang_dicom_elements *to, uint32_t tag, const char *vr, size_t size) {
    if (size > 0xFFFFFFFEu) to->failed = true;
    append_tag(to, tag);
    append(to, vr, 2);
    append_number(to, 0, 2);
    append_number(to, (uint32_t)size, 4);
}

void ang_elements_text(ang_dicom_elements *to, uint32_t tag, const char *vr, const char *value) {
    size_t length = strlen(value);
    if (length > 65534) length = 65534;
    append_tag(to, tag);
    append(to, vr, 2);
    append_number(to, (uint32_t)(length + length % 2), 2);
    append(to, value, length);
    if (length % 2) append(to, strcmp(vr, "UI") == 0 ? "" : " ", 1);
}

void ang_elements_short(ang_dicom_elements *to, uint32_t tag, unsigned value) {
    append_tag(to, tag);
    append(to, "US", 2);
    append_number(to, 2, 2);
    append_number(to, value, 2);
}

void ang_elements_bytes(ang_dicom_elements *to, uint32_t tag, const void *bytes, size_t size) {
    append_long(to, tag, "OB", size + size % 2);
    append(to, bytes, size);
    if (size % 2) append(to, "", 1);
}

void ang_elements_sequence(ang_dicom_elements *to, uint32_t tag, const ang_dicom_elements *item) {
    to->failed = to->failed || item->failed;
    append_long(to, tag, "SQ", item->size + 8);
    append_tag(to, 0xFFFEE000);
    append_number(to, (uint32_t)item->size, 4);
    append(to, item->data, item->size);
}

void ang_elements_file(ang_dicom_elements *to, const char *sop_class, const char *sop_instance,
                       const ang_dicom_elements *data_set) {
    static const unsigned char preamble[128] = {0};
    ang_dicom_elements meta = {0};
    append_long(&meta, 0x00020001, "OB", 2);
    append(&meta, "\0\1", 2);
    ang_elements_text(&meta, 0x00020002, "UI", sop_class);
    ang_elements_text(&meta, 0x00020003, "UI", sop_instance);
    ang_elements_text(&meta, 0x00020010, "UI", "1.2.840.10008.1.2.1");
    ang_elements_text(&meta, 0x00020012, "UI", "2.25.130369335850744569636550958233727398062"); /* ours, made once */
    ang_elements_text(&meta, 0x00020013, "SH", "ANGIOSCOPE");
    append(to, preamble, sizeof preamble);
    append(to, "DICM", 4);
    append_tag(to, 0x00020000);
    append(to, "UL", 2);
    append_number(to, 4, 2);
    append_number(to, (uint32_t)meta.size, 4);
    append(to, meta.data, meta.size);
    append(to, data_set->data, data_set->size);
    to->failed = to->failed || meta.failed || data_set->failed;
    free(meta.data);
}

void ang_dicom_uuid_uid(unsigned char bytes[16], int version, char uid[65]) {
    bytes[6] = (unsigned char)((bytes[6] & 0x0F) | version << 4);
    bytes[8] = (unsigned char)((bytes[8] & 0x3F) | 0x80);
    char digits[40];
    int count = 0;
    for (bool rest = true; rest;) {
        unsigned carried = 0;
        rest = false;
        for (int i = 0; i < 16; i++) {
            carried = carried << 8 | bytes[i];
            bytes[i] = (unsigned char)(carried / 10);
            carried %= 10;
            rest = rest || bytes[i];
        }
        digits[count++] = (char)('0' + carried);
    }
    memcpy(uid, "2.25.", 5);
    for (int i = 0; i < count; i++) uid[5 + i] = digits[count - 1 - i];
    uid[5 + count] = '\0';
}

bool ang_dicom_random_uid(char uid[65]) {
    unsigned char bytes[16];
    if (getrandom(bytes, sizeof bytes, 0) != (ssize_t)sizeof bytes) return false;
    ang_dicom_uuid_uid(bytes, 4, uid);
    return true;
}
