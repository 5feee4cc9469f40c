/* Voxels as text: decimal numbers, or bytes in hexadecimal. */
#include "core/base/memory.h"
#include "io/formats.h"
#include "io/voxels/decoder.h"

#include <ctype.h>
#include <stdlib.h>
#include <string.h>

enum { longest_number = 63 };

typedef struct reading {
    FILE *file;
    const char *label;
    ang_sample type;
    uint8_t rest[8]; /* of a sample that did not fit */
    size_t rest_from, rest_end;
} reading;

static void *start(FILE *file, const ang_byte_parts *parts, const ang_byte_part *part, ang_error *err) {
    reading *self = ang_alloc(1, sizeof *self, "voxels", err);
    if (self) *self = (reading){.file = file, .label = ang_base_name(part->path), .type = parts->type};
    return self;
}

static bool between_numbers(int c) { return isspace(c) || c == ','; }

/* The next number's text; 0 at the end, -1 where it is too long to be one. */
static int next_number(FILE *file, char text[longest_number + 1]) {
    int c = getc_unlocked(file), length = 0;
    while (c != EOF && between_numbers(c)) c = getc_unlocked(file);
    for (; c != EOF && !between_numbers(c); c = getc_unlocked(file)) {
        if (length == longest_number) return -1;
        text[length++] = (char)c;
    }
    text[length] = '\0';
    return length;
}

static bool next_sample(reading *self, uint8_t sample[8], bool *ended, ang_error *err) {
    char text[longest_number + 1], *end = text;
    int length = next_number(self->file, text);
    *ended = length == 0;
    if (*ended) return true;
    double value = length > 0 ? strtod(text, &end) : 0;
    if (length < 0 || *end || strpbrk(text, "xXpP"))
        return ang_fail(err, ANG_INPUT, "%s: holds what is no number where its voxels should be", self->label);
    return ang_sample_put(sample, self->type, value) ||
           ang_fail(err, ANG_INPUT, "%s: holds %.20s, which its number type does not", self->label, text);
}

static ptrdiff_t read_numbers(void *context, uint8_t *out, size_t size, ang_error *err) {
    reading *self = context;
    size_t done = 0, each = ang_sample_size(self->type);
    while (done < size) {
        if (self->rest_from == self->rest_end) {
            bool ended;
            if (!next_sample(self, self->rest, &ended, err)) return -1;
            if (ended) break;
            self->rest_from = 0;
            self->rest_end = each;
        }
        out[done++] = self->rest[self->rest_from++];
    }
    return (ptrdiff_t)done;
}

static int hex_digit(FILE *file) {
    int c = getc_unlocked(file);
    while (c != EOF && isspace(c)) c = getc_unlocked(file);
    if (c >= '0' && c <= '9') return c - '0';
    c = c == EOF ? EOF : tolower(c);
    return c >= 'a' && c <= 'f' ? c - 'a' + 10 : c == EOF ? -1 : -2;
}

static ptrdiff_t read_hex(void *context, uint8_t *out, size_t size, ang_error *err) {
    reading *self = context;
    for (size_t i = 0; i < size; i++) {
        int high = hex_digit(self->file), low = high >= 0 ? hex_digit(self->file) : high;
        if (high == -2 || low == -2) {
            ang_fail(err, ANG_INPUT, "%s: holds what is no hexadecimal digit where its voxels should be", self->label);
            return -1;
        }
        if (low < 0) return (ptrdiff_t)i;
        out[i] = (uint8_t)(high << 4 | low);
    }
    return (ptrdiff_t)size;
}

const ang_decoder ang_decoder_text = {start, read_numbers, free};
const ang_decoder ang_decoder_hex = {start, read_hex, free};
