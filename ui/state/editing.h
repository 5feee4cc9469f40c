/* What the hands are doing in the transfer-function editor: nothing of it is undone or saved. A plain value. */
#ifndef ANG_UI_EDITING_H
#define ANG_UI_EDITING_H

#include "ui/state/hu_axis.h"
#include "ui/state/point_set.h"

typedef enum ang_editing_drag {
    ANG_EDITING_NONE,
    ANG_EDITING_POINTS, /* moves the chosen points */
    ANG_EDITING_BOX,    /* chooses points */
    ANG_EDITING_RANGE,  /* of HU, to be shown in the slices */
    ANG_EDITING_SLIDE   /* along the axis */
} ang_editing_drag;

typedef struct ang_editing {
    bool focused;         /* keys are the editor's */
    double x, y;          /* where the pointer was in the last frame */
    ang_point_set chosen; /* where `ang_viewer.point` is not -1 */
    ang_editing_drag drag;
    /* Of the drag: */
    ang_document base;     /* what it moves the points of */
    ang_point_set before;  /* chosen when it began */
    ang_point_shift moved; /* so far, without limits */
    bool unchoose;         /* a click without a drag takes the point out of the choice */
    bool had_range;
    ang_hu_range range_before;
    double start_hu, start_height; /* where it began */
    double hu, height;             /* where it is */

    bool shows;         /* the slices show what is selected */
    bool has_range;     /* a range was dragged: it is what is shown, else what is around the pointed or chosen point */
    ang_hu_range range; /* HU */
    bool marked;        /* in this frame there is something to show: */
    ang_hu_share mark;
} ang_editing;

#endif
