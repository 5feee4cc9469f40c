#include "ui/panes/crosshair.h"

#include "ui/panes/overlay.h"
#include "ui/viewer_private.h"

#include <math.h>
#include <stdio.h>

/* Lengths at scale 1. */
static const double gap = 14;           /* free around the place itself */
static const double edge = 26;          /* the letters at the edges stay free */
static const double handle_share = 0.8; /* of the way from the place to where the line ends */
static const double least_way = 48;     /* a shorter piece of line has no handle */
static const double reach = 9;          /* of a handle */
static const double snap_deg = 1;

/* The line in which another pane's plane cuts this one: from the crosshair's place (x, y) in its direction and against
 * it. In pixels of the pane. */
typedef struct cut {
    double x, y, direction[2];
    double begin, end; /* along `direction`; begin > end: nothing of it in the pane */
    ang_pane plane;
} cut;

/* The stretch of a line through (x, y) inside the pane without its edges. */
static void clip(cut *cut, const double size[2], double free) {
    const double at[2] = {cut->x, cut->y};
    cut->begin = -INFINITY;
    cut->end = INFINITY;
    for (int i = 0; i < 2; i++) {
        double slope = cut->direction[i], low = free - at[i], high = size[i] - free - at[i];
        if (fabs(slope) < 1e-9) {
            if (low > 0 || high < 0) cut->end = -INFINITY;
            continue;
        }
        cut->begin = fmax(cut->begin, fmin(low / slope, high / slope));
        cut->end = fmin(cut->end, fmax(low / slope, high / slope));
    }
}

/* Upright and level lines stand on whole pixels. */
static double crisp(const ang_viewer *viewer, double at, double slope) {
    if (!(fabs(slope) < 1e-9)) return at;
    return (int)ang_gui_hairline(viewer->gui) % 2 ? floor(at) + 0.5 : round(at);
}

static cut cut_of(const ang_viewer *viewer, ang_pane plane, const ang_slice_frame *frame, double beside_mm) {
    cut cut = {.plane = plane};
    ang_slice_cut(frame, &viewer->turn, (ang_orientation)plane, cut.direction);
    ang_slice_locate(frame, viewer->document.crosshair, &cut.x, &cut.y);
    cut.x = crisp(viewer, cut.x - cut.direction[1] * beside_mm / frame->mm_per_pixel, cut.direction[0]);
    cut.y = crisp(viewer, cut.y + cut.direction[0] * beside_mm / frame->mm_per_pixel, cut.direction[1]);
    clip(&cut, (double[]){frame->width, frame->height}, ang_gui_px(viewer->gui, edge));
    return cut;
}

/* Where the handles of a line are along it; their number. */
static int handles(const ang_viewer *viewer, const cut *cut, double along[2]) {
    int count = 0;
    double least = ang_gui_px(viewer->gui, least_way);
    if (cut->begin > cut->end) return 0;
    if (cut->begin < -least) along[count++] = cut->begin * handle_share;
    if (cut->end > least) along[count++] = cut->end * handle_share;
    return count;
}

/* Others have the whole pane to themselves. */
static bool tool_turns(const ang_viewer *viewer) {
    return viewer->tool == ANG_TOOL_WINDOW || viewer->tool == ANG_TOOL_CROSSHAIR || viewer->tool == ANG_TOOL_SCROLL;
}

bool ang_crosshair_handle_at(const ang_viewer *viewer, ang_pane pane, const ang_slice_frame *frame, double x,
                             double y) {
    if (!viewer->crosshair_shown || !tool_turns(viewer)) return false;
    for (int other = 0; other < ANG_PANE_VOLUME; other++) {
        if (other == (int)pane) continue;
        cut cut = cut_of(viewer, (ang_pane)other, frame, 0);
        double along[2];
        for (int i = handles(viewer, &cut, along) - 1; i >= 0; i--) {
            double dx = cut.x + along[i] * cut.direction[0] - x, dy = cut.y + along[i] * cut.direction[1] - y;
            if (hypot(dx, dy) <= ang_gui_px(viewer->gui, reach)) return true;
        }
    }
    return false;
}

static double wrapped(double degrees) { return degrees - 360 * round(degrees / 360); }

