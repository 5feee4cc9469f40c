/* Cine: slices, or views of the volume, one after another at a steady rate. Pure; times are seconds of a steady clock.
 */
#ifndef ANG_UI_CINE_H
#define ANG_UI_CINE_H

#include <stdbool.h>

typedef struct ang_cine {
    bool running;
    int pane;            /* ang_pane that plays */
    double per_second;   /* steps, 1..60 */
    bool back_and_forth; /* turns back at the ends; else begins at the first again */
    int direction;       /* 1, or -1 on the way back */
    double due_seconds;  /* when the next step is due */
} ang_cine;
extern const ang_cine ang_cine_default;

void ang_cine_start(ang_cine *cine, int pane, double now);
/* The next faster (1) or slower (-1) rate; what plays goes on from `now`. */
void ang_cine_set_faster(ang_cine *cine, int direction, double now);
/* The steps due since the last call, 0 or more: what the screen was too slow to show is left out, so that it never
 * lags. */
int ang_cine_due(ang_cine *cine, double now);
/* The index (0..count-1, count >= 1) to which that many steps lead. */
int ang_cine_advance(ang_cine *cine, int index, int count, int steps);

#endif
