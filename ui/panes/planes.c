#include "ui/panes/planes.h"

#include "ui/study.h"
#include "ui/viewer_private.h"

void ang_planes_take(ang_viewer *viewer) {
    viewer->turn = viewer->document.turn;
    for (int i = 0; i < ANG_ORIENTATIONS; i++)
        viewer->range[i] = ang_slice_range_of(viewer->study.volume, &viewer->turn, (ang_orientation)i);
}

void ang_planes_follow(ang_viewer *viewer) {
    const ang_turn *turn = &viewer->document.turn;
    const ang_turn was = viewer->turn;
    if (ang_turn_same(&was, turn)) return;
    ang_planes_take(viewer);
    ang_viewer_point_at(viewer, viewer->document.crosshair); /* first, for planes along the patient move it */
    for (int i = 0; i < ANG_ORIENTATIONS; i++) {
        ang_slice_axes before = ang_slice_axes_of(&was, (ang_orientation)i);
        ang_slice_axes after = ang_slice_axes_of(turn, (ang_orientation)i);
        ang_slice_keep_place(&viewer->document.slice_view[i], viewer->study.volume, viewer->document.crosshair, &before,
                             &after);
    }
}

void ang_planes_turn(ang_viewer *viewer, int degrees) {
    int pane = viewer->focus.pane;
    ang_orientation orientation = pane < ANG_PANE_VOLUME ? (ang_orientation)pane : ANG_AXIAL;
    ang_slice_axes axes = ang_slice_axes_of(&viewer->document.turn, orientation);
    viewer->document.turn = ang_turn_about(&viewer->document.turn, axes.inward, degrees);
}

void ang_planes_straighten(ang_viewer *viewer, int argument) {
    (void)argument;
    viewer->document.turn = ang_turn_none;
}

bool ang_planes_turned(const ang_viewer *viewer) {
    return viewer->ready && !ang_turn_same(&viewer->document.turn, &ang_turn_none);
}
