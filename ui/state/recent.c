#include "ui/state/recent.h"

#include <stdio.h>
#include <string.h>

void ang_recent_add(ang_recent *recent, const char *path) {
    size_t length = strlen(path);
    if (length == 0 || length >= ANG_RECENT_SIZE) return;
    char added[ANG_RECENT_SIZE]; /* `path` may be one of the list */
    memcpy(added, path, length + 1);
    int at = 0;
    while (at < recent->count && strcmp(recent->path[at], added) != 0) at++;
    if (at == recent->count && recent->count < ANG_RECENT_MOST) recent->count++;
    if (at == ANG_RECENT_MOST) at--;
    memmove(recent->path[1], recent->path[0], (size_t)at * sizeof recent->path[0]);
    memcpy(recent->path[0], added, length + 1);
}

const char *ang_recent_short(const char *path, char *text, size_t size) {
    size_t most = 56, length = strlen(path);
    if (length <= most) {
        snprintf(text, size, "%s", path);
        return text;
    }
    const char *from = path + length - most, *slash = strchr(from, '/');
    if (slash && slash[1]) from = slash;
    while ((*from & 0xc0) == 0x80) from++; /* not within a letter of UTF-8 */
    snprintf(text, size, "\u2026%s", from);
    return text;
}
