#include "ui/dialogs/load_report.h"

#include "ui/panes/identity.h"
#include "ui/viewer_private.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { WIDTH = 640, HEIGHT = 420, NAMES = 112 }; /* at scale 1 */

static void show_facts(ang_viewer *viewer) {
    ang_gui *gui = viewer->gui;
    const ang_facts *facts = &viewer->study.facts;
    for (size_t i = 0; i < facts->count; i++) {
        const ang_fact *fact = &facts->fact[i];
        if (!fact->value) {
            ang_gui_heading(gui, fact->name);
            continue;
        }
        ang_gui_text_dim(gui, "%s", fact->name);
        ang_gui_same_line(gui);
        ang_gui_column(gui, ang_gui_px(gui, NAMES));
        ang_gui_paragraph(gui, fact->value, 0);
    }
}

/* Sentences from `first` up to `end` under a heading: those about files where `files`, else the others. */
static void show_notes(ang_viewer *viewer, const char *heading, size_t first, size_t end, bool files) {
    ang_gui *gui = viewer->gui;
    const ang_notes *notes = &viewer->study.notes;
    bool any = false;
    for (size_t i = first; i < end && i < notes->count; i++) {
        char text[ANG_NOTES_LINE];
        if ((notes->file[i] != NULL) != files) continue;
        if (!any) ang_gui_heading(gui, heading);
        any = true;
        ang_gui_paragraph(gui, ang_notes_line(notes, i, ang_identity_shown(viewer), text, sizeof text), 0);
        ang_gui_gap(gui, ang_gui_px(gui, 2));
    }
}

static void copy_report(ang_viewer *viewer) {
    if (!viewer->study.report) return;
    ang_window_set_clipboard(viewer->window, viewer->study.report);
    ang_viewer_say(viewer, false, "The report is on the clipboard.");
}

bool ang_load_report_key(ang_viewer *viewer, int key, unsigned modifiers) {
    enum { line = 20, page = HEIGHT - 40 };
    if (!viewer->notes) return false;
    bool copy = key == 'C' && modifiers == ANG_MOD_CONTROL;
    double by = key == ANG_KEY_UP          ? -line
                : key == ANG_KEY_DOWN      ? line
                : key == ANG_KEY_PAGE_UP   ? -page
                : key == ANG_KEY_PAGE_DOWN ? page
                                           : 0;
    if (copy) copy_report(viewer);
    viewer->report_scroll += ang_gui_px(viewer->gui, by);
    return copy || by < 0 || by > 0;
}

void ang_load_report_window(ang_viewer *viewer) {
    ang_gui *gui = viewer->gui;
    const ang_study *study = &viewer->study;
    size_t warnings = (size_t)study->warnings, all = study->notes.count;
    double button = ang_gui_px(gui, 96);
    ang_gui_message_begin(gui, "report");
    char title[340];
    ang_gui_text(gui, "%s", ang_identity_series(viewer, title));
    if (study->series_count > 1) {
        ang_gui_same_line(gui);
        ang_gui_text_dim(gui, "series %d of %d", study->series, study->series_count);
    }
    ang_gui_scroll_begin(gui, "found", ang_gui_px(gui, WIDTH),
                         fmin(ang_gui_px(gui, HEIGHT), viewer->input.height - ang_gui_px(gui, 160)));
    ang_gui_scroll_by(gui, viewer->report_scroll);
    viewer->report_scroll = 0;
    show_notes(viewer, "Warnings", 0, warnings, false);
    show_notes(viewer, "Files left out", 0, warnings, true);
    show_notes(viewer, "Assumed", warnings, all, false);
    show_notes(viewer, "Assumed of files", warnings, all, true);
    show_facts(viewer);
    ang_gui_scroll_end(gui);
    ang_gui_gap(gui, ang_gui_px(gui, 4));
    if (ang_gui_button(gui, "Copy", button, study->report != NULL)) copy_report(viewer);
    ang_gui_tooltip(gui,
                    "The whole report as text: Ctrl+C. It names no files and patients, unless --keep-phi was given.");
    ang_gui_same_line(gui);
    if (ang_gui_button(gui, "Series...", button, true)) {
        viewer->notes = false;
        viewer->series.open = true;
    }
    ang_gui_same_line(gui);
    if (ang_gui_button(gui, "Close", button, true)) viewer->notes = false;
    ang_gui_message_end(gui);
}
