#include "ui/state/layout.h"

#include <math.h>

const ang_layout ang_layout_default = {.across = 0.5, .down = 0.5, .panel = 320};

/* At scale 1. */
static const double gap = 4, grip = 10;
static const double least_panel = 280, most_panel = 640;
static const double least_across = 180, least_down = 120; /* of a pane */

static double within(double value, double low, double high) {
    return value < low ? low : value > high ? fmax(high, low) : value;
}

/* The panel's width in pixels: the panes keep their least as long as the panel has its own. */
static double panel_width(const ang_layout *layout, const ang_layout_frame *frame) {
    if (layout->panel_hidden) return 0;
    double scale = frame->scale, left = frame->width - (2 * least_across + 2 * gap) * scale;
    double wanted = within(layout->panel, least_panel, most_panel) * scale;
    wanted = fmin(wanted, fmax(left, least_panel * scale));
    return round(fmin(wanted, frame->width));
}

/* Pixels before a gap that divides `room`; both parts keep `least` where there is room for two. */
static double before_gap(double room, double share, double least) {
    least = fmin(least, floor(room / 2));
    return within(round(room * share), least, room - least);
}

static void place_grips(ang_layout_places *places, const ang_layout_frame *frame, double wide) {
    double reach = round(grip * frame->scale), out = floor((reach - wide) / 2);
    const ang_rect *first = &places->pane[0], *last = &places->pane[3];
    double x = first->x + first->width - out, y = first->y + first->height - out;
    if (places->panel.width > 0)
        places->grip[ANG_GRIP_PANEL] =
            (ang_rect){places->panel.x + places->panel.width - out, frame->top, reach, places->panel.height};
    if (frame->maximised >= 0 || last->width < 1 || last->height < 1) return;
    places->grip[ANG_GRIP_ACROSS] = (ang_rect){x, places->panes.y, reach, places->panes.height};
    places->grip[ANG_GRIP_DOWN] = (ang_rect){places->panes.x, y, places->panes.width, reach};
    places->grip[ANG_GRIP_CROSS] = (ang_rect){x, y, reach, reach};
}

ang_layout_places ang_layout_place(const ang_layout *layout, const ang_layout_frame *frame) {
    ang_layout_places places = {0};
    double wide = round(gap * frame->scale), tall = fmax(frame->height - frame->top - frame->bottom, 0);
    double side = panel_width(layout, frame), start = side > 0 ? side + wide : 0;
    places.panel = (ang_rect){0, frame->top, side, tall};
    places.status = (ang_rect){0, frame->top + tall, frame->width, frame->bottom};
    places.panes = (ang_rect){start, frame->top, fmax(frame->width - start, 0), tall};
    ang_rect all = places.panes;
    double width = before_gap(fmax(all.width - wide, 0), layout->across, round(least_across * frame->scale));
    double height = before_gap(fmax(tall - wide, 0), layout->down, round(least_down * frame->scale));
    for (int i = 0; i < ANG_PANES; i++) {
        bool right = i % 2, low = i / 2;
        places.pane[i] =
            (ang_rect){right ? all.x + width + wide : all.x, low ? all.y + height + wide : all.y,
                       right ? fmax(all.width - width - wide, 0) : width, low ? fmax(tall - height - wide, 0) : height};
        if (frame->maximised >= 0) places.pane[i] = i == frame->maximised ? all : (ang_rect){0};
    }
    place_grips(&places, frame, wide);
    return places;
}

ang_layout ang_layout_drag(const ang_layout *from, const ang_layout_frame *frame, ang_grip held, double dx, double dy) {
    ang_layout layout = *from;
    ang_layout_frame whole = *frame;
    whole.maximised = -1;
    ang_layout_places places = ang_layout_place(from, &whole);
    double wide = round(gap * frame->scale);
    if (held == ANG_GRIP_PANEL) {
        layout.panel = within((places.panel.width + dx) / frame->scale, least_panel, most_panel);
        layout.panel = panel_width(&layout, frame) / frame->scale;
        return layout;
    }
    double across = places.panes.width - wide, down = places.panes.height - wide;
    if (held != ANG_GRIP_DOWN && across >= 1)
        layout.across =
            before_gap(across, (places.pane[0].width + dx) / across, round(least_across * frame->scale)) / across;
    if (held != ANG_GRIP_ACROSS && down >= 1)
        layout.down = before_gap(down, (places.pane[0].height + dy) / down, round(least_down * frame->scale)) / down;
    return layout;
}

ang_layout ang_layout_even(const ang_layout *layout, ang_grip held) {
    ang_layout even = *layout;
    if (held == ANG_GRIP_PANEL) even.panel = ang_layout_default.panel;
    if (held == ANG_GRIP_CROSS || held == ANG_GRIP_ACROSS) even.across = ang_layout_default.across;
    if (held == ANG_GRIP_CROSS || held == ANG_GRIP_DOWN) even.down = ang_layout_default.down;
    return even;
}

bool ang_layout_valid(const ang_layout *layout) {
    return layout->across > 0 && layout->across < 1 && layout->down > 0 && layout->down < 1 &&
           layout->panel >= least_panel && layout->panel <= most_panel;
}
