/* Completion for fish. */
#include "app/manual/manual.h"

/* In single quotes fish knows \' and \\ alone. */
static void print_quoted(FILE *out, const char *text) {
    fputc('\'', out);
    for (; *text; text++) {
        if (*text == '\'' || *text == '\\') fputc('\\', out);
        fputc(*text, out);
    }
    fputc('\'', out);
}

static void print_value(FILE *out, const ang_option *option) {
    const char *words;
    switch (ang_value_of(option, &words)) {
    case ANG_VALUE_NONE:
        break;
    case ANG_VALUE_WORDS:
        fputs(" -x -a '", out);
        ang_manual_spaced(words, out);
        fputc('\'', out);
        break;
    case ANG_VALUE_FILE:
        fputs(" -r -F", out);
        break;
    case ANG_VALUE_FOLDER:
        fputs(" -x -a '(__fish_complete_directories)'", out);
        break;
    case ANG_VALUE_PRESET:
        fputs(" -r -F -a '(__angioscope_presets)'", out);
        break;
    case ANG_VALUE_OTHER:
        fputs(" -x", out);
        break;
    }
}

static void print_verb(FILE *out, const ang_verb_entry *verb) {
    const ang_option *option;
    for (int i = 0; (option = ang_option_at(i)); i++) {
        if (!(option->verbs & verb->verb)) continue;
        fprintf(out, "complete -c angioscope -n '__angioscope_verb %s' -l %s", verb->name, option->name);
        if (option->letter) fprintf(out, " -s %c", option->letter);
        print_value(out, option);
        fputs(" -d ", out);
        print_quoted(out, ang_manual_brief(option));
        fputc('\n', out);
    }
    if (verb->actions) {
        fprintf(out, "complete -c angioscope -n '__angioscope_verb %s; and __angioscope_words 2' -f -a '", verb->name);
        ang_manual_spaced(verb->actions, out);
        fprintf(out,
                "'\ncomplete -c angioscope -n '__angioscope_verb %s; and not __angioscope_words 2' -F -a "
                "'(__angioscope_presets)'\n",
                verb->name);
    } else if (!verb->paths) {
        fprintf(out, "complete -c angioscope -n '__angioscope_verb %s' -f\n", verb->name);
    }
}

void ang_manual_fish(FILE *out) {
    fputs("# Completion of angioscope for fish, made from its tables of verbs and options.\n\n"
          "function __angioscope_presets\n"
          "    set -l words (commandline -opc)\n"
          "    $words[1] presets list 2>/dev/null | awk 'NR > 1 { print $1 }'\n"
          "end\n\n"
          "# Whether this many words stand before the cursor's.\n"
          "function __angioscope_words\n"
          "    test (count (commandline -opc)) -eq $argv[1]\n"
          "end\n\n"
          "# Whether this verb is meant.\n"
          "function __angioscope_verb\n"
          "    set -l words (commandline -opc)\n"
          "    set -l verb ",
          out);
    fprintf(out, "%s\n    if test (count $words) -gt 1; and contains -- $words[2]", ang_verb_table[0].name);
    for (int i = 0; i < ang_verb_count; i++) fprintf(out, " %s", ang_verb_table[i].name);
    fputs("\n        set verb $words[2]\n"
          "    end\n"
          "    test $verb = $argv[1]\n"
          "end\n\n"
          "complete -c angioscope -n '__angioscope_words 1' -l version -d 'print the version'\n",
          out);
    for (int i = 0; i < ang_verb_count; i++) {
        fprintf(out, "complete -c angioscope -n '__angioscope_words 1' -a %s -d ", ang_verb_table[i].name);
        print_quoted(out, ang_verb_table[i].summary);
        fputc('\n', out);
    }
    for (int i = 0; i < ang_verb_count; i++) print_verb(out, &ang_verb_table[i]);
}
