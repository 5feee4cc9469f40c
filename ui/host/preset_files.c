#include "ui/host/preset_files.h"

#include "ui/viewer_private.h"

bool ang_preset_file_take(ang_viewer *viewer, const char *path) {
    const ang_viewer_host *host = viewer->host;
    if (!host->is_preset_file(host->context, path)) return false;
    char first[256], said[ANG_NOTES_LINE];
    ang_error err = {0};
    viewer->files.open = false;
    viewer->redraws = 2;
    bool done = host->import_presets(host->context, path, first, sizeof first, said, sizeof said, &err);
    ang_thumbnails_renew(viewer); /* also where some came and then none */
    if (!done) {
        ang_viewer_say(viewer, true, "%s", err.message);
        return true;
    }
    const ang_preset *preset = ang_preset_named(viewer, first);
    if (viewer->ready && preset) ang_viewer_choose_preset(viewer, preset);
    ang_viewer_say(viewer, false, "%s", said);
    return true;
}
