/* The manual page, in the macros of man(7). */
#include "app/manual/manual.h"

#include <string.h>

/* Text in the body: what roff would take for its own is escaped. */
static void print_text(FILE *out, const char *text) {
    bool begins = true;
    for (; *text; text++) {
        if (begins && (*text == '.' || *text == '\'')) fputs("\\&", out);
        if (*text == '-')
            fputs("\\-", out);
        else if (*text == '\\')
            fputs("\\e", out);
        else if (*text == '~')
            fputs("\\(ti", out);
        else if (*text == '^')
            fputs("\\(ha", out);
        else
            fputc(*text, out);
        begins = *text == '\n';
    }
}

static void print_bold(FILE *out, const char *text) {
    fputs("\\fB", out);
    print_text(out, text);
    fputs("\\fR", out);
}

/* Capital words of a usage are what the user puts in. */
static void print_usage(FILE *out, const char *usage) {
    print_bold(out, "angioscope");
    while (*usage) {
        size_t length = strcspn(usage, " ");
        char word[64];
        snprintf(word, sizeof word, "%.*s", (int)length, usage);
        bool typed = (word[0] >= 'a' && word[0] <= 'z') || word[0] == '-';
        fputs(typed ? " \\fB" : " \\fI", out);
        print_text(out, word);
        fputs("\\fR", out);
        usage += length + (usage[length] == ' ');
    }
    fputc('\n', out);
}

static void print_verbs(FILE *out) {
    fputs(".SH VERBS\n", out);
    for (int i = 0; i < ang_verb_count; i++) {
        const ang_verb_entry *verb = &ang_verb_table[i];
        fprintf(out, ".SS %s\n", verb->name);
        print_usage(out, verb->usage);
        fputs(".PP\n", out);
        print_text(out, verb->about);
        fputs("\n.PP\nOptions:", out);
        const ang_option *option;
        bool first = true;
        for (int k = 0; (option = ang_option_at(k)); k++) {
            if (!(option->verbs & verb->verb)) continue;
            fputs(first ? "\n\\fB\\%\\-\\-" : ",\n\\fB\\%\\-\\-", out);
            print_text(out, option->name);
            fputs("\\fR", out);
            first = false;
        }
        fputs(".\n", out);
    }
}

static void print_range(FILE *out, const ang_option *option) {
    if (option->type == INTEGER || option->type == REAL) {
        char range[128];
        snprintf(range, sizeof range, " %s from %.10g to %.10g%s%s.",
                 option->type == REAL ? "A number" : "A whole number", option->min, option->max,
                 option->unit ? " " : "", option->unit ? option->unit : "");
        print_text(out, range);
    }
    if (option->initial) {
        fputs(" Default ", out);
        print_bold(out, option->initial);
        if (option->unit) fprintf(out, " %s", option->unit);
        fputc('.', out);
    }
}

static void print_options(FILE *out) {
    fputs(
        ".SH OPTIONS\nA value follows its option as the next word or after \\(lq=\\(rq. The verbs that take an option "
        "stand in parentheses.\n",
        out);
    const ang_option *option;
    for (int i = 0; (option = ang_option_at(i)); i++) {
        fputs(".TP\n", out);
        if (option->letter) fprintf(out, "\\fB\\-%c\\fR, ", option->letter);
        fputs("\\fB\\-\\-", out);
        print_text(out, option->name);
        fputs("\\fR", out);
        if (option->argument) {
            fputs(option->type == CHOICE ? " " : " \\fI", out);
            print_text(out, option->argument);
            fputs("\\fR", out);
        }
        fputs("\n(", out);
        const char *between = "";
        for (int k = 0; k < ang_verb_count; k++) {
            if (!(option->verbs & ang_verb_table[k].verb)) continue;
            fprintf(out, "%s%s", between, ang_verb_table[k].name);
            between = ", ";
        }
        fputs(") ", out);
        print_text(out, option->help);
        fputc('.', out);
        print_range(out, option);
        fputc('\n', out);
    }
    fputs(".TP\n\\fB\\-\\-version\\fR\nPrint the version; without a verb.\n", out);
}

