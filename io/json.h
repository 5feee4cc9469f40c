/* JSON files read with errors that name file, line and field. cJSON keeps no positions, so lines are found again in the
 * text by walking the path of the field. */
#ifndef ANG_IO_JSON_H
#define ANG_IO_JSON_H

#include "core/base/error.h"

#include <cjson/cJSON.h>
#include <stdbool.h>
#include <stddef.h>

/* A parsed file. Plain value; release with ang_json_close. */
typedef struct ang_json {
    char *file; /* as it was asked for */
    char *text; /* NUL-terminated */
    cJSON *root;
} ang_json;

/* Reads and parses a file of at most 4 MB. False with ANG_INPUT where it cannot be read and ANG_USAGE where it is not
 * JSON. */
bool ang_json_open(const char *path, ang_json *json, ang_error *err);
/* The same from text in memory; `file` only labels errors. */
bool ang_json_parse(const char *file, const char *text, ang_json *json, ang_error *err);
void ang_json_close(ang_json *json);

/* The line (from 1) in valid JSON text of a field such as "points[3].opacity"; where the path does not exist, that of
 * the deepest part of it that does. Keys with escapes in them are not found. */
int ang_json_line(const char *text, const char *path);
/* Fails with ANG_USAGE and "FILE:LINE: " before the sentence. Returns false. */
bool ang_json_fail(const ang_json *json, const char *path, ang_error *err, const char *format, ...)
    __attribute__((format(printf, 4, 5)));

/* Refuses a field of `object` that `known` (NULL-terminated) does not have, naming the nearest that it has, and fields
 * given twice. `prefix` is the object's path with a final dot, or "". */
bool ang_json_check_fields(const ang_json *json, const cJSON *object, const char *prefix, const char *const *known,
                           ang_error *err);
/* Reads a number within [low, high] at `path`; left alone where `item` is NULL. */
bool ang_json_number(const ang_json *json, const cJSON *item, const char *path, double low, double high, double *value,
                     ang_error *err);

/* Reads `count` numbers, each within [low, high], of a list that must hold as many. */
bool ang_json_numbers(const ang_json *json, const cJSON *list, const char *path, int count, double low, double high,
                      double *values, ang_error *err);

/* Adds a number under `name`, or null where it is not finite, which JSON cannot say. */
void ang_json_add_number(cJSON *object, const char *name, double value);
/* The shortest decimal that reads back as the same double; "null" where it is not finite. Returns `text`. */
const char *ang_json_number_text(double value, char text[40]);
/* That as an item, to be printed: in memory it is no number to cJSON, whose own printing stops an epsilon short. */
cJSON *ang_json_exact(double value);

/* The text of the value at `path` in valid JSON, with blanks and line ends before it so that its lines keep their
 * numbers. NULL where there is none or memory is out. Free with free(). */
char *ang_json_part(const ang_json *json, const char *path);

/* The entry of NULL-terminated `known` most like `word` by edit distance; NULL where none is similar. */
const char *ang_nearest_word(const char *word, const char *const *known);

#endif
