/* Every option of the command line in one table, which drives parsing and help. */
#ifndef ANG_APP_OPTIONS_H
#define ANG_APP_OPTIONS_H

#include "core/base/error.h"

#include <stdbool.h>
#include <stdio.h>

/* Verbs as a set of bits, so that an option can belong to several. */
typedef enum ang_verb {
    ANG_VERB_INFO = 1,
    ANG_VERB_RENDER = 2,
    ANG_VERB_PRESETS = 4,
    ANG_VERB_PHANTOM = 8,
    ANG_VERB_CHECK = 16,
    ANG_VERB_SELFCHECK = 32,
    ANG_VERB_REPORT = 64,
    ANG_VERB_VIEW = 128,
} ang_verb;

enum { ANG_MOST_OPTIONS = 128, ANG_LONGEST_OPTION = 16384 /* a value as text: --measure with all its digits */ };

/* The values, with the table's defaults where not given. Strings are borrowed from argv or from the table. */
typedef struct ang_options {
    const char *output;
    const char *series, *preset, *method, *mode, *shading, *size, *view, *pan, *projection, *clip, *clip_plane,
        *background;
    const char *backend, *json, *raw_dims, *raw_type, *raw_spacing, *dims, *spacing, *heat, *proxy, *bricks, *gradients,
        *skipping, *cut_plane, *measure, *force, *state, *write_state, *pictures, *classification, *sweep;
    const char *cases;
    double scale, shift, iso, step, zoom, termination, fov, orbit, noise, gpu_memory, threshold, time_limit, max_error,
        max_time, fps; /* NaN where not given and without default */
    int frames, repeat, threads, seed, pass_steps, quads, phase, every;
    bool no_termination, no_skip, count_shown, separate_passes, show_bricks, axes, explain, manual_filter, strict,
        no_sandbox, annotate, keep_phi, replace, quiet, verbose, help, json_flag;
    bool series_remembered, phase_remembered, raw_remembered; /* of a state: see ang_load_options */
    const char **arguments;                                   /* what is not an option, NULL at the end */
    int argument_count;
    bool given[ANG_MOST_OPTIONS]; /* on the command line, in the order of the table */
} ang_options;

/* Reads argv[first...] for one verb. Reorders argv as getopt does. False with ANG_USAGE naming the option. `options->
 * arguments` points into argv. */
bool ang_options_parse(ang_verb verb, int argc, char **argv, ang_options *options, ang_error *err);

/* Gives an option of a verb, called `name`, the value `text`, "" for a flag, unless the command line gave it one.
 * Borrows `text`. False with ANG_USAGE where there is no such option or it cannot have that value. */
bool ang_options_offer(ang_verb verb, ang_options *options, const char *name, const char *text, ang_error *err);

/* Whether the command line gave the option of a verb that is called `name`. */
bool ang_options_given(ang_verb verb, const ang_options *options, const char *name);

/* Calls `take` with every option of a verb and its value as text, "" where it is not given: all that was asked for, for
 * those who must know whether it is what was asked for before. */
void ang_options_each(ang_verb verb, const ang_options *options,
                      void (*take)(void *context, const char *name, const char *value), void *context);

/* Prints the options of a verb: name, argument, default, range and help. */
void ang_options_help(ang_verb verb, FILE *out);

#endif