void ang_crosshair_turn(ang_viewer *viewer, ang_pane pane, const ang_slice_frame *frame, const ang_canvas *canvas) {
    ang_gesture *gesture = &viewer->gesture;
    ang_orientation orientation = (ang_orientation)pane;
    double x, y;
    ang_slice_locate(frame, viewer->document.crosshair, &x, &y);
    double now = atan2(canvas->y - y, canvas->x - x);
    double before = atan2(canvas->y - canvas->dy - y, canvas->x - canvas->dx - x);
    bool fine = (canvas->modifiers & ANG_MOD_SHIFT) != 0;
    gesture->turned_deg += wrapped((now - before) * 180 / M_PI) * (fine ? 0.1 : 1);
    const ang_turn *from = &gesture->before.turn;
    double start = ang_slice_turned(from, orientation), wanted = start + gesture->turned_deg;
    double quarter = 90 * round(wanted / 90);
    if (!fine && viewer->range[pane].whole && fabs(wanted - quarter) <= snap_deg) wanted = quarter;
    viewer->document.turn = ang_turn_about(from, frame->axes.inward, wanted - start);
}

static void stretch(ang_viewer *viewer, ang_rect rect, const cut *cut, double from, double to, ang_ink ink) {
    if (!(from < to)) return;
    double x = rect.x + cut->x, y = rect.y + cut->y;
    ang_gui_guide(viewer->gui, x + from * cut->direction[0], y + from * cut->direction[1], x + to * cut->direction[0],
                  y + to * cut->direction[1], ink, ang_gui_hairline(viewer->gui));
}

/* Free of what lies under the crosshair. */
static void draw_line(ang_viewer *viewer, ang_rect rect, const cut *cut, ang_ink ink) {
    double free = ang_gui_px(viewer->gui, gap);
    stretch(viewer, rect, cut, cut->begin, fmin(cut->end, -free), ink);
    stretch(viewer, rect, cut, fmax(cut->begin, free), cut->end, ink);
}

static void draw_handles(ang_viewer *viewer, ang_rect rect, const cut *cut, bool turning, const ang_canvas *canvas) {
    double along[2], small = ang_gui_px(viewer->gui, 4), large = ang_gui_px(viewer->gui, 6);
    for (int i = handles(viewer, cut, along) - 1; i >= 0; i--) {
        double x = cut->x + along[i] * cut->direction[0], y = cut->y + along[i] * cut->direction[1];
        bool near = turning || hypot(x - canvas->x, y - canvas->y) <= ang_gui_px(viewer->gui, reach);
        double radius = near ? large : small;
        ang_gui_disc(viewer->gui, rect.x + x, rect.y + y, radius + 1.5, ANG_INK(0, 0, 0, 200));
        ang_gui_disc(viewer->gui, rect.x + x, rect.y + y, radius, ang_pane_ink(cut->plane, 255));
    }
}

/* By how much the planes are turned in this pane, beside the pointer. */
static void write_angle(ang_viewer *viewer, ang_pane pane, ang_rect rect, const ang_canvas *canvas) {
    char text[32];
    double degrees = ang_slice_turned(&viewer->turn, (ang_orientation)pane);
    snprintf(text, sizeof text, "%.1f\xc2\xb0", fabs(degrees) < 0.05 ? 0 : degrees);
    double tall = ang_gui_text_height(viewer->gui, false), beside = ang_gui_px(viewer->gui, 16);
    double width = ang_gui_text_width(viewer->gui, text, false);
    double x = canvas->x + beside, y = canvas->y - tall - beside / 2;
    x = fmin(fmax(x, 0), rect.width - width - beside);
    y = fmin(fmax(y, 0), rect.height - tall);
    ang_gui_write(viewer->gui, rect.x + x, rect.y + y, 0, false, true, ANG_INK_TEXT, text);
}

void ang_crosshair_draw(ang_viewer *viewer, ang_pane pane, ang_rect rect, const ang_slice_frame *frame,
                        const ang_canvas *canvas) {
    const ang_gesture *gesture = &viewer->gesture;
    bool turning = canvas->held >= 0 && gesture->pane == (int)pane && gesture->turns && !gesture->cancelled;
    bool grips = turning || (tool_turns(viewer) && canvas->hovered && canvas->held < 0 && !viewer->shot.posed);
    double slab = viewer->document.slab_mm;
    for (int other = 0; other < ANG_PANE_VOLUME; other++) {
        if (other == (int)pane) continue;
        for (int side = -1; side <= 1 && slab > 0; side += 2) {
            cut face = cut_of(viewer, (ang_pane)other, frame, side * slab / 2);
            draw_line(viewer, rect, &face, ang_pane_ink((ang_pane)other, 90));
        }
        cut cut = cut_of(viewer, (ang_pane)other, frame, 0);
        draw_line(viewer, rect, &cut, ang_pane_ink((ang_pane)other, 170));
        if (grips) draw_handles(viewer, rect, &cut, turning, canvas);
    }
    if (turning) write_angle(viewer, pane, rect, canvas);
}
