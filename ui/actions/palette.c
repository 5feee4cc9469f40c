#include "ui/actions/palette.h"

#include "ui/actions/actions.h"
#include "ui/actions/window_presets.h"
#include "ui/state/search.h"
#include "ui/viewer_private.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MOST = 512, ROWS = 12, HELP_RANK = 100 };

typedef struct entry {
    char name[112];
    char shortcut[32];
    bool enabled, on;
    const ang_action *action; /* NULL: a window or a preset */
    const ang_preset *preset; /* NULL: a window */
    int window;
    int rank, order;
} entry;

typedef struct list {
    const char *query;
    entry *entries;
    int count;
} list;

static void add(list *list, entry entry, const char *help) {
    entry.rank = ang_search_rank(list->query, entry.name);
    int by_help = entry.rank < 0 && help ? ang_search_rank(list->query, help) : -1;
    if (by_help >= 0) entry.rank = HELP_RANK + by_help;
    if (entry.rank < 0 || list->count == MOST) return;
    entry.order = list->count;
    list->entries[list->count++] = entry;
}

static void add_actions(const ang_viewer *viewer, list *list) {
    int count;
    const ang_action *actions = ang_actions(&count);
    for (int i = 0; i < count; i++) {
        const ang_action *action = &actions[i];
        entry entry = {.action = action, .enabled = ang_action_enabled(viewer, action)};
        snprintf(entry.name, sizeof entry.name, "%s: %s", action->menu, action->name);
        ang_action_shortcut(action, entry.shortcut);
        entry.on = entry.enabled && action->checked && action->checked(viewer, action->argument);
        add(list, entry, action->help);
    }
}

static void add_windows(const ang_viewer *viewer, list *list) {
    int count;
    const ang_window_preset *windows = ang_window_presets(&count);
    for (int i = 0; i < count; i++) {
        entry entry = {.window = i, .enabled = viewer->ready};
        if (isfinite(windows[i].width))
            snprintf(entry.name, sizeof entry.name, "Window level: %s (C %.0f W %.0f)", windows[i].name,
                     windows[i].centre, windows[i].width);
        else
            snprintf(entry.name, sizeof entry.name, "Window level: %s", windows[i].name);
        snprintf(entry.shortcut, sizeof entry.shortcut, "%d", i + 1);
        add(list, entry, NULL);
    }
}

static void add_presets(const ang_viewer *viewer, list *list) {
    const ang_preset *presets[ANG_PRESETS];
    int count = viewer->ready ? ang_presets(viewer, presets) : 0;
    for (int i = 0; i < count; i++) {
        entry entry = {.preset = presets[i], .enabled = true};
        snprintf(entry.name, sizeof entry.name, "Preset: %s", presets[i]->name);
        entry.on = strcmp(presets[i]->name, viewer->document.preset) == 0;
        add(list, entry, presets[i]->description);
    }
}

static int by_rank(const void *a, const void *b) {
    const entry *left = a, *right = b;
    return left->rank != right->rank ? left->rank - right->rank : left->order - right->order;
}

static void run(ang_viewer *viewer, const entry *entry) {
    viewer->palette.open = false;
    if (entry->action)
        entry->action->run(viewer, entry->action->argument);
    else if (entry->preset)
        ang_viewer_choose_preset(viewer, entry->preset);
    else
        ang_window_preset_choose(viewer, entry->window);
}

void ang_palette_open(ang_viewer *viewer) { viewer->palette = (ang_palette){.open = true}; }

static void append(char *query, size_t size, uint32_t sign) {
    size_t used = strlen(query);
    char bytes[5] = {0};
    if (sign < 0x80) {
        bytes[0] = (char)sign;
    } else if (sign < 0x800) {
        bytes[0] = (char)(0xc0 | sign >> 6);
        bytes[1] = (char)(0x80 | (sign & 63));
    } else if (sign < 0x10000) {
        bytes[0] = (char)(0xe0 | sign >> 12);
        bytes[1] = (char)(0x80 | (sign >> 6 & 63));
        bytes[2] = (char)(0x80 | (sign & 63));
    }
    if (sign >= ' ' && used + strlen(bytes) < size) strcat(query, bytes);
}

static void erase(char *query) {
    size_t used = strlen(query);
    while (used > 0 && (query[used - 1] & 0xc0) == 0x80) used--;
    query[used > 0 ? used - 1 : 0] = '\0';
}

static void take_text(ang_viewer *viewer) {
    ang_palette *palette = &viewer->palette;
    const ang_input *input = &viewer->input;
    bool changed = input->character_count > 0;
    for (int i = 0; i < input->character_count; i++)
        append(palette->query, sizeof palette->query, input->characters[i]);
    for (int i = 0; i < input->press_count; i++) {
        if (input->press[i].key != ANG_KEY_BACKSPACE) continue;
        erase(palette->query);
        changed = true;
    }
    if (changed) palette->chosen = 0, palette->moved = true;
}

