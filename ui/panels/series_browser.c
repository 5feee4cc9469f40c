#include "ui/panels/series_browser.h"

#include "core/base/memory.h"
#include "ui/panes/identity.h"
#include "ui/panes/overlay.h"
#include "ui/viewer_private.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { PICTURE = 72, MARGIN = 6 }; /* at scale 1 */
enum { REASON_LINES = 6 };         /* room for what there is to say of the chosen series */

static void forget_list(ang_viewer *viewer) {
    ang_series_browser *series = &viewer->series;
    for (size_t i = 0; series->picture && i < series->list.count; i++)
        ang_painter_forget(viewer->painter, &series->picture[i]);
    free(series->picture);
    series->picture = NULL;
    ang_series_list_clear(&series->list);
    series->looked_at = 0;
}

void ang_series_browser_clear(ang_viewer *viewer) {
    ang_series_browser *series = &viewer->series;
    ang_surveying_end(&series->surveying);
    forget_list(viewer);
    ang_source_clear(&series->source);
    *series = (ang_series_browser){0};
}

/* The row of the series that is shown; -1 where none is. */
static int shown_row(const ang_viewer *viewer) {
    const ang_series_browser *series = &viewer->series;
    if (!viewer->ready || !ang_source_same_files(&viewer->shown, &series->source)) return -1;
    return viewer->study.series >= 1 && (size_t)viewer->study.series <= series->list.count ? viewer->study.series - 1
                                                                                           : -1;
}

/* Looks at the subject where it is another than that of the list; an old look is stopped first, without waiting. */
static void begin(ang_viewer *viewer) {
    ang_series_browser *series = &viewer->series;
    const ang_source *subject = ang_viewer_subject(viewer);
    if (!series->open || subject->count == 0 || ang_source_same_files(subject, &series->source)) return;
    ang_surveying_stop(&series->surveying);
    if (series->surveying.running) return;
    forget_list(viewer);
    series->failure[0] = '\0';
    series->chosen = 0;
    ang_error err = {0};
    ang_source copy = ang_source_of_series(subject, 0);
    ang_source_move(&series->source, &copy);
    if (!ang_surveying_start(&series->surveying, viewer->host, &series->source, &err))
        snprintf(series->failure, sizeof series->failure, "%.500s", err.message);
}

static void take_list(ang_viewer *viewer) {
    ang_series_browser *series = &viewer->series;
    series->picture = calloc(series->list.count + 1, sizeof *series->picture);
    int row = shown_row(viewer);
    series->chosen = row < 0 ? 0 : row;
    series->follow = true;
}

static void take_entry(ang_viewer *viewer, int index) {
    ang_series_browser *series = &viewer->series;
    const ang_series_entry *entry = &series->list.entry[index];
    series->looked_at = index + 1;
    if (series->picture)
        ang_viewer_paint_grey(viewer, entry->grey, entry->width, entry->height, &series->picture[index]);
}

/* The middle plane of the volume that is shown, as the axial pane shows it, where it was not to be had by itself. */
static void look_at_shown(ang_viewer *viewer, int row) {
    ang_series_entry *entry = &viewer->series.list.entry[row];
    const ang_volume *volume = viewer->study.volume;
    size_t width = (size_t)volume->dims[0], height = (size_t)volume->dims[1];
    const uint16_t *from = volume->data + (size_t)(volume->dims[2] / 2) * width * height;
    bool left = volume->affine.m[0][0] < 0, up = volume->affine.m[1][1] < 0; /* as the indices run */
    uint16_t *values = ang_alloc(width * height, sizeof *values, "a slice", NULL);
    for (size_t y = 0; values && y < height; y++)
        for (size_t x = 0; x < width; x++)
            values[y * width + x] = from[(up ? height - 1 - y : y) * width + (left ? width - 1 - x : x)];
    for (int axis = 0; axis < 3; axis++) {
        entry->dims[axis] = volume->dims[axis];
        entry->spacing_mm[axis] = ang_volume_spacing(volume, axis);
    }
    entry->looked_at = true;
    if (!values) return;
    ang_series_entry_picture(entry, &(ang_raw_slice){.values = values,
                                                     .width = volume->dims[0],
                                                     .height = volume->dims[1],
                                                     .slope = volume->slope,
                                                     .intercept = volume->intercept,
                                                     .hounsfield = viewer->study.hounsfield,
                                                     .window_centre = viewer->study.window_centre,
                                                     .window_width = viewer->study.window_width,
                                                     .pixel_aspect = entry->spacing_mm[1] / entry->spacing_mm[0],
                                                     .count = 1});
    free(values);
}

