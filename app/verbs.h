/* One function a verb of the command line, and what they share. Each returns an exit code. */
#ifndef ANG_APP_VERBS_H
#define ANG_APP_VERBS_H

#include "app/options.h"
#include "core/base/error.h"
#include "core/base/notes.h"
#include "core/base/progress.h"
#include "io/load.h"

int ang_app_info(const ang_options *options, ang_error *err);
int ang_app_render(const ang_options *options, ang_error *err);
int ang_app_report(const ang_options *options, ang_error *err);
int ang_app_presets(const ang_options *options, ang_error *err);
int ang_app_phantom(const ang_options *options, ang_error *err);
int ang_app_view(const ang_options *options, ang_error *err);
int ang_app_check(const ang_options *options, ang_error *err);
int ang_app_selfcheck(const ang_options *options, ang_error *err);

/* Where presets are looked for, NULL at the end; valid until the program ends. */
const char *const *ang_app_preset_folders(void);

/* How the options ask for input to be read; borrows from `options`. */
ang_load_options ang_app_load_options(const ang_options *options);

/* Progress on stderr: a bar on a terminal, else a line every 10 %; asks for a stop after SIGINT or SIGTERM.
 * NULL-context where `quiet`. */
typedef struct ang_app_progress ang_app_progress;
ang_app_progress *ang_app_progress_start(bool quiet);
const ang_progress *ang_app_progress_sink(const ang_app_progress *progress);
/* Ends the line on a terminal and frees. */
void ang_app_progress_end(ang_app_progress *progress);

/* Prints sentences to stderr, each with `prefix`; files are named: stderr is for the person who runs the program. What
 * `err` (NULL: none) is going to say is left out. */
void ang_app_say(const ang_notes *notes, const char *prefix, const ang_error *err);
/* Whether `count` arguments are there that are no options. False with ANG_USAGE: `wanted` says what they should be. */
bool ang_app_arguments(const ang_options *options, int count, const char *wanted, ang_error *err);
/* "AxB" or "AxBxC" into `count` whole numbers from 1 to `most`. */
bool ang_app_parse_dims(const char *option, const char *text, int count, int most, int *out, ang_error *err);
/* Numbers separated by commas: at least `least`, at most `most`; how many came goes to *count. */
bool ang_app_parse_numbers(const char *option, const char *text, int least, int most, double *out, int *count,
                           ang_error *err);

#endif
