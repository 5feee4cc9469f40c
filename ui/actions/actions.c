/* Everything that can be done by menu or key, in one table. */
#include "ui/panes/playing.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static const ang_window_preset windows[] = {{"Of the file", NAN, NAN}, {"CTA", 600, 200},    {"Soft tissue", 400, 40},
                                            {"Bone", 2000, 400},       {"Lung", 1500, -600}, {"Brain", 80, 40},
                                            {"Mediastinum", 350, 50},  {"Liver", 150, 70},   {"Stent", 2500, 700}};
enum { window_count = sizeof windows / sizeof *windows };
static const double zoom_step = 1.15; /* of a key, and of a turn of the wheel */

static bool is_ready(const ang_viewer *viewer) { return viewer->ready; }
static bool can_undo(const ang_viewer *viewer) { return viewer->ready && ang_history_can_undo(&viewer->history); }
static bool can_redo(const ang_viewer *viewer) { return viewer->ready && ang_history_can_redo(&viewer->history); }

static void open_path(ang_viewer *viewer, int argument) {
    (void)argument;
    ang_file_browser_open(viewer);
}

static void save_pane(ang_viewer *viewer, int argument) {
    (void)argument;
    viewer->save_wanted = true;
    viewer->save_pane = (ang_pane)viewer->focus.pane;
}

static void save_window(ang_viewer *viewer, int argument) {
    (void)argument;
    ang_shot_ask(viewer, -1);
}

static void save_seen(ang_viewer *viewer, int argument) {
    (void)argument;
    ang_shot_ask(viewer, viewer->focus.pane);
}

static void save_state(ang_viewer *viewer, int argument) {
    (void)argument;
    ang_session_save(viewer);
}

static void save_preset(ang_viewer *viewer, int argument) {
    (void)argument;
    ang_preset_dialog_open(viewer, false);
}

static bool edits_curve(const ang_viewer *viewer) { return ang_transfer_editor_has_keys(viewer); }
static bool has_points(const ang_viewer *viewer) { return edits_curve(viewer) && viewer->point >= 0; }

static void edit_curve(ang_viewer *viewer, int argument) {
    (void)argument;
    ang_transfer_editor_focus(viewer);
}
static bool is_editing_curve(const ang_viewer *viewer, int argument) {
    (void)argument;
    return viewer->editing.focused;
}
static void step_point(ang_viewer *viewer, int by) { ang_transfer_editor_step(viewer, by, false); }
static void add_next_point(ang_viewer *viewer, int by) { ang_transfer_editor_step(viewer, by, true); }
static void choose_all_points(ang_viewer *viewer, int argument) {
    (void)argument;
    ang_transfer_editor_choose_all(viewer);
}
static void insert_point(ang_viewer *viewer, int argument) {
    (void)argument;
    ang_transfer_editor_insert(viewer);
}
static void delete_points(ang_viewer *viewer, int argument) {
    (void)argument;
    ang_transfer_editor_delete(viewer);
}
static void zoom_curve(ang_viewer *viewer, int direction) {
    double about =
        viewer->point >= 0 ? viewer->document.points[viewer->point].hu : (viewer->editor_low + viewer->editor_high) / 2;
    ang_transfer_editor_zoom(viewer, about, direction > 0 ? 0.5 : 2);
}
static void show_whole_curve(ang_viewer *viewer, int argument) {
    (void)argument;
    ang_transfer_editor_show_all(viewer);
}
static void show_selected(ang_viewer *viewer, int argument) {
    (void)argument;
    viewer->editing.shows = !viewer->editing.shows;
}
static bool shows_selected(const ang_viewer *viewer, int argument) {
    (void)argument;
    return viewer->editing.shows;
}

static void step_preset(ang_viewer *viewer, int by) { ang_viewer_step_preset(viewer, by); }

static void quit(ang_viewer *viewer, int argument) {
    (void)argument;
    ang_window_close(viewer->window);
}

