#include "ui/panels/transfer_plot.h"

#include "ui/state/number_text.h"
#include "ui/viewer_private.h"

#include <math.h>
#include <stdio.h>

static const double reach = 9; /* pixels at scale 1 within which a point is meant */

double ang_plot_x(const ang_plot *plot, double hu) {
    const ang_viewer *viewer = plot->viewer;
    return plot->curve.x + (hu - viewer->editor_low) / (viewer->editor_high - viewer->editor_low) * plot->curve.width;
}

double ang_plot_hu(const ang_plot *plot, double x) {
    const ang_viewer *viewer = plot->viewer;
    return viewer->editor_low + (x - plot->curve.x) / plot->curve.width * (viewer->editor_high - viewer->editor_low);
}

double ang_plot_y(const ang_plot *plot, double height) { return plot->curve.y + (1 - height) * plot->curve.height; }
double ang_plot_height(const ang_plot *plot, double y) { return 1 - (y - plot->curve.y) / plot->curve.height; }

static double point_y(const ang_plot *plot, int i) {
    return ang_plot_y(plot, ang_height_of_opacity(ang_document_opacity(&plot->viewer->document, i)));
}

int ang_plot_point_at(const ang_plot *plot, double x, double y) {
    const ang_viewer *viewer = plot->viewer;
    double nearest = ang_gui_px(viewer->gui, reach);
    int found = -1;
    for (int i = 0; i < viewer->document.count; i++) {
        double far = hypot(ang_plot_x(plot, viewer->document.points[i].hu) - x, point_y(plot, i) - y);
        /* A chosen one is on top. */
        if (far < nearest || (far <= nearest && viewer->editing.chosen.has[i])) nearest = far, found = i;
    }
    return found;
}

static ang_ink ink_of(const double colour[3], unsigned alpha) {
    return ANG_INK((unsigned)(255 * colour[0] + 0.5), (unsigned)(255 * colour[1] + 0.5),
                   (unsigned)(255 * colour[2] + 0.5), alpha);
}

static double bottom_of(ang_rect rect) { return rect.y + rect.height; }

static void draw_histogram(const ang_plot *plot) {
    enum { most = 4096 };
    static double bars[most]; /* the drawing thread's alone */
    const ang_viewer *viewer = plot->viewer;
    if (!viewer->histogram) return;
    int columns = (int)fmin(plot->curve.width, most);
    ang_hu_range shown = {viewer->editor_low, ang_plot_hu(plot, plot->curve.x + columns)};
    ang_hu_bars(viewer->study.volume, viewer->histogram, shown, columns, bars);
    for (int i = 0; i < columns; i++) {
        double tall = round(bars[i] * plot->curve.height * 0.96);
        ang_rect bar = {plot->curve.x + i, bottom_of(plot->curve) - tall, 1, tall};
        if (tall > 0) ang_gui_fill(viewer->gui, bar, viewer->theme->bars);
    }
}

static const struct {
    double opacity;
    const char *label;
} grid[] = {{0.05, "5 %"}, {0.25, "25 %"}, {0.5, "50 %"}, {1, "100 %"}};
enum { grid_lines = sizeof grid / sizeof *grid };

static double grid_y(const ang_plot *plot, int line) {
    double thick = ang_gui_hairline(plot->viewer->gui); /* on whole pixels */
    return round(ang_plot_y(plot, ang_height_of_opacity(grid[line].opacity))) + thick / 2;
}

static void draw_grid(const ang_plot *plot) {
    for (int i = 0; i < grid_lines; i++)
        ang_gui_line(plot->viewer->gui, plot->curve.x, grid_y(plot, i), plot->curve.x + plot->curve.width,
                     grid_y(plot, i), plot->viewer->theme->grid, ang_gui_hairline(plot->viewer->gui));
}

/* At the left or the right side, on a ground of its own, to be read over the curve's colours. */
static void write_beside(const ang_plot *plot, double y, bool right, ang_ink ink, const char *text) {
    ang_gui *gui = plot->viewer->gui;
    double room = ang_gui_px(gui, 3), wide = ang_gui_text_width(gui, text, true) + 2 * room;
    double x = right ? plot->curve.x + plot->curve.width - wide : plot->curve.x;
    ang_gui_fill(gui, (ang_rect){x, y, wide, ang_gui_text_height(gui, true)},
                 ANG_INK_FADED(plot->viewer->theme->plot, 200));
    ang_gui_write(gui, x + room, y, 0, true, false, ink, text);
}

static void write_grid(const ang_plot *plot) {
    for (int i = 0; i < grid_lines; i++)
        write_beside(plot, grid_y(plot, i) + ang_gui_hairline(plot->viewer->gui), true, plot->viewer->theme->dim,
                     grid[i].label);
}

