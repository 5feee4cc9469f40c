/* Where measures appear in a slice pane: pure geometry in the pane's pixels. */
#ifndef ANG_UI_MEASURE_MARKS_H
#define ANG_UI_MEASURE_MARKS_H

#include "core/volume/measures.h"
#include "ui/state/slice_geometry.h"

/* How a measure lies to the plane that a pane shows. */
typedef enum ang_presence {
    ANG_PRESENCE_NONE,
    ANG_PRESENCE_CROSSES, /* a length goes through the plane */
    ANG_PRESENCE_NEAR,    /* all of it within half a slice of the plane */
    ANG_PRESENCE_WITHIN   /* all of it in the plane */
} ang_presence;
/* `step_mm`: from slice to slice. */
ang_presence ang_mark_presence(const ang_measurement *measurement, const ang_slice_frame *frame, double step_mm);
/* Where a length that crosses the plane does so. */
void ang_mark_crossing(const ang_measurement *measurement, const ang_slice_frame *frame, double at[2]);

enum { ANG_MARK_POINTS = ANG_MEASURE_OUTLINE };
/* A line through its points, closed where it is a region's; the number of points. */
int ang_mark_outline(const ang_measurement *measurement, const ang_slice_frame *frame, double at[ANG_MARK_POINTS][2]);

/* What of a mark is under a place. Handles are 0, 1, ... */
enum { ANG_MARK_NOTHING = -1, ANG_MARK_LINE = ANG_MEASURE_HANDLES, ANG_MARK_LABEL };
/* A handle within `reach` pixels, the nearest; else the line; else nothing. */
int ang_mark_hit(const ang_measurement *measurement, const ang_slice_frame *frame, double x, double y, double reach);

/* A part of the pane, pixels. */
typedef struct ang_mark_box {
    double left, top, right, bottom;
} ang_mark_box;

/* Where a label of width x height pixels stands: where it was put by hand; else beside the mark, `gap` pixels from its
 * line, never over its handles, where the pane has room and, if there is such a place, clear of what is taken. Kept
 * within the pane. */
ang_mark_box ang_mark_label(const ang_measurement *measurement, const ang_slice_frame *frame, double width,
                            double height, double gap, const ang_mark_box *taken, int count);

#endif
