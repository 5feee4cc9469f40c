/* The three slice planes, as they are turned against the patient. */
#ifndef ANG_UI_PLANES_H
#define ANG_UI_PLANES_H

#include <stdbool.h>

typedef struct ang_viewer ang_viewer;

/* Brings slices alone up to date with the document's turn, for what is shown anew. */
void ang_planes_take(ang_viewer *viewer);
/* Brings slices, views and crosshair up to date with the document's turn: what lies under the crosshair stays where it
 * is in each pane. Cheap where nothing has changed. */
void ang_planes_follow(ang_viewer *viewer);

/* Actions. */
void ang_planes_turn(ang_viewer *viewer,
                     int degrees); /* about the normal of the slice that keys apply to, else axial */
void ang_planes_straighten(ang_viewer *viewer, int argument);
bool ang_planes_turned(const ang_viewer *viewer);

#endif