/* What the slices show of it: a band behind the curve, with its ends. */
static void draw_mark(const ang_plot *plot) {
    const ang_viewer *viewer = plot->viewer;
    if (!viewer->editing.marked) return;
    double half = viewer->study.volume->slope / 2; /* a value takes its share of the axis */
    double left = fmax(ang_plot_x(plot, viewer->editing.mark.low - half), plot->curve.x);
    double right = fmin(ang_plot_x(plot, viewer->editing.mark.high + half), plot->curve.x + plot->curve.width);
    if (right < left) return;
    double top = plot->whole.y, tall = bottom_of(plot->strip) - top, thick = ang_gui_hairline(viewer->gui);
    ang_gui_fill(viewer->gui, (ang_rect){left, top, fmax(right - left, thick), tall}, ANG_INK_FADED(ANG_INK_MARK, 60));
    ang_gui_fill(viewer->gui, (ang_rect){left, top, thick, tall}, ANG_INK_MARK);
    ang_gui_fill(viewer->gui, (ang_rect){fmax(right - thick, left), top, thick, tall}, ANG_INK_MARK);
}

/* The preset as it was chosen, for comparison. */
static void draw_chosen(const ang_plot *plot) {
    ang_gui *gui = plot->viewer->gui;
    ang_transfer *transfer = ang_document_transfer(&plot->viewer->chosen, NULL);
    if (!transfer) return;
    double before = 0, thick = (plot->viewer->comparing ? 2 : 1) * ang_gui_hairline(gui);
    ang_ink ink = plot->viewer->theme->before;
    for (int i = 0; i <= (int)plot->curve.width; i++) {
        double x = plot->curve.x + i, opacity = ang_transfer_opacity(transfer, ang_plot_hu(plot, x));
        double y = ang_plot_y(plot, ang_height_of_opacity(opacity));
        if (i > 0) ang_gui_line(gui, x - 1, before, x, y, ink, thick);
        before = y;
    }
    ang_transfer_free(transfer);
}

static void draw_curve(const ang_plot *plot, const ang_transfer *transfer) {
    ang_gui *gui = plot->viewer->gui;
    double bottom = bottom_of(plot->curve), before = 0, thick = fmax(ang_gui_px(gui, 1.5), 1);
    for (int i = 0; i <= (int)plot->curve.width; i++) {
        double x = plot->curve.x + i, colour[3], hu = ang_plot_hu(plot, x);
        double opacity = ang_transfer_opacity(transfer, hu), y = ang_plot_y(plot, ang_height_of_opacity(opacity));
        ang_transfer_colour(transfer, hu, colour);
        if (opacity > 0) ang_gui_fill(gui, (ang_rect){x, y, 1, bottom - y}, ink_of(colour, 110));
        if (i > 0) ang_gui_line(gui, x - 1, before, x, y, plot->viewer->theme->curve, thick);
        before = y;
    }
}

static void draw_strip(const ang_plot *plot, const ang_transfer *transfer) {
    ang_rect strip = plot->strip;
    for (int i = 0; i < (int)strip.width; i += 2) {
        double colour[3];
        ang_transfer_colour(transfer, ang_plot_hu(plot, strip.x + i + 1), colour);
        ang_gui_fill(plot->viewer->gui, (ang_rect){strip.x + i, strip.y, fmin(2, strip.width - i), strip.height},
                     ink_of(colour, 255));
    }
}

static void draw_points(const ang_plot *plot, int pointed) {
    const ang_viewer *viewer = plot->viewer;
    ang_gui *gui = viewer->gui;
    double thin = ang_gui_hairline(gui);
    for (int i = 0; i < viewer->document.count; i++) {
        const ang_transfer_point *point = &viewer->document.points[i];
        bool chosen = viewer->editing.chosen.has[i];
        double x = ang_plot_x(plot, point->hu), y = point_y(plot, i);
        double radius = ang_gui_px(gui, chosen || i == pointed ? 6 : 4.5);
        ang_gui_disc(gui, x, y, radius + 1.5 * thin, viewer->theme->plot);
        ang_gui_disc(gui, x, y, radius, ink_of(point->colour, 255));
        ang_gui_ring(gui, x, y, radius, chosen ? viewer->theme->accent : viewer->theme->ring,
                     (chosen ? 2.5 : 1.2) * thin);
        /* Besides its colour a chosen point has a size, and the one whose numbers are shown a dot. */
        if (i == viewer->point) ang_gui_disc(gui, x, y, ang_gui_px(gui, 2), viewer->theme->plot);
    }
}

/* Points that lie beyond the plot's sides, so that none is lost: how many. */
static void draw_beyond(const ang_plot *plot) {
    const ang_viewer *viewer = plot->viewer;
    int count[2] = {0, 0};
    for (int i = 0; i < viewer->document.count; i++) {
        count[0] += viewer->document.points[i].hu < viewer->editor_low;
        count[1] += viewer->document.points[i].hu > viewer->editor_high;
    }
    char text[24];
    snprintf(text, sizeof text, "\xe2\x86\x90 %d", count[0]);
    /* Below the lowest of the grid's numbers. */
    double y = bottom_of(plot->curve) - ang_gui_text_height(viewer->gui, true) - ang_gui_px(viewer->gui, 3);
    if (count[0] > 0) write_beside(plot, y, false, viewer->theme->text, text);
    snprintf(text, sizeof text, "%d \xe2\x86\x92", count[1]);
    if (count[1] > 0) write_beside(plot, y, true, viewer->theme->text, text);
}

