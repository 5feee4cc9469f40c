#include "ui/viewer.h"

#include "core/base/clock.h"
#include "core/base/memory.h"
#include "ui/actions/keys.h"
#include "ui/actions/menus.h"
#include "ui/dialogs/messages.h"
#include "ui/panels/panel.h"
#include "ui/panels/transfer_editor.h"
#include "ui/panes/arriving.h"
#include "ui/panes/identity.h"
#include "ui/panes/overlay.h"
#include "ui/panes/playing.h"
#include "ui/panes/volume_pane.h"
#include "ui/study.h"
#include "ui/viewer_private.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const double message_seconds = 6;
/* After the one that an event needs: lists and messages measure themselves in one frame and show in a later one. */
enum { settling_frames = 2 };

void ang_viewer_say(ang_viewer *viewer, bool bad, const char *format, ...) {
    va_list args;
    va_start(args, format);
    vsnprintf(viewer->message, sizeof viewer->message, format, args);
    va_end(args);
    viewer->message_bad = bad;
    viewer->message_until = ang_now_ms() / 1000 + message_seconds;
}

/* Of the 3D pane; where another is large, as if none were. */
static ang_rect volume_place(const ang_viewer *viewer) {
    ang_layout_frame frame = viewer->grips.frame;
    if (frame.maximised != ANG_PANE_VOLUME) frame.maximised = -1;
    return ang_layout_place(&viewer->grips.layout, &frame).pane[ANG_PANE_VOLUME];
}

static void panes(ang_viewer *viewer) {
    viewer->hovered = ANG_PANES;
    viewer->hovered_hu = NAN;
    ang_rect volume = volume_place(viewer);
    if (viewer->pane[ANG_PANE_VOLUME].width < 1) ang_volume_await(viewer, (int)volume.width, (int)volume.height);
    for (int i = 0; i < ANG_PANES; i++) {
        if (viewer->pane[i].width < 1) continue;
        if (i == ANG_PANE_VOLUME)
            ang_volume_pane(viewer, viewer->pane[i]);
        else
            ang_slice_pane(viewer, (ang_pane)i, viewer->pane[i]);
    }
}

static void layout(ang_viewer *viewer) {
    ang_gui *gui = viewer->gui;
    const ang_input *input = &viewer->input;
    ang_grips *grips = &viewer->grips;
    grips->frame = (ang_layout_frame){.width = input->width,
                                      .height = input->height,
                                      .top = ang_menus(viewer),
                                      .bottom = ang_gui_px(gui, 24),
                                      .scale = input->scale,
                                      .maximised = viewer->maximised};
    ang_layout_places places = ang_layout_place(&grips->layout, &grips->frame);
    if (viewer->ready) {
        ang_grips_show(viewer, &places);
        places = ang_layout_place(&grips->layout, &grips->frame);
        memcpy(viewer->pane, places.pane, sizeof viewer->pane);
        if (places.panel.width >= 1) ang_panel(viewer, places.panel);
        panes(viewer);
        ang_focus_follow(viewer);
        ang_transfer_editor_leave(viewer);
    } else {
        if (viewer->series.open && places.panel.width >= 1) ang_panel(viewer, places.panel);
        if (viewer->loading.running) ang_arriving_show(viewer, &places);
    }
    ang_status_line(viewer, places.status);
    ang_messages(viewer);
    ang_palette_show(viewer);
}

static void describe_browsers(const ang_viewer *viewer, ang_viewer_state *state) {
    state->open = viewer->files.open ? "files" : viewer->notes ? "report" : viewer->series.open ? "series" : "";
    state->files.listed = (int)viewer->files.shown_count;
    state->files.chosen = viewer->files.chosen;
    state->series.listed = (int)viewer->series.list.count;
    state->series.chosen = viewer->series.chosen;
    state->series.looked_at = viewer->series.looked_at;
    state->series.dates = viewer->series.dates;
    state->slices_previewed = viewer->preview.pictures;
}

/* Seconds until there is something to do for the pictures while the hands rest; infinite: nothing. */
static double rest_work_in(const ang_viewer *viewer) {
    if (!viewer->ready) return INFINITY;
    if (ang_thumbnails_wanted(viewer)) return 0;
    return fmin(ang_slices_refine_in(viewer), fmin(ang_volume_refine_in(viewer), ang_picture_error_in(viewer)));
}

