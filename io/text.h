/* Text from files made fit for JSON and terminals. Pure functions. */
#ifndef ANG_IO_TEXT_H
#define ANG_IO_TEXT_H

#include <stddef.h>
#include <stdio.h>

/* Replaces, in place, every byte that is not part of well-formed UTF-8 (RFC 3629) and every control character by '?'.
 */
void ang_text_clean(char *text);

/* Bytes of the character of UTF-8 (RFC 3629) that NUL-terminated `text` begins with; 0 where that is none, or a control
 * character. */
size_t ang_text_character(const char *text);

/* The greatest number of bytes up to `length` <= strlen(text) that cuts no character in two. */
size_t ang_text_cut(const char *text, size_t length);

/* Writes text into HTML or XML, as content or as a value in double quotes: what is markup there becomes entities. */
void ang_text_put_markup(FILE *out, const char *text);

/* Latin-1 (ISO 8859-1) becomes UTF-8 in `out`, cut to `size` bytes between characters. */
void ang_text_from_latin1(const char *text, char *out, size_t size);

/* A person's name of DICOM (PN, PS3.5 6.2.1.1), "Family^Given^Middle^Prefix^Suffix", as one reads it: "Family, Given
 * Middle", cut to `size` bytes. Of its up to three groups the first that is not empty. */
void ang_person_name_print(const char *name, char *out, size_t size);

#endif
