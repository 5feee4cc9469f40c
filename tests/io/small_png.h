/* Small PNG files, written here chunk by chunk. Define FOLDER before including this. */
#ifndef ANG_TESTS_IO_SMALL_PNG_H
#define ANG_TESTS_IO_SMALL_PNG_H

#include "tests/io/loading.h"

static inline void put_chunk(FILE *out, const char *type, const uint8_t *data, size_t size) {
    uint8_t head[8] = {(uint8_t)(size >> 24), (uint8_t)(size >> 16), (uint8_t)(size >> 8), (uint8_t)size};
    memcpy(head + 4, type, 4);
    uLong crc = crc32(crc32(0, head + 4, 4), data, (uInt)size);
    uint8_t tail[4] = {(uint8_t)(crc >> 24), (uint8_t)(crc >> 16), (uint8_t)(crc >> 8), (uint8_t)crc};
    fwrite(head, 1, 8, out);
    fwrite(data, 1, size, out);
    fwrite(tail, 1, 4, out);
}

/* A PNG (ISO 15948) of `bits` a sample and 1 or 3 channels; `samples` big endian, rows from the top. */
static inline void write_png(const char *path, int wide, int high, int bits, int channels, const uint8_t *samples) {
    uint8_t header[13] = {0, 0, 0, (uint8_t)wide, 0, 0, 0, (uint8_t)high, (uint8_t)bits, channels == 3 ? 2 : 0};
    size_t row = (size_t)(wide * channels * bits / 8);
    uint8_t raw[4096], packed[4096];
    uLongf size = sizeof packed;
    for (int y = 0; y < high; y++) {
        raw[(row + 1) * (size_t)y] = 0; /* no filter */
        memcpy(raw + (row + 1) * (size_t)y + 1, samples + row * (size_t)y, row);
    }
    assert_int_equal(compress(packed, &size, raw, (row + 1) * (size_t)high), Z_OK);
    FILE *out = fopen(path, "wb");
    assert_non_null(out);
    fwrite("\x89PNG\r\n\x1A\n", 1, 8, out);
    put_chunk(out, "IHDR", header, sizeof header);
    put_chunk(out, "IDAT", packed, size);
    put_chunk(out, "IEND", header, 0);
    fclose(out);
}

#endif
