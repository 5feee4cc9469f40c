/* The transfer function over the histogram: points that are dragged, added, deleted, typed and coloured. */
#include "ui/viewer_private.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const double reach = 9; /* pixels at scale 1 within which a point is meant */

/* Opacities are mostly small: the square root gives them room. */
static double height_of(double opacity) { return sqrt(fmin(fmax(opacity, 0), 1)); }
static double opacity_of(double height) { return fmin(fmax(height, 0), 1) * fmin(fmax(height, 0), 1); }

typedef struct plot {
    ang_viewer *viewer;
    ang_rect rect; /* of the plot, without the strip of colours */
} plot;

static double x_of(const plot *plot, double hu) {
    const ang_viewer *viewer = plot->viewer;
    return plot->rect.x + (hu - viewer->editor_low) / (viewer->editor_high - viewer->editor_low) * plot->rect.width;
}
static double hu_of(const plot *plot, double x) {
    const ang_viewer *viewer = plot->viewer;
    return viewer->editor_low + (x - plot->rect.x) / plot->rect.width * (viewer->editor_high - viewer->editor_low);
}
static double y_of(const plot *plot, double opacity) {
    return plot->rect.y + (1 - height_of(opacity)) * plot->rect.height;
}

static ang_ink ink_of(const double colour[3], unsigned alpha) {
    return ANG_INK((unsigned)(255 * colour[0] + 0.5), (unsigned)(255 * colour[1] + 0.5),
                   (unsigned)(255 * colour[2] + 0.5), alpha);
}

void ang_transfer_editor_start(ang_viewer *viewer) {
    const ang_volume *volume = viewer->study.volume;
    free(viewer->histogram);
    viewer->histogram = ang_histogram_build(volume, viewer->host->threads, NULL);
    double low = ang_volume_hu(volume, volume->minimum), high = ang_volume_hu(volume, volume->maximum);
    if (viewer->histogram) {
        low = ang_volume_hu(volume, ang_histogram_quantile(viewer->histogram, 0.0005));
        high = ang_volume_hu(volume, ang_histogram_quantile(viewer->histogram, 0.9998));
    }
    double room = fmax((high - low) * 0.03, volume->slope);
    viewer->editor_low = low - room;
    viewer->editor_high = high + room;
    viewer->point = -1;
}

/* Voxels between two values; part of a bin where they lie within one. */
static double voxels_between(const ang_viewer *viewer, double low, double high) {
    const ang_volume *volume = viewer->study.volume;
    double from = ang_volume_stored(volume, low) + 0.5, to = ang_volume_stored(volume, high) + 0.5, sum = 0;
    if (to <= 0 || from >= ANG_HISTOGRAM_BINS) return 0;
    int first = (int)fmax(floor(from), 0), last = (int)fmin(ceil(to), ANG_HISTOGRAM_BINS);
    if (to - from < 1) return (double)viewer->histogram->bin[first];
    for (int i = first; i < last; i++) sum += (double)viewer->histogram->bin[i];
    return sum;
}

static void draw_histogram(const plot *plot) {
    const ang_viewer *viewer = plot->viewer;
    if (!viewer->histogram) return;
    enum { most = 2048 };
    static double bars[most]; /* the drawing thread's alone */
    int columns = (int)fmin(plot->rect.width, most);
    double highest = 0;
    for (int i = 0; i < columns; i++) {
        bars[i] = log1p(voxels_between(viewer, hu_of(plot, plot->rect.x + i), hu_of(plot, plot->rect.x + i + 1)));
        highest = fmax(highest, bars[i]);
    }
    for (int i = 0; i < columns && highest > 0; i++) {
        double tall = round(bars[i] / highest * plot->rect.height * 0.96);
        ang_rect bar = {plot->rect.x + i, plot->rect.y + plot->rect.height - tall, 1, tall};
        if (tall > 0) ang_gui_fill(viewer->gui, bar, ANG_INK(74, 78, 84, 255));
    }
}

