#include "io/image/picture_text.h"

#include <errno.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <zlib.h>

enum { most_text = 16 << 20, most_name = 256 };

typedef struct source {
    FILE *file;
    const char *path;
    uint64_t left; /* bytes behind the place */
} source;

static bool open_source(source *in, const char *path, ang_error *err) {
    struct stat status;
    *in = (source){.path = path};
    if (stat(path, &status) != 0) return ang_fail(err, ANG_INPUT, "%s: cannot be read (%s)", path, strerror(errno));
    if (S_ISREG(status.st_mode)) in->file = fopen(path, "rb");
    if (!in->file) return ang_fail(err, ANG_INPUT, "%s: cannot be read as a file", path);
    in->left = (uint64_t)status.st_size;
    return true;
}

static bool take(source *in, void *out, size_t size) {
    if (size > in->left || fread(out, 1, size, in->file) != size) return false;
    in->left -= size;
    return true;
}

static bool skip(source *in, uint64_t size) {
    if (size > in->left || fseek(in->file, (long)size, SEEK_CUR) != 0) return false;
    in->left -= size;
    return true;
}

/* `size` bytes of the file with a NUL behind them; NULL where they are not there or too many for a text. */
static char *take_text(source *in, uint64_t size, ang_error *err) {
    if (size > in->left || size > most_text) {
        ang_fail(err, ANG_INPUT, "%s: a text in it is damaged or too long", in->path);
        return NULL;
    }
    char *text = malloc((size_t)size + 1);
    if (!text) ang_fail(err, ANG_LIMIT, "%s: no memory for its text", in->path);
    if (!text) return NULL;
    if (take(in, text, (size_t)size)) {
        text[size] = '\0';
        return text;
    }
    free(text);
    ang_fail(err, ANG_INPUT, "%s: cannot be read to its end", in->path);
    return NULL;
}

static char *fail_damaged(const source *in, const char *format, ang_error *err) {
    ang_fail(err, ANG_INPUT, "%s: is damaged or no %s file", in->path, format);
    return NULL;
}

static char *fail_none(const source *in, const char *name, ang_error *err) {
    ang_fail(err, ANG_USAGE, "%s: carries no text %s", in->path, name);
    return NULL;
}

static char *unpack(const source *in, const char *packed, size_t size, ang_error *err) {
    /* zlib makes at most 1032 bytes of one. */
    uLongf length = size > most_text / 1032 ? most_text : 1032 * (uLongf)size + 64;
    char *text = malloc(length + 1);
    if (!text) ang_fail(err, ANG_LIMIT, "%s: no memory for its text", in->path);
    if (!text) return NULL;
    if (uncompress((Bytef *)text, &length, (const Bytef *)packed, (uLong)size) == Z_OK) {
        text[length] = '\0';
        return text;
    }
    free(text);
    ang_fail(err, ANG_INPUT, "%s: a text in it is damaged or too long", in->path);
    return NULL;
}

/* The text in the data of a chunk, behind its name and NUL. */
static char *text_of_chunk(const source *in, const char *type, const char *data, size_t size, ang_error *err) {
    bool packed = type[0] == 'z';
    if (packed || type[0] == 'i') {
        size_t fixed = packed ? 1 : 2; /* how it is packed; iTXt: before that whether it is */
        if (size < fixed) return fail_damaged(in, "PNG", err);
        packed = packed || data[0] != 0;
        data += fixed;
        size -= fixed;
    }
    for (int i = 0; type[0] == 'i' && i < 2; i++) { /* its language, and its name in that */
        const char *end = memchr(data, 0, size);
        if (!end) return fail_damaged(in, "PNG", err);
        size -= (size_t)(end + 1 - data);
        data = end + 1;
    }
    if (packed) return unpack(in, data, size, err);
    char *text = strndup(data, size);
    if (!text) ang_fail(err, ANG_LIMIT, "%s: no memory for its text", in->path);
    return text;
}

static char *search_png(source *in, const char *name, ang_error *err) {
    unsigned char head[8];
    size_t length = strlen(name) + 1;
    if (!take(in, head, 8) || memcmp(head, "\x89PNG\r\n\x1a\n", 8) != 0) return fail_damaged(in, "PNG", err);
    while (in->left > 0) {
        if (!take(in, head, 8)) return fail_damaged(in, "PNG", err);
        uint64_t size = (uint64_t)head[0] << 24 | (uint64_t)head[1] << 16 | (uint64_t)head[2] << 8 | head[3];
        const char *type = (const char *)head + 4;
        bool is_text = memcmp(type, "tEXt", 4) == 0 || memcmp(type, "zTXt", 4) == 0 || memcmp(type, "iTXt", 4) == 0;
        char start[most_name];
        bool named = is_text && size >= length && length <= sizeof start && take(in, start, length);
        if (named) size -= length;
        if (named && memcmp(start, name, length) == 0) {
            char *data = take_text(in, size, err);
            char *text = data ? text_of_chunk(in, type, data, (size_t)size, err) : NULL;
            free(data);
            return text;
        }
        if (memcmp(type, "IEND", 4) == 0) break;
        if (!skip(in, size + 4)) return fail_damaged(in, "PNG", err); /* and its sum */
    }
    return fail_none(in, name, err);
}

/* A name with its NUL. */
static bool take_name(source *in, char name[most_name]) {
    for (size_t i = 0; i < most_name; i++) {
        if (!take(in, &name[i], 1)) return false;
        if (!name[i]) return true;
    }
    return false;
}

static char *search_exr(source *in, const char *name, ang_error *err) {
    unsigned char head[8], size_bytes[4];
    char attribute[most_name], type[most_name];
    if (!take(in, head, 8) || memcmp(head, "\x76\x2f\x31\x01", 4) != 0) return fail_damaged(in, "EXR", err);
    for (;;) {
        if (!take_name(in, attribute)) return fail_damaged(in, "EXR", err);
        if (!attribute[0]) return fail_none(in, name, err);
        if (!take_name(in, type) || !take(in, size_bytes, 4)) return fail_damaged(in, "EXR", err);
        uint64_t size = (uint64_t)size_bytes[3] << 24 | (uint64_t)size_bytes[2] << 16 | (uint64_t)size_bytes[1] << 8 |
                        size_bytes[0];
        if (strcmp(attribute, name) == 0 && strcmp(type, "string") == 0) return take_text(in, size, err);
        if (!skip(in, size)) return fail_damaged(in, "EXR", err);
    }
}

static char *search(const char *path, const char *name, char *look(source *, const char *, ang_error *),
                    ang_error *err) {
    source in;
    if (!open_source(&in, path, err)) return NULL;
    char *text = look(&in, name, err);
    fclose(in.file);
    return text;
}

char *ang_png_text(const char *path, const char *name, ang_error *err) { return search(path, name, search_png, err); }

char *ang_exr_text(const char *path, const char *name, ang_error *err) { return search(path, name, search_exr, err); }
