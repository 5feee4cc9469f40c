/* Menus and the help overlay, made of the table of actions. */
#include "ui/viewer_private.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

const char *ang_action_shortcut(const ang_action *action, char text[32]) {
    char name[8];
    unsigned modifiers = action->modifiers;
    snprintf(text, 32, "%s%s%s%s", modifiers & ANG_MOD_CONTROL ? "Ctrl+" : "", modifiers & ANG_MOD_ALT ? "Alt+" : "",
             modifiers & ANG_MOD_SHIFT ? "Shift+" : "", action->key ? ang_key_name(action->key, name) : "");
    return text;
}

static void list_windows(ang_viewer *viewer) {
    int window_count;
    const ang_window_preset *windows = ang_window_presets(&window_count);
    if (!ang_gui_menu_begin(viewer->gui, "Window level")) return;
    for (int i = 0; i < window_count; i++) {
        char text[80], key[2] = {(char)('1' + i), '\0'};
        if (i == 0)
            snprintf(text, sizeof text, "%s", windows[i].name);
        else
            snprintf(text, sizeof text, "%s   W %.0f  C %.0f", windows[i].name, windows[i].width, windows[i].centre);
        if (ang_gui_menu_item(viewer->gui, text, key, false, viewer->ready)) ang_window_preset_choose(viewer, i);
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

/* What is no action but done by hand. */
static const struct {
    const char *hand, *does;
} hands[] = {
    {"Left drag", "slice: the tool (measure: or clicks); 3D: turn"},
    {"Click", "crosshair here; 3D: to what shows first"},
    {"Middle drag, Space + left drag", "pan"},
    {"Right drag, Ctrl + wheel", "zoom about the pointer"},
    {"Wheel", "slice: scroll; 3D: zoom"},
    {"Shift + drag in 3D", "up, down: shift the preset; across: stretch"},
    {"Ctrl + Shift + drag in 3D", "up, down: overall opacity"},
    {"Drag a handle of the crosshair", "turn the other two planes"},
    {"Double click", "the pane large, and back"},
    {"Drag of a gap between panes", "their sizes; double click: equal"},
    {"Shift in a drag of numbers", "ten times finer"},
    {"D held down", "the preset as it is saved"},
    {"Esc", "cancel a drag, loading, a window"},
    {"1 ... 9", "windows; in the 3D pane: presets"},
    {"Shift + arrows", "slice: the crosshair; 3D: turn"},
    {"Ctrl + arrows", "pan"},
    {"Ctrl + Shift + arrows", "the gaps between the panes"},
    {"Tab, Shift + Tab", "to the panel's controls; Esc: to the panes"},
    {"Arrows, Enter, Space", "there: move, type, press or change"},
    {"Ctrl + Tab", "as F6: the next pane"},
    {"Ctrl + Shift + P", "as Ctrl + K: find a command"},
};

static void help_cells(ang_gui *gui, const char *left, const char *right) {
    ang_gui_table_next(gui);
    ang_gui_text(gui, "%s", left);
    ang_gui_table_next(gui);
    ang_gui_text_dim(gui, "%s", right);
}

/* A line of the help: a menu's name, an action, or, of neither, nothing. */
typedef struct help_line {
    const char *menu;
    const ang_action *action;
} help_line;
enum { HELP_LINES = 256 };

/* Actions under the names of their menus, with a line between menus. */
static int list_help(help_line lines[HELP_LINES]) {
    int action_count, count = 0;
    const ang_action *actions = ang_actions(&action_count);
    const char *menu = "";
    for (int i = 0; i < action_count && count + 3 < HELP_LINES; i++) {
        if (strcmp(menu, actions[i].menu) != 0) {
            if (i > 0) lines[count++] = (help_line){0};
            menu = actions[i].menu;
            lines[count++] = (help_line){.menu = menu};
        }
        lines[count++] = (help_line){.action = &actions[i]};
    }
    return count;
}

static void show_help_line(ang_gui *gui, const help_line *line) {
    char text[32];
    if (line->menu) {
        ang_gui_table_next(gui);
        ang_gui_text_accent(gui, line->menu);
        ang_gui_table_next(gui);
    } else {
        help_cells(gui, line->action ? ang_action_shortcut(line->action, text) : "",
                   line->action ? line->action->name : "");
    }
}

void ang_help(ang_viewer *viewer) {
    if (!viewer->help) return;
    ang_gui *gui = viewer->gui;
    static const help_line none = {0};
    enum { hand_count = sizeof hands / sizeof *hands };
    help_line lines[HELP_LINES];
    /* Three columns of one height; the last one begins with what hands do. */
    int count = list_help(lines), rows = (count + hand_count + 1 + 2) / 3, later = 2 * rows - hand_count - 1;
    ang_gui_message_begin(gui, "help");
    bool open = ang_gui_table_begin(gui, "keys", 6);
    for (int i = 0; i < rows && open; i++) {
        show_help_line(gui, i < count ? &lines[i] : &none);
        show_help_line(gui, rows + i < count ? &lines[rows + i] : &none);
        if (i < hand_count)
            help_cells(gui, hands[i].hand, hands[i].does);
        else
            show_help_line(gui, i > hand_count && later + i < count ? &lines[later + i] : &none);
    }
    if (open) ang_gui_table_end(gui);
    ang_gui_gap(gui, ang_gui_px(gui, 8));
    ang_gui_text_dim(gui, "Angioscope %s. Not a medical device; not for diagnosis. F1 or Esc closes this.",
                     viewer->host->version);
    ang_gui_message_end(gui);
}
