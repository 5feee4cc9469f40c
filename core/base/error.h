/* One error object for every fallible call: filled where the failure is known best, shown once by the program. */
#ifndef ANG_BASE_ERROR_H
#define ANG_BASE_ERROR_H

#include <stdbool.h>

/* The kinds of failure; the values are the program's exit codes. */
typedef enum ang_code {
    ANG_OK = 0,
    ANG_CHECK_FAILED = 1,  /* two pictures differ by more than the threshold */
    ANG_USAGE = 2,         /* the command line or a preset is wrong */
    ANG_INPUT = 3,         /* input unreadable, or no 3D image series in it */
    ANG_GEOMETRY = 4,      /* geometry refused */
    ANG_GL = 5,            /* no usable OpenGL */
    ANG_LIMIT = 6,         /* memory or texture limit */
    ANG_OUTPUT = 7,        /* output not writable */
    ANG_INTERRUPTED = 130, /* the user interrupted long work */
} ang_code;

/* A failure: its code and one line that names the file, tag or option and says what to do. Plain value, no ownership.
 */
typedef struct ang_error {
    ang_code code;
    char message[1024];
} ang_error;

/* Fills `err` (which may be NULL) from a printf format without a trailing newline. Always returns false, so that a
 * fallible function can end with `return ang_fail(err, ...)`. */
bool ang_fail(ang_error *err, ang_code code, const char *format, ...) __attribute__((format(printf, 3, 4)));

#endif
