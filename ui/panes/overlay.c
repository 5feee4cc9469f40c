#include "ui/panes/overlay.h"

#include "core/scene/annotation.h"
#include "ui/panes/volume_pane.h"
#include "ui/study.h"
#include "ui/viewer_private.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static const double margin = 8; /* from a pane's edges, at scale 1 */

ang_ink ang_pane_ink(ang_pane pane, unsigned alpha) {
    /* 3D Slicer's: red, green, yellow; violet for the volume. */
    static const ang_ink inks[ANG_PANES] = {ANG_INK(243, 74, 51, 0), ANG_INK(110, 176, 75, 0), ANG_INK(237, 213, 76, 0),
                                            ANG_INK(140, 140, 224, 0)};
    return inks[pane] | (ang_ink)alpha << 24;
}

static bool small(const ang_viewer *viewer, ang_rect rect) {
    return rect.width < ang_gui_px(viewer->gui, 260) || rect.height < ang_gui_px(viewer->gui, 160);
}

void ang_pane_letters(ang_viewer *viewer, ang_rect rect, ang_vec3 right, ang_vec3 down) {
    ang_gui *gui = viewer->gui;
    double edge = ang_gui_px(gui, margin), tall = ang_gui_text_height(gui, false);
    double x = rect.x + rect.width / 2, y = rect.y + rect.height / 2 - tall / 2;
    ang_letters text = ang_letters_make(ang_vec3_scale(right, -1));
    ang_gui_write(gui, rect.x + edge, y, 0, false, true, ANG_INK_TEXT, text.text);
    text = ang_letters_make(right);
    ang_gui_write(gui, rect.x + rect.width - edge, y, 1, false, true, ANG_INK_TEXT, text.text);
    text = ang_letters_make(ang_vec3_scale(down, -1));
    ang_gui_write(gui, x, rect.y + edge / 2, 0.5, false, true, ANG_INK_TEXT, text.text);
    text = ang_letters_make(down);
    ang_gui_write(gui, x, rect.y + rect.height - edge / 2 - tall, 0.5, false, true, ANG_INK_TEXT, text.text);
}

void ang_pane_bar(ang_viewer *viewer, ang_rect rect, double mm_per_pixel, bool at_centre) {
    ang_gui *gui = viewer->gui;
    if (small(viewer, rect) || !(mm_per_pixel > 0)) return;
    double mm = ang_round_length(fmin(rect.width / 4, ang_gui_px(gui, 140)) * mm_per_pixel), length = mm / mm_per_pixel;
    if (!(mm > 0)) return;
    char text[64];
    snprintf(text, sizeof text, "%.6g mm%s", mm, at_centre ? " at the centre" : "");
    double line = ang_gui_text_height(gui, true) + ang_gui_px(gui, 3);
    double right = rect.x + rect.width - ang_gui_px(gui, margin);
    double y = rect.y + rect.height - ang_gui_px(gui, margin) - 2 * line - ang_gui_px(gui, 8);
    double tick = ang_gui_px(gui, 4), thick = fmax(ang_gui_px(gui, 1), 1);
    const ang_ink dark = ANG_INK(0, 0, 0, 200);
    ang_rect parts[3] = {{right - length, y, length, thick},
                         {right - length, y - tick, thick, 2 * tick + thick},
                         {right - thick, y - tick, thick, 2 * tick + thick}};
    for (int i = 0; i < 3; i++) {
        ang_rect around = {parts[i].x - 1, parts[i].y - 1, parts[i].width + 2, parts[i].height + 2};
        ang_gui_fill(gui, around, dark);
    }
    for (int i = 0; i < 3; i++) ang_gui_fill(gui, parts[i], ANG_INK_TEXT);
    ang_gui_write(gui, right, y - tick - line, 1, true, true, ANG_INK_TEXT, text);
}

const char *ang_text_fitted(const ang_gui *gui, const char *text, double room, char *fitted, size_t size) {
    if (ang_gui_text_width(gui, text, true) <= room) return text;
    size_t length = strlen(text);
    do {
        while (length > 0 && ((unsigned char)text[--length] & 0xc0) == 0x80) {
        }
        snprintf(fitted, size, "%.*s\u2026", (int)length, text);
    } while (length > 0 && ang_gui_text_width(gui, fitted, true) > room);
    return fitted;
}

void ang_pane_corner(ang_viewer *viewer, ang_rect rect, int right, int bottom, int line, const char *text) {
    ang_gui *gui = viewer->gui;
    if (small(viewer, rect)) return;
    double edge = ang_gui_px(gui, margin), tall = ang_gui_text_height(gui, true) + ang_gui_px(gui, 3);
    double x = right ? rect.x + rect.width - edge : rect.x + edge;
    double y =
        bottom ? rect.y + rect.height - edge - (line + 1) * tall + ang_gui_px(gui, 3) : rect.y + edge + line * tall;
    /* The pane's letter stands before its name. */
    if (!right && !bottom && line == 0) x += ang_gui_px(gui, 26);
    /* The middle of the edge is the letter's. */
    double room = rect.width / 2 - ang_gui_px(gui, 26);
    room -= right ? edge : x - rect.x;
    char fitted[256];
    ang_gui_write(gui, x, y, right, true, true, ANG_INK_TEXT, ang_text_fitted(gui, text, room, fitted, sizeof fitted));
}

