#include "io/image/portable.h"

#include "core/base/memory.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

/* Room for `width * height * 3` values of `value_size` bytes behind a header; the header is written. */
static unsigned char *begin(const char *magic, const char *scale, int width, int height, size_t value_size,
                            ang_bytes *out, ang_error *err) {
    char header[64];
    int length = snprintf(header, sizeof header, "%s\n%d %d\n%s\n", magic, width, height, scale);
    size_t size = (size_t)width * (size_t)height * 3 * value_size + (size_t)length;
    out->data = ang_alloc(size, 1, "picture", err);
    if (!out->data) return NULL;
    out->size = size;
    memcpy(out->data, header, (size_t)length);
    return out->data + length;
}

bool ang_ppm_encode(int width, int height, const float *rgb, ang_bytes *out, ang_error *err) {
    unsigned char *to = begin("P6", "255", width, height, 1, out, err);
    if (!to) return false;
    size_t count = (size_t)width * (size_t)height * 3;
    for (size_t i = 0; i < count; i++) {
        to[i] = rgb[i] >= 1 ? 255 : rgb[i] > 0 ? (unsigned char)lround(255.0 * (double)rgb[i]) : 0;
    }
    return true;
}

static void put_float(unsigned char *to, float value) {
    uint32_t bits;
    memcpy(&bits, &value, sizeof bits);
    for (int i = 0; i < 4; i++) to[i] = (unsigned char)(bits >> 8 * i);
}

static float get_float(const unsigned char *from, bool little) {
    uint32_t bits = 0;
    for (int i = 0; i < 4; i++) bits |= (uint32_t)from[little ? i : 3 - i] << 8 * i;
    float value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

bool ang_pfm_encode(int width, int height, const float *rgb, ang_bytes *out, ang_error *err) {
    unsigned char *to = begin("PF", "-1.0", width, height, 4, out, err);
    if (!to) return false;
    size_t row = (size_t)width * 3;
    for (int y = 0; y < height; y++) { /* the last row comes first */
        const float *from = rgb + row * (size_t)(height - 1 - y);
        for (size_t i = 0; i < row; i++) put_float(to + 4 * (row * (size_t)y + i), from[i]);
    }
    return true;
}

/* The next word of a header, comments skipped; one white-space character behind it is taken. */
static bool read_word(FILE *file, char *word, size_t size) {
    int c = fgetc(file);
    while (c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == '#') {
        if (c == '#') {
            while (c != '\n' && c != EOF) c = fgetc(file);
        }
        c = fgetc(file);
    }
    size_t length = 0;
    while (c != EOF && c != ' ' && c != '\t' && c != '\n' && c != '\r') {
        if (length + 1 >= size) return false;
        word[length++] = (char)c;
        c = fgetc(file);
    }
    word[length] = '\0';
    return length > 0;
}

/* A number of pixels, 1 to 65536; 0: it is none. */
static long read_length(const char *word) {
    char *end;
    long length = strtol(word, &end, 10);
    return *end || length < 1 || length > 65536 ? 0 : length;
}

/* Whether a file of known length has fewer than `size` bytes left: before room is made for what a header claims. */
static bool is_cut(FILE *file, size_t size) {
    struct stat status;
    long at = ftell(file);
    return fstat(fileno(file), &status) == 0 && S_ISREG(status.st_mode) && at >= 0 &&
           (status.st_size < at || (size_t)(status.st_size - at) < size);
}

static bool read_pixels(FILE *file, const char *path, ang_image *out, ang_error *err) {
    char magic[8], width[16], height[16], scale[32];
    bool good = read_word(file, magic, sizeof magic) && read_word(file, width, sizeof width) &&
                read_word(file, height, sizeof height) && read_word(file, scale, sizeof scale);
    bool is_float = good && strcmp(magic, "PF") == 0;
    if (!good || (!is_float && (strcmp(magic, "P6") != 0 || strcmp(scale, "255") != 0))) {
        return ang_fail(err, ANG_INPUT, "%s: neither a P6 pixmap of 8 bits nor a PF float map; convert it", path);
    }
    long w = read_length(width), h = read_length(height);
    if (w < 1 || h < 1) return ang_fail(err, ANG_INPUT, "%s: its size in pixels is not one that is read", path);
    size_t row = (size_t)w * 3, size = row * (is_float ? 4 : 1);
    if (is_cut(file, size * (size_t)h))
        return ang_fail(err, ANG_INPUT, "%s: ends before its last pixel; write it again", path);
    unsigned char *line = ang_alloc(size, 1, "picture", err);
    if (!line || !ang_image_create(out, (int)w, (int)h, err)) {
        free(line);
        return false;
    }
    bool little = strtod(scale, NULL) < 0;
    for (long y = 0; y < h; y++) {
        if (fread(line, 1, size, file) != size) {
            free(line);
            ang_image_clear(out);
            return ang_fail(err, ANG_INPUT, "%s: ends before its last pixel; write it again", path);
        }
        float *to = out->rgba + 4 * (size_t)w * (size_t)(is_float ? h - 1 - y : y);
        for (size_t i = 0; i < row; i++) {
            to[i / 3 * 4 + i % 3] = is_float ? get_float(line + 4 * i, little) : (float)line[i] / 255;
        }
        for (size_t i = 0; i < (size_t)w; i++) to[4 * i + 3] = 1;
    }
    free(line);
    return true;
}

bool ang_portable_read(const char *path, ang_image *out, ang_error *err) {
    FILE *file = fopen(path, "rbe");
    if (!file) {
        char text[128];
        return ang_fail(err, ANG_INPUT, "%s: cannot be read (%s)", path, strerror_r(errno, text, sizeof text));
    }
    bool good = read_pixels(file, path, out, err);
    fclose(file);
    return good;
}