static void print_pairs(FILE *out, const char *title, const char *const pairs[][2], size_t count) {
    fprintf(out, ".SH %s\n", title);
    for (size_t i = 0; i < count; i++) {
        fputs(".TP\n", out);
        print_bold(out, pairs[i][0]);
        fputc('\n', out);
        print_text(out, pairs[i][1]);
        fputc('\n', out);
    }
}

static void print_exit_codes(FILE *out) {
    fputs(".SH EXIT STATUS\n", out);
    for (int i = 0; i < ang_exit_code_count; i++) {
        fprintf(out, ".TP\n\\fB%d\\fR\n", ang_exit_codes[i].code);
        print_text(out, ang_exit_codes[i].meaning);
        fputc('\n', out);
    }
}

static const char *const environment[][2] = {
    {"XDG_CONFIG_HOME", "Folder of the user's settings; without it, $HOME/.config."},
    {"XDG_CACHE_HOME", "Folder of what can be measured again; without it, $HOME/.cache."},
    {"DISPLAY, WAYLAND_DISPLAY", "Where the window opens. No other verb than view needs a display."},
};
static const char *const files[][2] = {
    {"PREFIX/share/angioscope/presets", "Presets of the installation, one JSON file each."},
    {"$XDG_CONFIG_HOME/angioscope/presets", "The user's own presets; they hide those of the installation by name."},
    {"$XDG_CONFIG_HOME/angioscope/viewer.json", "The viewer's layout, theme and recent files."},
    {"$XDG_CACHE_HOME/angioscope/costs-*.json", "How fast this machine draws, for --max-time and --max-error."},
    {"PREFIX/lib/angioscope/angioscope-*.so", "Parts of the program that are opened when they are needed."},
    {".angioscope-*.part", "What an interrupted write leaves beside the file that it should have replaced. It is never "
                           "read and may be deleted."},
};
static const char *const examples[][2] = {
    {"angioscope /path/to/study", "Look at a study in a window."},
    {"angioscope info /path/to/study", "List its series and what was assumed in reading the largest."},
    {"angioscope render /path/to/study -o skull.png --preset ct-skull --view left --annotate",
     "A picture with letters, a scale and how wrong it may be."},
    {"angioscope render /path/to/study -o turn.png --preset cta-head --frames 36 --orbit 360",
     "36 pictures round the patient."},
    {"angioscope render /path/to/study -o out.exr --max-error 2 --json -",
     "The fastest picture within 2 levels of 255 of the exact one, and what it took as JSON."},
    {"angioscope phantom -o phantom && angioscope view phantom", "A study to try everything with."},
};
#define PAIRS(list) list, sizeof list / sizeof *list

void ang_manual_man(FILE *out) {
    fputs(".\\\" Made from the tables of verbs and options.\n"
          ".TH ANGIOSCOPE 1 " ANG_DATE " \"Angioscope " ANG_VERSION "\" \"User Commands\"\n"
          ".SH NAME\nangioscope \\- viewer for CT and CT\\-angiography volumes\n.SH SYNOPSIS\n",
          out);
    for (int i = 0; i < ang_verb_count; i++) {
        if (i > 0) fputs(".br\n", out);
        print_usage(out, ang_verb_table[i].usage);
    }
    fputs(".SH DESCRIPTION\n"
          "Shows CT and CT\\-angiography volumes as slices and volume renderings, in a window or as pictures made "
          "without "
          "one, with presets for what a radiologist wants to see. A picture can say how wrong it may be and what it "
          "cost.\n.PP\n"
          "Standard output carries only what was asked for; messages and progress go to standard error. Nothing that "
          "identifies a patient is written without \\fB\\-\\-keep\\-phi\\fR. Files are written whole or not at "
          "all.\n.PP\n"
          "Angioscope is not a medical device and not for diagnosis.\n",
          out);
    print_verbs(out);
    print_options(out);
    print_exit_codes(out);
    print_pairs(out, "ENVIRONMENT", PAIRS(environment));
    print_pairs(out, "FILES", PAIRS(files));
    print_pairs(out, "EXAMPLES", PAIRS(examples));
}
