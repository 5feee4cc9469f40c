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

void ang_presets_panel(ang_viewer *viewer) {
    ang_gui *gui = viewer->gui;
    const ang_preset *presets[ANG_PRESETS];
    int count = ang_presets(viewer, presets), chosen = ang_preset_chosen(viewer, presets, count);
    keep_saved(viewer, presets, chosen);
    ang_gui_heading(gui, "PRESET");
    choose(viewer, presets, count, chosen);
    ang_thumbnails_strip(viewer);
    bool changed = viewer->document.edited, key = viewer->input.key['D'] && viewer->input.modifiers == 0;
    /* In two rows where the panel is narrow. */
    double apart = ang_gui_px(gui, 8), least = ang_gui_px(gui, 62);
    int across = ang_gui_room(gui) < 4 * least + 3 * apart ? 2 : 4;
    double width = (ang_gui_room(gui) - (across - 1) * apart) / across;
    ang_gui_button(gui, "Compare", width, changed);
    viewer->comparing = changed && (ang_gui_pressed(gui) || (key && !viewer->typing && !ang_gui_popup_open(gui)));
    ang_gui_tooltip(gui, "Shows the preset as it is saved as long as this is held down. Key D.");
    ang_gui_same_line(gui);
    /* The list may be another one after this. */
    const ang_preset *saved = chosen >= 0 ? presets[chosen] : NULL;
    if (ang_gui_button(gui, "Reset", width, changed && saved)) ang_viewer_choose_preset(viewer, saved);
    ang_gui_tooltip(gui, "Back to the preset as it is saved");
    if (across > 2) ang_gui_same_line(gui);
    if (ang_gui_button(gui, "Save...", width, true)) ang_preset_dialog_open(viewer, false);
    ang_gui_tooltip(gui, "Saves what is shown as a preset of your own. Ctrl+P.");
    ang_gui_same_line(gui);
    bool own = saved && viewer->host->preset_place(viewer->host->context, saved->name) == ANG_PRESET_AT_OWN;
    if (ang_gui_button(gui, "Delete...", width, own)) ang_preset_dialog_open(viewer, true);
    ang_gui_tooltip(gui, own ? "Deletes this preset of yours" : "Only presets of your own can be deleted");
}
