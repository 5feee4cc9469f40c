/* The pane that keys apply to: the one that the pointer moved on last, or that F6 chose. */
#ifndef ANG_UI_FOCUS_H
#define ANG_UI_FOCUS_H

#include <stdbool.h>

typedef struct ang_viewer ang_viewer;

typedef struct ang_focus {
    int pane;    /* ang_pane */
    double x, y; /* the pointer in the last frame */
    bool by_key; /* F6 chose it: its frame is drawn thicker */
} ang_focus;

/* After the panes of a frame: the pointer may have moved onto another one. */
void ang_focus_follow(ang_viewer *viewer);
/* Arrows with modifiers: the crosshair or the camera, pan, gaps. False where the key is none of those. */
bool ang_focus_arrow(ang_viewer *viewer, int key, unsigned modifiers);

/* Actions, on that pane. */
void ang_focus_cycle(ang_viewer *viewer, int by); /* the next (1) or the last (-1); the side panel is one of them */
void ang_focus_scroll(ang_viewer *viewer, int slices);     /* the volume is zoomed instead */
void ang_focus_zoom(ang_viewer *viewer, int steps);        /* about its middle */
void ang_focus_reset(ang_viewer *viewer, int all);         /* its view; 1: that of each pane */
void ang_focus_maximise(ang_viewer *viewer, int argument); /* and back */
bool ang_focus_maximised(const ang_viewer *viewer, int argument);

#endif
