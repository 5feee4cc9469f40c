#include "io/dicom/bytes.h"
#include "io/dicom/parse.h"

#include <math.h>
#include <string.h>

void ang_dicom_assume_vr(ang_dicom_element *element, const char *vr) {
    if (!element->vr[0] || strcmp(element->vr, "UN") == 0) memcpy(element->vr, vr, 3);
}

bool ang_dicom_verbatim(ang_dicom_reader *reader, const ang_dicom_element *element, char *out, size_t size) {
    static const char escape = 0x1B;
    out[0] = 0;
    if (element->length == 0 || element->length > ang_dicom_value_size) return false;
    const uint8_t *p = ang_dicom_bytes(reader, element->offset, element->length);
    if (!p) return false;
    size_t begin = 0, end = element->length;
    while (begin < end && (p[begin] == ' ' || p[begin] == 0)) begin++;
    while (end > begin && (p[end - 1] == ' ' || p[end - 1] == 0)) end--;
    if (end - begin >= size) end = begin + size - 1;
    memcpy(out, p + begin, end - begin);
    out[end - begin] = 0;
    for (char *c = out; *c; c++) {
        if (((unsigned char)*c < ' ' && *c != escape) || *c == 127) *c = ' ';
    }
    return out[0] != 0;
}

bool ang_dicom_text(ang_dicom_reader *reader, const ang_dicom_element *element, char *out, size_t size) {
    bool given = ang_dicom_verbatim(reader, element, out, size);
    for (char *c = out; *c; c++) {
        if ((unsigned char)*c < ' ') *c = ' ';
    }
    return given;
}

/* Numbers of a binary VR; -1 where the VR is not one. */
static int binary_numbers(ang_dicom_reader *reader, const ang_dicom_element *element, double *out, int count) {
    static const char codes[] = "USSSULSLFLFD";
    int kind = -1;
    for (int i = 0; i < 6; i++) {
        if (memcmp(element->vr, codes + 2 * i, 2) == 0) kind = i;
    }
    if (kind < 0) return -1;
    size_t size = kind < 2 ? 2 : kind < 5 ? 4 : 8;
    int n = 0;
    for (; n < count && (size_t)(n + 1) * size <= element->length; n++) {
        const uint8_t *p = ang_dicom_bytes(reader, element->offset + (uint64_t)n * size, size);
        if (!p) break;
        uint32_t low = size == 2 ? get16(p, element->big_endian) : get32(p, element->big_endian);
        if (kind == 0 || kind == 2) out[n] = low;
        if (kind == 1) out[n] = (int16_t)low;
        if (kind == 3) out[n] = (int32_t)low;
        if (kind == 4) {
            float value;
            memcpy(&value, &low, sizeof value);
            out[n] = (double)value;
        }
        if (kind == 5) {
            uint64_t bits = get64(p, element->big_endian);
            memcpy(&out[n], &bits, sizeof bits);
        }
        if (!isfinite(out[n])) break;
    }
    return n;
}

/* One value of a decimal string, up to its backslash or the end, where *text is left. strtod would follow the locale
 * and take hexadecimal: the decimal strings of PS3.5 6.2 have neither. Nothing but blanks may follow the number: "1,5"
 * is not 1. */
static bool decimal(const char **text, double *out) {
    const char *p = *text;
    while (*p == ' ') p++;
    bool negative = *p == '-';
    if (*p == '-' || *p == '+') p++;
    double value = 0, scale = 1;
    int digits = 0, exponent = 0;
    bool point = false;
    for (; (*p >= '0' && *p <= '9') || (*p == '.' && !point); p++) {
        if (*p == '.') {
            point = true;
            continue;
        }
        value = value * 10 + (*p - '0');
        if (point) scale *= 10;
        digits++;
    }
    if (digits && (*p == 'e' || *p == 'E')) {
        bool below = p[1] == '-';
        p += p[1] == '-' || p[1] == '+' ? 2 : 1;
        if (*p < '0' || *p > '9') return false;
        for (; *p >= '0' && *p <= '9'; p++) exponent = exponent < 10000 ? 10 * exponent + (*p - '0') : exponent;
        if (below) exponent = -exponent;
    }
    while (*p == ' ') p++;
    if (!digits || (*p && *p != '\\')) return false;
    value /= scale;
    if (exponent) value *= pow(10, exponent);
    if (!isfinite(value)) return false;
    *out = negative ? -value : value;
    *text = p;
    return true;
}

int ang_dicom_numbers(ang_dicom_reader *reader, const ang_dicom_element *element, double *out, int count) {
    if (element->vr[0]) {
        int n = binary_numbers(reader, element, out, count);
        if (n >= 0) return n;
    }
    char text[512];
    if (!ang_dicom_text(reader, element, text, sizeof text)) return 0;
    int n = 0;
    for (const char *p = text; n < count; p++) {
        if (!decimal(&p, &out[n])) break;
        n++;
        if (!*p) break;
    }
    return n;
}

bool ang_dicom_word(ang_dicom_reader *reader, const ang_dicom_element *element, uint16_t *out) {
    if (element->length < 2) return false;
    const uint8_t *p = ang_dicom_bytes(reader, element->offset, 2);
    if (p) *out = get16(p, element->big_endian);
    return p != NULL;
}
