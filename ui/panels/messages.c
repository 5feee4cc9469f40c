/* What stands in the middle of the window: loading, a failure, what to open, what loading assumed. */
#include "ui/viewer_private.h"

#include <stdio.h>

static void show_loading(ang_viewer *viewer) {
    ang_gui *gui = viewer->gui;
    char what[64];
    double width = ang_gui_px(gui, 380);
    double fraction = ang_loading_progress(&viewer->loading, what);
    ang_gui_message_begin(gui, "loading");
    ang_gui_text(gui, "%s", what[0] ? what : "opening");
    ang_gui_progress(gui, fraction, width);
    ang_gui_gap(gui, ang_gui_px(gui, 4));
    if (ang_gui_button(gui, "Cancel", ang_gui_px(gui, 96), true)) ang_loading_stop(&viewer->loading);
    ang_gui_same_line(gui);
    ang_gui_text_dim(gui, "%3.0f %%", 100 * fraction);
    ang_gui_message_end(gui);
}

static void show_failure(ang_viewer *viewer) {
    ang_gui *gui = viewer->gui;
    ang_gui_message_begin(gui, "failure");
    ang_gui_paragraph(gui, viewer->failure, ang_gui_px(gui, 480));
    ang_gui_gap(gui, ang_gui_px(gui, 4));
    if (ang_gui_button(gui, "Open...", ang_gui_px(gui, 96), true)) viewer->opening = true;
    ang_gui_same_line(gui);
    if (ang_gui_button(gui, viewer->ready ? "Close" : "Quit", ang_gui_px(gui, 96), true)) {
        if (!viewer->ready) ang_window_close(viewer->window);
        viewer->failure[0] = '\0';
    }
    ang_gui_message_end(gui);
}

static void show_opening(ang_viewer *viewer) {
    ang_gui *gui = viewer->gui;
    double width = ang_gui_px(gui, 480);
    ang_gui_message_begin(gui, "open");
    ang_gui_text(gui, "Folder or file to open");
    bool entered = ang_gui_text_field(gui, "##path", viewer->typed_path, sizeof viewer->typed_path, width);
    ang_gui_gap(gui, ang_gui_px(gui, 4));
    entered = ang_gui_button(gui, "Open", ang_gui_px(gui, 96), viewer->typed_path[0] != '\0') || entered;
    ang_gui_same_line(gui);
    bool closed = ang_gui_button(gui, "Cancel", ang_gui_px(gui, 96), true);
    ang_gui_same_line(gui);
    ang_gui_text_dim(gui, "or drop it on the window");
    if (entered && viewer->typed_path[0]) ang_viewer_open(viewer, viewer->typed_path);
    if (entered || closed) viewer->opening = false;
    ang_gui_message_end(gui);
}

static void show_welcome(ang_viewer *viewer) {
    ang_gui *gui = viewer->gui;
    ang_gui_message_begin(gui, "welcome");
    ang_gui_text(gui, "Drop a folder of DICOM slices here, or open one.");
    ang_gui_gap(gui, ang_gui_px(gui, 4));
    if (ang_gui_button(gui, "Open...", ang_gui_px(gui, 96), true)) viewer->opening = true;
    ang_gui_message_end(gui);
}

static void show_notes(ang_viewer *viewer) {
    ang_gui *gui = viewer->gui;
    ang_gui_message_begin(gui, "notes");
    ang_gui_text(gui, "What loading found and assumed");
    ang_gui_gap(gui, ang_gui_px(gui, 4));
    for (size_t i = 0; i < viewer->study.notes.count; i++) {
        char line[ANG_NOTES_LINE + 16], text[ANG_NOTES_LINE];
        ang_notes_line(&viewer->study.notes, i, true, text, sizeof text);
        snprintf(line, sizeof line, "%s%s", (int)i < viewer->study.warnings ? "Warning: " : "", text);
        ang_gui_paragraph(gui, line, ang_gui_px(gui, 600));
        ang_gui_gap(gui, ang_gui_px(gui, 2));
    }
    if (ang_gui_button(gui, "Close", ang_gui_px(gui, 96), true)) viewer->notes = false;
    ang_gui_message_end(gui);
}

void ang_messages(ang_viewer *viewer) {
    if (viewer->opening)
        show_opening(viewer);
    else if (viewer->loading.running)
        show_loading(viewer);
    else if (viewer->failure[0])
        show_failure(viewer);
    else if (!viewer->ready)
        show_welcome(viewer);
    else if (viewer->notes)
        show_notes(viewer);
    else if (viewer->preset_dialog.open)
        ang_preset_dialog_show(viewer);
    else if (viewer->browsing)
        ang_thumbnails_show(viewer);
    ang_help(viewer);
}
