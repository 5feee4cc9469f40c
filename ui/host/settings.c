#include "ui/host/settings.h"

#include "ui/viewer_private.h"

#include <stdio.h>
#include <string.h>

static const ang_viewer_settings *of_host(const ang_viewer *viewer) { return viewer->host->settings; }

void ang_settings_take(ang_viewer *viewer) {
    viewer->theme = &ang_theme_dark;
    viewer->corner_text = viewer->crosshair_shown = true;
    viewer->grips = (ang_grips){.layout = ang_layout_default, .held = -1};
    const ang_viewer_settings *settings = of_host(viewer);
    if (!settings) return;
    viewer->theme = settings->light_theme ? &ang_theme_light : &ang_theme_dark;
    viewer->corner_text = settings->corner_text;
    viewer->crosshair_shown = settings->crosshair;
    if (ang_layout_valid(&settings->layout)) viewer->grips.layout = settings->layout;
    viewer->recent = settings->recent;
    viewer->remembered = *settings;
}

static bool same_recent(const ang_recent *a, const ang_recent *b) {
    if (a->count != b->count) return false;
    for (int i = 0; i < a->count; i++)
        if (strcmp(a->path[i], b->path[i]) != 0) return false;
    return true;
}

static bool same_layout(const ang_layout *a, const ang_layout *b) {
    return a->panel_hidden == b->panel_hidden && !(a->across < b->across || a->across > b->across) &&
           !(a->down < b->down || a->down > b->down) && !(a->panel < b->panel || a->panel > b->panel);
}

static bool same(const ang_viewer_settings *a, const ang_viewer_settings *b) {
    return a->light_theme == b->light_theme && a->corner_text == b->corner_text && a->crosshair == b->crosshair &&
           same_layout(&a->layout, &b->layout) && same_recent(&a->recent, &b->recent);
}

void ang_settings_remember(ang_viewer *viewer, bool all) {
    if (!viewer->host->remember) return;
    ang_viewer_settings *last = &viewer->remembered;
    ang_viewer_settings now = {.light_theme = viewer->theme == &ang_theme_light,
                               .layout = viewer->grips.layout,
                               .corner_text = viewer->corner_text,
                               .crosshair = viewer->crosshair_shown,
                               .width = last->width,
                               .height = last->height,
                               .recent = viewer->recent};
    bool changed = !same(&now, last);
    if (all || (changed && now.width < 1)) ang_window_size(viewer->window, &now.width, &now.height);
    if (!changed && now.width == last->width && now.height == last->height) return;
    *last = now;
    viewer->host->remember(viewer->host->context, last);
}

void ang_settings_opened(ang_viewer *viewer, const char *path) {
    char full[ANG_RECENT_SIZE];
    if (viewer->host->full_path && viewer->host->full_path(viewer->host->context, path, full, sizeof full))
        ang_recent_add(&viewer->recent, full);
}
