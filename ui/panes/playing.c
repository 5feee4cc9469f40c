#include "ui/panes/playing.h"

#include "core/base/clock.h"
#include "ui/panes/overlay.h"
#include "ui/viewer_private.h"

#include <math.h>
#include <stdio.h>

static const double degrees_a_step = 1;

void ang_playing_toggle(ang_viewer *viewer, int argument) {
    (void)argument;
    ang_cine *cine = &viewer->cine;
    int pane = viewer->focus.pane;
    if (cine->running && cine->pane == pane)
        ang_playing_stop(viewer);
    else
        ang_cine_start(cine, pane, viewer->input.time_seconds);
}

void ang_playing_faster(ang_viewer *viewer, int direction) {
    ang_cine_set_faster(&viewer->cine, direction, viewer->input.time_seconds);
}

void ang_playing_stop(ang_viewer *viewer) { viewer->cine.running = false; }

bool ang_playing_volume(const ang_viewer *viewer) {
    return viewer->cine.running && viewer->cine.pane == ANG_PANE_VOLUME;
}

/* About the patient's long axis. */
static void turn(ang_view *view, double degrees) {
    double azimuth = view->azimuth_deg + degrees;
    view->azimuth_deg = azimuth - 360 * ceil((azimuth - 180) / 360);
}

void ang_playing_step(ang_viewer *viewer) {
    ang_cine *cine = &viewer->cine;
    if (!cine->running) return;
    bool held = ang_playing_volume(viewer) && viewer->hovered == ANG_PANE_VOLUME && ang_gui_holding(viewer->gui);
    if (!viewer->ready || held || viewer->pane[cine->pane].width < 1) {
        ang_playing_stop(viewer);
        return;
    }
    int steps = ang_cine_due(cine, viewer->input.time_seconds);
    if (steps == 0) return;
    if (cine->pane == ANG_PANE_VOLUME) {
        turn(&viewer->document.view, steps * degrees_a_step);
        return;
    }
    const ang_slice_range *range = &viewer->range[cine->pane];
    int index = ang_cine_advance(cine, ang_slice_index(range, viewer->document.crosshair), range->count, steps);
    viewer->document.crosshair = ang_slice_place(range, viewer->document.crosshair, index);
}

double ang_playing_next_in(const ang_viewer *viewer) {
    return viewer->cine.running ? fmax(viewer->cine.due_seconds - ang_now_ms() / 1000, 0) : INFINITY;
}

void ang_playing_write(ang_viewer *viewer, ang_pane pane, ang_rect rect, int line) {
    const ang_cine *cine = &viewer->cine;
    char text[64];
    if (!cine->running || cine->pane != (int)pane) return;
    if (pane == ANG_PANE_VOLUME)
        snprintf(text, sizeof text, "turning, %.0f\xc2\xb0/s", cine->per_second * degrees_a_step);
    else
        snprintf(text, sizeof text, "cine %.0f/s%s", cine->per_second, cine->back_and_forth ? ", back and forth" : "");
    ang_pane_corner(viewer, rect, 0, 1, line, text);
}
