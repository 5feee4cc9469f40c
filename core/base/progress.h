/* How long work tells what it is doing and learns that it should stop. */
#ifndef ANG_BASE_PROGRESS_H
#define ANG_BASE_PROGRESS_H

#include <stdbool.h>
#include <stddef.h>

/* `update` is called with a short present participle ("reading slices") and the share done in [0, 1]; it returns false
 * to ask for a stop. It may be called from any thread and must be thread safe. */
typedef struct ang_progress {
    bool (*update)(void *context, const char *what, double fraction);
    void *context;
} ang_progress;

/* True to go on. A NULL `progress`, or one without a function, always goes on. */
static inline bool ang_progress_update(const ang_progress *progress, const char *what, double fraction) {
    return !progress || !progress->update || progress->update(progress->context, what, fraction);
}

#endif
