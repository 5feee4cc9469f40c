#include "io/gnuplot.h"

#ifdef ANG_WITH_GNUPLOT

#include "io/text.h"

#include <errno.h>
#include <spawn.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

/* The build's path first: it is what was tested; then wherever the shell would find it. */
static const char *program(void) { return access(ANG_WITH_GNUPLOT, X_OK) == 0 ? ANG_WITH_GNUPLOT : "gnuplot"; }

/* Starts gnuplot on three files. 0 or the system's reason. */
static int start(FILE *script, FILE *out, FILE *complaints, pid_t *child) {
    extern char **environ;
    posix_spawn_file_actions_t files;
    int reason = posix_spawn_file_actions_init(&files);
    if (reason) return reason;
    posix_spawn_file_actions_adddup2(&files, fileno(script), 0);
    posix_spawn_file_actions_adddup2(&files, fileno(out), 1);
    posix_spawn_file_actions_adddup2(&files, fileno(complaints), 2);
    char name[] = "gnuplot", no_start_up[] = "-d", standard_input[] = "-";
    char *arguments[] = {name, no_start_up, standard_input, NULL};
    reason = posix_spawnp(child, program(), &files, NULL, arguments, environ);
    posix_spawn_file_actions_destroy(&files);
    return reason;
}

/* All of a file as a string; NULL where memory is out. */
static char *contents(FILE *file) {
    fseek(file, 0, SEEK_END);
    long size = ftell(file);
    rewind(file);
    char *text = size >= 0 ? malloc((size_t)size + 1) : NULL;
    if (text) text[fread(text, 1, (size_t)size, file)] = '\0';
    return text;
}

/* The first line with letters of what gnuplot said. */
static void complain(FILE *complaints, ang_error *err) {
    char *text = contents(complaints);
    const char *line = text ? strpbrk(text, "abcdefghijklmnopqrstuvwxyz") : NULL;
    int length = line ? (int)strcspn(line, "\n") : 0;
    ang_fail(err, ANG_OUTPUT, "gnuplot made no plot%s%.*s", line ? ": " : "", length, line ? line : "");
    ang_text_clean(err->message);
    free(text);
}

/* gnuplot does not notice where a disk is full. */
static bool whole(const char *svg) {
    const char *last = strrchr(svg, '<');
    return !svg[0] || (last && strncmp(last, "</svg>", 6) == 0);
}

static bool run(FILE *script, FILE *out, FILE *complaints, char **result, ang_error *err) {
    pid_t child;
    int reason = start(script, out, complaints, &child), status = 0;
    if (reason) return ang_fail(err, ANG_OUTPUT, "gnuplot cannot be started (%s)", strerror(reason));
    while (waitpid(child, &status, 0) < 0)
        if (errno != EINTR) return ang_fail(err, ANG_OUTPUT, "gnuplot was lost (%s)", strerror(errno));
    if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) {
        complain(complaints, err);
        return false;
    }
    *result = contents(out);
    if (!*result) return ang_fail(err, ANG_LIMIT, "no memory for a plot");
    if (whole(*result)) return true;
    free(*result);
    *result = NULL;
    return ang_fail(err, ANG_OUTPUT, "a plot was not written to its end; is there space for temporary files?");
}

/* Files instead of pipes: neither side can wait for the other. */
bool ang_gnuplot_run(const char *text, char **result, ang_error *err) {
    *result = NULL;
    FILE *script = tmpfile(), *out = tmpfile(), *complaints = tmpfile();
    bool good = script && out && complaints && fputs(text, script) >= 0 && fflush(script) == 0;
    if (good) {
        rewind(script);
        good = run(script, out, complaints, result, err);
    } else {
        ang_fail(err, ANG_OUTPUT, "no room for temporary files (%s)", strerror(errno));
    }
    if (script) fclose(script);
    if (out) fclose(out);
    if (complaints) fclose(complaints);
    return good;
}

bool ang_gnuplot_there(const char **why) {
    ang_error err = {0};
    char *nothing = NULL;
    bool there = ang_gnuplot_run("set terminal svg\n", &nothing, &err);
    free(nothing);
    *why = there ? NULL : "gnuplot cannot be run on this machine; install the package gnuplot-nox";
    return there;
}

#else

#include <stddef.h>

bool ang_gnuplot_run(const char *script, char **out, ang_error *err) {
    (void)script;
    *out = NULL;
    return ang_fail(err, ANG_USAGE, "this build has no gnuplot (ANG_WITH_GNUPLOT), which makes the plots");
}

bool ang_gnuplot_there(const char **why) {
    *why = "this build has no gnuplot (ANG_WITH_GNUPLOT), which makes the plots";
    return false;
}

#endif
