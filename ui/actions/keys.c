#include "ui/actions/keys.h"

#include "ui/actions/actions.h"
#include "ui/actions/window_presets.h"
#include "ui/dialogs/load_report.h"
#include "ui/panels/transfer_keys.h"
#include "ui/panes/playing.h"
#include "ui/viewer_private.h"

static bool end(bool *flag) {
    bool was = *flag;
    *flag = false;
    return was;
}

/* What Esc ends, each where it is open or under way; whether it was. */
static bool end_popup(ang_viewer *viewer) {
    if (!ang_gui_popup_open(viewer->gui)) return false;
    ang_gui_close_popups(viewer->gui);
    return true;
}
static bool end_palette(ang_viewer *viewer) { return end(&viewer->palette.open); }
/* All at once: they lie in one another's place. */
static bool end_dialogs(ang_viewer *viewer) {
    bool *const open[] = {&viewer->files.open, &viewer->help, &viewer->notes, &viewer->browsing,
                          &viewer->preset_dialog.open};
    bool any = false;
    for (size_t i = 0; i < sizeof open / sizeof *open; i++) any = end(open[i]) || any;
    return any;
}
static bool end_cine(ang_viewer *viewer) {
    if (!viewer->cine.running) return false;
    ang_playing_stop(viewer);
    return true;
}
static bool end_loading(ang_viewer *viewer) {
    if (!viewer->loading.running) return false;
    ang_loading_stop(&viewer->loading);
    return true;
}
static bool end_failure(ang_viewer *viewer) {
    if (!viewer->failure[0] || !viewer->ready) return false;
    viewer->failure[0] = '\0';
    return true;
}
static bool end_widgets(ang_viewer *viewer) {
    if (!ang_gui_navigating(viewer->gui)) return false;
    ang_gui_leave_widgets(viewer->gui);
    return true;
}
static bool end_series(ang_viewer *viewer) { return end(&viewer->series.open); }
static bool end_large_pane(ang_viewer *viewer) {
    viewer->maximised = -1;
    return true;
}

/* The foremost first; a press ends one of them. */
static bool (*const ends[])(ang_viewer *viewer) = {
    end_popup,     ang_grips_cancel, ang_gesture_cancel, ang_measuring_cancel, end_palette, end_dialogs,
    end_cine,      end_loading,      end_failure,        end_widgets,          end_series,  ang_transfer_editor_escape,
    end_large_pane};

static void escape(ang_viewer *viewer) {
    size_t i = 0;
    while (!ends[i](viewer)) i++;
}

/* That it takes from one menu to the next. */
enum { frames_to_menu = 6 };

enum { C = ANG_MOD_CONTROL, S = ANG_MOD_SHIFT };

/* What other programs have taught hands, and what other keyboards print on the same key. */
static const struct {
    int key;
    unsigned modifiers;
    int same;
    unsigned same_modifiers;
} aliases[] = {{'P', C | S, 'K', C},
               {'Y', C, 'Z', C | S},
               {ANG_KEY_ALT, 0, ANG_KEY_F10, 0},
               {ANG_KEY_TAB, C, ANG_KEY_F6, 0},
               {ANG_KEY_TAB, C | S, ANG_KEY_F6, S},
               {'=', 0, '+', 0},
               {'=', S, '+', 0},
               {'+', S, '+', 0}};

/* Of those that share a key the first that can be done now; false where there is none. What needs a study is told where
 * there is none. */
static bool run_action(ang_viewer *viewer, int key, unsigned modifiers) {
    int count;
    bool known = false;
    const ang_action *actions = ang_actions(&count);
    for (int i = 0; i < count; i++) {
        const ang_action *action = &actions[i];
        if (action->key != key || action->modifiers != modifiers) continue;
        known = true;
        if (!ang_action_enabled(viewer, action)) continue;
        action->run(viewer, action->argument);
        return true;
    }
    if (known && !viewer->ready) ang_viewer_say(viewer, false, "Nothing is open yet: Ctrl+O opens a folder or a file");
    return false;
}

/* Keys 1 to 9: a preset of the volume, a window of slices. */
static void choose_number(ang_viewer *viewer, int index) {
    const ang_preset *const *presets = viewer->host->presets;
    int count = 0;
    while (presets[count]) count++;
    if (viewer->focus.pane != ANG_PANE_VOLUME)
        ang_window_preset_choose(viewer, index);
    else if (index < count)
        ang_viewer_choose_preset(viewer, presets[index]);
}

static void press(ang_viewer *viewer, int key, unsigned modifiers) {
    if (run_action(viewer, key, modifiers)) return;
    for (size_t i = 0; i < sizeof aliases / sizeof *aliases; i++)
        if (aliases[i].key == key && aliases[i].modifiers == modifiers) {
            run_action(viewer, aliases[i].same, aliases[i].same_modifiers);
            return;
        }
    if (!viewer->ready || ang_focus_arrow(viewer, key, modifiers)) return;
    if (key >= '1' && key <= '9' && modifiers == 0) choose_number(viewer, key - '1');
}

/* Keys that the widget with the keyboard uses. */
static bool is_widgets(int key) {
    return key == ANG_KEY_SPACE || key == ANG_KEY_ENTER || (key >= ANG_KEY_LEFT && key <= ANG_KEY_END);
}

void ang_keys(ang_viewer *viewer) {
    const ang_input *input = &viewer->input;
    for (int i = 0; i < input->press_count; i++) {
        int key = input->press[i].key;
        if (key == ANG_KEY_ESCAPE) {
            escape(viewer);
            continue;
        }
        bool menu = ang_gui_popup_open(viewer->gui);
        if (menu) viewer->redraws = frames_to_menu;
        bool taken = viewer->typing || viewer->palette.open || viewer->files.open || viewer->preset_dialog.open ||
                     menu || (is_widgets(key) && ang_gui_navigating(viewer->gui));
        unsigned modifiers = input->press[i].modifiers;
        if (key == ANG_KEY_NONE || taken) continue;
        if (!ang_load_report_key(viewer, key, modifiers) && !ang_series_browser_key(viewer, key, modifiers) &&
            !ang_transfer_editor_key(viewer, key, modifiers))
            press(viewer, key, modifiers);
    }
}
