#include "ui/dialogs/help.h"

#include "ui/actions/actions.h"
#include "ui/viewer_private.h"

#include <string.h>

/* What is no action but done by hand. */
static const struct {
    const char *heading, *hand, *does;
} hands[] = {
    {"Mouse", "Left drag", "slice: the tool (measure: or clicks); 3D: turn"},
    {"Mouse", "Click", "crosshair here; 3D: to what shows first"},
    {"Mouse", "Middle drag, Space + left drag", "pan"},
    {"Mouse", "Right drag, Ctrl + wheel", "zoom about the pointer"},
    {"Mouse", "Wheel", "slice: scroll; 3D: zoom"},
    {"Mouse", "Shift + drag in 3D", "up, down: shift the preset; across: stretch"},
    {"Mouse", "Ctrl + Shift + drag in 3D", "up, down: overall opacity"},
    {"Mouse", "Drag a handle of the crosshair", "turn the other two planes"},
    {"Mouse", "Double click", "the pane large, and back"},
    {"Mouse", "Drag of a gap between panes", "their sizes; double click: equal"},
    {"Mouse", "Shift in a drag of numbers", "ten times finer"},
    {"More keys", "D held down", "the preset as it is saved"},
    {"More keys", "Esc", "cancel a drag, loading, a window"},
    {"More keys", "1 ... 9", "windows; in the 3D pane: presets"},
    {"More keys", "Shift + arrows", "slice: the crosshair; 3D: turn"},
    {"More keys", "Ctrl + arrows", "pan"},
    {"More keys", "Ctrl + Shift + arrows", "the gaps between the panes"},
    {"More keys", "Tab, Shift + Tab", "to the panel's controls; Esc: to the panes"},
    {"More keys", "Arrows, Enter, Space", "there: move, type, press or change"},
    {"More keys", "Alt alone", "as F10: to the menus"},
    {"More keys", "Ctrl + Tab", "as F6: the next pane"},
    {"More keys", "Ctrl + Shift + P", "as Ctrl + K: find a command"},
};

/* A line of the help: the name of a group, something and what it does, or nothing. */
typedef struct help_line {
    const char *group, *left, *right;
    const ang_action *action; /* whose shortcut is on the left; NULL: `left` */
} help_line;
/* `SPARE`: lines that breaking into columns may add. */
enum { HELP_LINES = 256, COLUMNS = 4, SPARE = 3 * COLUMNS };
/* Pixels at scale 1: what a column takes about in the larger and the smaller letters, a line beside its letters, and
 * all that is around the lines. */
static const double wide = 328, wide_small = 292, between_lines = 4, around = 108;

typedef struct help_list {
    help_line line[HELP_LINES];
    int count;
} help_list;

/* Under the name of its group, which stands after an empty line where it is another than before. */
static void add(help_list *list, const char **group, help_line line) {
    if (list->count + 3 > HELP_LINES) return;
    if (strcmp(*group, line.group) != 0) {
        if (list->count > 0) list->line[list->count++] = (help_line){0};
        list->line[list->count++] = (help_line){.group = line.group};
    }
    *group = line.group;
    list->line[list->count++] = line;
}

static void list_help(help_list *list) {
    int action_count;
    const ang_action *actions = ang_actions(&action_count);
    const char *group = "";
    for (int i = 0; i < action_count; i++)
        add(list, &group, (help_line){.group = actions[i].menu, .right = actions[i].name, .action = &actions[i]});
    for (size_t i = 0; i < sizeof hands / sizeof *hands; i++)
        add(list, &group, (help_line){.group = hands[i].heading, .left = hands[i].hand, .right = hands[i].does});
}

static void show_line(ang_gui *gui, const help_line *line) {
    char text[32];
    ang_gui_table_next(gui);
    if (line->group && !line->right)
        ang_gui_text_accent(gui, line->group);
    else
        ang_gui_text(gui, "%s", line->action ? ang_action_shortcut(line->action, text) : line->left ? line->left : "");
    ang_gui_table_next(gui);
    ang_gui_text_dim(gui, "%s   ", line->right ? line->right : ""); /* room before the next column */
}

/* Breaks the list into columns of one height, at most; a group that goes on in the next has its name there again. */
static int break_columns(const help_list *list, int rows, int columns, help_line *grid) {
    int at = 0;
    memset(grid, 0, (HELP_LINES + SPARE) * sizeof *grid);
    for (int i = 0; i < list->count; i++) {
        const help_line *line = &list->line[i];
        bool top = at % rows == 0, bottom = at % rows == rows - 1;
        if (top && !line->group) continue;
        if (bottom && line->group && !line->right) grid[at++] = (help_line){0}; /* no name at a column's end */
        if (at % rows == 0 && at > 0 && line->right) grid[at++] = (help_line){.group = line->group};
        if (at >= rows * columns) return 0;
        grid[at++] = *line;
    }
    return at;
}

typedef struct help_table {
    help_line grid[HELP_LINES + SPARE];
    int columns, rows;
} help_table;

/* In as many columns as the window has room for; true where all of it shows. */
static bool fill_table(const ang_viewer *viewer, const help_list *list, bool small, help_table *table) {
    const ang_gui *gui = viewer->gui;
    int columns = (int)(viewer->input.width / ang_gui_px(gui, small ? wide_small : wide));
    int most = small ? COLUMNS : COLUMNS - 1;
    columns = columns < 1 ? 1 : columns > most ? most : columns;
    int rows = (list->count + columns - 1) / columns;
    while (break_columns(list, rows, columns, table->grid) == 0) rows++;
    table->columns = columns;
    table->rows = rows;
    double line = ang_gui_text_height(gui, small) + ang_gui_px(gui, between_lines);
    return rows * line + ang_gui_px(gui, around) <= viewer->input.height;
}

void ang_help(ang_viewer *viewer) {
    if (!viewer->help) return;
    ang_gui *gui = viewer->gui;
    help_list list = {0};
    help_table table;
    list_help(&list);
    bool small = !fill_table(viewer, &list, false, &table);
    if (small) fill_table(viewer, &list, true, &table);
    const int columns = table.columns, rows = table.rows;
    ang_gui_message_begin(gui, "help");
    if (small) ang_gui_small_begin(gui);
    bool open = ang_gui_table_begin(gui, "keys", 2 * columns);
    for (int i = 0; i < rows && open; i++)
        for (int j = 0; j < columns; j++) show_line(gui, &table.grid[j * rows + i]);
    if (open) ang_gui_table_end(gui);
    if (small) ang_gui_small_end(gui);
    ang_gui_gap(gui, ang_gui_px(gui, 8));
    ang_gui_text_dim(gui, "Angioscope %s. Not a medical device; not for diagnosis. F1 or Esc closes this.",
                     viewer->host->version);
    ang_gui_message_end(gui);
}
