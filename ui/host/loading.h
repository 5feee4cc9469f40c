/* Loading on a thread of its own, with progress and slices that the window shows, and a way to stop. */
#ifndef ANG_UI_LOADING_H
#define ANG_UI_LOADING_H

#include "ui/viewer.h"

#include <pthread.h>
#include <stdatomic.h>

/* Zero-initialise. What the thread writes is guarded by `lock`. */
typedef struct ang_loading {
    const ang_viewer_host *host;
    pthread_t thread;
    pthread_mutex_t lock;
    bool running; /* a thread is there, or was and has not been joined */
    ang_source source;
    bool finished, stop, done; /* guarded */
    char what[64];             /* guarded */
    double fraction;           /* guarded */
    double told_ms;            /* guarded: when the window was last woken */
    atomic_bool previewing;    /* some thread makes `next`, or it has not been taken yet */
    ang_preview *next;         /* that thread's, then guarded */
    size_t next_index, next_count;
    double pictured_ms; /* of the thread that makes `next`: when it last began */
    bool fresh;         /* guarded: `next` is to be taken */
    ang_study study;    /* the thread's until finished */
    ang_error err;
} ang_loading;

/* Begins to load; `source` is taken. False with ANG_LIMIT where no thread can be made. */
bool ang_loading_start(ang_loading *loading, const ang_viewer_host *host, ang_source *source, ang_error *err);
/* How far it is; copies what it does into `what`. */
double ang_loading_progress(ang_loading *loading, char what[64]);
/* A slice that has been read since the last call: copied to `preview`, with its place from 0 and how many there are.
 * False where there is none. */
bool ang_loading_preview(ang_loading *loading, ang_preview *preview, size_t *index, size_t *count);
/* Asks it to stop: it then finishes with ANG_INTERRUPTED. */
void ang_loading_stop(ang_loading *loading);
/* Whether it has been asked to. */
bool ang_loading_stopping(ang_loading *loading);
/* Whether it has finished; then ends the thread and gives its result: `done`, `source`, and `study` or `err`. */
bool ang_loading_take(ang_loading *loading, bool *done, ang_source *source, ang_study *study, ang_error *err);
/* Stops and waits; lets go of everything. */
void ang_loading_end(ang_loading *loading);

#endif
