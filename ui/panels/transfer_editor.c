#include "ui/panels/transfer_editor.h"

#include "ui/panels/transfer_keys.h"
#include "ui/panels/transfer_plot.h"
#include "ui/state/number_text.h"
#include "ui/viewer_private.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void ang_transfer_editor_start(ang_viewer *viewer) {
    const ang_volume *volume = viewer->study.volume;
    free(viewer->histogram);
    viewer->histogram = ang_histogram_build(volume, viewer->host->threads, NULL);
    viewer->point = -1;
    viewer->editing = (ang_editing){.shows = viewer->editing.shows};
    ang_transfer_editor_show_data(viewer);
}

void ang_transfer_editor_show_data(ang_viewer *viewer) {
    const ang_volume *volume = viewer->study.volume;
    double low = ang_volume_hu(volume, volume->minimum), high = ang_volume_hu(volume, volume->maximum);
    if (viewer->histogram) {
        low = ang_volume_hu(volume, ang_histogram_quantile(viewer->histogram, 0.0005));
        high = ang_volume_hu(volume, ang_histogram_quantile(viewer->histogram, 0.9998));
    }
    double room = fmax((high - low) * 0.03, volume->slope);
    viewer->editor_low = low - room;
    viewer->editor_high = high + room;
}

static ang_hu_range shown_range(const ang_viewer *viewer) {
    return (ang_hu_range){viewer->editor_low, viewer->editor_high};
}

static void show_range(ang_viewer *viewer, ang_hu_range range) {
    viewer->editor_low = range.low;
    viewer->editor_high = range.high;
}

void ang_transfer_editor_show_all(ang_viewer *viewer) {
    show_range(viewer, ang_hu_range_all(viewer->study.volume, &viewer->document));
}

void ang_transfer_editor_zoom(ang_viewer *viewer, double about, double factor) {
    ang_hu_range all = ang_hu_range_all(viewer->study.volume, &viewer->document);
    /* So narrow that one value fills the plot. */
    show_range(viewer, ang_hu_range_zoom(shown_range(viewer), about, factor, viewer->study.volume->slope, all));
}

static void slide(ang_viewer *viewer, double by) {
    ang_hu_range all = ang_hu_range_all(viewer->study.volume, &viewer->document);
    show_range(viewer, ang_hu_range_slide(shown_range(viewer), by, all));
}

void ang_transfer_editor_choose(ang_viewer *viewer, int index) {
    viewer->point = index;
    ang_point_set_only(&viewer->editing.chosen, index);
}

/* A point is about to be held: Shift adds it to those chosen, else it alone is, unless it is one of them. */
static void take_point(ang_viewer *viewer, int index, bool adds) {
    ang_editing *editing = &viewer->editing;
    editing->unchoose = adds && editing->chosen.has[index];
    if (adds)
        editing->chosen.has[index] = true;
    else if (!editing->chosen.has[index])
        ang_point_set_only(&editing->chosen, index);
    viewer->point = index;
}

static bool lies_in(ang_rect rect, double y) { return y >= rect.y && y < rect.y + rect.height; }

/* What a left press begins. */
static ang_editing_drag press(ang_viewer *viewer, const ang_plot *plot, const ang_canvas *canvas, double x, double y) {
    bool adds = (canvas->modifiers & ANG_MOD_SHIFT) != 0;
    if (lies_in(plot->axis, y)) {
        if (canvas->double_clicked) ang_transfer_editor_show_all(viewer);
        return ANG_EDITING_SLIDE;
    }
    if (lies_in(plot->strip, y) || (canvas->modifiers & ANG_MOD_ALT)) return ANG_EDITING_RANGE;
    if (viewer->input.key[ANG_KEY_SPACE]) return ANG_EDITING_SLIDE;
    int pointed = ang_plot_point_at(plot, x, y);
    if (pointed >= 0) {
        take_point(viewer, pointed, adds);
        return ANG_EDITING_POINTS;
    }
    if (canvas->double_clicked) {
        int added = ang_document_add_point(&viewer->document, ang_plot_hu(plot, x));
        if (added < 0) {
            ang_viewer_say(viewer, true, "A transfer function has at most %d points.", ANG_DOCUMENT_POINTS);
            return ANG_EDITING_NONE;
        }
        double opacity = ang_opacity_of_height(ang_plot_height(plot, y));
        ang_document_move_point(&viewer->document, added, ang_plot_hu(plot, x), opacity);
        ang_transfer_editor_choose(viewer, added);
        return ANG_EDITING_POINTS;
    }
    if (!adds) ang_transfer_editor_choose(viewer, -1);
    return ANG_EDITING_BOX;
}

