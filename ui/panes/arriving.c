#include "ui/panes/arriving.h"

#include "ui/panes/overlay.h"
#include "ui/viewer_private.h"

#include <stdio.h>

static void show_slice(ang_viewer *viewer, ang_rect rect) {
    const ang_slice_preview *preview = &viewer->preview;
    if (preview->count == 0 || preview->texture.width < 1) return;
    char text[64];
    snprintf(text, sizeof text, "%zu / %zu", preview->index + 1, preview->count);
    ang_gui_picture(viewer->gui, &preview->texture,
                    ang_rect_within(rect, preview->texture.width, preview->texture.height));
    ang_pane_corner(viewer, rect, 0, 1, 0, text);
}

void ang_arriving_show(ang_viewer *viewer, const ang_layout_places *places) {
    static const char *const names[ANG_PANES] = {"arriving", "coming 2", "coming 3", "coming 4"};
    bool shown = false;
    if (places->panel.width >= 1 && !viewer->series.open) {
        ang_gui_area_begin(viewer->gui, "coming panel", places->panel, true);
        ang_gui_area_end(viewer->gui);
    }
    for (int i = 0; i < ANG_PANES; i++) {
        ang_rect rect = places->pane[i];
        ang_canvas canvas;
        if (rect.width < 1) continue;
        ang_gui_pane_begin(viewer->gui, names[i], rect, &canvas);
        ang_gui_fill(viewer->gui, rect, ANG_INK(0, 0, 0, 255));
        if (!shown) show_slice(viewer, rect);
        shown = true;
        ang_gui_pane_end(viewer->gui);
    }
}
