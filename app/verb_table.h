/* The verbs of the command line and the exit codes in tables, which drive help, the manual page and completions. */
#ifndef ANG_APP_VERB_TABLE_H
#define ANG_APP_VERB_TABLE_H

#include "app/options.h"

typedef struct ang_verb_entry {
    const char *name;
    ang_verb verb;
    const char *usage; /* after the program's name */
    const char *summary;
    const char *about;   /* sentences for the manual */
    const char *actions; /* words that must follow, separated by |; NULL: none */
    bool paths;          /* whether files or folders are its arguments */
} ang_verb_entry;

/* The first is the one that is meant where none is given. */
extern const ang_verb_entry ang_verb_table[];
extern const int ang_verb_count;

typedef struct ang_exit_code {
    int code;
    const char *brief;   /* for the line in --help */
    const char *meaning; /* a sentence for the manual */
} ang_exit_code;

extern const ang_exit_code ang_exit_codes[];
extern const int ang_exit_code_count;

#endif
