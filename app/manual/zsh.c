/* Completion for zsh, through its _arguments. */
#include "app/manual/manual.h"

#include <string.h>

/* Text inside single quotes of the shell, where _arguments takes [ ] and : for its own. */
static void print_quoted(FILE *out, const char *text) {
    for (; *text; text++) {
        if (*text == '\'')
            fputs("'\\''", out);
        else if (strchr("[]:\\", *text))
            fprintf(out, "\\%c", *text);
        else
            fputc(*text, out);
    }
}

static void print_value(FILE *out, const ang_option *option) {
    const char *words;
    ang_value_kind kind = ang_value_of(option, &words);
    if (kind == ANG_VALUE_NONE) return;
    fputc(':', out);
    print_quoted(out, kind == ANG_VALUE_WORDS ? option->name : option->argument);
    switch (kind) {
    case ANG_VALUE_WORDS:
        fputs(":(", out);
        ang_manual_spaced(words, out);
        fputc(')', out);
        break;
    case ANG_VALUE_FILE:
        fputs(":_files", out);
        break;
    case ANG_VALUE_FOLDER:
        fputs(":_files -/", out);
        break;
    case ANG_VALUE_PRESET:
        fputs(":_angioscope_presets", out);
        break;
    default:
        fputs(": ", out);
    }
}

static void print_option(FILE *out, const ang_option *option) {
    bool value = option->type != FLAG;
    fputs("        ", out);
    if (option->letter)
        fprintf(out, "'(-%c --%s)'{-%c%s,--%s%s}'", option->letter, option->name, option->letter, value ? "+" : "",
                option->name, value ? "=" : "");
    else
        fprintf(out, "'--%s%s", option->name, value ? "=" : "");
    fputc('[', out);
    print_quoted(out, ang_manual_brief(option));
    fputc(']', out);
    print_value(out, option);
    fputs("' \\\n", out);
}

static void print_verb(FILE *out, const ang_verb_entry *verb) {
    fprintf(out, "    %s)\n        _arguments -s -S : \\\n", verb->name);
    const ang_option *option;
    for (int i = 0; (option = ang_option_at(i)); i++)
        if (option->verbs & verb->verb) print_option(out, option);
    if (verb->actions) {
        fputs("        '1:action:(", out);
        ang_manual_spaced(verb->actions, out);
        fputs(")' '*:preset:_angioscope_presets'\n", out);
    } else {
        fprintf(out, "        '%s'\n", verb->paths ? "*:path:_files" : "*:: :");
    }
    fputs("        ;;\n", out);
}

void ang_manual_zsh(FILE *out) {
    fputs("#compdef angioscope\n"
          "# Completion of angioscope for zsh, made from its tables of verbs and options.\n\n"
          "_angioscope_presets() {\n"
          "    local -a presets\n"
          "    presets=(${(f)\"$(_call_program presets $program presets list 2>/dev/null | awk 'NR > 1 { print $1 "
          "}')\"})\n"
          "    _alternative \"presets:preset:($presets)\" 'files:file:_files'\n"
          "}\n\n"
          "_angioscope() {\n"
          "    local curcontext=$curcontext program=$words[1] verb=",
          out);
    fprintf(out, "%s ret=1\n    local -a verbs\n    typeset -A opt_args\n    verbs=(\n", ang_verb_table[0].name);
    for (int i = 0; i < ang_verb_count; i++) {
        fprintf(out, "        '%s:", ang_verb_table[i].name);
        print_quoted(out, ang_verb_table[i].summary);
        fputs("'\n", out);
    }
    fputs("    )\n"
          "    if (( CURRENT == 2 )) && [[ $words[2] != -* ]]; then\n"
          "        _describe verb verbs && ret=0\n"
          "        _files && ret=0\n"
          "        return ret\n"
          "    fi\n"
          "    if (( CURRENT > 2 && $verbs[(I)$words[2]:*] )); then\n"
          "        verb=$words[2]\n"
          "        shift words\n"
          "        (( CURRENT-- ))\n"
          "    fi\n"
          "    case $verb in\n",
          out);
    for (int i = 0; i < ang_verb_count; i++) print_verb(out, &ang_verb_table[i]);
    fputs("    esac\n}\n\n_angioscope \"$@\"\n", out);
}
