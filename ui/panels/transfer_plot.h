/* The plot of the transfer-function editor: where things lie on it, and how they look. */
#ifndef ANG_UI_TRANSFER_PLOT_H
#define ANG_UI_TRANSFER_PLOT_H

#include "ui/toolkit/rect.h"

typedef struct ang_viewer ang_viewer;

/* The curve's rectangle, the strip of colours below it and the numbers below that; pixels of the window. */
typedef struct ang_plot {
    ang_viewer *viewer;
    ang_rect whole, curve, strip, axis;
} ang_plot;

double ang_plot_x(const ang_plot *plot, double hu);
double ang_plot_hu(const ang_plot *plot, double x);
double ang_plot_y(const ang_plot *plot, double height);
double ang_plot_height(const ang_plot *plot, double y);
/* The point of the document that a hand at (x, y) means; -1: none. */
int ang_plot_point_at(const ang_plot *plot, double x, double y);

/* With how many decimals a value is shown: as fine as the plot can tell it (number_text.h). */
int ang_plot_hu_decimals(const ang_viewer *viewer, double hu);

/* Draws all of it; `pointed`: the point under the pointer, -1: none. */
void ang_plot_draw(const ang_plot *plot, int pointed);

#endif
