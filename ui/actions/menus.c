#include "ui/actions/menus.h"

#include "ui/actions/actions.h"
#include "ui/actions/window_presets.h"
#include "ui/viewer_private.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static void list_windows(ang_viewer *viewer) {
    int window_count;
    const ang_window_preset *windows = ang_window_presets(&window_count);
    if (!ang_gui_menu_begin(viewer->gui, "Window level")) return;
    for (int i = 0; i < window_count; i++) {
        char key[64]; /* and beside it, in a column, what it sets */
        snprintf(key, sizeof key, "%d", i + 1);
        if (i > 0) snprintf(key, sizeof key, "%d    C %.0f  W %.0f", i + 1, windows[i].centre, windows[i].width);
        const ang_document *document = &viewer->document;
        bool shown = fabs(document->window_centre - windows[i].centre) < 0.5 &&
                     fabs(document->window_width - windows[i].width) < 0.5;
        if (ang_gui_menu_item(viewer->gui, windows[i].name, key, shown, viewer->ready))
            ang_window_preset_choose(viewer, i);
    }
    ang_gui_menu_end(viewer->gui);
}

/* Below "Open..." of the first menu. */
static void list_recent(ang_viewer *viewer) {
    ang_gui *gui = viewer->gui;
    const ang_recent *recent = &viewer->recent;
    if (!ang_gui_menu_begin(gui, "Open recent")) return;
    char text[160], path[ANG_RECENT_SIZE] = "";
    for (int i = 0; i < recent->count; i++) {
        char label[200];
        snprintf(label, sizeof label, "%s##%d", ang_recent_short(recent->path[i], text, sizeof text), i);
        if (ang_gui_menu_item(gui, label, "", false, true)) strcpy(path, recent->path[i]);
        ang_gui_tooltip(gui, recent->path[i]);
    }
    if (recent->count == 0) ang_gui_menu_item(gui, "Nothing yet", "", false, false);
    ang_gui_menu_separator(gui);
    bool forgets = ang_gui_menu_item(gui, "Forget these", "", false, recent->count > 0);
    ang_gui_menu_end(gui);
    if (path[0]) ang_viewer_open(viewer, path);
    if (forgets) viewer->recent.count = 0;
}

double ang_menus(ang_viewer *viewer) {
    ang_gui *gui = viewer->gui;
    int action_count;
    const ang_action *actions = ang_actions(&action_count);
    double height = ang_gui_menu_bar_begin(gui);
    for (int first = 0; first < action_count;) {
        const char *menu = actions[first].menu;
        int end = first;
        while (end < action_count && strcmp(actions[end].menu, menu) == 0) end++;
        if (strcmp(menu, "Help") == 0) list_windows(viewer);
        bool open = ang_gui_menu_begin(gui, menu);
        for (int i = first; i < end && open; i++) {
            const ang_action *action = &actions[i];
            char text[32];
            bool enabled = ang_action_enabled(viewer, action);
            bool checked = action->checked && enabled && action->checked(viewer, action->argument);
            if (action->apart) ang_gui_menu_separator(gui);
            if (ang_gui_menu_item(gui, action->name, ang_action_shortcut(action, text), checked, enabled))
                action->run(viewer, action->argument);
            if (action->help) ang_gui_tooltip(gui, action->help);
            if (first == 0 && i == 0) list_recent(viewer);
        }
        if (open) ang_gui_menu_end(gui);
        first = end;
    }
    ang_gui_menu_bar_end(gui);
    return height;
}
