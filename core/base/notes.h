/* A growing list of sentences: assumptions made and warnings given while loading or planning. */
#ifndef ANG_BASE_NOTES_H
#define ANG_BASE_NOTES_H

#include <stdbool.h>
#include <stddef.h>

/* Zero-initialise; owns its strings; not thread safe. A file's name may identify a patient, so it is never part of the
 * sentence: ang_notes_line joins them. */
typedef struct ang_notes {
    char **text; /* the sentences, without the names of files */
    char **file; /* the name of the file that each is about; NULL where it is about none */
    size_t count;
} ang_notes;

/* Appends a sentence; a sentence that is already in the list is not repeated. Where memory is out it is dropped. */
void ang_notes_add(ang_notes *notes, const char *format, ...) __attribute__((format(printf, 2, 3)));
/* The same for a sentence about `file`, which must not name it. */
void ang_notes_add_file(ang_notes *notes, const char *file, const char *format, ...)
    __attribute__((format(printf, 3, 4)));
/* Appends all of `more`. */
void ang_notes_append(ang_notes *notes, const ang_notes *more);

/* Sentence `index` for people, written to `out` of `size` bytes and returned: `file "NAME": sentence` where `named`,
 * else `a file: sentence`; the bare sentence where it is about no file. */
enum { ANG_NOTES_LINE = 1536 }; /* bytes that hold any sentence and the name of any file */
const char *ang_notes_line(const ang_notes *notes, size_t index, bool named, char *out, size_t size);

/* The ending of a regular noun after `count`: "1 slice", "2 slices". */
static inline const char *ang_plural(long long count) { return count == 1 ? "" : "s"; }

/* Frees the list and makes it empty. */
void ang_notes_clear(ang_notes *notes);

#endif
