#include "ui/panes/interruption.h"

static bool going_on(void *context, const char *what, double fraction) {
    (void)what;
    (void)fraction;
    ang_interruption *input = context;
    if (pthread_equal(pthread_self(), input->thread) && ang_window_pending(input->window))
        atomic_store(&input->came, true);
    return !atomic_load(&input->came);
}

ang_progress ang_interruption_start(ang_interruption *interruption, ang_window *window) {
    interruption->window = window;
    interruption->thread = pthread_self();
    atomic_init(&interruption->came, false);
    return (ang_progress){going_on, interruption};
}
