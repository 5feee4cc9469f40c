#include "ui/panes/focus.h"

#include "ui/panes/volume_pane.h"
#include "ui/study.h"
#include "ui/viewer_private.h"

#include <math.h>

static const double turn_degrees = 5, pan_pixels = 24, zoom_step = 1.15; /* of a key; pixels at scale 1 */

void ang_focus_follow(ang_viewer *viewer) {
    ang_focus *focus = &viewer->focus;
    const ang_input *input = &viewer->input;
    bool moved = input->x < focus->x || input->x > focus->x || input->y < focus->y || input->y > focus->y ||
                 input->wheel_y < 0 || input->wheel_y > 0;
    for (int i = 0; i < ANG_BUTTON_COUNT; i++) moved = moved || input->button[i];
    focus->x = input->x;
    focus->y = input->y;
    if (viewer->hovered < ANG_PANES && moved) {
        focus->pane = (int)viewer->hovered;
        focus->by_key = false;
        bool widgets = ang_gui_navigating(viewer->gui) && !ang_gui_popup_open(viewer->gui);
        if (widgets && !ang_gui_dialog_open(viewer->gui) && !viewer->typing) ang_gui_leave_widgets(viewer->gui);
    }
    if (viewer->maximised >= 0) focus->pane = viewer->maximised;
}

void ang_focus_cycle(ang_viewer *viewer, int by) {
    ang_focus *focus = &viewer->focus;
    bool panel = !viewer->grips.layout.panel_hidden, widgets = ang_gui_navigating(viewer->gui);
    int places = panel ? ANG_PANES + 1 : ANG_PANES;
    int at = ((widgets ? ANG_PANES : focus->pane) + by + places) % places;
    if (at == ANG_PANES) {
        ang_gui_enter_widgets(viewer->gui);
        return;
    }
    ang_gui_leave_widgets(viewer->gui);
    focus->pane = at;
    focus->by_key = true;
    if (viewer->maximised >= 0) viewer->maximised = at;
}

/* In the plane of the slice, by as much as another slice of those that change is away. */
static void move_crosshair(ang_viewer *viewer, ang_orientation orientation, int right, int down) {
    ang_slice_frame frame = ang_slice_frame_of(viewer, orientation, viewer->pane[orientation]);
    ang_vec3 way = ang_vec3_add(ang_vec3_scale(frame.axes.right, right), ang_vec3_scale(frame.axes.down, down));
    double step = 0, most = 0;
    for (int i = 0; i < ANG_ORIENTATIONS; i++) {
        double along = fabs(ang_vec3_dot(viewer->range[i].normal, way));
        if (along > most) most = along, step = viewer->range[i].step;
    }
    ang_viewer_point_at(viewer, ang_vec3_add(viewer->document.crosshair, ang_vec3_scale(way, step)));
}

static void pan(ang_viewer *viewer, int right, int down) {
    int pane = viewer->focus.pane;
    double pixels = ang_gui_px(viewer->gui, pan_pixels);
    if (pane == ANG_PANE_VOLUME) {
        ang_volume_pan(viewer, right * pixels, down * pixels);
        return;
    }
    ang_slice_view *view = &viewer->document.slice_view[pane];
    ang_slice_frame frame = ang_slice_frame_of(viewer, (ang_orientation)pane, viewer->pane[pane]);
    view->pan_mm[0] -= right * pixels * frame.mm_per_pixel;
    view->pan_mm[1] -= down * pixels * frame.mm_per_pixel;
    ang_slice_keep_inside(view, viewer->study.volume, &frame.axes);
}

bool ang_focus_arrow(ang_viewer *viewer, int key, unsigned modifiers) {
    if (key < ANG_KEY_LEFT || key > ANG_KEY_DOWN) return false;
    int right = key == ANG_KEY_RIGHT ? 1 : key == ANG_KEY_LEFT ? -1 : 0;
    int down = key == ANG_KEY_DOWN ? 1 : key == ANG_KEY_UP ? -1 : 0;
    bool volume = viewer->focus.pane == ANG_PANE_VOLUME;
    if (modifiers == ANG_MOD_SHIFT && volume)
        ang_view_turn(&viewer->document.view, right * turn_degrees, down * turn_degrees);
    else if (modifiers == ANG_MOD_SHIFT)
        move_crosshair(viewer, (ang_orientation)viewer->focus.pane, right, down);
    else if (modifiers == ANG_MOD_CONTROL)
        pan(viewer, right, down);
    else if (modifiers == (ANG_MOD_CONTROL | ANG_MOD_SHIFT))
        ang_grips_step(viewer, right, down);
    else
        return false;
    return true;
}

void ang_focus_zoom(ang_viewer *viewer, int steps) {
    double factor = pow(zoom_step, steps);
    int pane = viewer->focus.pane;
    if (pane == ANG_PANE_VOLUME) {
        ang_volume_zoom(viewer, factor);
        return;
    }
    ang_rect rect = viewer->pane[pane];
    ang_slice_view *view = &viewer->document.slice_view[pane];
    ang_slice_frame frame = ang_slice_frame_of(viewer, (ang_orientation)pane, rect);
    ang_slice_zoom(view, &frame, rect.width / 2, rect.height / 2, factor);
}

void ang_focus_scroll(ang_viewer *viewer, int slices) {
    if (viewer->focus.pane == ANG_PANE_VOLUME)
        ang_focus_zoom(viewer, slices);
    else
        ang_slice_scroll(viewer, (ang_orientation)viewer->focus.pane, slices);
}

void ang_focus_reset(ang_viewer *viewer, int all) {
    for (int i = 0; i < ANG_PANES; i++) {
        if (!all && i != viewer->focus.pane) continue;
        if (i == ANG_PANE_VOLUME)
            viewer->document.view = ang_viewer_first_view;
        else
            viewer->document.slice_view[i] = ang_slice_view_default;
    }
}

void ang_focus_maximise(ang_viewer *viewer, int argument) {
    (void)argument;
    viewer->maximised = viewer->maximised >= 0 ? -1 : viewer->focus.pane;
}
bool ang_focus_maximised(const ang_viewer *viewer, int argument) {
    (void)argument;
    return viewer->maximised >= 0;
}
