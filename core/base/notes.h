/* A growing list of sentences: assumptions made and warnings given while loading or planning. */
#ifndef ANG_BASE_NOTES_H
#define ANG_BASE_NOTES_H

#include <stddef.h>

/* Zero-initialise; owns its strings; not thread safe. */
typedef struct ang_notes {
    char **text;
    size_t count;
} ang_notes;

/* Appends a sentence; a sentence that is already in the list is not repeated. Where memory is out it is dropped. */
void ang_notes_add(ang_notes *notes, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* Frees the list and makes it empty. */
void ang_notes_clear(ang_notes *notes);

#endif
