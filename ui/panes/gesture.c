#include "ui/panes/gesture.h"

#include "ui/viewer_private.h"

bool ang_gesture_cancel(ang_viewer *viewer) {
    ang_gesture *gesture = &viewer->gesture;
    if (gesture->pane < 0 || gesture->cancelled || !ang_gui_holding(viewer->gui)) return false;
    viewer->document = gesture->before;
    viewer->crosshair = gesture->crosshair;
    if (gesture->pane < ANG_PANE_VOLUME) viewer->slice[gesture->pane].view = gesture->view;
    gesture->cancelled = true;
    ang_measuring_cancel(viewer);
    return true;
}
