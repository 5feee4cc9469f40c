#include "io/voxels/header_text.h"

#include <ctype.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

bool ang_header_line(const uint8_t *bytes, size_t size, size_t *at, char line[ANG_HEADER_LINE]) {
    if (*at >= size) return false;
    const uint8_t *begin = bytes + *at, *end = memchr(begin, '\n', size - *at);
    size_t length = end ? (size_t)(end - begin) : size - *at;
    *at += length + (end ? 1 : 0);
    while (length > 0 && isspace(begin[length - 1])) length--;
    if (length > ANG_HEADER_LINE - 1) length = ANG_HEADER_LINE - 1;
    memcpy(line, begin, length);
    line[length] = '\0';
    return true;
}

int ang_header_numbers(const char *text, double *out, int room) {
    int count = 0;
    for (;;) {
        while (isspace((unsigned char)*text)) text++;
        if (!*text) return count;
        char *end;
        double value = strtod(text, &end);
        if (end == text || (*end && !isspace((unsigned char)*end)) || count == room) return -1;
        out[count++] = value;
        text = end;
    }
}

bool ang_header_word(const char **text, char *out, size_t size) {
    const char *at = *text;
    while (isspace((unsigned char)*at)) at++;
    bool quoted = *at == '"';
    if (!*at) return false;
    if (quoted) at++;
    size_t length = 0;
    for (; *at && (quoted ? *at != '"' : !isspace((unsigned char)*at)); at++) {
        if (quoted && *at == '\\' && at[1]) at++;
        if (length + 1 < size) out[length++] = *at;
    }
    out[length] = '\0';
    *text = quoted && *at ? at + 1 : at;
    return true;
}

bool ang_header_is(const char *a, const char *b) { return strcasecmp(a, b) == 0; }

double ang_header_unit_mm(const char *unit) {
    static const struct {
        const char *name;
        double mm;
    } units[] = {{"mm", 1},        {"millimeter", 1}, {"millimeters", 1},  {"cm", 10},
                 {"m", 1000},      {"um", 1e-3},      {"\xC2\xB5m", 1e-3}, {"\xCE\xBCm", 1e-3},
                 {"micron", 1e-3}, {"microns", 1e-3}, {"nm", 1e-6}};
    for (size_t i = 0; i < sizeof units / sizeof *units; i++)
        if (ang_header_is(unit, units[i].name)) return units[i].mm;
    return NAN;
}

const char *ang_header_unit_time(const char *unit) {
    static const char *const units[][2] = {{"s", "s"},     {"sec", "s"},   {"second", "s"},   {"seconds", "s"},
                                           {"min", "min"}, {"ms", "ms"},   {"msec", "ms"},    {"milliseconds", "ms"},
                                           {"us", "us"},   {"usec", "us"}, {"minute", "min"}, {"minutes", "min"}};
    for (size_t i = 0; i < sizeof units / sizeof *units; i++)
        if (ang_header_is(unit, units[i][0])) return units[i][1];
    return "";
}
