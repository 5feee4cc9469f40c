/* Measuring: what the hands do with the tool. The measures themselves are the document's. */
#ifndef ANG_UI_MEASURING_H
#define ANG_UI_MEASURING_H

#include "ui/gui.h"
#include "ui/state/layout.h"
#include "ui/state/measure_marks.h"

typedef struct ang_viewer ang_viewer;

typedef struct ang_measuring {
    ang_measure_kind kind;   /* that the tool makes */
    ang_measurement pending; /* being made; its next place follows the pointer */
    int placed;              /* how many of its places are fixed; 0: nothing is being made */
    int pane;                /* ang_pane in which it is made */
    bool holding;            /* a press of this tool is held */
    bool began;              /* it began what is being made */
    bool by_keys;            /* the next place follows the crosshair, not the pointer */
    int chosen;              /* of the document's; -1 or beyond the last: none */
    int grabbed;             /* of `chosen`, what a drag moves: a handle or ANG_MARK_* */
    double label_mm[2];      /* where the label was when it was grabbed, as in ang_measurement */
    /* Labels as drawn last; of no size: not drawn. */
    ang_mark_box label[ANG_ORIENTATIONS][ANG_MEASURES];
    /* Values of regions, and what they are of; the last is the pending one's. */
    ang_region_values values[ANG_MEASURES + 1];
    ang_measurement measured[ANG_MEASURES + 1];
} ang_measuring;

/* Nothing is being made or chosen: for another study. */
void ang_measuring_start(ang_viewer *viewer);
/* Takes the tool, for measures of this kind. */
void ang_measuring_take(ang_viewer *viewer, ang_measure_kind kind);
/* Gives up what is half made; whether there was any. */
bool ang_measuring_cancel(ang_viewer *viewer);
/* By keys, in the slice pane that has them: begins a measure at the crosshair, or fixes its next place there. */
bool ang_measuring_by_keys(const ang_viewer *viewer);
void ang_measuring_place(ang_viewer *viewer, int argument);
/* What the hands do on a pane; only the tool's. */
void ang_measuring_slice(ang_viewer *viewer, ang_pane pane, const ang_canvas *canvas, const ang_slice_frame *frame);
void ang_measuring_volume(ang_viewer *viewer, const ang_canvas *canvas);
int ang_measuring_chosen(const ang_viewer *viewer); /* index into the document's measures; -1: none */
void ang_measuring_choose(ang_viewer *viewer, int index);
/* Chooses it and brings the crosshair to its middle. */
void ang_measuring_jump(ang_viewer *viewer, int index);
void ang_measuring_delete(ang_viewer *viewer, int index);
/* Of the document's measures, one each (only those of regions mean something); and of the one being made. */
const ang_region_values *ang_measuring_values(ang_viewer *viewer);
const ang_region_values *ang_measuring_pending_values(ang_viewer *viewer);
/* Whether a slice pane shows a measure, and how it lies to the slice. */
bool ang_measuring_shows(const ang_viewer *viewer, ang_pane pane, const ang_slice_frame *frame, int index,
                         ang_presence *presence);
/* What can be grabbed under the pointer (a handle or ANG_MARK_*), and of which measure. */
int ang_measuring_under(const ang_viewer *viewer, ang_pane pane, const ang_canvas *canvas, const ang_slice_frame *frame,
                        int *index);

#endif
