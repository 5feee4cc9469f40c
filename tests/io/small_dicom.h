/* Small DICOM files for tests of loading. Define FOLDER, where they are written, before including this. */
#ifndef ANG_TESTS_IO_SMALL_DICOM_H
#define ANG_TESTS_IO_SMALL_DICOM_H

#include "tests/io/loading.h"

typedef struct dicom_file {
    uint8_t bytes[8192];
    size_t size;
} dicom_file;

static inline void put(dicom_file *f, uint16_t group, uint16_t element, const char *vr, const void *value,
                       size_t length) {
    uint8_t head[12] = {(uint8_t)group,          (uint8_t)(group >> 8), (uint8_t)element,
                        (uint8_t)(element >> 8), (uint8_t)vr[0],        (uint8_t)vr[1]};
    size_t padded = length + length % 2, head_size = 8;
    if (vr[0] == 'O') {
        head[8] = (uint8_t)padded;
        head[9] = (uint8_t)(padded >> 8);
        head_size = 12;
    } else {
        head[6] = (uint8_t)padded;
        head[7] = (uint8_t)(padded >> 8);
    }
    memcpy(f->bytes + f->size, head, head_size);
    f->size += head_size;
    memcpy(f->bytes + f->size, value, length);
    if (length % 2) f->bytes[f->size + length] = ' ';
    f->size += padded;
}

static inline void put_text(dicom_file *f, uint16_t group, uint16_t element, const char *vr, const char *text) {
    put(f, group, element, vr, text, strlen(text));
}

static inline void put_word(dicom_file *f, uint16_t group, uint16_t element, int value) {
    uint8_t bytes[2] = {(uint8_t)value, (uint8_t)(value >> 8)};
    put(f, group, element, "US", bytes, 2);
}

/* PixelData of one fragment behind an empty offset table (PS3.5 A.4). */
static inline void put_stream(dicom_file *f, const uint8_t *stream, size_t length) {
    uint8_t head[28] = {0xE0, 0x7F, 0x10, 0, 'O', 'B', 0, 0, 0xFF, 0xFF, 0xFF, 0xFF, 0xFE, 0xFF, 0, 0xE0, 0, 0, 0, 0};
    static const uint8_t item[4] = {0xFE, 0xFF, 0, 0xE0}, end[8] = {0xFE, 0xFF, 0xDD, 0xE0};
    memcpy(head + 20, item, sizeof item);
    for (int i = 0; i < 4; i++) head[24 + i] = (uint8_t)(length >> 8 * i);
    memcpy(f->bytes + f->size, head, sizeof head);
    memcpy(f->bytes + f->size + sizeof head, stream, length);
    memcpy(f->bytes + f->size + sizeof head + length, end, sizeof end);
    f->size += sizeof head + length + sizeof end;
}

enum { width = 5, height = 3 };

/* What small() writes; zero means the usual. */
typedef struct form {
    double z;
    int instance;
    const char *slope, *intercept, *photometric, *spacing;
    const char *position, *orientation, *modality, *image_type, *sop_class, *character_set, *description, *patient;
    bool no_rows, is_signed, has_padding, cut, no_position, no_orientation;
    bool damaged; /* the header is sound, the (compressed) pixels are not */
    bool no_image;
    const uint8_t *stream; /* compressed pixels; NULL: `pixels` as they are */
    size_t stream_length;  /* even */
    int padding;
    const char *transfer_syntax; /* of `stream`; without one, which it is said to have: explicit VR, little endian */
    const char *trigger_time, *patient_id, *series_uid, *padding_vr;
    int temporal_position;                  /* 0: none */
    int columns, rows, bits_stored, frames; /* 0: width, height, 16, one */
    uint16_t pixels[width * height];
} form;

static inline void write_small(const char *name, const dicom_file *f, size_t cut) {
    char path[512];
    snprintf(path, sizeof path, FOLDER "/%s", name);
    FILE *out = fopen(path, "wb");
    assert_non_null(out);
    fwrite(f->bytes, 1, f->size - cut, out);
    fclose(out);
}