/* True where Enter ended it. */
static bool take_keys(ang_viewer *viewer, int count) {
    ang_palette *palette = &viewer->palette;
    const ang_input *input = &viewer->input;
    bool entered = false;
    for (int i = 0; i < input->press_count; i++) {
        int key = input->press[i].key;
        int by = key == ANG_KEY_DOWN        ? 1
                 : key == ANG_KEY_UP        ? -1
                 : key == ANG_KEY_PAGE_DOWN ? ROWS
                 : key == ANG_KEY_PAGE_UP   ? -ROWS
                                            : 0;
        entered = entered || key == ANG_KEY_ENTER;
        palette->chosen += by;
        if (by != 0) palette->moved = true;
    }
    palette->chosen = palette->chosen >= count ? count - 1 : palette->chosen;
    palette->chosen = palette->chosen < 0 ? 0 : palette->chosen;
    return entered;
}

static void show_query(ang_viewer *viewer, double width) {
    ang_gui *gui = viewer->gui;
    ang_canvas field;
    const char *query = viewer->palette.query;
    double tall = ang_gui_px(gui, 28), inset = ang_gui_px(gui, 8);
    ang_gui_canvas(gui, "query", width, tall, &field);
    ang_gui_fill(gui, field.rect, viewer->theme->control);
    ang_gui_frame(gui, field.rect, viewer->theme->accent);
    double y = field.rect.y + (tall - ang_gui_text_height(gui, false)) / 2, x = field.rect.x + inset;
    ang_gui_clip(gui, field.rect);
    double end = x + ang_gui_text_width(gui, query, false);
    ang_gui_write(gui, x, y, 0, false, false, query[0] ? viewer->theme->text : viewer->theme->dim,
                  query[0] ? query : "  A part of a command's, a window's or a preset's name");
    double thick = fmax(ang_gui_px(gui, 1), 1);
    ang_gui_fill(gui, (ang_rect){end + thick, y, thick, ang_gui_text_height(gui, false)}, viewer->theme->text);
    ang_gui_unclip(gui);
}

/* True where it was clicked. */
static bool draw_row(ang_viewer *viewer, const entry *entry, int row) {
    ang_gui *gui = viewer->gui;
    const ang_theme *theme = viewer->theme;
    ang_canvas canvas;
    char right[48];
    snprintf(right, sizeof right, "%s%s", entry->on ? "on   " : "", entry->shortcut);
    ang_rect rect = ang_gui_rows_row(gui, row, row == viewer->palette.chosen, entry->enabled, &canvas);
    double inset = ang_gui_px(gui, 8), y = rect.y + (rect.height - ang_gui_text_height(gui, false)) / 2;
    ang_gui_write(gui, rect.x + inset, y, 0, false, false, entry->enabled ? theme->text : theme->dim, entry->name);
    ang_gui_write(gui, rect.x + rect.width - inset, y, 1, false, false, theme->dim, right);
    return canvas.clicked && entry->enabled;
}

static void show(ang_viewer *viewer, list *list) {
    ang_gui *gui = viewer->gui;
    ang_palette *palette = &viewer->palette;
    double width = ang_gui_px(gui, 560), row_height = ang_gui_px(gui, 24);
    int pressed = -1;
    ang_rows_part part;
    ang_gui_message_begin(gui, "palette");
    show_query(viewer, width);
    ang_gui_gap(gui, ang_gui_px(gui, 4));
    ang_gui_rows_begin(gui, "found", width, ROWS * row_height, row_height, (size_t)list->count,
                       palette->moved ? palette->chosen : -1, &part);
    for (int row = part.first; row < part.end; row++)
        if (draw_row(viewer, &list->entries[row], row)) pressed = row;
    if (list->count == 0) ang_gui_text_dim(gui, "Nothing has such a name.");
    ang_gui_rows_end(gui);
    ang_gui_gap(gui, ang_gui_px(gui, 2));
    ang_gui_text_dim(gui, "Arrows choose, Enter does it, Esc closes this.");
    ang_gui_message_end(gui);
    palette->moved = false;
    if (pressed >= 0) run(viewer, &list->entries[pressed]);
}

void ang_palette_show(ang_viewer *viewer) {
    if (!viewer->palette.open) return;
    static entry entries[MOST]; /* the drawing thread's alone */
    list list = {.query = viewer->palette.query, .entries = entries};
    take_text(viewer);
    add_actions(viewer, &list);
    add_windows(viewer, &list);
    add_presets(viewer, &list);
    qsort(entries, (size_t)list.count, sizeof *entries, by_rank);
    bool entered = take_keys(viewer, list.count);
    int chosen = viewer->palette.chosen;
    if (entered && chosen < list.count && entries[chosen].enabled)
        run(viewer, &entries[chosen]);
    else
        show(viewer, &list);
}
