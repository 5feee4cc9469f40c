/* Where the parts of the window lie: menu bar on top, panel at the left, four panes two by two, status line at the
 * bottom; and what dragging the gaps between them does. Pure functions; pixels unless said otherwise. */
#ifndef ANG_UI_LAYOUT_H
#define ANG_UI_LAYOUT_H

#include "ui/toolkit/rect.h"

#include <stdbool.h>

typedef enum ang_pane { ANG_PANE_AXIAL, ANG_PANE_CORONAL, ANG_PANE_SAGITTAL, ANG_PANE_VOLUME, ANG_PANES } ang_pane;

/* What the user has chosen. */
typedef struct ang_layout {
    double across, down; /* share of the panes' room, 0..1, left of the upright gap and above the level one */
    double panel;        /* width at scale 1 */
    bool panel_hidden;
} ang_layout;
extern const ang_layout ang_layout_default;

/* What can be taken hold of. */
typedef enum ang_grip {
    ANG_GRIP_CROSS,  /* where the gaps meet: both at once */
    ANG_GRIP_ACROSS, /* the upright gap: moves across */
    ANG_GRIP_DOWN,   /* the level gap */
    ANG_GRIP_PANEL,  /* between panel and panes */
    ANG_GRIPS
} ang_grip;

typedef struct ang_layout_frame {
    double width, height; /* of the window */
    double top, bottom;   /* heights of menu bar and status line */
    double scale;         /* pixels per unit of length */
    int maximised;        /* the only pane that is shown; -1: all */
} ang_layout_frame;

/* Rectangles of whole pixels; of no size: not shown. Grips are wider than the gaps, to be hit more easily. */
typedef struct ang_layout_places {
    ang_rect panel, panes, pane[ANG_PANES], status;
    ang_rect grip[ANG_GRIPS];
} ang_layout_places;

/* Panel and panes keep a least size as far as the window has room for it; the panel gives way first. */
ang_layout_places ang_layout_place(const ang_layout *layout, const ang_layout_frame *frame);
/* The layout as it is after its grip has been dragged from where `from` had it by dx, dy. */
ang_layout ang_layout_drag(const ang_layout *from, const ang_layout_frame *frame, ang_grip grip, double dx, double dy);
/* The gap in the middle; the panel as wide as it is at first. */
ang_layout ang_layout_even(const ang_layout *layout, ang_grip grip);
/* Whether every number of it can be used, as those of a file may not. */
bool ang_layout_valid(const ang_layout *layout);

#endif
