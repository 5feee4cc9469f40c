/* Lines, words and numbers of text headers. Pure functions. */
#ifndef ANG_VOXELS_HEADER_TEXT_H
#define ANG_VOXELS_HEADER_TEXT_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum { ANG_HEADER_LINE = 4096 };

/* The line at `*at` without its end and the blanks before that, cut to ANG_HEADER_LINE - 1 bytes; `*at` moves behind
 * its end. False at the end of the bytes. */
bool ang_header_line(const uint8_t *bytes, size_t size, size_t *at, char line[ANG_HEADER_LINE]);
/* Numbers between blanks, "nan" and "inf" too. Their count, or -1 where there are more than `room` or something else is
 * among them. */
int ang_header_numbers(const char *text, double *out, int room);
/* The next word, or text in quotation marks, at `*text`, into `out`, cut to `size`; `*text` moves behind it. False at
 * the end. */
bool ang_header_word(const char **text, char *out, size_t size);
/* Equal without regard to case. */
bool ang_header_is(const char *a, const char *b);
/* A unit of length in mm: "mm", "cm", "m", "um" and spelt out; NaN for others. */
double ang_header_unit_mm(const char *unit);
/* A unit of time, "s", "min", "ms", "us", however it is spelt; "" for others, which are any text and may identify. */
const char *ang_header_unit_time(const char *unit);

#endif
