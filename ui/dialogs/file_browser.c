#include "ui/dialogs/file_browser.h"

#include "ui/viewer_private.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { WIDTH = 640, HEIGHT = 360, ROW = 24, RECENT = 176 }; /* of the lists, at scale 1 */

/* Of the lists in pixels, less where the window is small. */
static double list_width(const ang_viewer *viewer) {
    return fmin(ang_gui_px(viewer->gui, WIDTH), viewer->input.width - ang_gui_px(viewer->gui, 84));
}
static double list_height(const ang_viewer *viewer) {
    double least = ang_gui_px(viewer->gui, 3 * ROW), rest = ang_gui_px(viewer->gui, 208);
    return fmax(fmin(ang_gui_px(viewer->gui, HEIGHT), viewer->input.height - rest), least);
}

void ang_file_browser_clear(ang_file_browser *files) {
    ang_file_list_clear(&files->list);
    free(files->shown);
    *files = (ang_file_browser){0};
}

/* Which rows there are, after the path, the filter or the folder has changed. */
static void choose_rows(ang_file_browser *files) {
    free(files->shown);
    files->shown = calloc(files->list.count + 1, sizeof *files->shown);
    files->shown_count = 0;
    if (files->shown) files->shown_count = ang_file_list_show(&files->list, files->filter, files->typed, files->shown);
    files->chosen = files->typed[0] && files->shown_count > 0 ? 0 : -1;
    files->follow = true;
}

static const ang_file_entry *chosen_entry(const ang_file_browser *files) {
    if (files->chosen < 0 || (size_t)files->chosen >= files->shown_count) return NULL;
    return &files->list.entry[files->shown[files->chosen]];
}

/* Lists the folder of the path where it is another than before, and picks out what fits the rest. */
static void follow_path(ang_viewer *viewer) {
    ang_file_browser *files = &viewer->files;
    char path[ANG_PATH_SIZE];
    if (ang_path_restart(files->path)) files->anew = true;
    ang_path_expand(files->path, viewer->host->home, path, sizeof path);
    size_t name_at = ang_path_name_at(path);
    snprintf(files->typed, sizeof files->typed, "%s", path + name_at);
    path[name_at] = '\0';
    if (strcmp(path, files->listed) != 0) {
        ang_error err = {0};
        ang_file_list_clear(&files->list);
        files->failure[0] = '\0';
        snprintf(files->listed, sizeof files->listed, "%s", path);
        if (!viewer->host->list_folder(viewer->host->context, path[0] ? path : ".", &files->list, &err))
            snprintf(files->failure, sizeof files->failure, "%.500s", err.message);
        ang_file_list_sort(&files->list);
    }
    choose_rows(files);
}

static void go_to(ang_viewer *viewer, const char *folder) {
    ang_file_browser *files = &viewer->files;
    size_t length = strlen(folder);
    bool slash = length > 0 && folder[length - 1] == '/';
    int used = snprintf(files->path, sizeof files->path, "%s%s", folder, slash ? "" : "/");
    if (used < 0 || (size_t)used >= sizeof files->path) files->path[0] = '\0'; /* longer than any path may be */
    files->anew = true;
    follow_path(viewer);
}

/* The path that was opened last: what is shown, else the last of earlier runs; empty: none. */
static const char *last_opened(const ang_viewer *viewer) {
    if (viewer->shown.count > 0) return viewer->shown.paths[0];
    return viewer->recent.count > 0 ? viewer->recent.path[0] : "";
}

/* Where the last opened lies, else where the program was started. */
static void go_to_start(ang_viewer *viewer) {
    const ang_viewer_host *host = viewer->host;
    const char *path = last_opened(viewer);
    char folder[ANG_PATH_SIZE];
    bool found = path[0] && host->full_path && host->full_path(host->context, path, folder, sizeof folder);
    if (!found && path[0] == '/') { /* it is gone: what it lay in */
        int used = snprintf(folder, sizeof folder, "%s", path);
        found = used > 0 && (size_t)used < sizeof folder;
    }
    if (found) {
        ang_path_up(folder);
        go_to(viewer, folder);
    }
    if (!found || viewer->files.failure[0]) go_to(viewer, host->folder);
}