void ang_pane_frame(ang_viewer *viewer, ang_rect rect, ang_pane pane) {
    static const char *const letters[ANG_PANES] = {"A", "C", "S", "3D"};
    ang_gui *gui = viewer->gui;
    /* Keys apply to the one with the bright frame of two lines; two more say that it was chosen by one. */
    bool active = viewer->focus.pane == (int)pane;
    int lines = !active ? 1 : viewer->focus.by_key && !ang_gui_navigating(gui) ? 4 : 2;
    for (int i = 0; i < lines; i++)
        ang_gui_frame(gui, ang_rect_inset(rect, i * ang_gui_hairline(gui)), ang_pane_ink(pane, active ? 255 : 110));
    double edge = ang_gui_px(gui, margin);
    ang_gui_write(gui, rect.x + edge, rect.y + edge - ang_gui_px(gui, 1), 0, false, true, ang_pane_ink(pane, 255),
                  letters[pane]);
}

/* The status line. Cells have widths that do not follow their text; those that would reach beyond `end` are left out,
 * since a message needs the room. */
typedef struct status {
    ang_viewer *viewer;
    double x, y, end;
} status;

static void cell(status *status, double width, bool dim, const char *text) {
    const ang_theme *theme = status->viewer->theme;
    width = ang_gui_px(status->viewer->gui, width);
    if (status->x + width > status->end) {
        status->end = -INFINITY;
        return;
    }
    ang_gui_write(status->viewer->gui, status->x, status->y, 0, true, false, dim ? theme->dim : theme->text, text);
    status->x += width;
}

/* "L 12.3  P 4.0  H 100.0 mm": each with the letter of the side on which it lies. */
static void write_place(ang_vec3 mm, char *text, size_t size) {
    static const char positive[] = "LPH", negative[] = "RAF";
    double at[3] = {mm.x, mm.y, mm.z};
    char side[3];
    for (int i = 0; i < 3; i++) side[i] = at[i] < 0 ? negative[i] : positive[i];
    snprintf(text, size, "%c %.1f  %c %.1f  %c %.1f mm", side[0], fabs(at[0]), side[1], fabs(at[1]), side[2],
             fabs(at[2]));
}

static void status_cells(status *status) {
    ang_viewer *viewer = status->viewer;
    const ang_document *document = &viewer->document;
    const char *unit = viewer->study.hounsfield ? "HU" : "";
    char text[256];
    bool hovering = viewer->hovered < ANG_PANE_VOLUME;
    write_place(hovering ? viewer->hovered_mm : viewer->document.crosshair, text, sizeof text);
    cell(status, 200, false, text);
    double hu = hovering ? viewer->hovered_hu : ang_viewer_hu_at(viewer, viewer->document.crosshair);
    if (isnan(hu))
        snprintf(text, sizeof text, "outside");
    else
        snprintf(text, sizeof text, "%.0f %s", hu, unit);
    cell(status, 72, false, text);
    snprintf(text, sizeof text, "C %.0f  W %.0f", document->window_centre, document->window_width);
    cell(status, 110, true, text);
    ang_pane pane = (ang_pane)viewer->focus.pane;
    snprintf(text, sizeof text, "zoom %.0f %%",
             pane == ANG_PANE_VOLUME ? ang_volume_zoom_percent(viewer) : ang_slice_zoom_percent(viewer, pane));
    cell(status, 92, true, text);
    bool measures = viewer->tool == ANG_TOOL_MEASURE;
    snprintf(text, sizeof text, "tool: %s",
             measures ? ang_measure_kind_name(viewer->measuring.kind) : ang_tool_name(viewer->tool));
    cell(status, 110, true, text);
    const ang_volume_picture *volume = &viewer->volume;
    snprintf(text, sizeof text, "%s, %s", volume->method ? volume->method->name : "-", ang_mode_name(document->mode));
    cell(status, 110, true, text);
    const char *state = volume->refined ? "refined" : ang_volume_level(viewer) > 0 ? "refining" : "coarse";
    snprintf(text, sizeof text, "%.0f ms, %s", volume->frame_ms, state);
    cell(status, 110, true, text);
    ang_picture_error_text(viewer, text, sizeof text);
    cell(status, 150, true, text);
}

void ang_status_line(ang_viewer *viewer, ang_rect rect) {
    ang_gui *gui = viewer->gui;
    ang_gui_area_begin(gui, "status", rect, true);
    const char *message = viewer->shot.posed ? "" : viewer->message; /* it may name a folder */
    double margin = ang_gui_px(gui, 12), right = rect.x + rect.width - margin, left = rect.x + margin;
    double y = rect.y + (rect.height - ang_gui_text_height(gui, true)) / 2;
    double needed = message[0] ? ang_gui_text_width(gui, message, true) + margin : 0;
    status status = {viewer, left, y, right - needed};
    if (viewer->ready) status_cells(&status);
    if (message[0]) {
        char fitted[sizeof viewer->message + 4];
        ang_ink ink = viewer->message_bad ? viewer->theme->bad : viewer->theme->accent;
        ang_gui_write(gui, right, y, 1, true, false, ink,
                      ang_text_fitted(gui, message, right - left, fitted, sizeof fitted));
    }
    ang_gui_area_end(gui);
}
