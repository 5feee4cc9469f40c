/* A folder for a while, which nobody else may read and which does not outlive the program, however that ends. Private
 * to io/. */
#ifndef ANG_ARCHIVE_SCRATCH_H
#define ANG_ARCHIVE_SCRATCH_H

#include "core/base/error.h"

#include <sys/types.h>

typedef struct ang_scratch {
    char path[256]; /* below $TMPDIR or /tmp, with a name that cannot be foreseen; empty: none was made */
    int line;       /* held open while the folder is needed; -1: none */
    pid_t guard;    /* the process that waits for its end and removes the folder; 0: none */
} ang_scratch;

/* Makes the folder. A small process beside this one removes it where this one is killed. False with ANG_OUTPUT. Thread
 * safe. */
bool ang_scratch_make(ang_scratch *scratch, ang_error *err);
/* Removes the folder with all that is in it. */
void ang_scratch_remove(ang_scratch *scratch);

#endif
