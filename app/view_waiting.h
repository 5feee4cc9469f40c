/* A state that was opened and waits for its data to be read. */
#ifndef ANG_APP_VIEW_WAITING_H
#define ANG_APP_VIEW_WAITING_H

#include "app/options.h"
#include "io/load.h"
#include "io/session/state.h"
#include "ui/viewer.h"

/* One thread at a time: the window's, or while it waits the loader's. Clear with ang_waiting_clear. */
typedef struct ang_waiting {
    const ang_options *options;
    ang_state state; /* ang_state_default, without a preset: there is none */
    char *file;      /* that it was read from */
    bool over;       /* what is being read is what the state names, or what --state was given beside */
    char series[12];
} ang_waiting;

/* Reads a state, instead of what was there. False as ang_state_read, and there is none. */
bool ang_waiting_read(ang_waiting *waiting, const char *file, ang_error *err);
/* Where its data are, into `path`. False with ANG_INPUT where it does not say, or they are not there; it still waits.
 */
bool ang_waiting_data(const ang_waiting *waiting, char *path, size_t size, ang_error *err);
/* How `path` is read: as the options say, else as the state does; borrows from `waiting`. */
ang_load_options ang_waiting_load_options(ang_waiting *waiting, const char *path);
/* As `session` of ang_viewer_host: after this none waits. */
bool ang_waiting_session(ang_waiting *waiting, const ang_study *study, ang_session *session, ang_error *err);
void ang_waiting_clear(ang_waiting *waiting);

#endif