static void draw_grid(const plot *plot) {
    static const struct {
        double opacity;
        const char *label;
    } lines[] = {{0.05, "5 %"}, {0.25, "25 %"}, {0.5, "50 %"}, {1, "100 %"}};
    ang_gui *gui = plot->viewer->gui;
    double right = plot->rect.x + plot->rect.width;
    for (size_t i = 0; i < sizeof lines / sizeof *lines; i++) {
        double y = round(y_of(plot, lines[i].opacity)) + 0.5;
        ang_gui_line(gui, plot->rect.x, y, right, y, ANG_INK(255, 255, 255, 22), 1);
        ang_gui_write(gui, right - ang_gui_px(gui, 3), y + 1, 1, true, false, ANG_INK(150, 150, 150, 160),
                      lines[i].label);
    }
}

/* The preset as it was chosen, for comparison. */
static void draw_chosen(const plot *plot) {
    ang_gui *gui = plot->viewer->gui;
    ang_transfer *transfer = ang_document_transfer(&plot->viewer->chosen, NULL);
    if (!transfer) return;
    double before = 0;
    for (int i = 0; i <= (int)plot->rect.width; i++) {
        double x = plot->rect.x + i, y = y_of(plot, ang_transfer_opacity(transfer, hu_of(plot, x)));
        if (i > 0) ang_gui_line(gui, x - 1, before, x, y, ANG_INK(160, 190, 220, 150), 1);
        before = y;
    }
    ang_transfer_free(transfer);
}

static void draw_curve(const plot *plot, const ang_transfer *transfer) {
    ang_gui *gui = plot->viewer->gui;
    double bottom = plot->rect.y + plot->rect.height, before = 0;
    for (int i = 0; i <= (int)plot->rect.width; i++) {
        double x = plot->rect.x + i, colour[3], hu = hu_of(plot, x), opacity = ang_transfer_opacity(transfer, hu);
        double y = y_of(plot, opacity);
        ang_transfer_colour(transfer, hu, colour);
        if (opacity > 0) ang_gui_fill(gui, (ang_rect){x, y, 1, bottom - y}, ink_of(colour, 110));
        if (i > 0) ang_gui_line(gui, x - 1, before, x, y, ANG_INK(235, 235, 235, 255), fmax(ang_gui_px(gui, 1.5), 1));
        before = y;
    }
}

static void draw_strip(const plot *plot, const ang_transfer *transfer, ang_rect strip) {
    ang_gui *gui = plot->viewer->gui;
    for (int i = 0; i < (int)strip.width; i += 2) {
        double colour[3];
        ang_transfer_colour(transfer, hu_of(plot, strip.x + i + 1), colour);
        ang_gui_fill(gui, (ang_rect){strip.x + i, strip.y, fmin(2, strip.width - i), strip.height},
                     ink_of(colour, 255));
    }
}

static void draw_points(const plot *plot, int pointed) {
    const ang_viewer *viewer = plot->viewer;
    ang_gui *gui = viewer->gui;
    for (int i = 0; i < viewer->document.count; i++) {
        const ang_transfer_point *point = &viewer->document.points[i];
        double x = x_of(plot, point->hu), y = y_of(plot, ang_document_opacity(&viewer->document, i));
        double radius = ang_gui_px(gui, i == viewer->point || i == pointed ? 6 : 4.5);
        ang_gui_disc(gui, x, y, radius + 1.5, ANG_INK(20, 20, 20, 255));
        ang_gui_disc(gui, x, y, radius, ink_of(point->colour, 255));
        ang_gui_ring(gui, x, y, radius, i == viewer->point ? ANG_INK_ACCENT : ANG_INK(240, 240, 240, 255),
                     i == viewer->point ? 2.5 : 1.2);
    }
}

static int point_at(const plot *plot, double x, double y) {
    const ang_viewer *viewer = plot->viewer;
    double nearest = ang_gui_px(viewer->gui, reach);
    int found = -1;
    for (int i = 0; i < viewer->document.count; i++) {
        double far = hypot(x_of(plot, viewer->document.points[i].hu) - x,
                           y_of(plot, ang_document_opacity(&viewer->document, i)) - y);
        /* The selected one is on top. */
        if (far < nearest || (far <= nearest && i == viewer->point)) nearest = far, found = i;
    }
    return found;
}