static void undo(ang_viewer *viewer, int argument) {
    (void)argument;
    ang_history_undo(&viewer->history, &viewer->document);
    viewer->point = -1;
}

static void redo(ang_viewer *viewer, int argument) {
    (void)argument;
    ang_history_redo(&viewer->history, &viewer->document);
    viewer->point = -1;
}

static void reset_slice(ang_viewer *viewer, int orientation) {
    viewer->slice[orientation].view = ang_slice_view_default;
}

static void reset_pane(ang_viewer *viewer, int pane) {
    if (pane == ANG_PANE_VOLUME)
        viewer->document.view = ang_viewer_first_view;
    else
        reset_slice(viewer, pane);
}

static void reset_view(ang_viewer *viewer, int all) {
    for (int i = 0; i < ANG_PANES; i++)
        if (all || i == viewer->focus.pane) reset_pane(viewer, i);
}

static void straighten(ang_viewer *viewer, int argument) {
    (void)argument;
    viewer->document.turn = ang_turn_none;
}
static bool is_turned(const ang_viewer *viewer) {
    return viewer->ready && !ang_turn_same(&viewer->document.turn, &ang_turn_none);
}

/* About the normal of the slice, as a drag of a handle does. */
static void turn_planes(ang_viewer *viewer, int degrees) {
    int pane = viewer->focus.pane;
    ang_orientation orientation = pane < ANG_PANE_VOLUME ? (ang_orientation)pane : ANG_AXIAL;
    ang_slice_axes axes = ang_slice_axes_of(&viewer->document.turn, orientation);
    viewer->document.turn = ang_turn_about(&viewer->document.turn, axes.inward, degrees);
}

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
static void toggle_turning(ang_viewer *viewer, int argument) {
    (void)argument;
    viewer->turns_about_crosshair = !viewer->turns_about_crosshair;
}
static bool turns_about_crosshair(const ang_viewer *viewer, int argument) {
    (void)argument;
    return viewer->turns_about_crosshair;
}
static bool is_parallel(const ang_viewer *viewer, int argument) {
    (void)argument;
    return viewer->document.view.projection == ANG_PARALLEL;
}

static bool is_cropped(const ang_viewer *viewer, int argument) {
    (void)argument;
    return viewer->document.crop;
}
static bool is_clipped(const ang_viewer *viewer, int argument) {
    (void)argument;
    return ang_clip_plane_given(&viewer->document.clip);
}
static bool has_clip_plane(const ang_viewer *viewer) { return viewer->ready && is_clipped(viewer, 0); }

static void choose_tool(ang_viewer *viewer, int tool) {
    ang_measuring_cancel(viewer);
    viewer->tool = (ang_tool)tool;
}
static bool is_tool(const ang_viewer *viewer, int tool) { return viewer->tool == (ang_tool)tool; }

static void maximise(ang_viewer *viewer, int argument) {
    (void)argument;
    viewer->maximised = viewer->maximised >= 0 ? -1 : viewer->focus.pane;
}
static bool is_maximised(const ang_viewer *viewer, int argument) {
    (void)argument;
    return viewer->maximised >= 0;
}

