/* Every preset as a small picture of this volume, to choose by eye. */
#include "ui/viewer_private.h"

#include <string.h>

enum { WIDTH = 128, HEIGHT = 96, COLUMNS = 5 }; /* at scale 1 */

int ang_presets(const ang_viewer *viewer, const ang_preset *presets[ANG_THUMBNAILS]) {
    int count = 0;
    if (viewer->own_preset) presets[count++] = viewer->own_preset;
    for (int i = 0; viewer->host->presets[i] && count < ANG_THUMBNAILS; i++)
        presets[count++] = viewer->host->presets[i];
    return count;
}

bool ang_thumbnails_wanted(const ang_viewer *viewer) {
    const ang_preset *presets[ANG_THUMBNAILS];
    return viewer->browsing && viewer->volume.renderer && viewer->thumbnails < ang_presets(viewer, presets);
}

void ang_thumbnails_step(ang_viewer *viewer) {
    const ang_preset *presets[ANG_THUMBNAILS];
    int count = ang_presets(viewer, presets), next = viewer->thumbnails;
    if (next >= count) return;
    ang_document document = viewer->document;
    ang_document_take_preset(&document, presets[next]);
    document.view = ang_viewer_first_view;
    document.crop = false;
    document.clip = (ang_clip_plane){0};
    ang_error err = {0};
    bool made = ang_volume_thumbnail(viewer, &document, (int)ang_gui_px(viewer->gui, WIDTH),
                                     (int)ang_gui_px(viewer->gui, HEIGHT), &viewer->thumbnail[next], &err);
    /* One that cannot be drawn stays empty. */
    if (made || err.code != ANG_INTERRUPTED) viewer->thumbnails++;
}

void ang_thumbnails_clear(ang_viewer *viewer) {
    for (int i = 0; i < viewer->thumbnails; i++) ang_painter_forget(viewer->painter, &viewer->thumbnail[i]);
    viewer->thumbnails = 0;
    viewer->browsing = false;
}

/* A picture with its name below; true where it was clicked. */
static bool show_one(ang_viewer *viewer, const ang_preset *preset, int index) {
    ang_gui *gui = viewer->gui;
    double width = ang_gui_px(gui, WIDTH), height = ang_gui_px(gui, HEIGHT), line = ang_gui_px(gui, 20);
    ang_canvas canvas;
    ang_gui_canvas(gui, preset->name, width, height + line, &canvas);
    ang_rect picture = {canvas.rect.x, canvas.rect.y, width, height};
    ang_gui_fill(gui, picture, ANG_INK(0, 0, 0, 255));
    if (index < viewer->thumbnails) ang_gui_picture(gui, &viewer->thumbnail[index], picture);
    bool chosen = strcmp(preset->name, viewer->document.preset) == 0;
    bool lit = canvas.hovered || canvas.focused;
    ang_ink border = chosen ? viewer->theme->accent : lit ? viewer->theme->text : viewer->theme->edge;
    ang_gui_frame(gui, picture, border);
    ang_gui_clip(gui, canvas.rect);
    ang_gui_write(gui, picture.x + width / 2, picture.y + height + ang_gui_px(gui, 3), 0.5, true, false,
                  chosen || lit ? viewer->theme->text : viewer->theme->dim, preset->name);
    ang_gui_unclip(gui);
    ang_gui_tooltip(gui, preset->description);
    return canvas.activated || (canvas.clicked && canvas.released == ANG_BUTTON_LEFT);
}

void ang_thumbnails_show(ang_viewer *viewer) {
    ang_gui *gui = viewer->gui;
    const ang_preset *presets[ANG_THUMBNAILS];
    int count = ang_presets(viewer, presets);
    ang_gui_message_begin(gui, "presets");
    for (int i = 0; i < count; i++) {
        if (i % COLUMNS != 0) ang_gui_same_line(gui);
        if (!show_one(viewer, presets[i], i)) continue;
        ang_viewer_choose_preset(viewer, presets[i]);
        viewer->browsing = false;
    }
    ang_gui_gap(gui, ang_gui_px(gui, 2));
    ang_gui_text_dim(gui, "A click takes one; Esc or B closes this.");
    ang_gui_message_end(gui);
}
