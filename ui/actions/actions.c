/* Everything that can be done by menu or key, in one table. What an action does is its module's; here is what is nobody
 * else's. */
#include "ui/actions/actions.h"

#include "ui/host/state_files.h"
#include "ui/panels/measures.h"
#include "ui/panels/transfer_keys.h"
#include "ui/panes/planes.h"
#include "ui/panes/playing.h"
#include "ui/study.h"
#include "ui/viewer_private.h"

#include <stddef.h>
#include <stdio.h>

static bool is_ready(const ang_viewer *viewer) { return viewer->ready; }
static bool can_undo(const ang_viewer *viewer) { return viewer->ready && ang_history_can_undo(&viewer->history); }
static bool can_redo(const ang_viewer *viewer) { return viewer->ready && ang_history_can_redo(&viewer->history); }

/* What is only a flag of the viewer is named by its place. */
#define FLAG(member) ((int)offsetof(ang_viewer, member))
static void toggle(ang_viewer *viewer, int flag) {
    bool *there = (bool *)((char *)viewer + flag);
    *there = !*there;
}
static bool is_on(const ang_viewer *viewer, int flag) { return *(const bool *)((const char *)viewer + flag); }
static bool is_off(const ang_viewer *viewer, int flag) { return !is_on(viewer, flag); }

static void ask_path(ang_viewer *viewer, int argument) {
    (void)argument;
    ang_file_browser_open(viewer);
}
static void save_state(ang_viewer *viewer, int argument) {
    (void)argument;
    ang_session_save(viewer);
}
static void save_preset(ang_viewer *viewer, int argument) {
    (void)argument;
    ang_preset_dialog_open(viewer, false);
}
static bool has_source(const ang_viewer *viewer) { return ang_viewer_subject(viewer)->count > 0; }
static void show_series(ang_viewer *viewer, int argument) {
    (void)argument;
    viewer->series.open = !viewer->series.open;
    if (viewer->series.open) viewer->grips.layout.panel_hidden = false; /* which is where it is */
}
static bool has_phases(const ang_viewer *viewer) { return viewer->ready && viewer->study.phases > 1; }
static void quit(ang_viewer *viewer, int argument) {
    (void)argument;
    ang_window_close(viewer->window);
}

static void stepped(ang_viewer *viewer) {
    ang_planes_take(viewer);
    viewer->point = -1;
}
static void undo(ang_viewer *viewer, int argument) {
    (void)argument;
    if (ang_history_undo(&viewer->history, &viewer->document)) stepped(viewer);
}
static void redo(ang_viewer *viewer, int argument) {
    (void)argument;
    if (ang_history_redo(&viewer->history, &viewer->document)) stepped(viewer);
}

static void choose_tool(ang_viewer *viewer, int tool) {
    ang_measuring_cancel(viewer);
    viewer->tool = (ang_tool)tool;
}
static bool is_tool(const ang_viewer *viewer, int tool) { return viewer->tool == (ang_tool)tool; }
static void centre_crosshair(ang_viewer *viewer, int argument) {
    (void)argument;
    ang_viewer_point_at(viewer, ang_volume_centre(viewer->study.volume));
}

static void standard_view(ang_viewer *viewer, int argument) {
    static const char *const names[] = {"anterior", "posterior", "left", "right", "superior", "inferior"};
    ang_view_parse(names[argument], &viewer->document.view, NULL);
    viewer->document.view.pan_mm[0] = viewer->document.view.pan_mm[1] = 0;
}
static void toggle_projection(ang_viewer *viewer, int argument) {
    (void)argument;
    ang_view *view = &viewer->document.view;
    view->projection = view->projection == ANG_PARALLEL ? ANG_PERSPECTIVE : ANG_PARALLEL;
}
static bool is_parallel(const ang_viewer *viewer, int argument) {
    (void)argument;
    return viewer->document.view.projection == ANG_PARALLEL;
}
static void toggle_theme(ang_viewer *viewer, int argument) {
    (void)argument;
    viewer->theme = viewer->theme == &ang_theme_dark ? &ang_theme_light : &ang_theme_dark;
}
static bool is_light(const ang_viewer *viewer, int argument) {
    (void)argument;
    return viewer->theme == &ang_theme_light;
}
static void full_screen(ang_viewer *viewer, int argument) {
    (void)argument;
    ang_window_toggle_full_screen(viewer->window);
}

