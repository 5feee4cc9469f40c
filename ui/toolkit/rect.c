#include "ui/toolkit/rect.h"

#include <math.h>

ang_rect ang_rect_inset(ang_rect rect, double by) {
    return (ang_rect){rect.x + by, rect.y + by, rect.width - 2 * by, rect.height - 2 * by};
}

ang_rect ang_rect_within(ang_rect outer, double width, double height) {
    double scale = fmin(outer.width / width, outer.height / height);
    double across = round(width * scale), down = round(height * scale);
    return (ang_rect){outer.x + floor((outer.width - across) / 2), outer.y + floor((outer.height - down) / 2), across,
                      down};
}

/* The share of a line, from 0 to 1, that lies within a rectangle; false: none of it. */
static bool stretch_within(const double line[4], const ang_rect *box, double *begin, double *end) {
    const double low[2] = {box->x, box->y}, high[2] = {box->x + box->width, box->y + box->height};
    *begin = 0;
    *end = 1;
    for (int axis = 0; axis < 2; axis++) {
        double from = line[axis], by = line[2 + axis] - from;
        if (fabs(by) < 1e-12) {
            if (from <= low[axis] || from >= high[axis]) return false;
            continue;
        }
        double a = (low[axis] - from) / by, b = (high[axis] - from) / by;
        *begin = fmax(*begin, fmin(a, b));
        *end = fmin(*end, fmax(a, b));
    }
    return *begin < *end;
}

int ang_line_outside(const double line[4], const ang_rect *boxes, size_t count, double pieces[ANG_LINE_PIECES][4]) {
    int found = 0;
    double at = 0, begin, end;
    while (at < 1 && found < ANG_LINE_PIECES) {
        /* The box that is met next, and how far all go on that cover that place. */
        double next = 1, after = at;
        for (size_t i = 0; i < count; i++) {
            if (!stretch_within(line, &boxes[i], &begin, &end) || end <= at) continue;
            if (begin <= at)
                after = fmax(after, end);
            else
                next = fmin(next, begin);
        }
        if (after > at) {
            at = after;
            continue;
        }
        for (int axis = 0; axis < 2; axis++) {
            pieces[found][axis] = line[axis] + at * (line[2 + axis] - line[axis]);
            pieces[found][2 + axis] = line[axis] + next * (line[2 + axis] - line[axis]);
        }
        found++;
        at = next;
    }
    return found;
}
