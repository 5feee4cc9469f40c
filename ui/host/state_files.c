#include "ui/host/state_files.h"

#include "ui/panes/planes.h"
#include "ui/study.h"
#include "ui/viewer_private.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* To the last digit where it is a place for it as it stands. */
static void point_at(ang_viewer *viewer, ang_vec3 crosshair) {
    ang_viewer_point_at(viewer, crosshair);
    if (ang_vec3_length(ang_vec3_sub(viewer->document.crosshair, crosshair)) < 1e-9)
        viewer->document.crosshair = crosshair;
}

static void restore(ang_viewer *viewer, const ang_session *session) {
    const ang_document *document = &session->document, before = viewer->document;
    viewer->document = *document;
    if (document->method < 0) viewer->document.method = before.method;
    viewer->voxels_shown = session->voxels_shown;
    viewer->turns_about_crosshair = session->turns_about_crosshair;
    ang_planes_take(viewer);
    point_at(viewer, isfinite(document->crosshair.x) ? document->crosshair : before.crosshair);
    viewer->maximised = session->maximised;
    viewer->corner_text = session->corner_text;
    viewer->crosshair_shown = session->crosshair_lines;
    int tool = 0;
    while (tool < ANG_TOOLS && strcmp(ang_tool_name((ang_tool)tool), session->tool) != 0) tool++;
    if (tool < ANG_TOOLS) viewer->tool = (ang_tool)tool;
    if (session->tool[0] && tool == ANG_TOOLS)
        ang_viewer_say(viewer, true, "The state has a tool \"%s\", which this program does not", session->tool);
}

void ang_session_apply(ang_viewer *viewer) {
    ang_session session;
    ang_error err = {0};
    const ang_viewer_host *host = viewer->host;
    bool found = host->session(host->context, &viewer->study, &session, &err);
    if (found && err.message[0]) ang_viewer_say(viewer, true, "%s", err.message);
    if (!found) {
        snprintf(viewer->failure, sizeof viewer->failure, "%s", err.message);
        return;
    }
    ang_document *document = &session.document;
    if (!isfinite(document->window_centre)) {
        document->window_centre = viewer->document.window_centre;
        document->window_width = viewer->document.window_width;
    }
    /* The preset that it began from is what it is compared with, and what "Reset" goes back to. */
    const ang_preset *origin = ang_preset_named(viewer, document->preset);
    viewer->chosen = *document;
    if (origin) ang_document_take_preset(&viewer->chosen, origin);
    restore(viewer, &session);
}

const char *ang_session_data(ang_viewer *viewer, const char *path, char *room, size_t size) {
    const ang_viewer_host *host = viewer->host;
    ang_error err = {0};
    if (!host->is_state(host->context, path)) return path;
    if (host->open_state(host->context, path, room, size, &err)) return room;
    snprintf(viewer->failure, sizeof viewer->failure, "%s", err.message);
    return NULL;
}

void ang_session_save(ang_viewer *viewer) {
    ang_error err = {0};
    ang_viewer_state state;
    const ang_viewer_host *host = viewer->host;
    ang_viewer_describe(viewer, &state);
    bool done = host->save_state(host->context, &state, viewer->saved, sizeof viewer->saved, &err);
    ang_say_saved(viewer, done, &err);
}
