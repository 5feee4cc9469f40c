#include "ui/panes/identity.h"

#include "ui/panes/overlay.h"
#include "ui/viewer_private.h"

#include <stdio.h>

bool ang_identity_shown(const ang_viewer *viewer) {
    return !viewer->names_hidden && (!viewer->shot.posed || viewer->host->keep_phi);
}

const char *ang_identity_series(const ang_viewer *viewer, char text[340]) {
    const ang_study *study = &viewer->study;
    bool described = study->description[0] && ang_identity_shown(viewer);
    snprintf(text, 340, "%s%s%s", study->label, described ? ": " : "", described ? study->description : "");
    return text;
}

void ang_identity_write(ang_viewer *viewer, ang_rect rect) {
    char text[340];
    if (ang_identity_shown(viewer)) ang_pane_corner(viewer, rect, 0, 0, 1, viewer->study.patient);
    ang_pane_corner(viewer, rect, 1, 0, 0, ang_identity_series(viewer, text));
}
