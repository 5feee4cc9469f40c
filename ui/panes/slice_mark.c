#include "ui/panes/slice_mark.h"

#include "core/base/memory.h"
#include "ui/viewer_private.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { ALPHA = 150 };

static bool fill(ang_viewer *viewer, ang_slice_picture *picture, float low, float high, ang_error *err) {
    ang_slice_mark *mark = &picture->mark;
    bool same = mark->version == picture->version && mark->low >= low && mark->low <= low && mark->high >= high &&
                mark->high <= high;
    if (same && mark->texture.name) return true;
    size_t pixels = (size_t)picture->plane.width * (size_t)picture->plane.height;
    ang_ink *ink = ang_alloc(pixels, sizeof *ink, "what a range selects", err);
    if (!ink) return false;
    const ang_ink marked = ANG_INK_FADED(ANG_INK_MARK, ALPHA);
    for (size_t i = 0; i < pixels; i++) ink[i] = picture->hu[i] >= low && picture->hu[i] <= high ? marked : 0;
    bool done = ang_painter_picture(viewer->painter, &mark->texture, picture->plane.width, picture->plane.height,
                                    (const uint8_t *)ink, false, err);
    free(ink);
    if (!done) return false;
    mark->low = low;
    mark->high = high;
    mark->version = picture->version;
    return true;
}

/* What the colour means, below the pane's and the patient's name: a swatch and the range. */
static void write_legend(const ang_viewer *viewer, ang_rect rect) {
    ang_gui *gui = viewer->gui;
    const ang_hu_share *share = &viewer->editing.mark;
    char text[80];
    snprintf(text, sizeof text, "%.6g to %.6g%s", share->low, share->high, viewer->study.hounsfield ? " HU" : "");
    double swatch = ang_gui_px(gui, 10), gap = ang_gui_px(gui, 6), tall = ang_gui_text_height(gui, true);
    /* On the third line: the second is the patient's. */
    double x = rect.x + ang_gui_px(gui, 8), y = rect.y + ang_gui_px(gui, 8) + 2 * (tall + ang_gui_px(gui, 3));
    if (swatch + gap + ang_gui_text_width(gui, text, true) > rect.width / 2) return;
    ang_rect square = {x, floor(y + (tall - swatch) / 2), swatch, swatch};
    ang_gui_fill(gui, square, ANG_INK_MARK);
    ang_gui_frame(gui, square, ANG_INK(0, 0, 0, 255));
    ang_gui_write(gui, x + swatch + gap, y, 0, true, true, ANG_INK_TEXT, text);
}

void ang_slice_mark_show(ang_viewer *viewer, ang_slice_picture *picture, ang_rect rect) {
    if (!viewer->editing.marked || !picture->filled) return;
    ang_error err = {0};
    /* Interpolation lies between values: to either side half of the way to the next belongs to a value. */
    double half = viewer->study.volume->slope / 2;
    float low = (float)(viewer->editing.mark.low - half), high = (float)(viewer->editing.mark.high + half);
    if (!fill(viewer, picture, low, high, &err)) {
        ang_viewer_say(viewer, true, "%s", err.message);
        return;
    }
    ang_gui_picture(viewer->gui, &picture->mark.texture, rect);
    write_legend(viewer, rect);
}