static void begin(ang_viewer *viewer, const ang_plot *plot, const ang_canvas *canvas, double x, double y) {
    ang_editing *editing = &viewer->editing;
    viewer->gesture = (ang_gesture){.pane = ANG_PANES, .before = viewer->document};
    editing->focused = true;
    editing->before = editing->chosen;
    editing->had_range = editing->has_range;
    editing->range_before = editing->range;
    editing->moved = (ang_point_shift){0};
    editing->unchoose = false;
    editing->start_hu = editing->hu = ang_plot_hu(plot, x);
    editing->start_height = editing->height = ang_plot_height(plot, y);
    editing->drag = ANG_EDITING_NONE;
    if (canvas->held == ANG_BUTTON_LEFT) {
        editing->drag = press(viewer, plot, canvas, x, y);
    } else if (canvas->held == ANG_BUTTON_MIDDLE) {
        editing->drag = ANG_EDITING_SLIDE;
    } else {
        int pointed = ang_plot_point_at(plot, x, y);
        if (pointed < 0) return;
        ang_document_delete_point(&viewer->document, pointed);
        ang_transfer_editor_choose(viewer, -1);
    }
    editing->base = viewer->document;
}

static void drag_points(ang_viewer *viewer, const ang_plot *plot, const ang_canvas *canvas) {
    ang_editing *editing = &viewer->editing;
    double fine = canvas->modifiers & ANG_MOD_SHIFT ? 0.1 : 1;
    editing->moved.hu += canvas->dx * fine * (viewer->editor_high - viewer->editor_low) / plot->curve.width;
    editing->moved.height -= canvas->dy * fine / plot->curve.height;
    ang_point_shift shift = editing->moved;
    /* Ctrl: along one axis, the one of the drag's greater part. */
    if (canvas->modifiers & ANG_MOD_CONTROL) {
        bool across = fabs(canvas->x - canvas->start_x) >= fabs(canvas->y - canvas->start_y);
        *(across ? &shift.height : &shift.hu) = 0;
    }
    ang_points_move(&viewer->document, &editing->base, &editing->chosen, shift);
    editing->unchoose = false;
}

static void drag_box(ang_viewer *viewer) {
    ang_editing *editing = &viewer->editing;
    bool keeps = viewer->input.modifiers & ANG_MOD_SHIFT;
    editing->chosen = keeps ? editing->before : (ang_point_set){0};
    ang_point_set_add_box(&editing->chosen, &viewer->document, (double[]){editing->start_hu, editing->hu},
                          (double[]){editing->start_height, editing->height});
    viewer->point = ang_point_set_first(&editing->chosen, &viewer->document);
}

static void drag_range(ang_viewer *viewer) {
    ang_editing *editing = &viewer->editing;
    editing->range = (ang_hu_range){fmin(editing->start_hu, editing->hu), fmax(editing->start_hu, editing->hu)};
    editing->has_range = editing->shows = true;
}

static void follow(ang_viewer *viewer, const ang_plot *plot, const ang_canvas *canvas, double x, double y) {
    ang_editing *editing = &viewer->editing;
    editing->hu = ang_plot_hu(plot, x);
    editing->height = ang_plot_height(plot, y);
    switch (editing->drag) {
    case ANG_EDITING_POINTS:
        drag_points(viewer, plot, canvas);
        break;
    case ANG_EDITING_BOX:
        drag_box(viewer);
        break;
    case ANG_EDITING_RANGE:
        drag_range(viewer);
        break;
    case ANG_EDITING_SLIDE:
        slide(viewer, -canvas->dx * (viewer->editor_high - viewer->editor_low) / plot->curve.width);
        break;
    case ANG_EDITING_NONE:
        break;
    }
}

/* Esc: what a drag has chosen goes, as what it has changed of the document. */
static void take_back(ang_viewer *viewer) {
    ang_editing *editing = &viewer->editing;
    if (editing->drag == ANG_EDITING_BOX) {
        editing->chosen = editing->before;
        viewer->point = ang_point_set_first(&editing->chosen, &viewer->document);
    } else if (editing->drag == ANG_EDITING_POINTS) {
        ang_transfer_editor_choose(viewer, -1);
    } else if (editing->drag == ANG_EDITING_RANGE) {
        editing->has_range = editing->had_range;
        editing->range = editing->range_before;
    }
    editing->drag = ANG_EDITING_NONE;
}

