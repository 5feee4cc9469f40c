/* Plots by gnuplot, the program. */
#ifndef ANG_IO_GNUPLOT_H
#define ANG_IO_GNUPLOT_H

#include "core/base/error.h"

#include <stdbool.h>

/* Whether this build may use gnuplot (ANG_WITH_GNUPLOT) and the machine has it; else *why (static) says what is
 * missing. */
bool ang_gnuplot_there(const char **why);

/* Runs a script, which must set the terminal svg and write to standard output, without the user's or the system's
 * start-up files; *out is what came, a string to be freed with free(). False with ANG_OUTPUT and gnuplot's first words
 * where it fails or what it wrote is cut off, ANG_USAGE in a build without it, ANG_LIMIT. */
bool ang_gnuplot_run(const char *script, char **out, ang_error *err);

#endif
