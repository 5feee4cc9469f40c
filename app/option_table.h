/* The table of options as those read it who describe the options: help, the manual page, completions. */
#ifndef ANG_APP_OPTION_TABLE_H
#define ANG_APP_OPTION_TABLE_H

#include "app/options.h"

#include <stddef.h>

typedef enum ang_option_type { FLAG, TEXT, CHOICE, INTEGER, REAL } ang_option_type;

typedef struct ang_option {
    const char *name;
    char letter; /* one-letter form, 0: none */
    ang_option_type type;
    unsigned verbs;       /* ang_verb; a name may come again for other verbs */
    size_t offset;        /* into ang_options */
    const char *argument; /* shown in help; for CHOICE the words, separated by | */
    double min, max;      /* INTEGER, REAL; the ends belong to the range */
    const char *initial;  /* as it would be typed; NULL: not given */
    const char *unit;
    const char *help;
} ang_option;

/* The options from 0 on in the order of the table; NULL after the last. */
const ang_option *ang_option_at(int index);

#endif
