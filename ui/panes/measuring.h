/* What the hands are measuring: state of the tool. The measures themselves are the document's. */
#ifndef ANG_UI_MEASURING_H
#define ANG_UI_MEASURING_H

#include "ui/state/measure_marks.h"
#include "ui/toolkit/gui.h"

typedef struct ang_measuring {
    ang_measure_kind kind;   /* that the tool makes */
    ang_measurement pending; /* being made; its next place follows the pointer */
    int placed;              /* how many of its places are fixed; 0: nothing is being made */
    int pane;                /* ang_pane in which it is made */
    bool holding;            /* a press of this tool is held */
    bool began;              /* it began what is being made */
    int chosen;              /* of the document's; -1 or beyond the last: none */
    int grabbed;             /* of `chosen`, what a drag moves: a handle or ANG_MARK_* */
    double label_mm[2];      /* where the label was when it was grabbed, as in ang_measurement */
    /* Labels as drawn last; of no size: not drawn. */
    ang_mark_box label[ANG_ORIENTATIONS][ANG_MEASURES];
    /* Values of regions, and what they are of; the last is the pending one's. */
    ang_region_values values[ANG_MEASURES + 1];
    ang_measurement measured[ANG_MEASURES + 1];
} ang_measuring;

#endif
