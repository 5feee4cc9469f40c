/* The panes while the first study is read: its slices as they arrive. */
#ifndef ANG_UI_ARRIVING_H
#define ANG_UI_ARRIVING_H

#include "ui/state/layout.h"

typedef struct ang_viewer ang_viewer;

/* An empty panel and dark panes; the slice that was read last fills the first that has room, as its file holds it. */
void ang_arriving_show(ang_viewer *viewer, const ang_layout_places *places);

#endif
