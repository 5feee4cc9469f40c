#include "ui/panes/orientation.h"

#include "ui/viewer_private.h"

#include <math.h>
#include <stdlib.h>

/* Pixels at scale 1. */
static const double reach = 26, from_left = 46, from_bottom = 84;

typedef struct tip {
    double x, y, nearness; /* of the reach; nearness towards the eye */
    const char *letter;
} tip;

static int by_nearness(const void *a, const void *b) {
    double x = ((const tip *)a)->nearness, y = ((const tip *)b)->nearness;
    return (x > y) - (x < y);
}

void ang_orientation_axes(ang_viewer *viewer, ang_rect rect, const ang_camera *camera) {
    static const char *const letters[6] = {"R", "L", "A", "P", "F", "H"};
    ang_gui *gui = viewer->gui;
    if (rect.width < ang_gui_px(gui, 300) || rect.height < ang_gui_px(gui, 240)) return;
    tip tips[6];
    for (int i = 0; i < 6; i++) {
        double sign = i % 2 ? 1 : -1;
        int axis = i / 2;
        tips[i] = (tip){sign * ang_vec3_at(camera->right, axis), -sign * ang_vec3_at(camera->up, axis),
                        -sign * ang_vec3_at(camera->forward, axis), letters[i]};
    }
    /* What is nearer is drawn over what is farther. */
    qsort(tips, 6, sizeof *tips, by_nearness);
    double x = rect.x + ang_gui_px(gui, from_left), y = rect.y + rect.height - ang_gui_px(gui, from_bottom);
    double far = ang_gui_px(gui, reach), tall = ang_gui_text_height(gui, true);
    for (int i = 0; i < 6; i++) {
        bool before = tips[i].nearness > -1e-9;
        double to_x = x + far * tips[i].x, to_y = y + far * tips[i].y;
        double thick = fmax(ang_gui_px(gui, before ? 1.5 : 1), 1), length = hypot(tips[i].x, tips[i].y);
        ang_gui_line(gui, x, y, to_x, to_y, ANG_INK(0, 0, 0, 120), thick + 2);
        ang_gui_line(gui, x, y, to_x, to_y, before ? ANG_INK_TEXT : ANG_INK(150, 150, 150, 140), thick);
        /* Of those behind only what is far from the middle is written. */
        if (!before && length < 0.5) continue;
        double beyond = far + ang_gui_px(gui, 9) * length;
        ang_gui_write(gui, x + beyond * tips[i].x, y + beyond * tips[i].y - tall / 2, 0.5, true, true,
                      before ? ANG_INK_TEXT : ANG_INK_DIM, tips[i].letter);
    }
}
