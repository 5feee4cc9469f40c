#include "core/base/facts.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Takes `value`. */
static void append(ang_facts *facts, const char *name, char *value) {
    ang_fact *grown = realloc(facts->fact, (facts->count + 1) * sizeof *grown);
    char *copy = strdup(name);
    if (grown) facts->fact = grown;
    if (grown && copy) {
        facts->fact[facts->count++] = (ang_fact){copy, value};
        return;
    }
    free(copy);
    free(value);
}

void ang_facts_heading(ang_facts *facts, const char *heading) { append(facts, heading, NULL); }

void ang_facts_add(ang_facts *facts, const char *name, const char *format, ...) {
    char *value = NULL;
    va_list args;
    va_start(args, format);
    int length = vasprintf(&value, format, args);
    va_end(args);
    if (length >= 0) append(facts, name, value);
}

void ang_facts_clear(ang_facts *facts) {
    for (size_t i = 0; i < facts->count; i++) {
        free(facts->fact[i].name);
        free(facts->fact[i].value);
    }
    free(facts->fact);
    *facts = (ang_facts){0};
}
