/* The series of what has been opened, each with a picture of its middle slice and what the loader thinks of it. */
#ifndef ANG_UI_SERIES_BROWSER_H
#define ANG_UI_SERIES_BROWSER_H

#include "core/render/painter.h"
#include "ui/host/surveying.h"

typedef struct ang_viewer ang_viewer;

/* Zero-initialise; free with ang_series_browser_clear. */
typedef struct ang_series_browser {
    bool open, dates;
    ang_surveying surveying;
    ang_source source; /* that `list` is of */
    ang_series_list list;
    ang_paint_texture *picture; /* of each entry; of no name: none */
    int chosen;                 /* row */
    int looked_at;
    bool follow;       /* the list is to scroll to the chosen row */
    char failure[512]; /* why there is no list; empty: there is, or will be */
} ang_series_browser;

void ang_series_browser_show(ang_viewer *viewer);
/* Takes what has been found meanwhile, and begins to look where the browser is open. */
void ang_series_browser_step(ang_viewer *viewer);
/* Whether the key was for it. */
bool ang_series_browser_key(ang_viewer *viewer, int key, unsigned modifiers);
void ang_series_browser_clear(ang_viewer *viewer);

#endif
