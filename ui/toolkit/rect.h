/* Rectangles of the window, in pixels from its left top corner. */
#ifndef ANG_UI_RECT_H
#define ANG_UI_RECT_H

typedef struct ang_rect {
    double x, y, width, height;
} ang_rect;
/* The largest rectangle of these proportions in the middle of another, on whole pixels from its corner. */
ang_rect ang_rect_within(ang_rect outer, double width, double height);

#endif
