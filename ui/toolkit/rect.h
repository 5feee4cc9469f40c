/* Rectangles of the window, in pixels from its left top corner. */
#ifndef ANG_UI_RECT_H
#define ANG_UI_RECT_H

#include <stdbool.h>
#include <stddef.h>

typedef struct ang_rect {
    double x, y, width, height;
} ang_rect;
/* Smaller by `by` on every side. */
ang_rect ang_rect_inset(ang_rect rect, double by);
/* The largest rectangle of these proportions in the middle of another, on whole pixels from its corner. */
ang_rect ang_rect_within(ang_rect outer, double width, double height);

enum { ANG_LINE_PIECES = 16 };
/* What of the line from x0, y0 to x1, y1 lies in none of `count` rectangles: pieces of it, each as x0, y0, x1, y1, in
 * its direction. Their number; those beyond ANG_LINE_PIECES are left out. */
int ang_line_outside(const double line[4], const ang_rect *boxes, size_t count, double pieces[ANG_LINE_PIECES][4]);

#endif
