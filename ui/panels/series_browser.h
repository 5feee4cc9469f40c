/* The series browser's state. */
#ifndef ANG_UI_SERIES_BROWSER_H
#define ANG_UI_SERIES_BROWSER_H

#include "core/render/painter.h"
#include "ui/host/surveying.h"

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

#endif
