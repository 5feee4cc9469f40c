/* Between states (io/session/state.h) and what they are states of: options, pictures. */
#ifndef ANG_APP_PICTURE_STATE_H
#define ANG_APP_PICTURE_STATE_H

#include "app/options.h"
#include "app/picture.h"
#include "io/load.h"
#include "io/session/state.h"

/* Options of the command line with those of the state that --state names, for what the command line leaves open. Clear
 * with ang_stated_clear. Not to be moved: `options` borrows from the rest. */
typedef struct ang_stated {
    ang_options options;
    ang_state state; /* ang_state_default without --state */
    char series[12], phase[12];
    const char *arguments[2];
} ang_stated;

/* Reads options->state, where it is given, and the options of render or report that result from it; for report, which
 * compares methods, without that of the state. False with ANG_USAGE naming the file, ANG_INPUT where its data are not
 * there, ANG_LIMIT. */
bool ang_stated_open(ang_verb verb, const ang_options *options, ang_stated *stated, ang_error *err);
/* Gives the state's preset, where there is one and the command line names none, to a picture that has none yet. */
void ang_stated_hand_preset(ang_stated *stated, ang_picture *picture);
void ang_stated_clear(ang_stated *stated);

/* Offers what a state says of a picture to options of render, which borrow it. False with ANG_USAGE: `file` (the
 * state's) and the option. */
bool ang_state_offer(const ang_state *state, const char *file, ang_options *options, ang_error *err);
/* Whether the data are those that the state was saved of, as far as it says; else a sentence goes to `warnings`. */
bool ang_state_matches(const ang_state *state, const ang_load_report *report, ang_notes *warnings);

/* The state of a picture as JSON text to go into its file: what repeats it, nothing that may identify a patient. NULL
 * with ANG_LIMIT. Free with free(). */
char *ang_picture_state_print(const ang_options *options, const ang_picture *picture, const ang_method *method,
                              const ang_load_report *report, ang_error *err);

#endif
