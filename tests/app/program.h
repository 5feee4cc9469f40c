/* The program as scripts use it. cmocka.h and what it needs must be included first. */
#ifndef ANG_TESTS_APP_PROGRAM_H
#define ANG_TESTS_APP_PROGRAM_H

#include <stdbool.h>
#include <stdio.h>
#include <sys/stat.h>
#include <sys/wait.h>

static char output[1 << 20];

/* Runs the program with arguments for the shell; stdout goes to `output`. Returns the exit code. */
static inline int run(const char *arguments) {
    char command[4096];
    snprintf(command, sizeof command, "%s %s", ANG_PROGRAM, arguments);
    FILE *pipe = popen(command, "r");
    assert_non_null(pipe);
    size_t length = fread(output, 1, sizeof output - 1, pipe);
    output[length] = '\0';
    int status = pclose(pipe);
    assert_true(WIFEXITED(status));
    return WEXITSTATUS(status);
}

/* Fails where the program ends otherwise. */
static inline void expect(int code, const char *arguments) {
    int actual = run(arguments);
    if (actual != code) fail_msg("angioscope %s: exit code %d, not %d; it said: %s", arguments, actual, code, output);
}

static inline bool exists(const char *path) {
    struct stat status;
    return stat(path, &status) == 0;
}

#endif
