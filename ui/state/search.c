#include "ui/state/search.h"

#include <stdbool.h>
#include <stddef.h>
#include <string.h>

static char lower(char sign) { return sign >= 'A' && sign <= 'Z' ? (char)(sign - 'A' + 'a') : sign; }

static bool is_inner(char sign) {
    sign = lower(sign);
    return (sign >= 'a' && sign <= 'z') || (sign >= '0' && sign <= '9') || (sign & 0x80);
}

static bool same(const char *a, const char *b, size_t length) {
    for (size_t i = 0; i < length; i++)
        if (lower(a[i]) != lower(b[i])) return false;
    return true;
}

static int rank_of_word(const char *word, size_t length, const char *text) {
    int best = -1;
    size_t room = strlen(text);
    for (size_t at = 0; at + length <= room; at++) {
        if (!same(word, text + at, length)) continue;
        int rank = at == 0 ? 0 : is_inner(text[at - 1]) ? 2 : 1;
        if (best < 0 || rank < best) best = rank;
    }
    return best;
}

int ang_search_rank(const char *query, const char *text) {
    int sum = 0;
    while (*query) {
        query += strspn(query, " ");
        size_t length = strcspn(query, " ");
        if (length == 0) break;
        int rank = rank_of_word(query, length, text);
        if (rank < 0) return -1;
        sum += rank;
        query += length;
    }
    return sum;
}