void ang_file_browser_open(ang_viewer *viewer) {
    ang_file_browser *files = &viewer->files;
    files->open = true;
    files->listed[0] = '\0'; /* it may have changed */
    files->path[ang_path_name_at(files->path)] = '\0';
    files->anew = true;
    if (files->path[0])
        follow_path(viewer);
    else
        go_to_start(viewer);
}

/* From `folder` to the one above, where its row is chosen. */
static void go_up(ang_viewer *viewer, const char *folder) {
    ang_file_browser *files = &viewer->files;
    char left[ANG_PATH_SIZE], path[ANG_PATH_SIZE];
    snprintf(path, sizeof path, "%s", folder);
    ang_path_up(path);
    snprintf(left, sizeof left, "%s", folder + strlen(path));
    left[strcspn(left, "/")] = '\0';
    go_to(viewer, path);
    for (size_t i = 0; i < files->shown_count && left[0]; i++)
        if (strcmp(files->list.entry[files->shown[i]].name, left) == 0) files->chosen = (int)i;
}

static bool join(const ang_file_browser *files, const char *name, char *path, size_t size) {
    return (size_t)snprintf(path, size, "%s%s", files->listed, name) < size;
}

static void open_path(ang_viewer *viewer, const char *path) {
    viewer->files.open = false;
    ang_viewer_open(viewer, path);
}

/* What Enter and a double click do: a file opens, a folder too where it holds images and no folders; else it is gone
 * into. */
static void enter(ang_viewer *viewer, const ang_file_entry *entry) {
    ang_file_browser *files = &viewer->files;
    char path[ANG_PATH_SIZE];
    if (!join(files, entry->name, path, sizeof path)) return;
    ang_file_list within = {0};
    bool series = entry->folder && viewer->host->list_folder(viewer->host->context, path, &within, NULL) &&
                  ang_file_list_is_series(&within);
    ang_file_list_clear(&within);
    if (entry->folder && !series)
        go_to(viewer, path);
    else
        open_path(viewer, path);
}

/* The folder that is chosen, else the one that is listed, with all that is below it. */
static void open_folder(ang_viewer *viewer) {
    ang_file_browser *files = &viewer->files;
    const ang_file_entry *entry = chosen_entry(files);
    char path[ANG_PATH_SIZE];
    if (join(files, entry && entry->folder ? entry->name : "", path, sizeof path)) open_path(viewer, path);
}

static void press_enter(ang_viewer *viewer, unsigned modifiers) {
    const ang_file_entry *entry = chosen_entry(&viewer->files);
    if (modifiers & ANG_MOD_CONTROL)
        open_folder(viewer);
    else if (entry)
        enter(viewer, entry);
    else if (!viewer->files.typed[0])
        open_folder(viewer);
    else /* what is not listed may be there all the same; if not, that is said */
        open_path(viewer, viewer->files.path);
}

static void complete(ang_viewer *viewer) {
    ang_file_browser *files = &viewer->files;
    char name[ANG_PATH_SIZE];
    ang_file_list_complete(&files->list, files->filter, files->typed, name, sizeof name);
    size_t at = ang_path_name_at(files->path);
    if (at + strlen(name) >= sizeof files->path) return;
    memcpy(files->path + at, name, strlen(name) + 1);
    files->anew = true;
    follow_path(viewer);
}

static void move_to(ang_file_browser *files, int row) {
    int last = (int)files->shown_count - 1;
    files->chosen = row > last ? last : row < 0 ? (last < 0 ? -1 : 0) : row;
    files->follow = true;
}

static void toggle(ang_file_browser *files, bool *flag) {
    *flag = !*flag;
    choose_rows(files);
}

static void open_recent(ang_viewer *viewer, int index) {
    char path[ANG_RECENT_SIZE];
    snprintf(path, sizeof path, "%s", viewer->recent.path[index]); /* which moves up */
    open_path(viewer, path);
}

