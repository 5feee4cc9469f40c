#include "io/text.h"

#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

size_t ang_text_character(const char *text) {
    const uint8_t *p = (const uint8_t *)text;
    if (p[0] < 0x80) return p[0] >= 0x20 && p[0] != 0x7F ? 1 : 0;
    size_t length = p[0] >= 0xC2 && p[0] <= 0xDF   ? 2
                    : p[0] >= 0xE0 && p[0] <= 0xEF ? 3
                    : p[0] >= 0xF0 && p[0] <= 0xF4 ? 4
                                                   : 0;
    if (length == 0) return 0;
    /* Too long a form, a surrogate, beyond U+10FFFF, or a control character of U+0080 to U+009F. */
    if ((p[0] == 0xE0 && p[1] < 0xA0) || (p[0] == 0xED && p[1] > 0x9F)) return 0;
    if ((p[0] == 0xF0 && p[1] < 0x90) || (p[0] == 0xF4 && p[1] > 0x8F)) return 0;
    if (p[0] == 0xC2 && p[1] < 0xA0) return 0;
    for (size_t i = 1; i < length; i++)
        if ((p[i] & 0xC0) != 0x80) return 0;
    return length;
}

void ang_text_clean(char *text) {
    while (*text) {
        size_t length = ang_text_character(text);
        if (length == 0) *text = '?';
        text += length ? length : 1;
    }
}

size_t ang_text_cut(const char *text, size_t length) {
    while (length > 0 && ((unsigned char)text[length] & 0xC0) == 0x80) length--;
    return length;
}

void ang_text_put_markup(FILE *out, const char *text) {
    for (; *text; text++) switch (*text) {
        case '<':
            fputs("&lt;", out);
            break;
        case '>':
            fputs("&gt;", out);
            break;
        case '&':
            fputs("&amp;", out);
            break;
        case '"':
            fputs("&quot;", out);
            break;
        default:
            fputc(*text, out);
        }
}

void ang_text_from_latin1(const char *text, char *out, size_t size) {
    size_t used = 0;
    for (const uint8_t *p = (const uint8_t *)text; *p; p++) {
        size_t needed = *p < 0x80 ? 1 : 2;
        if (used + needed >= size) break;
        if (needed == 2) out[used++] = (char)(0xC0 | *p >> 6);
        out[used++] = (char)(needed == 2 ? 0x80 | (*p & 0x3F) : *p);
    }
    if (size) out[used] = 0;
}

void ang_person_name_print(const char *name, char *out, size_t size) {
    char part[3][257] = {""}; /* family, given and middle name; titles are left out */
    name += strspn(name, "=");
    for (int i = 0; i < 3; i++) {
        size_t length = strcspn(name, "^=");
        snprintf(part[i], sizeof part[i], "%.*s", (int)length, name);
        name += length + (name[length] == '^');
    }
    bool more = part[1][0] || part[2][0];
    snprintf(out, size, "%s%s%s%s%s", part[0], part[0][0] && more ? ", " : "", part[1],
             part[1][0] && part[2][0] ? " " : "", part[2]);
    ang_text_clean(out); /* a character that was cut */
}