void ang_viewer_describe(const ang_viewer *viewer, ang_viewer_state *state) {
    const ang_volume_picture *volume = &viewer->volume;
    *state = (ang_viewer_state){.phase = viewer->loading.running ? "loading"
                                         : viewer->failure[0]    ? "failed"
                                         : viewer->ready         ? "ready"
                                                                 : "empty",
                                .study = viewer->ready ? &viewer->study : NULL,
                                .path = viewer->path,
                                .document = &viewer->document,
                                .cine = &viewer->cine,
                                .hovered = viewer->hovered,
                                .hovered_hu = viewer->hovered_hu,
                                .maximised = viewer->maximised,
                                .editor = viewer->editor,
                                .editor_low = viewer->editor_low,
                                .editor_high = viewer->editor_high,
                                .point = viewer->point,
                                .measure = viewer->ready ? ang_measuring_chosen(viewer) : -1,
                                .region_values = viewer->measuring.values,
                                .editing = &viewer->editing,
                                .tool = ang_tool_name(viewer->tool),
                                .corner_text = viewer->corner_text,
                                .crosshair_lines = viewer->crosshair_shown,
                                .names_hidden = viewer->names_hidden,
                                .voxels_shown = viewer->voxels_shown,
                                .turns_about_crosshair = viewer->turns_about_crosshair,
                                .choice = ang_volume_method_choice(viewer),
                                .method = volume->method ? volume->method->name : NULL,
                                .size = {volume->size[0], volume->size[1]},
                                .refined = volume->refined && isinf(ang_slices_refine_in(viewer)),
                                .levels_shown = volume->refining.levels_shown,
                                .at_rest = viewer->ready && isinf(rest_work_in(viewer)),
                                .presets_pictured = ang_thumbnails_made(viewer),
                                .judged = volume->refined && volume->error.version == volume->version,
                                .error = volume->error.levels,
                                .latency_ms = viewer->latency_ms,
                                .frame_ms = volume->frame_ms,
                                .undo = ang_history_can_undo(&viewer->history),
                                .redo = ang_history_can_redo(&viewer->history),
                                .saved = viewer->saved[0] ? viewer->saved : NULL,
                                .frames = viewer->frames,
                                .focus = (ang_pane)viewer->focus.pane,
                                .widgets = ang_gui_navigating(viewer->gui),
                                .help = viewer->help,
                                .palette = viewer->palette.open,
                                .theme = viewer->theme->name,
                                .layout = &viewer->grips.layout,
                                .recent = &viewer->recent};
    ang_layout_places places = ang_layout_place(&viewer->grips.layout, &viewer->grips.frame);
    memcpy(state->grip, places.grip, sizeof state->grip);
    const ang_preset_dialog *dialog = &viewer->preset_dialog;
    state->saving.name = dialog->open ? dialog->name : NULL;
    state->saving.problem = dialog->problem;
    state->saving.replaces = dialog->asked;
    for (int i = 0; i < ANG_ORIENTATIONS && viewer->ready; i++) {
        state->slice[i].index = ang_slice_index(&viewer->range[i], viewer->document.crosshair);
        state->slice[i].count = viewer->range[i].count;
        state->slice[i].axes = ang_slice_axes_of(&viewer->turn, (ang_orientation)i);
        state->slice[i].mm_per_pixel = ang_vec3_length(viewer->slice[i].plane.step_x);
        state->pane[i] = viewer->pane[i];
    }
    state->pane[ANG_PANE_VOLUME] = viewer->pane[ANG_PANE_VOLUME];
    describe_browsers(viewer, state);
}

static void tell_host(ang_viewer *viewer) {
    ang_viewer_state state;
    if (!viewer->host->shown) return;
    if (viewer->ready) ang_measuring_values(viewer);
    ang_viewer_describe(viewer, &state);
    viewer->host->shown(viewer->host->context, &state);
}

static bool draw_frame(ang_viewer *viewer, ang_error *err) {
    const ang_ink gap = viewer->theme->gap;
    const float background[3] = {(float)(gap & 255) / 255, (float)(gap >> 8 & 255) / 255,
                                 (float)(gap >> 16 & 255) / 255};
    ang_gui_set_theme(viewer->gui, viewer->theme);
    if (!ang_gui_begin(viewer->gui, &viewer->input, err)) return false;
    viewer->typing = ang_gui_typing(viewer->gui);
    if (viewer->message[0] && viewer->input.time_seconds > viewer->message_until) viewer->message[0] = '\0';
    ang_keys(viewer);
    ang_playing_step(viewer);
    ang_shot_pose(viewer);
    layout(viewer);
    ang_painter_clear(viewer->painter, viewer->input.width, viewer->input.height, background);
    ang_gui_end(viewer->gui);
    ang_shot_take(viewer);
    if (viewer->shot.posed)
        viewer->redraws = settling_frames; /* what it leaves out does not blink */
    else
        ang_window_show(viewer->window);
    viewer->frames++;
    if (viewer->input.since_seconds > 0) viewer->latency_ms = ang_now_ms() - 1000 * viewer->input.since_seconds;
    bool changing =
        ang_playing_volume(viewer) || ang_gui_holding(viewer->gui) || ang_gui_adjusting(viewer->gui) || viewer->typing;
    if (viewer->ready && !changing) ang_history_note(&viewer->history, &viewer->document, viewer->input.time_seconds);
    if (viewer->ready) ang_save_panes(viewer);
    return ang_painter_check(viewer->painter, err);
}

