#include "app/view_preferences.h"

#include "io/session/preferences.h"

#include <stdio.h>
#include <string.h>

enum { PATH = 4096 };
_Static_assert((int)ANG_RECENT_FILES == (int)ANG_RECENT_MOST && (int)ANG_RECENT_PATH == (int)ANG_RECENT_SIZE,
               "both keep the same paths");

void ang_view_preferences_read(ang_viewer_settings *settings) {
    ang_preferences kept = ang_preferences_default;
    char path[PATH];
    ang_error err = {0};
    if (ang_preferences_path(path, sizeof path) && !ang_preferences_read(path, &kept, &err))
        fprintf(stderr, "warning: %s; the viewer begins with its defaults\n", err.message);
    *settings = (ang_viewer_settings){.light_theme = kept.light_theme,
                                      .layout = {.across = kept.split_across,
                                                 .down = kept.split_down,
                                                 .panel = kept.panel_width,
                                                 .panel_hidden = kept.panel_hidden},
                                      .corner_text = kept.corner_text,
                                      .crosshair = kept.crosshair,
                                      .width = kept.window_width,
                                      .height = kept.window_height,
                                      .recent.count = kept.recent_count};
    memcpy(settings->recent.path, kept.recent, sizeof kept.recent);
}

bool ang_view_preferences_write(const ang_viewer_settings *settings, ang_error *err) {
    ang_preferences kept = {.light_theme = settings->light_theme,
                            .split_across = settings->layout.across,
                            .split_down = settings->layout.down,
                            .panel_width = settings->layout.panel,
                            .panel_hidden = settings->layout.panel_hidden,
                            .corner_text = settings->corner_text,
                            .crosshair = settings->crosshair,
                            .window_width = settings->width,
                            .window_height = settings->height,
                            .recent_count = settings->recent.count};
    memcpy(kept.recent, settings->recent.path, sizeof kept.recent);
    char path[PATH];
    return !ang_preferences_path(path, sizeof path) || ang_preferences_write(path, &kept, err);
}
