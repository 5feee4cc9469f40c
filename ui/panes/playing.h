/* What cine does to the panes: the slices of one go by, or the volume turns. */
#ifndef ANG_UI_PLAYING_H
#define ANG_UI_PLAYING_H

#include "ui/state/layout.h"

typedef struct ang_viewer ang_viewer;

void ang_playing_stop(ang_viewer *viewer);
/* Takes the steps that are due; once a frame, before panes are drawn. */
void ang_playing_step(ang_viewer *viewer);
/* Seconds until the next; infinite where nothing plays. */
double ang_playing_next_in(const ang_viewer *viewer);
/* The volume turns by itself: not a state to be kept for undo. */
bool ang_playing_volume(const ang_viewer *viewer);
/* The rate in the pane's corner, `line` lines above the lowest. */
void ang_playing_write(ang_viewer *viewer, ang_pane pane, ang_rect rect, int line);

/* Actions: in the pane that keys apply to, or stops it there; 1: faster, -1: slower. */
void ang_playing_toggle(ang_viewer *viewer, int argument);
void ang_playing_faster(ang_viewer *viewer, int direction);

#endif