/* The range of HU about what is under the pointer, or moved along. */
static void zoom_range(ang_viewer *viewer, double about, double factor) {
    double low = about + (viewer->editor_low - about) * factor, high = about + (viewer->editor_high - about) * factor;
    double least = 20 * viewer->study.volume->slope;
    if (high - low < least || high - low > 2e5) return;
    viewer->editor_low = low;
    viewer->editor_high = high;
}

static void drag_point(ang_viewer *viewer, const plot *plot, const ang_canvas *canvas) {
    double fine = canvas->modifiers & ANG_MOD_SHIFT ? 0.1 : 1;
    double dx = canvas->dx * fine, dy = canvas->dy * fine;
    /* Ctrl: along one axis, the one of the drag's greater part. */
    if (canvas->modifiers & ANG_MOD_CONTROL) {
        bool across = fabs(canvas->x - canvas->start_x) >= fabs(canvas->y - canvas->start_y);
        dx = across ? dx : 0;
        dy = across ? 0 : dy;
    }
    int i = viewer->point;
    double per_pixel = (viewer->editor_high - viewer->editor_low) / plot->rect.width;
    double height = height_of(ang_document_opacity(&viewer->document, i)) - dy / plot->rect.height;
    double opacity = dy < 0 || dy > 0 ? opacity_of(height) : ang_document_opacity(&viewer->document, i);
    ang_document_move_point(&viewer->document, i, viewer->document.points[i].hu + dx * per_pixel, opacity);
}

static void handle(ang_viewer *viewer, const plot *plot, const ang_canvas *canvas) {
    double x = canvas->rect.x + canvas->x, y = canvas->rect.y + canvas->y;
    if (canvas->pressed) {
        viewer->gesture = (ang_gesture){.pane = ANG_PANES, .before = viewer->document, .crosshair = viewer->crosshair};
        int pointed = point_at(plot, x, y);
        if (canvas->held == ANG_BUTTON_LEFT) {
            viewer->point = pointed;
            if (pointed < 0 && canvas->double_clicked) {
                viewer->point = ang_document_add_point(&viewer->document, hu_of(plot, x));
                double height = 1 - (y - plot->rect.y) / plot->rect.height;
                if (viewer->point >= 0)
                    ang_document_move_point(&viewer->document, viewer->point, hu_of(plot, x), opacity_of(height));
            }
        } else if (canvas->held == ANG_BUTTON_RIGHT && pointed >= 0) {
            ang_document_delete_point(&viewer->document, pointed);
            viewer->point = -1;
        }
    }
    bool moved = canvas->dx != 0 || canvas->dy != 0;
    if (canvas->held == ANG_BUTTON_LEFT && moved && viewer->point >= 0 && !viewer->gesture.cancelled)
        drag_point(viewer, plot, canvas);
    bool slides = canvas->held == ANG_BUTTON_MIDDLE || (canvas->held == ANG_BUTTON_LEFT && viewer->point < 0);
    if (slides && moved) {
        double by = canvas->dx * (viewer->editor_high - viewer->editor_low) / plot->rect.width;
        viewer->editor_low -= by;
        viewer->editor_high -= by;
    }
    if (canvas->wheel != 0) zoom_range(viewer, hu_of(plot, x), pow(0.85, canvas->wheel));
}

/* HU at the ends and in the middle, under the strip. */
static void write_axis(const plot *plot, double y) {
    const ang_viewer *viewer = plot->viewer;
    static const double places[] = {0, 0.5, 1};
    for (int i = 0; i < 3; i++) {
        char text[32];
        double x = plot->rect.x + places[i] * plot->rect.width;
        snprintf(text, sizeof text, "%.0f%s", hu_of(plot, x), i == 2 && viewer->study.hounsfield ? " HU" : "");
        ang_gui_write(viewer->gui, x, y, places[i], true, false, ANG_INK_DIM, text);
    }
}

