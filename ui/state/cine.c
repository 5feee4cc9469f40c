#include "ui/state/cine.h"

#include <math.h>

static const double rates[] = {1, 2, 3, 5, 8, 10, 12, 15, 20, 25, 30, 40, 50, 60};
enum { rate_count = sizeof rates / sizeof *rates };

const ang_cine ang_cine_default = {.per_second = 15, .direction = 1};

void ang_cine_start(ang_cine *cine, int pane, double now) {
    cine->running = true;
    cine->pane = pane;
    cine->direction = 1;
    cine->due_seconds = now + 1 / cine->per_second;
}

void ang_cine_set_faster(ang_cine *cine, int direction, double now) {
    int at = 0;
    while (at + 1 < rate_count && rates[at + 1] <= cine->per_second) at++;
    at += direction;
    cine->per_second = rates[at < 0 ? 0 : at >= rate_count ? rate_count - 1 : at];
    cine->due_seconds = now + 1 / cine->per_second;
}

int ang_cine_due(ang_cine *cine, double now) {
    static const double most = 1e6; /* after a long sleep; any number of steps would do */
    if (!cine->running || now < cine->due_seconds) return 0;
    double steps = fmin(floor((now - cine->due_seconds) * cine->per_second) + 1, most);
    cine->due_seconds = steps < most ? cine->due_seconds + steps / cine->per_second : now + 1 / cine->per_second;
    return (int)steps;
}

int ang_cine_advance(ang_cine *cine, int index, int count, int steps) {
    if (!cine->back_and_forth) return (index + steps) % count;
    int last = count - 1;
    if (last == 0) return 0;
    /* There and back again is one round of 2 * last steps. */
    int on_round = cine->direction > 0 ? index : 2 * last - index;
    on_round = (on_round + steps) % (2 * last);
    cine->direction = on_round < last ? 1 : -1;
    return on_round <= last ? on_round : 2 * last - on_round;
}
