#include "ui/dialogs/preset_dialog.h"

#include "ui/viewer_private.h"

#include <stdio.h>
#include <string.h>

/* Until a field that asks for the keyboard has it. */
enum { frames_to_focus = 4 };

void ang_preset_dialog_open(ang_viewer *viewer, bool deletes) {
    ang_preset_dialog *dialog = &viewer->preset_dialog;
    const ang_preset *presets[ANG_PRESETS];
    int count = ang_presets(viewer, presets), chosen = ang_preset_chosen(viewer, presets, count);
    *dialog = (ang_preset_dialog){.open = true, .deletes = deletes};
    viewer->redraws = frames_to_focus;
    snprintf(dialog->name, sizeof dialog->name, "%s", viewer->document.preset);
    if (chosen >= 0) snprintf(dialog->description, sizeof dialog->description, "%s", presets[chosen]->description);
}

static void problem(ang_preset_dialog *dialog, const ang_error *err) {
    snprintf(dialog->problem, sizeof dialog->problem, "%s", err->message);
}

/* The presets' pictures belong to a list that is there no longer. */
static void presets_changed(ang_viewer *viewer) {
    ang_thumbnails_renew(viewer);
    viewer->preset_dialog.open = false;
    ang_gui_leave_widgets(viewer->gui); /* what was entered kept the keyboard */
}

static void save(ang_viewer *viewer) {
    ang_preset_dialog *dialog = &viewer->preset_dialog;
    const ang_viewer_host *host = viewer->host;
    ang_error err = {0};
    if (!host->save_preset(host->context, &viewer->document, dialog->name, dialog->description, viewer->saved,
                           sizeof viewer->saved, &err)) {
        viewer->saved[0] = '\0';
        problem(dialog, &err);
        return;
    }
    ang_document *document = &viewer->document;
    memset(document->preset, 0, sizeof document->preset);
    snprintf(document->preset, sizeof document->preset, "%s", dialog->name);
    document->edited = false;
    document->shift_hu = 0;
    document->stretch = 1;
    viewer->chosen = *document;
    presets_changed(viewer);
    ang_viewer_say(viewer, false, "Saved %s", viewer->saved);
}

/* What the name would hide or replace; empty: nothing. */
static const char *clash(const ang_viewer *viewer) {
    switch (viewer->host->preset_place(viewer->host->context, viewer->preset_dialog.name)) {
    case ANG_PRESET_AT_OWN:
        return "You have a preset of this name. It would be replaced.";
    case ANG_PRESET_AT_INSTALLED:
        return "A preset of this name comes with the program. Yours would be shown instead of it until you delete "
               "yours.";
    case ANG_PRESET_AT_NOWHERE:
        break;
    }
    return "";
}

/* Buttons at the dialog's foot; what was decided. */
static void decide(ang_viewer *viewer, const char *label, bool enabled, bool entered, bool *done) {
    ang_gui *gui = viewer->gui;
    ang_gui_gap(gui, ang_gui_px(gui, 4));
    *done = ang_gui_button(gui, label, ang_gui_px(gui, 96), enabled) || (entered && enabled);
    ang_gui_same_line(gui);
    if (ang_gui_button(gui, "Cancel", ang_gui_px(gui, 96), true)) viewer->preset_dialog.open = false;
}

/* In two lines, so that nothing moves when there is something to say. */
static void say(ang_gui *gui, const char *text, double width) {
    char lines[1100];
    bool one = ang_gui_text_width(gui, text, false) <= width;
    snprintf(lines, sizeof lines, "%s%s", text[0] ? text : " ", one ? "\n " : "");
    ang_gui_paragraph(gui, lines, width);
}

static void show_saving(ang_viewer *viewer) {
    ang_gui *gui = viewer->gui;
    ang_preset_dialog *dialog = &viewer->preset_dialog;
    double width = ang_gui_px(gui, 400);
    char before[sizeof dialog->name];
    memcpy(before, dialog->name, sizeof before);
    ang_gui_text(gui, "Save as a preset of your own");
    ang_gui_gap(gui, ang_gui_px(gui, 4));
    ang_gui_text_dim(gui, "Name");
    bool entered = ang_gui_text_field(gui, "##name", dialog->name, sizeof dialog->name, width);
    ang_gui_text_dim(gui, "What it is for");
    entered =
        ang_gui_text_field(gui, "##description", dialog->description, sizeof dialog->description, width) || entered;
    if (strcmp(before, dialog->name) != 0) {
        dialog->asked = false;
        dialog->problem[0] = '\0';
    }
    const char *warning = dialog->asked ? clash(viewer) : "";
    const char *told = dialog->problem[0] ? dialog->problem : warning;
    ang_gui_gap(gui, ang_gui_px(gui, 2));
    say(gui, told, width);
    bool done;
    decide(viewer, warning[0] ? "Replace" : "Save", dialog->name[0] != '\0', entered, &done);
    if (!done) return;
    viewer->redraws = frames_to_focus;
    dialog->problem[0] = '\0';
    if (!dialog->asked && clash(viewer)[0])
        dialog->asked = true;
    else
        save(viewer);
}

static void show_deleting(ang_viewer *viewer) {
    ang_gui *gui = viewer->gui;
    ang_preset_dialog *dialog = &viewer->preset_dialog;
    const ang_viewer_host *host = viewer->host;
    char text[160];
    snprintf(text, sizeof text, "Delete your preset \"%s\"? Its file goes and cannot be brought back.", dialog->name);
    ang_gui_paragraph(gui, text, ang_gui_px(gui, 400));
    if (dialog->problem[0]) ang_gui_paragraph(gui, dialog->problem, ang_gui_px(gui, 400));
    bool done;
    decide(viewer, "Delete", true, false, &done);
    if (!done) return;
    ang_error err = {0};
    if (!host->delete_preset(host->context, dialog->name, &err)) {
        problem(dialog, &err);
        return;
    }
    presets_changed(viewer);
    ang_viewer_say(viewer, false, "Deleted the preset %s; what is shown stays", dialog->name);
}

void ang_preset_dialog_show(ang_viewer *viewer) {
    ang_gui_message_begin(viewer->gui, "preset");
    if (viewer->preset_dialog.deletes)
        show_deleting(viewer);
    else
        show_saving(viewer);
    ang_gui_message_end(viewer->gui);
}
