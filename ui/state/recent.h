/* The last files opened. A plain value. */
#ifndef ANG_UI_RECENT_H
#define ANG_UI_RECENT_H

#include <stddef.h>

enum { ANG_RECENT_MOST = 10, ANG_RECENT_SIZE = 1024 };

typedef struct ang_recent {
    int count;
    char path[ANG_RECENT_MOST][ANG_RECENT_SIZE]; /* absolute, the last one first */
} ang_recent;

/* Puts a path first; one that is there moves up, the oldest falls out. One that is too long or empty is left out. */
void ang_recent_add(ang_recent *recent, const char *path);
/* A path short enough for a list: its last parts, after an ellipsis where something is left out. */
const char *ang_recent_short(const char *path, char *text, size_t size);

#endif
