/* Long work on the window's thread that ends as soon as input comes. */
#ifndef ANG_UI_INTERRUPTION_H
#define ANG_UI_INTERRUPTION_H

#include "core/base/progress.h"
#include "ui/toolkit/window.h"

#include <pthread.h>
#include <stdatomic.h>

/* Methods ask from any of their threads; events may be looked for only on the one that opened the window, which is
 * among them. */
typedef struct ang_interruption {
    ang_window *window;
    pthread_t thread;
    atomic_bool came;
} ang_interruption;

/* From the window's thread. The progress borrows `interruption` and asks for a stop once there is input. */
ang_progress ang_interruption_start(ang_interruption *interruption, ang_window *window);

#endif
