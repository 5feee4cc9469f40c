#include "ui/panels/measures.h"

#include "ui/viewer_private.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void ang_measuring_next(ang_viewer *viewer, int argument) {
    (void)argument;
    int kind = (int)viewer->measuring.kind + (viewer->tool == ANG_TOOL_MEASURE);
    ang_measuring_take(viewer, (ang_measure_kind)(kind % ANG_MEASURE_KINDS));
}

bool ang_measures_any(const ang_viewer *viewer) { return viewer->ready && viewer->document.measures.count > 0; }
bool ang_measures_chosen(const ang_viewer *viewer) {
    /* Delete is the transfer function's while a point of it is chosen. */
    return ang_measures_any(viewer) && ang_measuring_chosen(viewer) >= 0 && viewer->point < 0;
}
bool ang_measures_shown(const ang_viewer *viewer, int argument) {
    (void)argument;
    return !viewer->document.measures.hidden;
}

void ang_measures_delete_chosen(ang_viewer *viewer, int argument) {
    (void)argument;
    ang_measuring_delete(viewer, ang_measuring_chosen(viewer));
}
void ang_measures_clear(ang_viewer *viewer, int argument) {
    (void)argument;
    viewer->document.measures = (ang_measures){0};
}
void ang_measures_toggle(ang_viewer *viewer, int argument) {
    (void)argument;
    viewer->document.measures.hidden = !viewer->document.measures.hidden;
}

void ang_measures_copy(ang_viewer *viewer, int argument) {
    (void)argument;
    ang_error err = {0};
    const ang_measures *measures = &viewer->document.measures;
    char *text = ang_measures_print(measures, ang_measuring_values(viewer), viewer->study.hounsfield ? "HU" : "", &err);
    if (text) {
        ang_window_set_clipboard(viewer->window, text);
        ang_viewer_say(viewer, false, "Copied %d measure%s", measures->count, ang_plural((size_t)measures->count));
    } else {
        ang_viewer_say(viewer, true, "%s", err.message);
    }
    free(text);
}

/* "2  angle  45.0" and a degree sign; of regions the mean and the area. */
static void describe(ang_viewer *viewer, int index, char *text, size_t size) {
    const ang_measurement *m = &viewer->document.measures.item[index];
    char line[ANG_MEASURE_LINES][64];
    int lines =
        ang_measurement_lines(m, &ang_measuring_values(viewer)[index], viewer->study.hounsfield ? "HU" : "", line);
    int used = snprintf(text, size, "%d  %s  %.*s", index + 1, ang_measure_kind_name(m->kind),
                        (int)strcspn(line[0], ","), line[0]);
    if (lines > 1) used += snprintf(text + used, size - (size_t)used, ", %s", line[lines - 1]);
    snprintf(text + used, size - (size_t)used, "##measure%d", index);
}

void ang_measures_list(ang_viewer *viewer) {
    ang_gui *gui = viewer->gui;
    ang_measures *measures = &viewer->document.measures;
    bool making = viewer->tool == ANG_TOOL_MEASURE;
    if (!making && measures->count == 0) return;
    ang_gui_heading(gui, "MEASURES");
    if (making) {
        static const char *const kinds[] = {"Length", "Angle", "Region: ellipse", "Region: rectangle"};
        int kind = (int)viewer->measuring.kind;
        ang_gui_label(gui, "Next");
        if (ang_gui_choice(gui, "##kind", kinds, ANG_MEASURE_KINDS, &kind, 0))
            ang_measuring_take(viewer, (ang_measure_kind)kind);
        ang_gui_tooltip(gui, "What the tool measures next. M goes on to the next kind.");
    }
    for (int i = 0; i < measures->count; i++) {
        char text[200];
        describe(viewer, i, text, sizeof text);
        if (ang_gui_selectable(gui, text, i == ang_measuring_chosen(viewer))) ang_measuring_jump(viewer, i);
        ang_gui_tooltip(gui, "A click goes there: its slices are shown");
    }
    if (measures->count == 0) {
        ang_gui_text_dim(gui, "Drag in a slice, or click its places");
        return;
    }
    double width = (ang_gui_room(gui) - 2 * ang_gui_px(gui, 8)) / 3;
    int chosen = ang_measuring_chosen(viewer);
    if (ang_gui_button(gui, "Delete", width, chosen >= 0)) ang_measuring_delete(viewer, chosen);
    ang_gui_tooltip(gui, "The chosen one; also the key Delete");
    ang_gui_same_line(gui);
    if (ang_gui_button(gui, measures->hidden ? "Show" : "Hide", width, true)) ang_measures_toggle(viewer, 0);
    ang_gui_tooltip(gui, "All of them, in every pane");
    ang_gui_same_line(gui);
    if (ang_gui_button(gui, "Copy", width, true)) ang_measures_copy(viewer, 0);
    ang_gui_tooltip(gui, "As text, with tabs, for a spreadsheet");
}
