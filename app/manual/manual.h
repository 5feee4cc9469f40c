/* What is generated from the tables of verbs and options: the manual page and the completions of shells. */
#ifndef ANG_APP_MANUAL_MANUAL_H
#define ANG_APP_MANUAL_MANUAL_H

#include "app/option_table.h"
#include "app/verb_table.h"

#include <stdio.h>

void ang_manual_man(FILE *out);
void ang_manual_bash(FILE *out);
void ang_manual_zsh(FILE *out);
void ang_manual_fish(FILE *out);

/* What a shell may offer for an option's value. */
typedef enum ang_value_kind {
    ANG_VALUE_NONE,  /* a flag */
    ANG_VALUE_WORDS, /* one of the words */
    ANG_VALUE_FILE,
    ANG_VALUE_FOLDER,
    ANG_VALUE_PRESET, /* a preset's name, or a file */
    ANG_VALUE_OTHER   /* nothing that could be listed */
} ang_value_kind;
/* `words` (NULL without any) are separated by |. */
ang_value_kind ang_value_of(const ang_option *option, const char **words);

/* The first sentence or clause of an option's help, for lists of one line each. Valid until the next call. */
const char *ang_manual_brief(const ang_option *option);

/* Calls `take` for each of the words separated by |, in a buffer of its own. */
void ang_manual_words(const char *words, void (*take)(FILE *out, const char *word), FILE *out);
/* The words separated by spaces. */
void ang_manual_spaced(const char *words, FILE *out);

#endif