static void draw_box(const ang_plot *plot) {
    const ang_viewer *viewer = plot->viewer;
    const ang_editing *editing = &viewer->editing;
    if (editing->drag != ANG_EDITING_BOX) return;
    double x[2] = {ang_plot_x(plot, editing->start_hu), ang_plot_x(plot, editing->hu)};
    double y[2] = {ang_plot_y(plot, editing->start_height), ang_plot_y(plot, editing->height)};
    ang_rect box = {fmin(x[0], x[1]), fmin(y[0], y[1]), fabs(x[1] - x[0]), fabs(y[1] - y[0])};
    ang_gui_fill(viewer->gui, box, ANG_INK_FADED(viewer->theme->accent, 40));
    ang_gui_frame(viewer->gui, box, viewer->theme->accent);
}

/* Round numbers under the strip, each with its tick; the unit at the right end. */
static void draw_axis(const ang_plot *plot) {
    const ang_viewer *viewer = plot->viewer;
    ang_gui *gui = viewer->gui;
    const char *unit = viewer->study.hounsfield ? "HU" : "";
    double y = plot->axis.y + ang_gui_px(gui, 4), right = plot->axis.x + plot->axis.width;
    double room = right - ang_gui_text_width(gui, unit, true) - ang_gui_px(gui, 6);
    ang_hu_ticks ticks = ang_hu_ticks_make((ang_hu_range){viewer->editor_low, viewer->editor_high},
                                           plot->axis.width / ang_gui_px(gui, 52));
    for (int i = 0; i < ticks.count; i++) {
        char text[32];
        double hu = ticks.first + i * ticks.step, x = ang_plot_x(plot, hu);
        if (fabs(hu) < ticks.step / 2) hu = 0; /* no "-0" */
        snprintf(text, sizeof text, "%.*f", ticks.decimals, hu);
        double half = ang_gui_text_width(gui, text, true) / 2;
        ang_gui_fill(gui, (ang_rect){floor(x), plot->axis.y, ang_gui_hairline(gui), ang_gui_px(gui, 3)},
                     viewer->theme->dim);
        /* One that would be cut off moves inwards, as long as it stays at its tick. */
        double at = fmin(fmax(x, plot->axis.x + half), room - half);
        if (fabs(at - x) <= half) ang_gui_write(gui, at, y, 0.5, true, false, viewer->theme->dim, text);
    }
    ang_gui_write(gui, right, y, 1, true, false, viewer->theme->dim, unit);
}

int ang_plot_hu_decimals(const ang_viewer *viewer, double hu) {
    return ang_number_decimals(hu, (viewer->editor_high - viewer->editor_low) / fmax(viewer->editor.width, 1));
}

static void write_pointed(const ang_plot *plot, int pointed) {
    const ang_viewer *viewer = plot->viewer;
    if (pointed < 0) return;
    char text[80];
    double hu = viewer->document.points[pointed].hu, percent = 100 * ang_document_opacity(&viewer->document, pointed);
    snprintf(text, sizeof text, "%.*f%s, opacity %.*f %%", ang_plot_hu_decimals(viewer, hu), hu,
             viewer->study.hounsfield ? " HU" : "", ang_percent_decimals(percent), percent);
    write_beside(plot, plot->whole.y + ang_gui_px(viewer->gui, 3), false, viewer->theme->text, text);
}

void ang_plot_draw(const ang_plot *plot, int pointed) {
    ang_viewer *viewer = plot->viewer;
    ang_gui *gui = viewer->gui;
    ang_rect back = {plot->whole.x, plot->whole.y, plot->whole.width, bottom_of(plot->curve) - plot->whole.y};
    ang_gui_fill(gui, back, viewer->theme->plot);
    ang_transfer *transfer = ang_document_transfer(&viewer->document, NULL);
    ang_gui_clip(gui, (ang_rect){back.x, back.y, back.width, back.height + ang_gui_px(gui, 8)});
    draw_histogram(plot);
    draw_grid(plot);
    if (transfer) {
        draw_curve(plot, transfer);
        draw_strip(plot, transfer);
    }
    write_grid(plot);
    if (viewer->document.edited) draw_chosen(plot);
    draw_mark(plot);
    draw_points(plot, pointed);
    draw_box(plot);
    draw_beyond(plot);
    ang_gui_unclip(gui);
    ang_transfer_free(transfer);
    draw_axis(plot);
    write_pointed(plot, pointed);
    if (viewer->editing.focused) ang_gui_frame(gui, back, viewer->theme->accent);
}