static void numbers(ang_viewer *viewer) {
    ang_gui *gui = viewer->gui;
    ang_document *document = &viewer->document;
    bool chosen = viewer->point >= 0 && viewer->point < document->count;
    if (!chosen) {
        viewer->point = -1;
        ang_gui_hint(gui, "Click a point; double-click adds one");
        return;
    }
    int i = viewer->point;
    double hu = document->points[i].hu, percent = 100 * ang_document_opacity(document, i);
    const double swatch = ang_gui_px(gui, 26), gap = ang_gui_px(gui, 8), remove = ang_gui_px(gui, 60);
    double half = floor((ang_gui_room(gui) - swatch - remove - 3 * gap) / 2);
    char name[32];
    /* A field belongs to its point: another point is another field. */
    snprintf(name, sizeof name, "##hu%d", i);
    if (ang_gui_number_field(gui, name, &hu, viewer->study.hounsfield ? "%.6g HU" : "%.6g", half))
        ang_document_move_point(document, i, hu, percent / 100);
    ang_gui_tooltip(gui, "Value of the point; Enter sets it");
    ang_gui_same_line(gui);
    snprintf(name, sizeof name, "##opacity%d", i);
    if (ang_gui_number_field(gui, name, &percent, "%.4g %%", half))
        ang_document_move_point(document, i, document->points[i].hu, percent / 100);
    ang_gui_tooltip(gui, "Opacity per unit distance");
    ang_gui_same_line(gui);
    if (ang_gui_colour(gui, "##colour", document->points[i].colour)) document->edited = true;
    ang_gui_tooltip(gui, "Colour of the point");
    ang_gui_same_line(gui);
    bool key = false;
    for (int k = 0; k < viewer->input.press_count; k++)
        key = key || (viewer->input.press[k].key == ANG_KEY_DELETE && !viewer->typing);
    if (ang_gui_button(gui, "Delete", remove, document->count > 1) || key) {
        ang_document_delete_point(document, i);
        viewer->point = -1;
    }
}

void ang_transfer_editor(ang_viewer *viewer) {
    ang_gui *gui = viewer->gui;
    ang_gui_heading(gui, "TRANSFER FUNCTION");
    const double strip_height = ang_gui_px(gui, 10), axis_height = ang_gui_px(gui, 18), inset = ang_gui_px(gui, 8);
    double width = ang_gui_room(gui), tall = ang_gui_px(gui, 190);
    ang_canvas canvas;
    ang_gui_canvas(gui, "transfer function", width, tall, &canvas);
    plot plot = {viewer, {canvas.rect.x, canvas.rect.y + inset, width, tall - strip_height - axis_height - inset}};
    viewer->editor = plot.rect;
    handle(viewer, &plot, &canvas);
    ang_rect back = {canvas.rect.x, canvas.rect.y, width, inset + plot.rect.height};
    ang_gui_fill(gui, back, ANG_INK(14, 14, 14, 255));
    ang_gui_clip(gui, (ang_rect){back.x, back.y, back.width, back.height + inset});
    draw_histogram(&plot);
    draw_grid(&plot);
    ang_transfer *transfer = ang_document_transfer(&viewer->document, NULL);
    if (viewer->document.edited) draw_chosen(&plot);
    if (transfer) draw_curve(&plot, transfer);
    double bottom = plot.rect.y + plot.rect.height;
    if (transfer) draw_strip(&plot, transfer, (ang_rect){canvas.rect.x, bottom, width, strip_height});
    ang_transfer_free(transfer);
    int pointed = canvas.hovered ? point_at(&plot, canvas.rect.x + canvas.x, canvas.rect.y + canvas.y) : -1;
    draw_points(&plot, pointed);
    ang_gui_unclip(gui);
    write_axis(&plot, bottom + strip_height + ang_gui_px(gui, 2));
    if (pointed >= 0) {
        char text[80];
        snprintf(text, sizeof text, "%.0f%s, opacity %.3g %%", viewer->document.points[pointed].hu,
                 viewer->study.hounsfield ? " HU" : "", 100 * ang_document_opacity(&viewer->document, pointed));
        ang_gui_write(gui, back.x + ang_gui_px(gui, 6), back.y + ang_gui_px(gui, 3), 0, true, true, ANG_INK_TEXT, text);
    }
    numbers(viewer);
}