static void handle_keys(ang_viewer *viewer, int page) {
    ang_file_browser *files = &viewer->files;
    const ang_input *input = &viewer->input;
    for (int i = 0; i < input->press_count && files->open; i++) {
        int key = input->press[i].key;
        unsigned modifiers = input->press[i].modifiers;
        if (key == ANG_KEY_ENTER)
            press_enter(viewer, modifiers);
        else if (key == ANG_KEY_TAB)
            complete(viewer);
        else if (key == 'H' && modifiers == ANG_MOD_CONTROL)
            toggle(files, &files->filter.hidden);
        else if (key == 'F' && modifiers == ANG_MOD_CONTROL)
            toggle(files, &files->filter.all);
        else if (modifiers == ANG_MOD_CONTROL && key >= '1' && key < '1' + viewer->recent.count)
            open_recent(viewer, key - '1');
        else if (key == ANG_KEY_DOWN)
            move_to(files, files->chosen + 1);
        else if (key == ANG_KEY_UP && modifiers & ANG_MOD_ALT)
            go_up(viewer, files->listed);
        else if (key == ANG_KEY_UP)
            move_to(files, files->chosen - 1);
        else if (key == ANG_KEY_PAGE_DOWN)
            move_to(files, files->chosen + page);
        else if (key == ANG_KEY_PAGE_UP)
            move_to(files, files->chosen - page);
        else if (key == ANG_KEY_BACKSPACE && files->was_folder && files->path[0])
            go_up(viewer, files->path); /* whose last slash the field may have taken off */
    }
}

/* "12.3 MB" */
static void write_size(long long bytes, char *text, size_t size) {
    static const char *const units[] = {"B", "kB", "MB", "GB", "TB"};
    double value = (double)bytes;
    int unit = 0;
    while (value >= 999.5 && unit < 4) {
        value /= 1000;
        unit++;
    }
    snprintf(text, size, unit > 0 && value < 99.95 ? "%.1f %s" : "%.0f %s", value, units[unit]);
}

static void draw_row(ang_viewer *viewer, int row) {
    ang_gui *gui = viewer->gui;
    const ang_theme *theme = viewer->theme;
    ang_file_browser *files = &viewer->files;
    const ang_file_entry *entry = &files->list.entry[files->shown[row]];
    ang_canvas canvas;
    ang_rect rect = ang_gui_rows_row(gui, row, row == files->chosen, true, &canvas);
    double y = rect.y + (rect.height - ang_gui_text_height(gui, false)) / 2, edge = ang_gui_px(gui, 8);
    double right = rect.x + rect.width - edge, size_width = ang_gui_px(gui, 72);
    char text[32] = "";
    if (!entry->folder) write_size(entry->bytes, text, sizeof text);
    ang_gui_write(gui, right, y, 1, false, false, theme->dim, text);
    /* A folder is told by its slash. */
    char name[300];
    snprintf(name, sizeof name, "%.280s%s", entry->name, entry->folder ? "/" : "");
    ang_gui_clip(gui, (ang_rect){rect.x, rect.y, rect.width - size_width - edge, rect.height});
    bool plain = entry->folder || entry->image;
    ang_gui_write(gui, rect.x + edge, y, 0, false, false, plain ? theme->text : theme->dim, name);
    ang_gui_unclip(gui);
    if (canvas.pressed) files->chosen = row;
    if (canvas.double_clicked) enter(viewer, entry);
}

/* What was opened last, to be opened again at once. */
static void draw_recent(ang_viewer *viewer) {
    ang_gui *gui = viewer->gui;
    const ang_recent *recent = &viewer->recent;
    int chosen = -1;
    ang_gui_scroll_begin(gui, "recent", ang_gui_px(gui, RECENT), list_height(viewer));
    ang_gui_heading(gui, "RECENT");
    for (int i = 0; i < recent->count; i++) {
        char label[320], help[ANG_RECENT_SIZE + 16];
        const char *name = recent->path[i] + ang_path_name_at(recent->path[i]);
        snprintf(label, sizeof label, "%d  %.280s##%d", i + 1, name, i);
        if (ang_gui_selectable(gui, label, false)) chosen = i;
        if (i < 9)
            snprintf(help, sizeof help, "%s (Ctrl+%d)", recent->path[i], i + 1);
        else
            snprintf(help, sizeof help, "%s", recent->path[i]);
        ang_gui_tooltip(gui, help);
    }
    ang_gui_scroll_end(gui);
    if (chosen >= 0) open_recent(viewer, chosen);
}

