/* Completion for bash, of use with the package bash-completion or without. */
#include "app/manual/manual.h"

static void print_names(FILE *out, ang_verb verb) {
    const ang_option *option;
    for (int i = 0; (option = ang_option_at(i)); i++) {
        if (!(option->verbs & verb)) continue;
        fprintf(out, " --%s", option->name);
        if (option->letter) fprintf(out, " -%c", option->letter);
    }
}

/* What to do where the word before the cursor is this option. */
static void print_value(FILE *out, const ang_option *option) {
    const char *words;
    ang_value_kind kind = ang_value_of(option, &words);
    if (kind == ANG_VALUE_NONE) return;
    fprintf(out, "        --%s", option->name);
    if (option->letter) fprintf(out, " | -%c", option->letter);
    fputs(") ", out);
    if (kind == ANG_VALUE_WORDS) {
        fputs("_angioscope_words \"", out);
        ang_manual_spaced(words, out);
        fputs("\" ;;\n", out);
    } else {
        fputs(kind == ANG_VALUE_FILE     ? "_angioscope_files -f ;;\n"
              : kind == ANG_VALUE_FOLDER ? "_angioscope_files -d ;;\n"
              : kind == ANG_VALUE_PRESET ? "_angioscope_presets ;;\n"
                                         : ": ;;\n",
              out);
    }
}

static void print_verb(FILE *out, const ang_verb_entry *verb) {
    fprintf(out, "    %s)\n        case $previous in\n", verb->name);
    const ang_option *option;
    for (int i = 0; (option = ang_option_at(i)); i++)
        if (option->verbs & verb->verb) print_value(out, option);
    fputs("        *) known=no ;;\n        esac\n        names=\"", out);
    print_names(out, verb->verb);
    fputs("\"\n        actions=\"", out);
    ang_manual_spaced(verb->actions, out);
    fprintf(out, "\" paths=%s\n        ;;\n", verb->paths ? "yes" : "no");
}

void ang_manual_bash(FILE *out) {
    fputs("# Completion of angioscope for bash, made from its tables of verbs and options.\n\n"
          "_angioscope_words() { COMPREPLY+=($(compgen -W \"$1\" -- \"$current\")); }\n\n"
          "_angioscope_files() {\n"
          "    local name\n"
          "    compopt -o filenames 2>/dev/null\n"
          "    while IFS= read -r name; do COMPREPLY+=(\"$name\"); done < <(compgen \"$1\" -- \"$current\")\n"
          "}\n\n"
          "_angioscope_presets() {\n"
          "    _angioscope_words \"$(\"$program\" presets list 2>/dev/null | awk 'NR > 1 { print $1 }')\"\n"
          "    _angioscope_files -f\n"
          "}\n\n"
          "_angioscope() {\n"
          "    local program=$1 current=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD - 1]}\n"
          "    local verb=",
          out);
    fprintf(out, "%s verbs=\"", ang_verb_table[0].name);
    for (int i = 0; i < ang_verb_count; i++) fprintf(out, "%s%s", i ? " " : "", ang_verb_table[i].name);
    fputs("\" names=\"\" actions=\"\" paths=yes known=yes\n"
          "    COMPREPLY=()\n"
          "    # --option=value comes as three words.\n"
          "    if [[ $current == = ]]; then\n"
          "        current=\"\"\n"
          "    elif [[ $previous == = && $COMP_CWORD -gt 2 ]]; then\n"
          "        previous=${COMP_WORDS[COMP_CWORD - 2]}\n"
          "    fi\n"
          "    if [[ $COMP_CWORD -gt 1 && \" $verbs \" == *\" ${COMP_WORDS[1]} \"* ]]; then verb=${COMP_WORDS[1]}; fi\n"
          "    case $verb in\n",
          out);
    for (int i = 0; i < ang_verb_count; i++) print_verb(out, &ang_verb_table[i]);
    fputs("    esac\n"
          "    [[ $known == yes ]] && return\n"
          "    if [[ $current == -* ]]; then\n"
          "        [[ $COMP_CWORD -eq 1 ]] && names+=\" --version\"\n"
          "        _angioscope_words \"$names\"\n"
          "        return\n"
          "    fi\n"
          "    if [[ $COMP_CWORD -eq 1 ]]; then _angioscope_words \"$verbs\"; fi\n"
          "    if [[ -n $actions && $COMP_CWORD -eq 2 ]]; then\n"
          "        _angioscope_words \"$actions\"\n"
          "    elif [[ -n $actions ]]; then\n"
          "        _angioscope_presets\n"
          "    elif [[ $paths == yes ]]; then\n"
          "        _angioscope_files -f\n"
          "    fi\n"
          "}\n\n"
          "complete -F _angioscope angioscope\n",
          out);
}
