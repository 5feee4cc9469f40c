#include "app/manual/manual.h"

#include <string.h>

ang_value_kind ang_value_of(const ang_option *option, const char **words) {
    static const struct {
        const char *argument;
        ang_value_kind kind;
        const char *words;
    } known[] = {
        {"FILE", ANG_VALUE_FILE, NULL},
        {"FILE|-", ANG_VALUE_FILE, NULL},
        {"OUT", ANG_VALUE_FILE, NULL},
        {"OUT.png", ANG_VALUE_FILE, NULL},
        {"DIR", ANG_VALUE_FOLDER, NULL},
        {"NAME|FILE", ANG_VALUE_PRESET, NULL},
        {"VIEW", ANG_VALUE_WORDS, "anterior|posterior|left|right|superior|inferior"},
        {"TYPE", ANG_VALUE_WORDS, "u8|i8|u16|i16|f32"},
    };
    *words = NULL;
    if (option->type == FLAG) return ANG_VALUE_NONE;
    if (option->type == CHOICE) {
        *words = option->argument;
        return ANG_VALUE_WORDS;
    }
    for (size_t i = 0; i < sizeof known / sizeof *known; i++) {
        if (strcmp(known[i].argument, option->argument) != 0) continue;
        *words = known[i].words;
        return known[i].kind;
    }
    return ANG_VALUE_OTHER;
}

const char *ang_manual_brief(const ang_option *option) {
    static char text[160];
    size_t length = strcspn(option->help, ";");
    if (length > sizeof text - 1) length = sizeof text - 1;
    snprintf(text, sizeof text, "%.*s", (int)length, option->help);
    return text;
}

void ang_manual_words(const char *words, void (*take)(FILE *out, const char *word), FILE *out) {
    char word[64];
    while (words && *words) {
        size_t length = strcspn(words, "|");
        snprintf(word, sizeof word, "%.*s", (int)length, words);
        take(out, word);
        words += length + (words[length] == '|');
    }
}

void ang_manual_spaced(const char *words, FILE *out) {
    for (; words && *words; words++) fputc(*words == '|' ? ' ' : *words, out);
}