void ang_series_browser_step(ang_viewer *viewer) {
    ang_series_browser *series = &viewer->series;
    begin(viewer);
    if (!series->surveying.running) return;
    bool listed = true;
    for (int index = 0; listed || index >= 0;) {
        index = ang_surveying_take(&series->surveying, &series->list, &listed);
        if (listed) take_list(viewer);
        if (index >= 0) take_entry(viewer, index);
        if (listed || index >= 0) viewer->redraws = 2;
    }
    if (!series->open) ang_surveying_stop(&series->surveying);
    ang_error err;
    if (!ang_surveying_finished(&series->surveying, &err)) return;
    viewer->redraws = 2;
    if (err.code == ANG_INTERRUPTED)
        ang_source_clear(&series->source); /* to begin anew when it is asked for */
    else if (err.code != ANG_OK)
        snprintf(series->failure, sizeof series->failure, "%.500s", err.message);
    int row = shown_row(viewer);
    if (row < 0 || series->list.entry[row].looked_at) return;
    look_at_shown(viewer, row);
    take_entry(viewer, row);
}

static void choose(ang_viewer *viewer, int row) {
    ang_series_browser *series = &viewer->series;
    if (row < 0 || (size_t)row >= series->list.count || row == shown_row(viewer)) return;
    const ang_series_entry *entry = &series->list.entry[row];
    if (!entry->loadable) {
        ang_viewer_say(viewer, true, "Series %d is not a volume: %s", entry->number, entry->remark);
        return;
    }
    ang_source source = ang_source_of_series(&series->source, entry->number);
    ang_viewer_open_source(viewer, &source);
}

bool ang_series_browser_key(ang_viewer *viewer, int key, unsigned modifiers) {
    ang_series_browser *series = &viewer->series;
    if (!series->open || modifiers || series->list.count == 0) return false;
    int last = (int)series->list.count - 1, row = series->chosen;
    switch (key) {
    case ANG_KEY_UP:
        row--;
        break;
    case ANG_KEY_DOWN:
        row++;
        break;
    case ANG_KEY_HOME:
        row = 0;
        break;
    case ANG_KEY_END:
        row = last;
        break;
    case ANG_KEY_ENTER:
        choose(viewer, row);
        return true;
    default:
        return false;
    }
    series->chosen = row < 0 ? 0 : row > last ? last : row;
    series->follow = true;
    return true;
}

/* Within the square at (x, y), at its own proportions. */
static void draw_picture(ang_viewer *viewer, int row, double x, double y, double side) {
    ang_gui *gui = viewer->gui;
    const ang_series_entry *entry = &viewer->series.list.entry[row];
    ang_rect square = {x, y, side, side};
    ang_gui_fill(gui, square, ANG_INK(0, 0, 0, 255));
    if (viewer->series.picture && entry->width > 0) {
        ang_gui_picture(gui, &viewer->series.picture[row], ang_rect_within(square, entry->width, entry->height));
    } else if (entry->looked_at) {
        ang_gui_write(gui, x + side / 2, y + (side - ang_gui_text_height(gui, true)) / 2, 0.5, true, false, ANG_INK_DIM,
                      "no picture");
    }
    ang_gui_frame(gui, square, viewer->theme->edge);
}

/* "shown", or what the loader thinks of it; each with a sign of its own. Whether it is a warning. */
static bool verdict_of(const ang_viewer *viewer, int row, char *text, size_t size) {
    ang_series_entry entry = viewer->series.list.entry[row];
    char verdict[480];
    bool shown = row == shown_row(viewer);
    if (shown) entry.warnings = viewer->study.warnings; /* reading has found more than looking */
    ang_series_entry_verdict(&entry, verdict, sizeof verdict);
    bool warned = entry.loadable && entry.warnings > 0;
    const char *sign = shown ? "\u25cf shown" : !entry.loadable ? "\u00d7" : warned ? "\u25b2" : "";
    bool plain = shown && !warned && !entry.remark[0];
    snprintf(text, size, "%s%s%s", sign, !sign[0] || plain ? "" : shown ? ", " : " ", plain ? "" : verdict);
    return warned;
}

static void draw_verdict(ang_viewer *viewer, int row, double x, double y, double room) {
    const ang_theme *theme = viewer->theme;
    char text[512], fitted[sizeof text + 4];
    bool warned = verdict_of(viewer, row, text, sizeof text);
    ang_gui_write(viewer->gui, x, y, 0, true, false,
                  row == shown_row(viewer) ? theme->accent
                  : warned                 ? theme->warning
                                           : theme->dim,
                  ang_text_fitted(viewer->gui, text, room, fitted, sizeof fitted));
}

