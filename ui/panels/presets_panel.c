#include "ui/panels/presets_panel.h"

#include "ui/viewer_private.h"

#include <stdio.h>
#include <string.h>

/* What the document is compared with and goes back to follows undo and sessions, which bring other presets. */
static void keep_saved(ang_viewer *viewer, const ang_preset *const *presets, int chosen) {
    if (chosen < 0 || strcmp(viewer->chosen.preset, viewer->document.preset) == 0) return;
    viewer->chosen = viewer->document;
    ang_document_take_preset(&viewer->chosen, presets[chosen]);
}

static void choose(ang_viewer *viewer, const ang_preset *const *presets, int count, int chosen) {
    ang_gui *gui = viewer->gui;
    const char *names[ANG_PRESETS];
    char changed[96];
    for (int i = 0; i < count; i++) names[i] = presets[i]->name;
    if (chosen >= 0 && viewer->document.edited) {
        snprintf(changed, sizeof changed, "%s (changed)", names[chosen]);
        names[chosen] = changed;
    }
    int taken = chosen;
    double all = ang_gui_px(gui, 72);
    if (ang_gui_choice(gui, "##preset", names, count, &taken, ang_gui_room(gui) - all - ang_gui_px(gui, 8)))
        ang_viewer_choose_preset(viewer, presets[taken]);
    if (chosen >= 0) ang_gui_tooltip(gui, presets[chosen]->description);
    ang_gui_same_line(gui);
    if (ang_gui_button(gui, "Pictures", all, true)) viewer->browsing = !viewer->browsing;
    ang_gui_tooltip(gui, "Every preset as a small picture of this volume. Key B.");
}

static const char *const words[4] = {"Compare", "Reset", "Save...", "Delete..."};

/* Of the buttons: in one row each with the same room beside its word, else, where the panel is narrow, halves of it. */
static bool widths(const ang_gui *gui, double width[4]) {
    double apart = ang_gui_px(gui, 8), room = ang_gui_room(gui), beside = room - 3 * apart;
    for (int i = 0; i < 4; i++) {
        width[i] = ang_gui_text_width(gui, words[i], false);
        beside -= width[i];
    }
    bool one_row = beside >= 8 * ang_gui_px(gui, 8);
    for (int i = 0; i < 4; i++) width[i] = one_row ? width[i] + beside / 4 : (room - apart) / 2;
    return one_row;
}

void ang_presets_panel(ang_viewer *viewer) {
    ang_gui *gui = viewer->gui;
    const ang_preset *presets[ANG_PRESETS];
    int count = ang_presets(viewer, presets), chosen = ang_preset_chosen(viewer, presets, count);
    keep_saved(viewer, presets, chosen);
    ang_gui_heading(gui, "PRESET");
    choose(viewer, presets, count, chosen);
    ang_thumbnails_strip(viewer);
    bool changed = viewer->document.edited, key = viewer->input.key['D'] && viewer->input.modifiers == 0;
    double width[4];
    bool one_row = widths(gui, width);
    ang_gui_button(gui, words[0], width[0], changed);
    viewer->comparing = changed && (ang_gui_pressed(gui) || (key && !viewer->typing && !ang_gui_popup_open(gui)));
    ang_gui_tooltip(gui, "Shows the preset as it is saved as long as this is held down. Key D.");
    ang_gui_same_line(gui);
    /* The list may be another one after this. */
    const ang_preset *saved = chosen >= 0 ? presets[chosen] : NULL;
    if (ang_gui_button(gui, words[1], width[1], changed && saved)) ang_viewer_choose_preset(viewer, saved);
    ang_gui_tooltip(gui, "Back to the preset as it is saved");
    if (one_row) ang_gui_same_line(gui);
    if (ang_gui_button(gui, words[2], width[2], true)) ang_preset_dialog_open(viewer, false);
    ang_gui_tooltip(gui, "Saves what is shown as a preset of your own. Ctrl+P.");
    ang_gui_same_line(gui);
    bool own = saved && viewer->host->preset_place(viewer->host->context, saved->name) == ANG_PRESET_AT_OWN;
    if (ang_gui_button(gui, words[3], width[3], own)) ang_preset_dialog_open(viewer, true);
    ang_gui_tooltip(gui, own ? "Deletes this preset of yours" : "Only presets of your own can be deleted");
}
