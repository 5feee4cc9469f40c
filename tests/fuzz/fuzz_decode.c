/* Compressed pixels of one slice through fragments and codecs. The first byte chooses the transfer syntax, the next two
 * the columns and rows, the fourth the bits; the rest are the fragments of PixelData behind an empty offset table. */
#include "io/dicom/decode.h"
#include "io/dicom/header.h"
#include "tests/fuzz/fuzz.h"

#include <stdlib.h>
#include <string.h>

/* Where codecs run: codec_sandbox.c or codec_direct.c. */
ang_sandbox *fuzz_sandbox(void);

typedef struct file {
    uint8_t *bytes;
    size_t size;
} file;

static void put(file *f, int group, int element, const char *vr, const void *value, size_t length) {
    uint8_t head[8] = {(uint8_t)group, (uint8_t)(group >> 8), (uint8_t)element, (uint8_t)(element >> 8),
                       (uint8_t)vr[0], (uint8_t)vr[1],        (uint8_t)length,  (uint8_t)(length >> 8)};
    memcpy(f->bytes + f->size, head, sizeof head);
    memcpy(f->bytes + f->size + sizeof head, value, length);
    f->size += sizeof head + length;
}

static void put_word(file *f, int element, int value) {
    uint8_t bytes[2] = {(uint8_t)value, (uint8_t)(value >> 8)};
    put(f, 0x28, element, "US", bytes, sizeof bytes);
}

static void put_pixels(file *f, const uint8_t *fragments, size_t length) {
    static const uint8_t head[20] = {0xE0, 0x7F, 0x10, 0,    'O', 'B',  0, 0, 0xFF, 0xFF,
                                     0xFF, 0xFF, 0xFE, 0xFF, 0,   0xE0, 0, 0, 0,    0};
    memcpy(f->bytes + f->size, head, sizeof head);
    memcpy(f->bytes + f->size + sizeof head, fragments, length);
    f->size += sizeof head + length;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    static const char *const endings[] = {"5",    "4.50", "4.51", "4.53", "4.55", "4.57",
                                          "4.70", "4.80", "4.81", "4.90", "4.91", "4.92"};
    if (size < 5) return 0;
    file f = {.bytes = calloc(size + 1024, 1)};
    fuzz_expect(f.bytes != NULL, "no memory");
    f.size = 132;
    memcpy(f.bytes + 128, "DICM", 4);
    char syntax[32] = "1.2.840.10008.1.2.";
    strcat(syntax, endings[data[0] % (sizeof endings / sizeof *endings)]);
    put(&f, 2, 0x10, "UI", syntax, strlen(syntax) + strlen(syntax) % 2);
    put(&f, 8, 0x60, "CS", "CT", 2);
    put_word(&f, 0x02, 1);
    put_word(&f, 0x10, data[2]);
    put_word(&f, 0x11, data[1]);
    put_word(&f, 0x100, data[3] & 0x40 ? 8 : 16);
    put_word(&f, 0x101, 1 + data[3] % 16);
    put_word(&f, 0x102, data[3] % 16);
    put_word(&f, 0x103, data[3] >> 7);
    put_pixels(&f, data + 4, size - 4);

    static ang_dicom_reader reader;
    ang_dicom_slice slice = {0};
    ang_error err = {0};
    const char *path = fuzz_file("a.dcm", f.bytes, f.size);
    free(f.bytes);
    ang_dicom_slice *frames = NULL;
    ang_dicom_found found = ang_dicom_header(path, "a.dcm", &reader, &slice, &frames, &err);
    ang_dicom_close(&reader);
    fuzz_expect(!frames, "frames of one picture");
    if (found != ANG_DICOM_FOUND || slice.refusal[0]) return 0;
    uint16_t *out = malloc((size_t)slice.rows * (size_t)slice.columns * sizeof *out);
    fuzz_expect(out != NULL, "no memory");
    bool ok = ang_dicom_decode(path, "a.dcm", &slice, fuzz_sandbox(), out, NULL, &err);
    fuzz_expect(ok || err.message[0], "refused without a reason");
    free(out);
    return 0;
}