/* All that there is to say of the chosen one, which a row may have cut off. */
static void show_reason(ang_viewer *viewer) {
    ang_gui *gui = viewer->gui;
    const ang_series_browser *series = &viewer->series;
    if (series->list.count == 0) return;
    char text[512], verdict[480];
    verdict_of(viewer, series->chosen, verdict, sizeof verdict);
    snprintf(text, sizeof text, "Series %d: %s", series->list.entry[series->chosen].number, verdict);
    ang_gui_gap(gui, ang_gui_px(gui, 4));
    ang_gui_small_begin(gui);
    ang_gui_paragraph(gui, text, 0);
    ang_gui_small_end(gui);
}

static void draw_row(ang_viewer *viewer, int row) {
    ang_gui *gui = viewer->gui;
    const ang_theme *theme = viewer->theme;
    ang_series_browser *series = &viewer->series;
    const ang_series_entry *entry = &series->list.entry[row];
    ang_canvas canvas;
    ang_rect rect = ang_gui_rows_row(gui, row, row == series->chosen, true, &canvas);
    double margin = ang_gui_px(gui, MARGIN), side = ang_gui_px(gui, PICTURE);
    draw_picture(viewer, row, rect.x + margin, rect.y + margin, side);
    double x = rect.x + side + 2 * margin + ang_gui_px(gui, 2), y = rect.y + margin;
    double line = (side - ang_gui_text_height(gui, true)) / 3;
    char text[256];
    bool dated = series->dates && entry->date[0] && ang_identity_shown(viewer);
    double room = fmax(rect.x + rect.width - x - margin, 1);
    ang_gui_clip(gui, (ang_rect){x, rect.y, room, rect.height});
    ang_series_entry_title(entry, ang_identity_shown(viewer), text, sizeof text);
    ang_gui_write(gui, x, y - ang_gui_px(gui, 1), 0, false, false, entry->loadable ? theme->text : theme->dim, text);
    char phases[32] = "";
    if (entry->phases > 1) snprintf(phases, sizeof phases, ", %d phases", entry->phases);
    snprintf(text, sizeof text, "%d x %d, %d slice%s%s%s%s", entry->dims[0], entry->dims[1], entry->dims[2],
             ang_plural(entry->dims[2]), phases, dated ? ",  " : "", dated ? entry->date : "");
    ang_gui_write(gui, x, y + line, 0, true, false, theme->dim, entry->dims[0] > 0 ? text : "");
    const double *mm = entry->spacing_mm;
    snprintf(text, sizeof text, "%.3g x %.3g x %.3g mm", mm[0], mm[1], mm[2]);
    ang_gui_write(gui, x, y + 2 * line, 0, true, false, theme->dim, entry->dims[0] > 0 ? text : "");
    draw_verdict(viewer, row, x, y + 3 * line, room);
    ang_gui_unclip(gui);
    char verdict[480];
    ang_series_entry_verdict(entry, verdict, sizeof verdict);
    if (canvas.hovered) ang_gui_tooltip(gui, verdict);
    if (canvas.pressed) series->chosen = row;
    if (canvas.clicked) choose(viewer, row);
}

void ang_series_browser_show(ang_viewer *viewer) {
    ang_gui *gui = viewer->gui;
    ang_series_browser *series = &viewer->series;
    double button = ang_gui_px(gui, 64), gap = ang_gui_px(gui, 8);
    ang_gui_heading(gui, "SERIES");
    ang_gui_checkbox(gui, "Dates", &series->dates);
    ang_gui_tooltip(gui, "When each was acquired: may identify a patient");
    ang_gui_same_line(gui);
    ang_gui_skip(gui, fmax(ang_gui_room(gui) - 2 * button - gap, 0));
    if (ang_gui_button(gui, "Report", button, viewer->ready)) viewer->notes = true;
    ang_gui_tooltip(gui, "What loading found and assumed. Key F2.");
    ang_gui_same_line(gui);
    if (ang_gui_button(gui, "Close", button, true)) series->open = false;
    if (series->failure[0])
        ang_gui_paragraph(gui, series->failure, 0);
    else if (series->list.count == 0)
        ang_gui_text_dim(gui, "Looking at the series ...");
    ang_rows_part part;
    double row_height = ang_gui_px(gui, PICTURE + 2 * MARGIN);
    double reason = ang_gui_px(gui, 12) + REASON_LINES * (ang_gui_text_height(gui, true) + ang_gui_px(gui, 1));
    ang_gui_rows_begin(gui, "series", 0, -reason, row_height, series->list.count, series->follow ? series->chosen : -1,
                       &part);
    series->follow = false;
    for (int row = part.first; row < part.end; row++) draw_row(viewer, row);
    ang_gui_rows_end(gui);
    show_reason(viewer);
}