static int draw_list(ang_viewer *viewer) {
    ang_gui *gui = viewer->gui;
    ang_file_browser *files = &viewer->files;
    ang_rows_part part;
    double width = list_width(viewer);
    if (viewer->recent.count > 0) {
        draw_recent(viewer);
        ang_gui_same_line(gui);
        width -= ang_gui_px(gui, RECENT + 8);
    }
    ang_gui_rows_begin(gui, "files", width, list_height(viewer), ang_gui_px(gui, ROW), files->shown_count,
                       files->follow ? files->chosen : -1, &part);
    files->follow = false;
    for (int row = part.first; row < part.end && (size_t)row < files->shown_count; row++) draw_row(viewer, row);
    const char *empty = files->failure[0]        ? files->failure
                        : files->list.count == 0 ? "This folder is empty."
                        : files->shown_count > 0 ? NULL
                        : files->typed[0]        ? "Nothing here has such a name."
                                                 : "No folders and no files that could be images here.";
    if (empty) ang_gui_text_dim(gui, "%s", empty);
    ang_gui_rows_end(gui);
    return part.page;
}

/* The folder, with buttons that lead out of it. */
static void draw_path(ang_viewer *viewer) {
    ang_gui *gui = viewer->gui;
    ang_file_browser *files = &viewer->files;
    double button = ang_gui_px(gui, 64), gap = ang_gui_px(gui, 8);
    bool up = false, home = false;
    files->was_folder = files->path[0] && !files->path[ang_path_name_at(files->path)];
    bool typed = ang_gui_path_field(gui, "##path", files->path, sizeof files->path,
                                    list_width(viewer) - 2 * (button + gap), files->anew);
    files->anew = false;
    ang_gui_same_line(gui);
    up = ang_gui_button(gui, "Up", button, strcmp(files->listed, "/") != 0);
    ang_gui_tooltip(gui, "The folder above: Backspace or Alt+Up");
    ang_gui_same_line(gui);
    home = ang_gui_button(gui, "Home", button, viewer->host->home != NULL);
    if (up) go_up(viewer, files->listed);
    if (home) go_to(viewer, viewer->host->home);
    if (typed) follow_path(viewer);
}

static void draw_foot(ang_viewer *viewer) {
    ang_gui *gui = viewer->gui;
    ang_file_browser *files = &viewer->files;
    ang_file_filter before = files->filter;
    const ang_file_entry *entry = chosen_entry(files);
    double button = ang_gui_px(gui, 96), wide = ang_gui_px(gui, 160), gap = ang_gui_px(gui, 8);
    ang_gui_checkbox(gui, "All files", &files->filter.all);
    ang_gui_tooltip(gui, "Also those that by their names are no images: Ctrl+F");
    ang_gui_same_line(gui);
    ang_gui_checkbox(gui, "Hidden", &files->filter.hidden);
    ang_gui_tooltip(gui, "Also names that begin with a dot: Ctrl+H");
    if (before.all != files->filter.all || before.hidden != files->filter.hidden) choose_rows(files);
    ang_gui_same_line(gui);
    ang_gui_skip(gui, fmax(ang_gui_room(gui) - 2 * button - wide - 2 * gap, 0));
    if (ang_gui_button(gui, entry && entry->folder ? "Open the folder chosen" : "Open this folder", wide, true))
        open_folder(viewer);
    ang_gui_tooltip(gui, "All series in and below it: Ctrl+Enter");
    ang_gui_same_line(gui);
    if (ang_gui_button(gui, "Open", button, entry != NULL) && entry) enter(viewer, entry);
    ang_gui_tooltip(gui, "The file, or into the folder: Enter or a double click");
    ang_gui_same_line(gui);
    if (ang_gui_button(gui, "Cancel", button, true)) files->open = false;
}

void ang_file_browser_show(ang_viewer *viewer) {
    ang_gui *gui = viewer->gui;
    ang_file_browser *files = &viewer->files;
    ang_gui_message_begin(gui, "open");
    draw_path(viewer);
    ang_gui_gap(gui, ang_gui_px(gui, 2));
    int page = draw_list(viewer);
    ang_gui_gap(gui, ang_gui_px(gui, 2));
    draw_foot(viewer);
    ang_gui_text_dim(gui, "Enter opens, Ctrl+Enter a folder with all below it, Backspace goes up, Tab completes;");
    ang_gui_text_dim(gui, "Ctrl+1 ... 9 open what is recent, Ctrl+F lists all files, Ctrl+H hidden ones.");
    ang_gui_text_dim(gui, "Presets of 3D Slicer (.vp, .vp.json, .xml) and saved states open like studies.");
    ang_gui_message_end(gui);
    if (files->open) handle_keys(viewer, page);
}
