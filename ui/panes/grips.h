/* The gaps between panel and panes, to be dragged. */
#ifndef ANG_UI_GRIPS_H
#define ANG_UI_GRIPS_H

#include "ui/state/layout.h"

typedef struct ang_viewer ang_viewer;

typedef struct ang_grips {
    ang_layout layout;
    ang_layout_frame frame; /* of the last window drawn */
    ang_layout before;      /* when `held` was taken hold of */
    int held;               /* ang_grip; -1: none */
} ang_grips;

/* What hands do with the gaps; to be called before anything that lies beside them. */
void ang_grips_show(ang_viewer *viewer, const ang_layout_places *places);
/* Takes back a drag that is under way; false where there is none. */
bool ang_grips_cancel(ang_viewer *viewer);
/* Moves the gaps between the panes by steps of a key. */
void ang_grips_step(ang_viewer *viewer, int right, int down);
/* Action: panes of equal size. */
void ang_grips_even(ang_viewer *viewer, int argument);

#endif