static inline void small(const char *name, const form *form) {
    dicom_file f = {.size = 132};
    memcpy(f.bytes + 128, "DICM", 4);
    char text[64];
    put_text(&f, 2, 0x10, "UI",
             form->damaged           ? "1.2.840.10008.1.2.5"
             : form->transfer_syntax ? form->transfer_syntax
                                     : "1.2.840.10008.1.2.1");
    if (form->character_set) put_text(&f, 8, 0x05, "CS", form->character_set);
    put_text(&f, 8, 0x08, "CS", form->image_type ? form->image_type : "ORIGINAL\\PRIMARY\\AXIAL");
    put_text(&f, 8, 0x16, "UI", form->sop_class ? form->sop_class : "1.2.840.10008.5.1.4.1.1.2");
    put_text(&f, 8, 0x60, "CS", form->modality ? form->modality : "CT");
    put_text(&f, 8, 0x103E, "LO", form->description ? form->description : "JOHN DOE HEAD");
    put_text(&f, 0x10, 0x10, "PN", form->patient ? form->patient : "DOE^MARY");
    if (form->patient_id) put_text(&f, 0x10, 0x20, "LO", form->patient_id);
    if (form->trigger_time) put_text(&f, 0x18, 0x1060, "DS", form->trigger_time);
    put_text(&f, 0x20, 0x0E, "UI", form->series_uid ? form->series_uid : "1.2.3.4");
    snprintf(text, sizeof text, "%d", form->instance);
    put_text(&f, 0x20, 0x13, "IS", text);
    snprintf(text, sizeof text, "-1\\-2\\%g", form->z);
    if (!form->no_position) put_text(&f, 0x20, 0x32, "DS", form->position ? form->position : text);
    if (!form->no_orientation)
        put_text(&f, 0x20, 0x37, "DS", form->orientation ? form->orientation : "1\\0\\0\\0\\1\\0");
    snprintf(text, sizeof text, "%d", form->temporal_position);
    if (form->temporal_position) put_text(&f, 0x20, 0x100, "IS", text);
    if (form->no_image) {
        write_small(name, &f, 0);
        return;
    }
    put_text(&f, 0x28, 0x04, "CS", form->photometric ? form->photometric : "MONOCHROME2");
    snprintf(text, sizeof text, "%d", form->frames);
    if (form->frames) put_text(&f, 0x28, 0x08, "IS", text);
    int columns = form->columns ? form->columns : width, rows = form->rows ? form->rows : height;
    if (!form->no_rows) put_word(&f, 0x28, 0x10, rows);
    put_word(&f, 0x28, 0x11, columns);
    put_text(&f, 0x28, 0x30, "DS", form->spacing ? form->spacing : "0.5\\0.25");
    put_word(&f, 0x28, 0x100, 16);
    put_word(&f, 0x28, 0x101, form->bits_stored ? form->bits_stored : 16);
    put_word(&f, 0x28, 0x102, form->bits_stored ? form->bits_stored - 1 : 15);
    put_word(&f, 0x28, 0x103, form->is_signed);
    uint8_t padding[2] = {(uint8_t)form->padding, (uint8_t)(form->padding >> 8)};
    if (form->has_padding) put(&f, 0x28, 0x120, form->padding_vr ? form->padding_vr : "US", padding, 2);
    put_text(&f, 0x28, 0x1052, "DS", form->intercept ? form->intercept : "-1024");
    put_text(&f, 0x28, 0x1053, "DS", form->slope ? form->slope : "1");
    uint8_t pixels[2 * width * height];
    for (int i = 0; i < width * height; i++) {
        pixels[2 * i] = (uint8_t)form->pixels[i];
        pixels[2 * i + 1] = (uint8_t)(form->pixels[i] >> 8);
    }
    if (form->damaged) {
        /* An empty offset table and one fragment, whose run lengths claim a segment that is not there. */
        static const uint8_t damaged[] = {0xE0, 0x7F, 0x10, 0,    'O',  'B',  0,    0, 0xFF, 0xFF, 0xFF,
                                          0xFF, 0xFE, 0xFF, 0,    0xE0, 0,    0,    0, 0,    0xFE, 0xFF,
                                          0,    0xE0, 8,    0,    0,    0,    9,    9, 9,    9,    9,
                                          9,    9,    9,    0xFE, 0xFF, 0xDD, 0xE0, 0, 0,    0,    0};
        memcpy(f.bytes + f.size, damaged, sizeof damaged);
        f.size += sizeof damaged;
    } else if (form->stream) {
        put_stream(&f, form->stream, form->stream_length);
    } else {
        put(&f, 0x7FE0, 0x10, "OW", pixels, 2 * (size_t)columns * (size_t)rows);
    }
    write_small(name, &f, form->cut ? 7 : 0);
}

static inline form form_at(double z, int value) {
    form f = {.z = z, .instance = (int)z};
    for (int i = 0; i < width * height; i++) f.pixels[i] = (uint16_t)(value + i);
    return f;
}

static inline double hu_at(const ang_volume *v, int x, int y, int z) {
    size_t i = ((size_t)z * (size_t)v->dims[1] + (size_t)y) * (size_t)v->dims[0] + (size_t)x;
    return ang_volume_hu(v, v->data[i]);
}

#endif