/* The fine pictures first, then how wrong it is, then small ones of the presets; each until input comes. */
static void rest_work(ang_viewer *viewer) {
    viewer->redraws = settling_frames;
    if (ang_window_pending(viewer->window) || rest_work_in(viewer) > 0) return;
    ang_rect rect = volume_place(viewer);
    if (ang_slices_refine_in(viewer) <= 0) {
        ang_slices_refine(viewer);
    } else if (ang_volume_refine_in(viewer) <= 0) {
        ang_volume_update(viewer, (int)rect.width, (int)rect.height, true);
        if (ang_volume_refine_in(viewer) <= 0) viewer->redraws = 0; /* the next level settles it */
    } else if (ang_picture_error_in(viewer) <= 0) {
        ang_picture_error_find(viewer);
    } else if (ang_thumbnails_wanted(viewer)) {
        ang_thumbnails_step(viewer);
        viewer->redraws = 0; /* nothing has to settle */
    }
}

/* Sleeps as long as nothing has to be drawn; refines the picture when the hands rest. */
static void rest(ang_viewer *viewer) {
    if (viewer->redraws > 0) {
        viewer->redraws--;
        ang_window_wait(viewer->window, 0);
        return;
    }
    tell_host(viewer);
    if (!ang_gui_holding(viewer->gui)) ang_settings_remember(viewer, false);
    if (viewer->cine.running) { /* what is coarse stays so meanwhile */
        ang_window_wait(viewer->window, ang_playing_next_in(viewer));
        return;
    }
    double seconds = rest_work_in(viewer);
    if (viewer->message[0]) seconds = fmin(seconds, fmax(viewer->message_until - ang_now_ms() / 1000, 0.01));
    seconds = fmin(seconds, ang_gui_tooltip_in(viewer->gui));
    if (viewer->typing) seconds = fmin(seconds, 0.5); /* the text cursor blinks */
    if (seconds > 0) ang_window_wait(viewer->window, seconds);
    rest_work(viewer);
}

static void take_dropped(ang_viewer *viewer) {
    char **paths;
    size_t count = ang_window_dropped(viewer->window, &paths);
    if (count == 0) return;
    ang_source source = ang_source_make((const char *const *)paths, count, 0);
    viewer->files.open = false;
    ang_viewer_open_source(viewer, &source);
}

static bool work(ang_viewer *viewer, const ang_viewer_options *options, ang_error *err) {
    if (options->path_count > 0) {
        ang_source source = ang_source_make(options->paths, options->path_count, 0);
        ang_viewer_open_source(viewer, &source);
    } else {
        ang_file_browser_open(viewer);
    }
    viewer->redraws = 2;
    while (!ang_window_closing(viewer->window)) {
        ang_viewer_take_loaded(viewer, options->preset);
        ang_viewer_take_preview(viewer);
        ang_series_browser_step(viewer);
        take_dropped(viewer);
        ang_window_hold_keys(viewer->window, ang_gui_changing_menus(viewer->gui));
        bool more = ang_window_input(viewer->window, &viewer->input);
        /* Also for what comes while frames settle: a menu shows in the second frame after its click. */
        if (viewer->input.since_seconds > 0) viewer->redraws = settling_frames;
        if (viewer->input.width < 1 || viewer->input.height < 1) {
            ang_window_wait(viewer->window, INFINITY); /* iconified */
            continue;
        }
        if (!draw_frame(viewer, err)) return false;
        if (more)
            ang_window_wait(viewer->window, 0);
        else
            rest(viewer);
    }
    return true;
}

bool ang_viewer_run(const ang_viewer_host *host, const ang_viewer_options *options, ang_error *err) {
    ang_viewer *viewer = ang_alloc(1, sizeof *viewer, "the viewer", err);
    if (!viewer) return false;
    viewer->host = host;
    ang_settings_take(viewer);
    viewer->maximised = viewer->point = -1;
    viewer->gesture.pane = -1;
    ang_measuring_start(viewer);
    viewer->hovered = ANG_PANES;
    viewer->cine = ang_cine_default;
    int width = options->width > 0 ? options->width : viewer->remembered.width;
    int height = options->height > 0 ? options->height : viewer->remembered.height;
    viewer->window = ang_window_create("Angioscope", width, height, options->scale, err);
    if (viewer->window) viewer->painter = ang_painter_create(ang_window_gl(viewer->window), err);
    if (viewer->painter) viewer->gui = ang_gui_create(viewer->window, viewer->painter, host->font, err);
    bool done = viewer->gui && work(viewer, options, err);
    if (viewer->gui) ang_settings_remember(viewer, true);
    ang_viewer_opening_clear(viewer);
    ang_series_browser_clear(viewer);
    ang_file_browser_clear(&viewer->files);
    ang_study_close(viewer);
    ang_gui_destroy(viewer->gui);
    ang_painter_destroy(viewer->painter);
    ang_window_destroy(viewer->window);
    free(viewer);
    return done;
}
