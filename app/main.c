#include "app/verb_table.h"
#include "app/verbs.h"
#include "io/text.h"

#include <signal.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static int run_entry(const ang_verb_entry *entry, const ang_options *options, ang_error *err) {
    switch (entry->verb) {
    case ANG_VERB_VIEW:
        return ang_app_view(options, err);
    case ANG_VERB_INFO:
        return ang_app_info(options, err);
    case ANG_VERB_RENDER:
        return ang_app_render(options, err);
    case ANG_VERB_REPORT:
        return ang_app_report(options, err);
    case ANG_VERB_PRESETS:
        return ang_app_presets(options, err);
    case ANG_VERB_PHANTOM:
        return ang_app_phantom(options, err);
    case ANG_VERB_CHECK:
        return ang_app_check(options, err);
    case ANG_VERB_SELFCHECK:
        return ang_app_selfcheck(options, err);
    }
    return ANG_USAGE;
}

static void print_usage(FILE *out) {
    fprintf(out, "angioscope " ANG_VERSION ", a viewer for CT and CT-angiography volumes. Not for diagnosis.\n\n");
    for (int i = 0; i < ang_verb_count; i++)
        fprintf(out, "  angioscope %-42s %s\n", ang_verb_table[i].usage, ang_verb_table[i].summary);
    fprintf(out, "\n'angioscope VERB --help' lists the options of a verb.\nExit codes:");
    for (int i = 0; i < ang_exit_code_count; i++)
        fprintf(out, "%s %d %s", i ? "," : "", ang_exit_codes[i].code, ang_exit_codes[i].brief);
    fprintf(out, ".\n");
}

/* The exit code, or ANG_OUTPUT where what was printed did not arrive. */
static int finish(int code) {
    if (code == ANG_OK && (fflush(stdout) != 0 || ferror(stdout))) {
        fprintf(stderr, "angioscope: standard output cannot be written\n");
        return ANG_OUTPUT;
    }
    return code;
}

/* `argv[0]` is the verb or, where none is given, the program. */
static int run_verb(const ang_verb_entry *verb, int argc, char **argv) {
    ang_options options;
    ang_error err = {0};
    int code = ANG_USAGE;
    if (ang_options_parse(verb->verb, argc, argv, &options, &err)) {
        if (options.help) {
            printf("angioscope %s\n%s\n\n", verb->usage, verb->summary);
            ang_options_help(verb->verb, stdout);
            return finish(ANG_OK);
        }
        code = run_entry(verb, &options, &err);
    }
    ang_text_clean(err.message); /* names and headers of files may hold what moves a terminal's cursor */
    if (code != ANG_OK && err.message[0]) fprintf(stderr, "angioscope: %s\n", err.message);
    return finish(code);
}

static bool has_display(void) {
    const char *names[] = {"DISPLAY", "WAYLAND_DISPLAY"};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        const char *value = getenv(names[i]);
        if (value && value[0]) return true;
    }
    return false;
}

int main(int argc, char **argv) {
    /* A closed pipe or a file that may not grow is an output that cannot be written, not a reason to die. */
    signal(SIGPIPE, SIG_IGN);
    signal(SIGXFSZ, SIG_IGN);
    if (argc < 2) {
        if (has_display()) return run_verb(&ang_verb_table[0], argc, argv);
        print_usage(stderr);
        return ANG_USAGE;
    }
    if (strcmp(argv[1], "--help") == 0 || strcmp(argv[1], "-h") == 0 || strcmp(argv[1], "help") == 0) {
        print_usage(stdout);
        return finish(ANG_OK);
    }
    if (strcmp(argv[1], "--version") == 0) {
        puts("angioscope " ANG_VERSION);
        return finish(ANG_OK);
    }
    for (int i = 0; i < ang_verb_count; i++)
        if (strcmp(argv[1], ang_verb_table[i].name) == 0) return run_verb(&ang_verb_table[i], argc - 1, argv + 1);
    /* What is there to be opened needs no verb, nor do options. */
    if (argv[1][0] == '-' || access(argv[1], F_OK) == 0) return run_verb(&ang_verb_table[0], argc, argv);
    if (strchr(argv[1], '/')) {
        fprintf(stderr, "angioscope: %s: there is no such file or folder\n", argv[1]);
        return ANG_INPUT;
    }
    fprintf(stderr, "angioscope: there is neither a verb nor a file '%s'; 'angioscope --help' lists the verbs\n",
            argv[1]);
    return ANG_USAGE;
}
