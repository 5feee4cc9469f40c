#include "ui/dialogs/help.h"

#include "ui/actions/actions.h"
#include "ui/viewer_private.h"

#include <string.h>

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