static void end(ang_viewer *viewer, const ang_canvas *canvas) {
    ang_editing *editing = &viewer->editing;
    if (canvas->clicked && editing->drag == ANG_EDITING_RANGE) editing->has_range = false;
    if (canvas->clicked && editing->unchoose) {
        editing->chosen.has[viewer->point] = false;
        viewer->point = ang_point_set_first(&editing->chosen, &viewer->document);
    }
    editing->drag = ANG_EDITING_NONE;
}

static void handle(ang_viewer *viewer, const ang_plot *plot, const ang_canvas *canvas) {
    ang_editing *editing = &viewer->editing;
    double x = canvas->rect.x + canvas->x, y = canvas->rect.y + canvas->y;
    if (canvas->pressed) begin(viewer, plot, canvas, x, y);
    bool moved = canvas->dx != 0 || canvas->dy != 0;
    if (viewer->gesture.cancelled)
        take_back(viewer);
    else if (canvas->held >= 0 && moved)
        follow(viewer, plot, canvas, x, y);
    if (canvas->released >= 0) end(viewer, canvas);
    if (canvas->wheel != 0) ang_transfer_editor_zoom(viewer, ang_plot_hu(plot, x), pow(0.85, canvas->wheel));
    bool along = editing->drag == ANG_EDITING_SLIDE || editing->drag == ANG_EDITING_RANGE;
    if (along || (canvas->hovered && y >= plot->strip.y)) ang_gui_cursor(viewer->gui, ANG_CURSOR_ACROSS);
}

/* From the neighbours on the left to those on the right of what is chosen or pointed at: all that it has a part in. */
static bool range_about(const ang_viewer *viewer, int pointed, ang_hu_range *range) {
    const ang_document *document = &viewer->document;
    int first = pointed, last = pointed;
    if (pointed < 0 || viewer->editing.chosen.has[pointed]) {
        for (int i = document->count - 1; i >= 0; i--)
            if (viewer->editing.chosen.has[i]) first = i;
        for (int i = 0; i < document->count; i++)
            if (viewer->editing.chosen.has[i]) last = i;
    }
    if (first < 0) return false;
    range->low = first > 0 ? document->points[first - 1].hu : -ANG_TRANSFER_HU_LIMIT;
    range->high = last + 1 < document->count ? document->points[last + 1].hu : ANG_TRANSFER_HU_LIMIT;
    return true;
}

static void mark(ang_viewer *viewer, int pointed) {
    ang_editing *editing = &viewer->editing;
    ang_hu_range range = editing->range;
    editing->marked = false;
    if (!editing->shows || !viewer->histogram || (!editing->has_range && !range_about(viewer, pointed, &range))) return;
    editing->mark = ang_hu_share_of(viewer->study.volume, viewer->histogram, range);
    editing->marked = editing->mark.first <= editing->mark.last;
}

/* For the number of a field; with a sign where the number is a change. */
static void field_format(int decimals, bool change, const char *unit, char format[16]) {
    snprintf(format, 16, "%%%s.%df%s", change ? "+" : "", decimals, unit);
}

/* The fields below the plot: of one point its values, of several what all of them change by. */
static void numbers(ang_viewer *viewer) {
    ang_gui *gui = viewer->gui;
    ang_document *document = &viewer->document;
    ang_editing *editing = &viewer->editing;
    int count = ang_point_set_count(&editing->chosen, document), i = viewer->point;
    if (count == 0) {
        ang_gui_hint(gui, "Double-click adds a point; by keys: E");
        return;
    }
    bool several = count > 1, hounsfield = viewer->study.hounsfield;
    const double swatch = ang_gui_px(gui, 26), gap = ang_gui_px(gui, 8), remove = ang_gui_px(gui, 72);
    double half = floor((ang_gui_room(gui) - swatch - remove - 3 * gap) / 2);
    double hu_before = several ? 0 : document->points[i].hu, hu = hu_before;
    double percent_before = several ? 0 : 100 * ang_document_opacity(document, i), percent = percent_before;
    char name[32], format[16];
    const ang_document from = *document;
    /* A field belongs to what is chosen: another choice is another field. */
    snprintf(name, sizeof name, "##hu%d-%d", i, count);
    field_format(ang_plot_hu_decimals(viewer, hu), several, hounsfield ? " HU" : "", format);
    if (ang_gui_number_field(gui, name, &hu, format, half))
        ang_points_move(document, &from, &editing->chosen, (ang_point_shift){.hu = hu - hu_before});
    ang_gui_tooltip(gui, several ? "By how much to move all chosen points; Enter moves them"
                                 : "Value of the point; Enter sets it");
    ang_gui_same_line(gui);
    snprintf(name, sizeof name, "##opacity%d-%d", i, count);
    field_format(ang_percent_decimals(percent), several, " %%", format);
    if (ang_gui_number_field(gui, name, &percent, format, half))
        ang_points_move(document, &from, &editing->chosen,
                        (ang_point_shift){.opacity = (percent - percent_before) / 100});
    ang_gui_tooltip(gui, several ? "By how much to raise the opacity of all chosen points"
                                 : "Opacity per unit distance; Enter sets it");
    ang_gui_same_line(gui);
    double colour[3];
    memcpy(colour, document->points[i].colour, sizeof colour);
    if (ang_gui_colour(gui, "##colour", colour)) ang_points_colour(document, &editing->chosen, colour);
    ang_gui_tooltip(gui, several ? "One colour for all chosen points" : "Colour of the point");
    ang_gui_same_line(gui);
    snprintf(name, sizeof name, several ? "Delete %d##delete" : "Delete##delete", count);
    if (ang_gui_button(gui, name, remove, document->count > 1)) ang_curve_delete(viewer, 0);
}

