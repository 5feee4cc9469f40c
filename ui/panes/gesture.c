#include "ui/panes/gesture.h"

#include "ui/panes/planes.h"
#include "ui/viewer_private.h"

bool ang_gesture_cancel(ang_viewer *viewer) {
    ang_gesture *gesture = &viewer->gesture;
    if (gesture->pane < 0 || gesture->cancelled || !ang_gui_holding(viewer->gui)) return false;
    viewer->document = gesture->before;
    ang_planes_take(viewer);
    gesture->cancelled = true;
    ang_measuring_cancel(viewer);
    return true;
}
