/* The forms behind property.h. Private to io/preset/slicer/. */
#ifndef ANG_IO_SLICER_FORMS_H
#define ANG_IO_SLICER_FORMS_H

#include "io/preset/slicer/property.h"

#include <stdio.h>

enum { ANG_PROPERTY_MOST_POINTS = 20000, ANG_PROPERTY_MOST = 1000, ANG_PROPERTY_LONGEST_FILE = 4 << 20 };

/* VTK's defaults, without a name and points. */
extern const ang_property ang_property_default;

/* As ang_property_parse of one form. `text` ends in a NUL beyond `size`; it holds none before. */
bool ang_property_parse_vp(const char *file, const char *text, ang_property_list *list, ang_error *err);
bool ang_property_parse_xml(const char *file, const char *text, ang_property_list *list, ang_error *err);
bool ang_property_parse_json(const char *file, const char *text, ang_property_list *list, ang_error *err);

/* A new property at the end of the list, with defaults and a copy of the first `length` bytes of `name`. NULL with
 * ANG_LIMIT, ANG_USAGE where there are too many. */
ang_property *ang_property_list_add(ang_property_list *list, const char *name, size_t length, ang_error *err);
/* Appends a point. False with ANG_LIMIT, ANG_USAGE where there are too many or a number is not finite. */
bool ang_property_function_add(ang_property_function *function, const ang_property_point *point, ang_error *err);
/* Reads "N v v v ..." into `function`, whose channels are set; "" and "0" are no points. `err` says what is wrong,
 * without the file. */
bool ang_property_function_read(const char *text, ang_property_function *function, ang_error *err);
/* Puts points in order; those that Slicer has set apart by the least that a double can are at one place again. */
void ang_property_function_settle(ang_property_function *function);

/* "N v v v ...", every number exact. */
void ang_property_function_write(const ang_property_function *function, FILE *out);
void ang_property_write_xml(const ang_property_list *list, FILE *out);
bool ang_property_write_json(const ang_property_list *list, FILE *out, ang_error *err);

#endif
