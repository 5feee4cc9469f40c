#include "core/base/notes.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static bool same_file(const char *a, const char *b) { return a && b ? strcmp(a, b) == 0 : a == b; }

static void append(ang_notes *notes, const char *file, const char *sentence) {
    for (size_t i = 0; i < notes->count; i++)
        if (strcmp(notes->text[i], sentence) == 0 && same_file(notes->file[i], file)) return;
    char **text = realloc(notes->text, (notes->count + 1) * sizeof *text);
    if (text) notes->text = text;
    char **files = realloc(notes->file, (notes->count + 1) * sizeof *files);
    if (files) notes->file = files;
    if (!text || !files) return;
    char *sentence_copy = strdup(sentence), *file_copy = file ? strdup(file) : NULL;
    if (!sentence_copy || (file && !file_copy)) {
        free(sentence_copy);
        free(file_copy);
        return;
    }
    notes->text[notes->count] = sentence_copy;
    notes->file[notes->count++] = file_copy;
}

void ang_notes_add(ang_notes *notes, const char *format, ...) {
    char buffer[1024];
    va_list args;
    va_start(args, format);
    vsnprintf(buffer, sizeof buffer, format, args);
    va_end(args);
    append(notes, NULL, buffer);
}

void ang_notes_add_file(ang_notes *notes, const char *file, const char *format, ...) {
    char buffer[1024];
    va_list args;
    va_start(args, format);
    vsnprintf(buffer, sizeof buffer, format, args);
    va_end(args);
    append(notes, file, buffer);
}

void ang_notes_append(ang_notes *notes, const ang_notes *more) {
    for (size_t i = 0; i < more->count; i++) append(notes, more->file[i], more->text[i]);
}

const char *ang_notes_line(const ang_notes *notes, size_t index, bool named, char *out, size_t size) {
    const char *file = notes->file[index], *text = notes->text[index];
    if (!file)
        snprintf(out, size, "%s", text);
    else if (named)
        snprintf(out, size, "file \"%s\": %s", file, text);
    else
        snprintf(out, size, "a file: %s", text);
    return out;
}

void ang_notes_clear(ang_notes *notes) {
    for (size_t i = 0; i < notes->count; i++) {
        free(notes->text[i]);
        free(notes->file[i]);
    }
    free(notes->text);
    free(notes->file);
    *notes = (ang_notes){0};
}