/* What the slices show of it, and how much that is. */
static void selecting(ang_viewer *viewer) {
    ang_gui *gui = viewer->gui;
    ang_editing *editing = &viewer->editing;
    ang_gui_checkbox(gui, "Show in slices", &editing->shows);
    ang_gui_tooltip(gui,
                    "Marks in the slices the voxels that the pointed or chosen points have a part in, or those of a "
                    "range dragged on the strip of colours (a click there ends it). Key H.");
    ang_gui_same_line(gui);
    if (!editing->marked) {
        ang_gui_hint(gui, editing->shows ? "drag on the colours" : "");
        return;
    }
    char text[96];
    const ang_hu_share *share = &editing->mark;
    const char *digits = share->ml < 9.95 ? "%.3g %%, %.2f ml" : "%.3g %%, %.0f ml";
    snprintf(text, sizeof text, digits, 100 * share->share, share->ml);
    ang_gui_hint(gui, text);
}

/* The choice follows what others do to the document. */
static void keep_choice(ang_viewer *viewer) {
    ang_editing *editing = &viewer->editing;
    if (viewer->point >= viewer->document.count) viewer->point = -1;
    if (viewer->point < 0)
        editing->chosen = (ang_point_set){0};
    else if (!editing->chosen.has[viewer->point])
        ang_point_set_only(&editing->chosen, viewer->point);
}

void ang_transfer_editor_leave(ang_viewer *viewer) {
    ang_editing *editing = &viewer->editing;
    bool moved = viewer->input.x < editing->x || viewer->input.x > editing->x || viewer->input.y < editing->y ||
                 viewer->input.y > editing->y;
    bool pressed = ang_gui_holding(viewer->gui);
    if (viewer->hovered < ANG_PANES && (moved || pressed)) editing->focused = false;
    editing->x = viewer->input.x;
    editing->y = viewer->input.y;
}

void ang_transfer_editor(ang_viewer *viewer) {
    ang_gui *gui = viewer->gui;
    ang_gui_heading(gui, "TRANSFER FUNCTION");
    const double strip = ang_gui_px(gui, 12), axis = ang_gui_px(gui, 18), inset = ang_gui_px(gui, 8);
    /* Taller where there is room for it. */
    double width = ang_gui_room(gui),
           tall = fmin(fmax(round(0.24 * viewer->input.height), ang_gui_px(gui, 190)), ang_gui_px(gui, 300));
    ang_canvas canvas;
    ang_gui_canvas(gui, "transfer function", width, tall, &canvas);
    ang_rect whole = canvas.rect;
    ang_rect curve = {whole.x, whole.y + inset, width, tall - strip - axis - inset};
    const double below = curve.y + curve.height;
    ang_plot plot = {viewer, whole, curve, {whole.x, below, width, strip}, {whole.x, below + strip, width, axis}};
    viewer->editor = curve;
    keep_choice(viewer);
    handle(viewer, &plot, &canvas);
    double x = whole.x + canvas.x, y = whole.y + canvas.y;
    bool over = canvas.hovered && y < plot.strip.y && canvas.held < 0;
    int pointed = over ? ang_plot_point_at(&plot, x, y) : -1;
    if (viewer->editing.drag == ANG_EDITING_POINTS) pointed = viewer->point;
    mark(viewer, pointed);
    ang_plot_draw(&plot, pointed);
    numbers(viewer);
    selecting(viewer);
}