static void toggle(bool *flag) { *flag = !*flag; }
static void even_panes(ang_viewer *viewer, int argument) {
    (void)argument;
    viewer->grips.layout = ang_layout_even(&viewer->grips.layout, ANG_GRIP_CROSS);
}
static void toggle_panel(ang_viewer *viewer, int argument) {
    (void)argument;
    toggle(&viewer->grips.layout.panel_hidden);
}
static bool shows_panel(const ang_viewer *viewer, int argument) {
    (void)argument;
    return !viewer->grips.layout.panel_hidden;
}
static void toggle_text(ang_viewer *viewer, int argument) {
    (void)argument;
    toggle(&viewer->corner_text);
}
static bool shows_text(const ang_viewer *viewer, int argument) {
    (void)argument;
    return viewer->corner_text;
}
static void toggle_theme(ang_viewer *viewer, int argument) {
    (void)argument;
    viewer->theme = viewer->theme == &ang_theme_dark ? &ang_theme_light : &ang_theme_dark;
}
static bool is_light(const ang_viewer *viewer, int argument) {
    (void)argument;
    return viewer->theme == &ang_theme_light;
}
static void toggle_crosshair(ang_viewer *viewer, int argument) {
    (void)argument;
    toggle(&viewer->crosshair_shown);
}
static bool shows_crosshair(const ang_viewer *viewer, int argument) {
    (void)argument;
    return viewer->crosshair_shown;
}
static void toggle_names(ang_viewer *viewer, int argument) {
    (void)argument;
    toggle(&viewer->names_hidden);
}
static bool shows_names(const ang_viewer *viewer, int argument) {
    (void)argument;
    return !viewer->names_hidden;
}
static void toggle_voxels(ang_viewer *viewer, int argument) {
    (void)argument;
    toggle(&viewer->voxels_shown);
}
static bool shows_voxels(const ang_viewer *viewer, int argument) {
    (void)argument;
    return viewer->voxels_shown;
}
static void full_screen(ang_viewer *viewer, int argument) {
    (void)argument;
    ang_window_toggle_full_screen(viewer->window);
}

static void scroll(ang_viewer *viewer, int slices) {
    if (viewer->focus.pane == ANG_PANE_VOLUME)
        ang_focus_zoom(viewer, pow(zoom_step, slices));
    else
        ang_slice_scroll(viewer, (ang_orientation)viewer->focus.pane, slices);
}

static void zoom(ang_viewer *viewer, int steps) { ang_focus_zoom(viewer, pow(zoom_step, steps)); }

static void show_palette(ang_viewer *viewer, int argument) {
    (void)argument;
    ang_palette_open(viewer);
}

static void to_menus(ang_viewer *viewer, int argument) {
    (void)argument;
    ang_gui_enter_menus(viewer->gui);
}

static void play(ang_viewer *viewer, int argument) {
    (void)argument;
    ang_playing_toggle(viewer, (ang_pane)viewer->focus.pane);
}
static bool plays(const ang_viewer *viewer, int argument) {
    (void)argument;
    return viewer->cine.running;
}
static void play_faster(ang_viewer *viewer, int direction) {
    ang_cine_set_faster(&viewer->cine, direction, viewer->input.time_seconds);
}
static void play_back_and_forth(ang_viewer *viewer, int argument) {
    (void)argument;
    toggle(&viewer->cine.back_and_forth);
}
static bool plays_back_and_forth(const ang_viewer *viewer, int argument) {
    (void)argument;
    return viewer->cine.back_and_forth;
}

static void slab_thickness(ang_viewer *viewer, int direction) {
    static const double steps[] = {0, 2, 5, 10, 20, 40, 80};
    enum { count = sizeof steps / sizeof *steps };
    int at = 0;
    while (at + 1 < count && steps[at + 1] <= viewer->document.slab_mm) at++;
    at += direction;
    viewer->document.slab_mm = steps[at < 0 ? 0 : at >= count ? count - 1 : at];
}

