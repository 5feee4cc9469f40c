#include "ui/panes/grips.h"

#include "ui/viewer_private.h"

static const double step = 24; /* of a key, at scale 1 */

/* The gap that `grip` stands for, as a line of the accent's colour. */
static void mark(ang_viewer *viewer, ang_rect grip) {
    ang_gui *gui = viewer->gui;
    double thick = ang_gui_px(gui, 2);
    bool upright = grip.height > grip.width;
    ang_rect line = upright ? (ang_rect){grip.x + (grip.width - thick) / 2, grip.y, thick, grip.height}
                            : (ang_rect){grip.x, grip.y + (grip.height - thick) / 2, grip.width, thick};
    ang_gui_fill(gui, line, viewer->theme->accent);
}

static void handle(ang_viewer *viewer, ang_grip grip, const ang_canvas *canvas) {
    static const ang_cursor cursors[ANG_GRIPS] = {ANG_CURSOR_HAND, ANG_CURSOR_ACROSS, ANG_CURSOR_UP_DOWN,
                                                  ANG_CURSOR_ACROSS};
    ang_grips *grips = &viewer->grips;
    if (canvas->pressed && canvas->held == ANG_BUTTON_LEFT) {
        grips->before = grips->layout;
        grips->held = (int)grip;
        if (canvas->double_clicked) {
            grips->layout = ang_layout_even(&grips->layout, grip);
            grips->held = -1;
        }
    }
    if (grips->held == (int)grip && canvas->held >= 0 && (canvas->dx != 0 || canvas->dy != 0))
        grips->layout = ang_layout_drag(&grips->before, &grips->frame, grip, canvas->x - canvas->start_x,
                                        canvas->y - canvas->start_y);
    if (grips->held == (int)grip && canvas->held < 0) grips->held = -1;
    if (canvas->hovered || grips->held == (int)grip) ang_gui_cursor(viewer->gui, cursors[grip]);
}

void ang_grips_show(ang_viewer *viewer, const ang_layout_places *places) {
    static const char *const names[ANG_GRIPS] = {"gap cross", "gap across", "gap down", "gap panel"};
    for (int i = 0; i < ANG_GRIPS; i++) {
        /* One that is not shown keeps its place in front of the panes, out of sight. */
        bool shown = places->grip[i].width >= 1;
        ang_rect rect = shown ? places->grip[i] : (ang_rect){-64, -64, 8, 8};
        ang_canvas canvas;
        ang_gui_grip_begin(viewer->gui, names[i], rect, &canvas);
        bool lit = shown && (canvas.hovered || viewer->grips.held == i);
        if (shown) handle(viewer, (ang_grip)i, &canvas);
        if (lit && i != ANG_GRIP_CROSS) mark(viewer, rect);
        if (lit && i == ANG_GRIP_CROSS) ang_gui_fill(viewer->gui, rect, viewer->theme->accent);
        ang_gui_pane_end(viewer->gui);
    }
}

bool ang_grips_cancel(ang_viewer *viewer) {
    ang_grips *grips = &viewer->grips;
    if (grips->held < 0) return false;
    grips->layout = grips->before;
    grips->held = -1;
    return true;
}

void ang_grips_step(ang_viewer *viewer, int right, int down) {
    ang_grips *grips = &viewer->grips;
    double by = ang_gui_px(viewer->gui, step);
    grips->layout = ang_layout_drag(&grips->layout, &grips->frame, ANG_GRIP_CROSS, right * by, down * by);
}

void ang_grips_even(ang_viewer *viewer, int argument) {
    (void)argument;
    viewer->grips.layout = ang_layout_even(&viewer->grips.layout, ANG_GRIP_CROSS);
}
