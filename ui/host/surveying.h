/* Finding out what series there are, on a thread of its own: the list first, then picture by picture. */
#ifndef ANG_UI_SURVEYING_H
#define ANG_UI_SURVEYING_H

#include "ui/viewer.h"

#include <pthread.h>

/* Zero-initialise. What the thread writes is guarded by `lock`. */
typedef struct ang_surveying {
    const ang_viewer_host *host;
    pthread_t thread;
    pthread_mutex_t lock;
    bool running; /* a thread is there, or was and has not been joined */
    ang_source source;
    bool finished, stop;   /* guarded */
    ang_series_list found; /* guarded */
    bool listed;           /* guarded: `found` has not been taken */
    size_t next;           /* guarded: entries before it have been taken with their pictures */
    size_t looked_at;      /* guarded: entries before it have been looked at */
    ang_error err;
} ang_surveying;

/* Begins; a copy of `source` is made. Not while one is running. False with ANG_LIMIT. */
bool ang_surveying_start(ang_surveying *surveying, const ang_viewer_host *host, const ang_source *source,
                         ang_error *err);
/* What has been found since the last call. `listed`: `list` has been made anew. Returns the index of an entry of it
 * that has been filled in, -1: none. To be called until there is nothing. */
int ang_surveying_take(ang_surveying *surveying, ang_series_list *list, bool *listed);
/* Whether it has come to its end, and all has been taken; then ends the thread. `err` says what went wrong: its code is
 * ANG_OK where nothing did. */
bool ang_surveying_finished(ang_surveying *surveying, ang_error *err);
void ang_surveying_stop(ang_surveying *surveying);
/* Stops and waits; lets go of everything. */
void ang_surveying_end(ang_surveying *surveying);

#endif