void ang_window_preset_choose(ang_viewer *viewer, int index) {
    double width = windows[index].width, centre = windows[index].centre;
    if (index == 0) ang_viewer_file_window(viewer, &centre, &width);
    viewer->document.window_centre = centre;
    viewer->document.window_width = width;
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

static void browse(ang_viewer *viewer, int argument) {
    (void)argument;
    toggle(&viewer->browsing);
}
static void show_help(ang_viewer *viewer, int argument) {
    (void)argument;
    toggle(&viewer->help);
}
static bool has_source(const ang_viewer *viewer) { return ang_viewer_subject(viewer)->count > 0; }
static void show_series(ang_viewer *viewer, int argument) {
    (void)argument;
    toggle(&viewer->series.open);
    if (viewer->series.open) viewer->grips.layout.panel_hidden = false; /* which is where it is */
}
static bool shows_series(const ang_viewer *viewer, int argument) {
    (void)argument;
    return viewer->series.open;
}
static void show_notes(ang_viewer *viewer, int argument) {
    (void)argument;
    toggle(&viewer->notes);
}

enum { C = ANG_MOD_CONTROL, S = ANG_MOD_SHIFT, A = ANG_MOD_ALT };

static const ang_action actions[] = {
    {"File", "Open...", "a folder or file; or drop it on the window", 'O', C, open_path, 0, false, NULL, NULL},
    {"File", "Series...", "what else the folder holds, with pictures", ANG_KEY_F3, 0, show_series, 0, false, has_source,
     shows_series},
    {"File", "Save picture of the pane", "the one with the bright frame; refined, without writing on it", 'S', C,
     save_pane, 0, true, is_ready, NULL},
    {"File", "Save pane as seen", "with letters, bar and measures", ANG_KEY_F12, 0, save_seen, 0, false, is_ready,
     NULL},
    {"File", "Save picture of the window", NULL, 'S', C | S, save_window, 0, false, NULL, NULL},
    {"File", "Save preset...", "what is shown, as a preset of your own, by name", 'P', C, save_preset, 0, false,
     is_ready, NULL},
    {"File", "Open state...", "a saved state, with the data that it is of", 'O', C | A, open_path, 0, true, NULL, NULL},
    {"File", "Save state", "all that is shown, and where its data are: to go on later, and for render --state", 'S',
     C | A, save_state, 0, false, is_ready, NULL},
    {"File", "Quit", NULL, 'Q', C, quit, 0, true, NULL, NULL},
    {"Edit", "Undo", "presets, points, windows, camera, planes, crop", 'Z', C, undo, 0, false, can_undo, NULL},
    {"Edit", "Redo", NULL, 'Z', C | S, redo, 0, false, can_redo, NULL},
    {"Curve", "Edit the points by keys", "arrows move what is chosen, with Shift ten times finer; Esc leaves", 'E', 0,
     edit_curve, 0, false, is_ready, is_editing_curve},
    {"Curve", "Next point", NULL, '.', 0, step_point, 1, true, edits_curve, NULL},
    {"Curve", "Previous point", NULL, ',', 0, step_point, -1, false, edits_curve, NULL},
    {"Curve", "Choose the next one too", "also a click with Shift, or a drag around several", '.', S, add_next_point, 1,
     false, edits_curve, NULL},
    {"Curve", "Choose the previous one too", NULL, ',', S, add_next_point, -1, false, edits_curve, NULL},
    {"Curve", "Choose all points", NULL, 'A', C, choose_all_points, 0, false, edits_curve, NULL},
    {"Curve", "Add a point", "also a double click", ANG_KEY_INSERT, 0, insert_point, 0, true, edits_curve, NULL},
    {"Curve", "Delete the chosen points", "also a right click on one", ANG_KEY_DELETE, 0, delete_points, 0, false,
     has_points, NULL},
    {"Curve", "Narrower range of HU", "also the wheel, about the pointer", '+', 0, zoom_curve, 1, true, edits_curve,
     NULL},
    {"Curve", "Wider range of HU", NULL, '-', 0, zoom_curve, -1, false, edits_curve, NULL},
    {"Curve", "Whole range of HU", "also a double click on the numbers", 'E', S, show_whole_curve, 0, false, is_ready,
     NULL},
    {"Curve", "Show in slices", "what the chosen points or a dragged range of HU select", 'H', 0, show_selected, 0,
     false, is_ready, shows_selected},
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
    {"Tools", "Crop box on", "off keeps the box", 'X', A, ang_crop_toggle, 0, true, is_ready, is_cropped},
    {"Tools", "Whole volume", "the crop box as large as it can be", 'X', C, ang_crop_reset, 0, false, is_ready, NULL},
    {"Tools", "Clip plane facing me", "through the crosshair; cuts away what is before it", 'K', 0,
     ang_clip_face_viewer, 0, true, is_ready, NULL},
    {"Tools", "Clip plane's other side", NULL, 'K', S, ang_clip_flip, 0, false, has_clip_plane, NULL},
    {"Tools", "Clip plane on", NULL, 'K', A, ang_clip_toggle, 0, false, is_ready, is_clipped},
    {"Tools", "Measure", "drag or click in a slice; again: length, angle, ellipse, rectangle", 'M', 0,
     ang_measuring_next, ANG_TOOL_MEASURE, false, is_ready, is_tool},
    {"Tools", "Delete the chosen measure", NULL, ANG_KEY_DELETE, 0, ang_measures_delete_chosen, 0, true,
     ang_measures_chosen, NULL},
    {"Tools", "Delete all measures", NULL, 0, 0, ang_measures_clear, 0, false, ang_measures_any, NULL},
    {"Tools", "Copy measures as text", "with tabs, for a spreadsheet", 'C', C, ang_measures_copy, 0, false,
     ang_measures_any, NULL},
    {"Tools", "Crosshair to the centre", NULL, ANG_KEY_HOME, 0, centre_crosshair, 0, true, is_ready, NULL},
    {"View", "Reset view", "of the pane with the bright frame", 'R', 0, reset_view, 0, false, is_ready, NULL},
    {"View", "Reset all views", NULL, 'R', S, reset_view, 1, false, is_ready, NULL},
    {"View", "Zoom in", "about the pane's middle; also Ctrl and wheel, or right drag", '+', 0, zoom, 1, false, is_ready,
     NULL},
    {"View", "Zoom out", NULL, '-', 0, zoom, -1, false, is_ready, NULL},
    {"View", "Pictures of the presets", NULL, 'B', 0, browse, 0, false, is_ready, NULL},
    {"View", "Next preset", NULL, 'N', 0, step_preset, 1, false, is_ready, NULL},
    {"View", "Previous preset", NULL, 'N', S, step_preset, -1, false, is_ready, NULL},
    {"View", "Anterior", NULL, 'A', A, standard_view, 0, true, is_ready, NULL},
    {"View", "Posterior", NULL, 'P', A, standard_view, 1, false, is_ready, NULL},
    {"View", "Left", NULL, 'L', A, standard_view, 2, false, is_ready, NULL},
    {"View", "Right", NULL, 'R', A, standard_view, 3, false, is_ready, NULL},
    {"View", "Superior", NULL, 'S', A, standard_view, 4, false, is_ready, NULL},
    {"View", "Inferior", NULL, 'I', A, standard_view, 5, false, is_ready, NULL},
    {"View", "Parallel projection", NULL, 'O', 0, toggle_projection, 0, true, is_ready, is_parallel},
    {"View", "Turn about the crosshair", "else about the volume's centre", 'C', S, toggle_turning, 0, false, is_ready,
     turns_about_crosshair},
    {"View", "Crosshair lines", NULL, 'X', S, toggle_crosshair, 0, true, is_ready, shows_crosshair},
    {"View", "Measures", NULL, 'M', S, ang_measures_toggle, 0, false, ang_measures_any, ang_measures_shown},
    {"View", "Text on the panes", NULL, 'T', 0, toggle_text, 0, false, is_ready, shows_text},
    {"View", "Patient's name", "and the series' description; left out of saved pictures unless --keep-phi is given",
     ANG_KEY_F4, 0, toggle_names, 0, false, is_ready, shows_names},
    {"View", "Light theme", "of all but the pictures", 0, 0, toggle_theme, 0, true, NULL, is_light},
    {"View", "Full screen", NULL, ANG_KEY_F11, 0, full_screen, 0, false, NULL, NULL},
    {"Layout", "One pane large", "also a double click", ANG_KEY_ENTER, 0, maximise, 0, false, is_ready, is_maximised},
    {"Layout", "Panes of equal size", "also a double click on the gap between them", '0', C, even_panes, 0, false,
     is_ready, NULL},
    {"Layout", "Side panel", NULL, 'B', C, toggle_panel, 0, false, is_ready, shows_panel},
    {"Layout", "Next pane", "whose frame is bright: keys apply to it", ANG_KEY_F6, 0, ang_focus_cycle, 1, true,
     is_ready, NULL},
    {"Layout", "Previous pane", NULL, ANG_KEY_F6, S, ang_focus_cycle, -1, false, is_ready, NULL},
    {"Slices", "Next slice", "also the wheel; in the 3D pane it zooms", ANG_KEY_UP, 0, scroll, 1, false, is_ready,
     NULL},
    {"Slices", "Previous slice", NULL, ANG_KEY_DOWN, 0, scroll, -1, false, is_ready, NULL},
    {"Slices", "Ten slices on", NULL, ANG_KEY_PAGE_UP, 0, scroll, 10, false, is_ready, NULL},
    {"Slices", "Ten slices back", NULL, ANG_KEY_PAGE_DOWN, 0, scroll, -10, false, is_ready, NULL},
    {"Slices", "Thicker slab", NULL, ']', 0, slab_thickness, 1, true, is_ready, NULL},
    {"Slices", "Thinner slab", NULL, '[', 0, slab_thickness, -1, false, is_ready, NULL},
    {"Slices", "Voxels as they are", "the nearest voxel's value, not interpolated", 'I', 0, toggle_voxels, 0, false,
     is_ready, shows_voxels},
    {"Slices", "Cine", "of the slices of the pane with the bright frame; in the 3D pane it turns", 'V', 0, play, 0,
     true, is_ready, plays},
    {"Slices", "Cine faster", NULL, ANG_KEY_UP, A, play_faster, 1, false, is_ready, NULL},
    {"Slices", "Cine slower", NULL, ANG_KEY_DOWN, A, play_faster, -1, false, is_ready, NULL},
    {"Slices", "Cine back and forth", "else from the first slice again", 'V', S, play_back_and_forth, 0, false,
     is_ready, plays_back_and_forth},
    {"Slices", "Turn the planes to the right",
     "by 1 degree about the normal of the slice with the bright frame, else axial; "
     "also by the handles of the crosshair",
     ANG_KEY_RIGHT, A, turn_planes, 1, true, is_ready, NULL},
    {"Slices", "Turn the planes to the left", NULL, ANG_KEY_LEFT, A, turn_planes, -1, false, is_ready, NULL},
    {"Slices", "Planes along the patient", "not oblique", 'R', C, straighten, 0, false, is_turned, NULL},
    {"Help", "Find a command...", "type a part of its name", 'K', C, show_palette, 0, false, NULL, NULL},
    {"Help", "What keys and mouse do", NULL, ANG_KEY_F1, 0, show_help, 0, false, NULL, NULL},
    {"Help", "To the menus", "then arrows and Enter; Esc leaves them", ANG_KEY_F10, 0, to_menus, 0, false, NULL, NULL},
    {"Help", "What loading found", "warnings, files left out, assumptions", ANG_KEY_F2, 0, show_notes, 0, false,
     is_ready, NULL},
};
enum { action_count = sizeof actions / sizeof *actions };

const ang_action *ang_actions(int *count) {
    *count = action_count;
    return actions;
}

const ang_window_preset *ang_window_presets(int *count) {
    *count = window_count;
    return windows;
}

bool ang_action_enabled(const ang_viewer *viewer, const ang_action *action) {
    return !action->enabled || action->enabled(viewer);
}

/* What is open or under way ends, the foremost first. */
static void escape(ang_viewer *viewer) {
    ang_gesture *gesture = &viewer->gesture;
    if (ang_grips_cancel(viewer)) return;
    bool dragging = gesture->pane >= 0 && !gesture->cancelled && ang_gui_holding(viewer->gui);
    if (dragging) {
        viewer->document = gesture->before;
        viewer->crosshair = gesture->crosshair;
        if (gesture->pane < ANG_PANE_VOLUME) viewer->slice[gesture->pane].view = gesture->view;
        gesture->cancelled = true;
        ang_measuring_cancel(viewer);
    } else if (ang_measuring_cancel(viewer)) {
        return;
    } else if (viewer->palette.open) {
        viewer->palette.open = false;
    } else if (viewer->files.open || viewer->help || viewer->notes || viewer->browsing || viewer->preset_dialog.open) {
        viewer->files.open = viewer->help = viewer->notes = viewer->browsing = viewer->preset_dialog.open = false;
    } else if (viewer->cine.running) {
        ang_playing_stop(viewer);
    } else if (viewer->loading.running) {
        ang_loading_stop(&viewer->loading);
    } else if (viewer->failure[0] && viewer->ready) {
        viewer->failure[0] = '\0';
    } else if (ang_gui_navigating(viewer->gui)) {
        ang_gui_leave_widgets(viewer->gui);
    } else if (viewer->series.open) {
        viewer->series.open = false;
    } else if (!ang_transfer_editor_escape(viewer)) {
        viewer->maximised = -1;
    }
}

/* What other programs have taught hands, and what other keyboards print on the same key. */
static const struct {
    int key;
    unsigned modifiers;
    int same;
    unsigned same_modifiers;
} aliases[] = {{'P', C | S, 'K', C},
               {'Y', C, 'Z', C | S},
               {ANG_KEY_TAB, C, ANG_KEY_F6, 0},
               {ANG_KEY_TAB, C | S, ANG_KEY_F6, S},
               {'=', 0, '+', 0},
               {'=', S, '+', 0},
               {'+', S, '+', 0}};

/* Of those that share a key the first that can be done now; false where there is none. */
static bool run_action(ang_viewer *viewer, int key, unsigned modifiers) {
    for (int i = 0; i < action_count; i++) {
        const ang_action *action = &actions[i];
        if (action->key != key || action->modifiers != modifiers || !ang_action_enabled(viewer, action)) continue;
        action->run(viewer, action->argument);
        return true;
    }
    return false;
}

static void press(ang_viewer *viewer, int key, unsigned modifiers) {
    if (run_action(viewer, key, modifiers)) return;
    for (size_t i = 0; i < sizeof aliases / sizeof *aliases; i++)
        if (aliases[i].key == key && aliases[i].modifiers == modifiers) {
            run_action(viewer, aliases[i].same, aliases[i].same_modifiers);
            return;
        }
    if (!viewer->ready || ang_focus_arrow(viewer, key, modifiers)) return;
    if (key >= '1' && key < '1' + window_count && modifiers == 0) choose_number(viewer, key - '1');
}

/* Keys that the widget with the keyboard uses. */
static bool is_widgets(int key) {
    return key == ANG_KEY_SPACE || key == ANG_KEY_ENTER || (key >= ANG_KEY_LEFT && key <= ANG_KEY_END);
}

void ang_actions_keys(ang_viewer *viewer) {
    const ang_input *input = &viewer->input;
    for (int i = 0; i < input->press_count; i++) {
        int key = input->press[i].key;
        if (key == ANG_KEY_ESCAPE) {
            if (ang_gui_popup_open(viewer->gui))
                ang_gui_close_popups(viewer->gui);
            else
                escape(viewer);
            continue;
        }
        bool taken = viewer->typing || viewer->palette.open || viewer->files.open || ang_gui_popup_open(viewer->gui) ||
                     (is_widgets(key) && ang_gui_navigating(viewer->gui));
        unsigned modifiers = input->press[i].modifiers;
        if (key == ANG_KEY_NONE || taken) continue;
        if (!ang_load_report_key(viewer, key, modifiers) && !ang_series_browser_key(viewer, key, modifiers) &&
            !ang_transfer_editor_key(viewer, key, modifiers))
            press(viewer, key, modifiers);
    }
}
