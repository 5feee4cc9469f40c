#include "app/verbs.h"

#include <signal.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

typedef struct verb_entry {
    const char *name;
    ang_verb verb;
    int (*run)(const ang_options *, ang_error *);
    const char *usage;
    const char *summary;
} verb_entry;

static const verb_entry verbs[] = {
    {"view", ANG_VERB_VIEW, ang_app_view, "[view] [PATH...] [options]", "a window with slices and volume rendering"},
    {"info", ANG_VERB_INFO, ang_app_info, "info PATH [options]", "what is in a folder or file, and what was assumed"},
    {"render", ANG_VERB_RENDER, ang_app_render, "render PATH -o OUT.png [options]", "a picture of a volume"},
    {"report", ANG_VERB_REPORT, ang_app_report, "report PATH -o DIR [options]",
     "error against run time, all methods, as a page to read"},
    {"presets", ANG_VERB_PRESETS, ang_app_presets, "presets list|show|import|export|sheet ...",
     "the presets there are; from and for 3D Slicer; a sheet of their pictures"},
    {"phantom", ANG_VERB_PHANTOM, ang_app_phantom, "phantom -o DIR [options]",
     "a synthetic head CTA as a DICOM series"},
    {"check", ANG_VERB_CHECK, ang_app_check, "check A.png B.png [options]", "how far two pictures differ"},
    {"selfcheck", ANG_VERB_SELFCHECK, ang_app_selfcheck, "selfcheck [options]",
     "stiff and extreme scenes on this machine's OpenGL"},
};
enum { verb_count = sizeof verbs / sizeof *verbs };

static void print_usage(FILE *out) {
    fprintf(out, "angioscope " ANG_VERSION ", a viewer for CT and CT-angiography volumes. Not for diagnosis.\n\n");
    for (int i = 0; i < verb_count; i++) fprintf(out, "  angioscope %-42s %s\n", verbs[i].usage, verbs[i].summary);
    fprintf(out, "\n'angioscope VERB --help' lists the options of a verb.\n"
                 "Exit codes: 0 ok, 1 pictures differ, 2 usage, 3 input, 4 geometry, 5 no OpenGL, 6 memory, 7 output, "
                 "130 interrupted.\n");
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
static int run_verb(const verb_entry *verb, int argc, char **argv) {
    ang_options options;
    ang_error err = {0};
    int code = ANG_USAGE;
    if (ang_options_parse(verb->verb, argc, argv, &options, &err)) {
        if (options.help) {
            printf("angioscope %s\n%s\n\n", verb->usage, verb->summary);
            ang_options_help(verb->verb, stdout);
            return finish(ANG_OK);
        }
        code = verb->run(&options, &err);
    }
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
    /* A closed pipe is an output that cannot be written, not a reason to die. */
    signal(SIGPIPE, SIG_IGN);
    if (argc < 2) {
        if (has_display()) return run_verb(&verbs[0], argc, argv);
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
    for (int i = 0; i < verb_count; i++)
        if (strcmp(argv[1], verbs[i].name) == 0) return run_verb(&verbs[i], argc - 1, argv + 1);
    /* What is there to be opened needs no verb, nor do options. */
    if (argv[1][0] == '-' || access(argv[1], F_OK) == 0) return run_verb(&verbs[0], argc, argv);
    if (strchr(argv[1], '/')) {
        fprintf(stderr, "angioscope: %s: there is no such file or folder\n", argv[1]);
        return ANG_INPUT;
    }
    fprintf(stderr, "angioscope: there is neither a verb nor a file '%s'; 'angioscope --help' lists the verbs\n",
            argv[1]);
    return ANG_USAGE;
}
