#include "ui/dialogs/messages.h"

#include "ui/dialogs/help.h"
#include "ui/dialogs/load_report.h"
#include "ui/viewer_private.h"

#include <stdio.h>

enum { SLICE = 320 }; /* side of the slice that is shown while loading, at scale 1 */

/* The slice that was read last, in a square that does not change with it: where the panes show another study. */
static void show_slice(ang_viewer *viewer) {
    ang_gui *gui = viewer->gui;
    const ang_slice_preview *preview = &viewer->preview;
    double side = ang_gui_px(gui, SLICE);
    ang_canvas canvas;
    ang_gui_canvas(gui, "slice", side, side, &canvas);
    ang_rect square = canvas.rect;
    ang_gui_fill(gui, square, ANG_INK(0, 0, 0, 255));
    if (preview->count == 0 || preview->texture.width < 1) return;
    ang_gui_picture(gui, &preview->texture, ang_rect_within(square, preview->texture.width, preview->texture.height));
    char text[64];
    snprintf(text, sizeof text, "%zu / %zu", preview->index + 1, preview->count);
    ang_gui_write(gui, square.x + ang_gui_px(gui, 6), square.y + ang_gui_px(gui, 4), 0, true, true, ANG_INK_TEXT, text);
}

static void show_loading(ang_viewer *viewer) {
    ang_gui *gui = viewer->gui;
    char what[64];
    double width = ang_gui_px(gui, SLICE);
    double fraction = ang_loading_progress(&viewer->loading, what);
    bool stopping = ang_loading_stopping(&viewer->loading);
    ang_gui_message_begin(gui, "loading");
    if (viewer->ready) {
        show_slice(viewer);
        ang_gui_gap(gui, ang_gui_px(gui, 4));
    }
    ang_gui_text(gui, "%s", stopping ? "stopping" : what[0] ? what : "opening");
    ang_gui_progress(gui, fraction, width);
    ang_gui_gap(gui, ang_gui_px(gui, 4));
    if (ang_gui_button(gui, "Cancel", ang_gui_px(gui, 96), !stopping)) ang_loading_stop(&viewer->loading);
    ang_gui_same_line(gui);
    ang_gui_text_dim(gui, "%3.0f %%", 100 * fraction);
    ang_gui_message_end(gui);
}

static void show_failure(ang_viewer *viewer) {
    ang_gui *gui = viewer->gui;
    ang_gui_message_begin(gui, "failure");
    ang_gui_paragraph(gui, viewer->failure, ang_gui_px(gui, 480));
    ang_gui_gap(gui, ang_gui_px(gui, 4));
    if (ang_gui_button(gui, "Open...", ang_gui_px(gui, 96), true)) ang_file_browser_open(viewer);
    ang_gui_same_line(gui);
    if (ang_gui_button(gui, "Series...", ang_gui_px(gui, 96), viewer->failed.count > 0)) viewer->series.open = true;
    ang_gui_tooltip(gui, "What there is, series by series, and what is wrong with it");
    ang_gui_same_line(gui);
    if (ang_gui_button(gui, viewer->ready ? "Close" : "Quit", ang_gui_px(gui, 96), true)) {
        if (!viewer->ready) ang_window_close(viewer->window);
        viewer->failure[0] = '\0';
    }
    ang_gui_message_end(gui);
}

static void show_welcome(ang_viewer *viewer) {
    ang_gui *gui = viewer->gui;
    ang_gui_message_begin(gui, "welcome");
    ang_gui_text(gui, "Drop a DICOM folder, a zip archive or another volume here, or open one.");
    ang_gui_gap(gui, ang_gui_px(gui, 4));
    if (ang_gui_button(gui, "Open...", ang_gui_px(gui, 96), true)) ang_file_browser_open(viewer);
    ang_gui_message_end(gui);
}

void ang_messages(ang_viewer *viewer) {
    if (viewer->files.open)
        ang_file_browser_show(viewer);
    else if (viewer->loading.running)
        show_loading(viewer);
    else if (viewer->failure[0])
        show_failure(viewer);
    else if (!viewer->ready)
        show_welcome(viewer);
    else if (viewer->notes)
        ang_load_report_window(viewer);
    else if (viewer->preset_dialog.open)
        ang_preset_dialog_show(viewer);
    else if (viewer->browsing)
        ang_thumbnails_show(viewer);
    ang_help(viewer);
}
