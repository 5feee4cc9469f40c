/* A list of names with what they are, to be shown as lines of a table. */
#ifndef ANG_BASE_FACTS_H
#define ANG_BASE_FACTS_H

#include <stddef.h>

/* Owns its strings. */
typedef struct ang_fact {
    char *name;  /* empty: the line goes on with what the one before is about */
    char *value; /* NULL: `name` is the heading of those that follow */
} ang_fact;

/* Zero-initialise; not thread safe. */
typedef struct ang_facts {
    ang_fact *fact;
    size_t count;
} ang_facts;

/* Append; where memory is out the line is dropped. */
void ang_facts_heading(ang_facts *facts, const char *heading);
void ang_facts_add(ang_facts *facts, const char *name, const char *format, ...) __attribute__((format(printf, 3, 4)));
/* Frees the list and makes it empty. */
void ang_facts_clear(ang_facts *facts);

#endif