static void slab_thickness(ang_viewer *viewer, int direction) {
    static const double steps[] = {0, 2, 5, 10, 20, 40, 80};
    enum { count = sizeof steps / sizeof *steps };
    int at = 0;
    while (at + 1 < count && steps[at + 1] <= viewer->document.slab_mm) at++;
    at += direction;
    viewer->document.slab_mm = steps[at < 0 ? 0 : at >= count ? count - 1 : at];
}

static void slab_projection(ang_viewer *viewer, int argument) {
    (void)argument;
    viewer->document.slab = (ang_slab)((viewer->document.slab + 1) % (ANG_SLAB_MINIP + 1));
    if (!(viewer->document.slab_mm > 0)) ang_viewer_say(viewer, false, "A slab of 0 mm shows the plane alone: key ]");
}

static void show_palette(ang_viewer *viewer, int argument) {
    (void)argument;
    ang_palette_open(viewer);
}
static void to_menus(ang_viewer *viewer, int argument) {
    (void)argument;
    if (!ang_gui_holding(viewer->gui)) ang_gui_enter_menus(viewer->gui);
}

enum { C = ANG_MOD_CONTROL, S = ANG_MOD_SHIFT, A = ANG_MOD_ALT };

static const ang_action actions[] = {
    {"File", "Open...", "a folder or file; or drop it on the window", 'O', C, ask_path, 0, false, NULL, NULL},
    {"File", "Series...", "what else the folder holds, with pictures", ANG_KEY_F3, 0, show_series, FLAG(series.open),
     false, has_source, is_on},
    {"File", "Save picture of the pane", "the one with the bright frame; refined, without writing on it", 'S', C,
     ang_save_pane_ask, 0, true, is_ready, NULL},
    {"File", "Save pane as DICOM", "a secondary capture; says who the patient is only with --keep-phi", 'D', C,
     ang_save_pane_ask, 1, false, is_ready, NULL},
    {"File", "Save pane as seen", "with letters, bar and measures", ANG_KEY_F12, 0, ang_shot_ask_pane, 0, false,
     is_ready, NULL},
    {"File", "Save picture of the window", NULL, 'S', C | S, ang_shot_ask_window, 0, false, NULL, NULL},
    {"File", "Save preset...", "what is shown, as a preset of your own, by name", 'P', C, save_preset, 0, false,
     is_ready, NULL},
    {"File", "Import preset...", "from 3D Slicer (.vp, .vp.json, presets.xml); or drop the file on the window", 0, 0,
     ask_path, 0, false, NULL, NULL},
    {"File", "Open state...", "a saved state, with the data that it is of", 'O', C | A, ask_path, 0, true, NULL, NULL},
    {"File", "Save state", "all that is shown, and where its data are: to go on later, and for render --state", 'S',
     C | A, save_state, 0, false, is_ready, NULL},
    {"File", "Quit", NULL, 'Q', C, quit, 0, true, NULL, NULL},
    {"Edit", "Undo", "presets, points, windows, camera, planes, crop", 'Z', C, undo, 0, false, can_undo, NULL},
    {"Edit", "Redo", NULL, 'Z', C | S, redo, 0, false, can_redo, NULL},
    {"Curve", "Edit the points by keys", "arrows move what is chosen, with Shift ten times finer; Esc leaves", 'E', 0,
     ang_curve_edit, FLAG(editing.focused), false, is_ready, is_on},
    {"Curve", "Next point", NULL, '.', 0, ang_curve_step, 1, true, ang_transfer_editor_has_keys, NULL},
    {"Curve", "Previous point", NULL, ',', 0, ang_curve_step, -1, false, ang_transfer_editor_has_keys, NULL},
    {"Curve", "Choose the next one too", "also a click with Shift, or a drag around several", '.', S,
     ang_curve_step_adding, 1, false, ang_transfer_editor_has_keys, NULL},
    {"Curve", "Choose the previous one too", NULL, ',', S, ang_curve_step_adding, -1, false,
     ang_transfer_editor_has_keys, NULL},
    {"Curve", "Choose all points", NULL, 'A', C, ang_curve_choose_all, 0, false, ang_transfer_editor_has_keys, NULL},
    {"Curve", "Add a point", "also a double click", ANG_KEY_INSERT, 0, ang_curve_insert, 0, true,
     ang_transfer_editor_has_keys, NULL},
    {"Curve", "Delete the chosen points", "also a right click on one", ANG_KEY_DELETE, 0, ang_curve_delete, 0, false,
     ang_curve_can_delete, NULL},
    {"Curve", "Narrower range of HU", "also the wheel, about the pointer", '+', 0, ang_curve_zoom, 1, true,
     ang_transfer_editor_has_keys, NULL},
    {"Curve", "Wider range of HU", NULL, '-', 0, ang_curve_zoom, -1, false, ang_transfer_editor_has_keys, NULL},
    {"Curve", "Whole range of HU", "also a double click on the numbers", 'E', S, ang_curve_show_all, 0, false, is_ready,
     NULL},
    {"Curve", "Show in slices", "what the chosen points or a dragged range of HU select", 'H', 0, toggle,
     FLAG(editing.shows), false, is_ready, is_on},
    {"Tools", "Window", "left drag in a slice: across width, up and down centre", 'W', 0, choose_tool, ANG_TOOL_WINDOW,
     false, is_ready, is_tool},
    {"Tools", "Crosshair", "left drag in a slice moves it", 'C', 0, choose_tool, ANG_TOOL_CROSSHAIR, false, is_ready,
     is_tool},
    {"Tools", "Scroll", "left drag in a slice: up and down through the slices", 'S', 0, choose_tool, ANG_TOOL_SCROLL,
     false, is_ready, is_tool},
    {"Tools", "Pan", "also middle drag, or Space and left drag", 'P', 0, choose_tool, ANG_TOOL_PAN, false, is_ready,
     is_tool},
    {"Tools", "Crop", "drag the handles of the crop box and the clip plane, in 3D and in slices", 'X', 0, choose_tool,
     ANG_TOOL_CROP, false, is_ready, is_tool},
    {"Tools", "Crop box on", "off keeps the box", 'X', A, toggle, FLAG(document.crop), true, is_ready, is_on},
    {"Tools", "Whole volume", "the crop box as large as it can be", 'X', C, ang_crop_reset, 0, false, is_ready, NULL},
    {"Tools", "Clip plane facing me", "through the crosshair; cuts away what is before it", 'K', 0,
     ang_clip_face_viewer, 0, true, is_ready, NULL},
    {"Tools", "Clip plane's other side", NULL, 'K', S, ang_clip_flip, 0, false, ang_clip_can_flip, NULL},
    {"Tools", "Clip plane on", NULL, 'K', A, ang_clip_toggle, 0, false, is_ready, ang_clip_is_on},
    {"Tools", "Measure", "drag or click in a slice; again: length, angle, ellipse, rectangle", 'M', 0,
     ang_measuring_next, ANG_TOOL_MEASURE, false, is_ready, is_tool},
    {"Tools", "Measure: point at the crosshair", "as a click there; Shift and arrows move the crosshair",
     ANG_KEY_INSERT, 0, ang_measuring_place, 0, false, ang_measuring_by_keys, NULL},
    {"Tools", "Delete the chosen measure", NULL, ANG_KEY_DELETE, 0, ang_measures_delete_chosen, 0, true,
     ang_measures_chosen, NULL},
    {"Tools", "Delete all measures", NULL, 0, 0, ang_measures_clear, 0, false, ang_measures_any, NULL},
    {"Tools", "Copy measures as text", "with tabs, for a spreadsheet", 'C', C, ang_measures_copy, 0, false,
     ang_measures_any, NULL},
    {"Tools", "Crosshair to the centre", NULL, ANG_KEY_HOME, 0, centre_crosshair, 0, true, is_ready, NULL},
    {"View", "Reset view", "of the pane with the bright frame", 'R', 0, ang_focus_reset, 0, false, is_ready, NULL},
    {"View", "Reset all views", NULL, 'R', S, ang_focus_reset, 1, false, is_ready, NULL},
    {"View", "Zoom in", "about the pane's middle; also Ctrl and wheel, or right drag", '+', 0, ang_focus_zoom, 1, false,
     is_ready, NULL},
    {"View", "Zoom out", NULL, '-', 0, ang_focus_zoom, -1, false, is_ready, NULL},
    {"View", "Pictures of the presets", NULL, 'B', 0, toggle, FLAG(browsing), false, is_ready, NULL},
    {"View", "Next preset", NULL, 'N', 0, ang_viewer_step_preset, 1, false, is_ready, NULL},
    {"View", "Previous preset", NULL, 'N', S, ang_viewer_step_preset, -1, false, is_ready, NULL},
    {"View", "Anterior", NULL, 'A', A, standard_view, 0, true, is_ready, NULL},
    {"View", "Posterior", NULL, 'P', A, standard_view, 1, false, is_ready, NULL},
    {"View", "Left", NULL, 'L', A, standard_view, 2, false, is_ready, NULL},
    {"View", "Right", NULL, 'R', A, standard_view, 3, false, is_ready, NULL},
    {"View", "Superior", NULL, 'S', A, standard_view, 4, false, is_ready, NULL},
    {"View", "Inferior", NULL, 'I', A, standard_view, 5, false, is_ready, NULL},
    {"View", "Parallel projection", NULL, 'O', 0, toggle_projection, 0, true, is_ready, is_parallel},
    {"View", "Turn about the crosshair", "else about the volume's centre", 'C', S, toggle, FLAG(turns_about_crosshair),
     false, is_ready, is_on},
    {"View", "Crosshair lines", NULL, 'X', S, toggle, FLAG(crosshair_shown), true, is_ready, is_on},
    {"View", "Measures", NULL, 'M', S, ang_measures_toggle, 0, false, ang_measures_any, ang_measures_shown},
    {"View", "Text on the panes", NULL, 'T', 0, toggle, FLAG(corner_text), false, is_ready, is_on},
    {"View", "Patient's name", "and the series' description; left out of saved pictures unless --keep-phi is given",
     ANG_KEY_F4, 0, toggle, FLAG(names_hidden), false, is_ready, is_off},
    {"View", "Light theme", "of all but the pictures", 0, 0, toggle_theme, 0, true, NULL, is_light},
    {"View", "Full screen", NULL, ANG_KEY_F11, 0, full_screen, 0, false, NULL, NULL},
    {"Layout", "One pane large", "also a double click", ANG_KEY_ENTER, 0, ang_focus_maximise, 0, false, is_ready,
     ang_focus_maximised},
    {"Layout", "Panes of equal size", "also a double click on the gap between them", '0', C, ang_grips_even, 0, false,
     is_ready, NULL},
    {"Layout", "Side panel", NULL, 'B', C, toggle, FLAG(grips.layout.panel_hidden), false, is_ready, is_off},
    {"Layout", "Next pane", "whose frame is bright: keys apply to it", ANG_KEY_F6, 0, ang_focus_cycle, 1, true,
     is_ready, NULL},
    {"Layout", "Previous pane", NULL, ANG_KEY_F6, S, ang_focus_cycle, -1, false, is_ready, NULL},
    {"Slices", "Next slice", "also the wheel; in the 3D pane it zooms", ANG_KEY_UP, 0, ang_focus_scroll, 1, false,
     is_ready, NULL},
    {"Slices", "Previous slice", NULL, ANG_KEY_DOWN, 0, ang_focus_scroll, -1, false, is_ready, NULL},
    {"Slices", "Ten slices on", NULL, ANG_KEY_PAGE_UP, 0, ang_focus_scroll, 10, false, is_ready, NULL},
    {"Slices", "Ten slices back", NULL, ANG_KEY_PAGE_DOWN, 0, ang_focus_scroll, -10, false, is_ready, NULL},
    {"Slices", "Thicker slab", NULL, ']', 0, slab_thickness, 1, true, is_ready, NULL},
    {"Slices", "Thinner slab", NULL, '[', 0, slab_thickness, -1, false, is_ready, NULL},
    {"Slices", "Slab: mean, MIP, MinIP", "what it shows, one after the other", ']', S, slab_projection, 0, false,
     is_ready, NULL},
    {"Slices", "Voxels as they are", "the nearest voxel's value, not interpolated", 'I', 0, toggle, FLAG(voxels_shown),
     false, is_ready, is_on},
    {"Slices", "Cine", "of the slices of the pane with the bright frame; in the 3D pane it turns", 'V', 0,
     ang_playing_toggle, FLAG(cine.running), true, is_ready, is_on},
    {"Slices", "Cine faster", NULL, ANG_KEY_UP, A, ang_playing_faster, 1, false, is_ready, NULL},
    {"Slices", "Cine slower", NULL, ANG_KEY_DOWN, A, ang_playing_faster, -1, false, is_ready, NULL},
    {"Slices", "Cine back and forth", "else from the first slice again", 'V', S, toggle, FLAG(cine.back_and_forth),
     false, is_ready, is_on},
    {"Slices", "Next phase", "of a series of several volumes at one place", ']', C, ang_viewer_step_phase, 1, true,
     has_phases, NULL},
    {"Slices", "Previous phase", NULL, '[', C, ang_viewer_step_phase, -1, false, has_phases, NULL},
    {"Slices", "Turn the planes to the right",
     "by 1 degree about the normal of the slice with the bright frame, else axial; "
     "also by the handles of the crosshair",
     ANG_KEY_RIGHT, A, ang_planes_turn, 1, true, is_ready, NULL},
    {"Slices", "Turn the planes to the left", NULL, ANG_KEY_LEFT, A, ang_planes_turn, -1, false, is_ready, NULL},
    {"Slices", "Planes along the patient", "not oblique", 'R', C, ang_planes_straighten, 0, false, ang_planes_turned,
     NULL},
    {"Help", "Find a command...", "type a part of its name", 'K', C, show_palette, 0, false, NULL, NULL},
    {"Help", "What keys and mouse do", NULL, ANG_KEY_F1, 0, toggle, FLAG(help), false, NULL, NULL},
    {"Help", "To the menus", "then arrows and Enter; Esc leaves them", ANG_KEY_F10, 0, to_menus, 0, false, NULL, NULL},
    {"Help", "What loading found", "warnings, files left out, assumptions", ANG_KEY_F2, 0, toggle, FLAG(notes), false,
     is_ready, NULL},
};
enum { action_count = sizeof actions / sizeof *actions };

const ang_action *ang_actions(int *count) {
    *count = action_count;
    return actions;
}

bool ang_action_enabled(const ang_viewer *viewer, const ang_action *action) {
    return !action->enabled || action->enabled(viewer);
}

const char *ang_action_shortcut(const ang_action *action, char text[32]) {
    char name[8];
    unsigned modifiers = action->modifiers;
    snprintf(text, 32, "%s%s%s%s", modifiers & ANG_MOD_CONTROL ? "Ctrl+" : "", modifiers & ANG_MOD_ALT ? "Alt+" : "",
             modifiers & ANG_MOD_SHIFT ? "Shift+" : "", action->key ? ang_key_name(action->key, name) : "");
    return text;
}
