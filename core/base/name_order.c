#include "core/base/name_order.h"

#include <ctype.h>
#include <string.h>

static size_t digits(const char *text) { return strspn(text, "0123456789"); }

int ang_name_compare(const char *a, const char *b) {
    const char *from_a = a, *from_b = b;
    while (*a && *b) {
        size_t in_a = digits(a), in_b = digits(b);
        if (in_a && in_b) {
            size_t zeros_a = strspn(a, "0"), zeros_b = strspn(b, "0");
            size_t length_a = in_a - (zeros_a < in_a ? zeros_a : in_a);
            size_t length_b = in_b - (zeros_b < in_b ? zeros_b : in_b);
            if (length_a != length_b) return length_a < length_b ? -1 : 1;
            int order = strncmp(a + in_a - length_a, b + in_b - length_b, length_a);
            if (order) return order;
            a += in_a;
            b += in_b;
            continue;
        }
        int order = tolower((unsigned char)*a) - tolower((unsigned char)*b);
        if (order) return order;
        a++;
        b++;
    }
    if (*a || *b) return *a ? 1 : -1;
    return strcmp(from_a, from_b);
}
