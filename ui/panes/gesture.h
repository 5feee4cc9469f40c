/* A drag on a pane: what it began with, and taking it back. */
#ifndef ANG_UI_GESTURE_H
#define ANG_UI_GESTURE_H

#include "ui/state/document.h"

typedef struct ang_viewer ang_viewer;

/* What a drag began with. */
typedef struct ang_gesture {
    int pane; /* ang_pane, -1: none */
    ang_document before;
    bool bends;        /* the preset is shifted and stretched */
    bool strengthens;  /* its opacity is */
    bool turns;        /* the slice planes are turned */
    double turned_deg; /* so far */
    double slices;     /* scrolled so far */
    bool cancelled;
} ang_gesture;

/* Takes back a drag that is under way; false where there is none. */
bool ang_gesture_cancel(ang_viewer *viewer);

#endif
