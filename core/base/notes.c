#include "core/base/notes.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void ang_notes_add(ang_notes *notes, const char *format, ...) {
    char buffer[1024];
    va_list args;
    va_start(args, format);
    vsnprintf(buffer, sizeof buffer, format, args);
    va_end(args);
    for (size_t i = 0; i < notes->count; i++)
        if (strcmp(notes->text[i], buffer) == 0) return;
    char **grown = realloc(notes->text, (notes->count + 1) * sizeof *grown);
    if (!grown) return;
    notes->text = grown;
    char *copy = strdup(buffer);
    if (copy) notes->text[notes->count++] = copy;
}

void ang_notes_clear(ang_notes *notes) {
    for (size_t i = 0; i < notes->count; i++) free(notes->text[i]);
    free(notes->text);
    *notes = (ang_notes){0};
}
