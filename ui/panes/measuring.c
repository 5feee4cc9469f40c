#include "ui/panes/measuring.h"

#include "ui/panes/volume_ray.h"
#include "ui/study.h"
#include "ui/viewer_private.h"

#include <string.h>

static const double reach = 7; /* pixels at scale 1 within which a handle or a line is grabbed */

void ang_measuring_start(ang_viewer *viewer) {
    viewer->measuring = (ang_measuring){.kind = viewer->measuring.kind, .chosen = -1, .grabbed = ANG_MARK_NOTHING};
}

bool ang_measuring_cancel(ang_viewer *viewer) {
    bool making = viewer->measuring.placed > 0;
    viewer->measuring.placed = 0;
    viewer->measuring.holding = false;
    viewer->measuring.grabbed = ANG_MARK_NOTHING;
    return making;
}

void ang_measuring_take(ang_viewer *viewer, ang_measure_kind kind) {
    ang_measuring_cancel(viewer);
    viewer->tool = ANG_TOOL_MEASURE;
    viewer->measuring.kind = kind;
}

int ang_measuring_chosen(const ang_viewer *viewer) {
    int chosen = viewer->measuring.chosen;
    return chosen < viewer->document.measures.count ? chosen : -1;
}

void ang_measuring_choose(ang_viewer *viewer, int index) {
    viewer->measuring.chosen = index;
    viewer->point = -1; /* Delete has one meaning */
}

void ang_measuring_jump(ang_viewer *viewer, int index) {
    ang_measuring_choose(viewer, index);
    ang_viewer_point_at(viewer, ang_measurement_middle(&viewer->document.measures.item[index]));
}

void ang_measuring_delete(ang_viewer *viewer, int index) {
    ang_measures_delete(&viewer->document.measures, index);
    viewer->measuring.chosen = -1;
}

static const ang_region_values *values_of(ang_viewer *viewer, const ang_measurement *measurement, int slot) {
    ang_measuring *measuring = &viewer->measuring;
    bool known = measuring->values[slot].count > 0 && ang_measurement_same(&measuring->measured[slot], measurement);
    if (!known && ang_measure_is_region(measurement->kind)) {
        measuring->values[slot] = ang_region_measure(viewer->study.volume, measurement);
        measuring->measured[slot] = *measurement;
    }
    return &measuring->values[slot];
}

const ang_region_values *ang_measuring_values(ang_viewer *viewer) {
    for (int i = 0; i < viewer->document.measures.count; i++) values_of(viewer, &viewer->document.measures.item[i], i);
    return viewer->measuring.values;
}

const ang_region_values *ang_measuring_pending_values(ang_viewer *viewer) {
    return values_of(viewer, &viewer->measuring.pending, ANG_MEASURES);
}

bool ang_measuring_shows(const ang_viewer *viewer, ang_pane pane, const ang_slice_frame *frame, int index,
                         ang_presence *presence) {
    const ang_measures *measures = &viewer->document.measures;
    *presence = ang_mark_presence(&measures->item[index], frame, viewer->range[pane].step);
    return !measures->hidden && *presence != ANG_PRESENCE_NONE;
}

static bool within(const ang_mark_box *box, double x, double y) {
    return x >= box->left && x < box->right && y >= box->top && y < box->bottom;
}

/* What of one measure lies under the pointer. */
static int hit(const ang_viewer *viewer, ang_pane pane, const ang_canvas *canvas, const ang_slice_frame *frame,
               int index) {
    ang_presence presence;
    bool shown = ang_measuring_shows(viewer, pane, frame, index, &presence);
    if (!shown || presence == ANG_PRESENCE_CROSSES) return ANG_MARK_NOTHING;
    int found = ang_mark_hit(&viewer->document.measures.item[index], frame, canvas->x, canvas->y,
                             ang_gui_px(viewer->gui, reach));
    bool on_label = within(&viewer->measuring.label[pane][index], canvas->x, canvas->y);
    return on_label && (found == ANG_MARK_NOTHING || found == ANG_MARK_LINE) ? ANG_MARK_LABEL : found;
}

int ang_measuring_under(const ang_viewer *viewer, ang_pane pane, const ang_canvas *canvas, const ang_slice_frame *frame,
                        int *index) {
    int chosen = ang_measuring_chosen(viewer), found = ANG_MARK_NOTHING;
    *index = chosen;
    if (chosen >= 0) found = hit(viewer, pane, canvas, frame, chosen);
    for (int i = viewer->document.measures.count - 1; i >= 0 && found == ANG_MARK_NOTHING; i--) {
        *index = i;
        found = hit(viewer, pane, canvas, frame, i);
    }
    return found;
}

/* The place under the pointer: the middle of its pixel. */
static ang_vec3 pointed(const ang_canvas *canvas, const ang_slice_frame *frame) {
    return ang_slice_at(frame, canvas->x + 0.5, canvas->y + 0.5);
}

static void begin(ang_viewer *viewer, ang_pane pane, ang_vec3 at, const ang_slice_axes *axes) {
    ang_measuring *measuring = &viewer->measuring;
    measuring->pending = (ang_measurement){.kind = measuring->kind, .point = {at, at, at}};
    if (ang_measure_is_region(measuring->kind)) {
        measuring->pending.right = axes->right;
        measuring->pending.down = axes->down;
    }
    measuring->placed = 1;
    measuring->pane = (int)pane;
    measuring->began = true;
    measuring->by_keys = false;
    measuring->chosen = -1;
}

/* Two clicks on one place measure nothing. */
static bool has_extent(const ang_measurement *measurement) {
    double arm[2] = {ang_vec3_length(ang_vec3_sub(measurement->point[1], measurement->point[0])),
                     ang_vec3_length(ang_vec3_sub(measurement->point[2], measurement->point[1]))};
    if (measurement->kind == ANG_MEASURE_LENGTH) return arm[0] > 0;
    if (measurement->kind == ANG_MEASURE_ANGLE) return arm[0] > 0 && arm[1] > 0;
    return ang_measurement_value(measurement) > 0;
}

/* Fixes the next place; the last one completes the measure. */
static void place(ang_viewer *viewer, ang_vec3 at) {
    ang_measuring *measuring = &viewer->measuring;
    ang_measures *measures = &viewer->document.measures;
    int needed = ang_measure_points(measuring->pending.kind);
    for (int i = measuring->placed; i < ANG_MEASURE_POINTS; i++) measuring->pending.point[i] = at;
    if (++measuring->placed < needed) return;
    measuring->placed = 0;
    if (!has_extent(&measuring->pending)) return;
    for (int i = needed; i < ANG_MEASURE_POINTS; i++) measuring->pending.point[i] = (ang_vec3){0};
    int index = ang_measures_add(measures, &measuring->pending);
    if (index < 0) {
        ang_viewer_say(viewer, true, "There are %d measures already: delete one first", ANG_MEASURES);
        return;
    }
    measures->hidden = false;
    ang_measuring_choose(viewer, index);
}

static void press(ang_viewer *viewer, ang_pane pane, const ang_canvas *canvas, const ang_slice_frame *frame) {
    ang_measuring *measuring = &viewer->measuring;
    measuring->holding = true;
    measuring->began = measuring->by_keys = false;
    measuring->grabbed = ANG_MARK_NOTHING;
    if (measuring->placed > 0 && measuring->pane == (int)pane) return;
    int index, found = ang_measuring_under(viewer, pane, canvas, frame, &index);
    if (found == ANG_MARK_NOTHING) {
        begin(viewer, pane, pointed(canvas, frame), &frame->axes);
        return;
    }
    measuring->placed = 0;
    ang_measuring_choose(viewer, index);
    measuring->grabbed = found;
    const ang_mark_box *label = &measuring->label[pane][index];
    double x, y;
    ang_slice_locate(frame, ang_measurement_middle(&viewer->document.measures.item[index]), &x, &y);
    measuring->label_mm[0] = ((label->left + label->right) / 2 - x) * frame->mm_per_pixel;
    measuring->label_mm[1] = ((label->top + label->bottom) / 2 - y) * frame->mm_per_pixel;
}

bool ang_measuring_by_keys(const ang_viewer *viewer) {
    return viewer->ready && viewer->tool == ANG_TOOL_MEASURE && viewer->focus.pane != ANG_PANE_VOLUME;
}

void ang_measuring_place(ang_viewer *viewer, int argument) {
    (void)argument;
    ang_measuring *measuring = &viewer->measuring;
    ang_pane pane = (ang_pane)viewer->focus.pane;
    if (measuring->placed > 0 && measuring->pane == (int)pane) {
        place(viewer, viewer->document.crosshair);
        return;
    }
    ang_slice_frame frame = ang_slice_frame_of(viewer, (ang_orientation)pane, viewer->pane[pane]);
    begin(viewer, pane, viewer->document.crosshair, &frame.axes);
    measuring->by_keys = true;
}

/* What is grabbed follows the pointer, from where it was when the button went down. */
static void pull(ang_viewer *viewer, const ang_canvas *canvas, const ang_slice_frame *frame) {
    ang_measuring *measuring = &viewer->measuring;
    int chosen = ang_measuring_chosen(viewer);
    if (chosen < 0 || measuring->grabbed == ANG_MARK_NOTHING) return;
    const ang_measurement *before = &viewer->gesture.before.measures.item[chosen];
    double across = (canvas->x - canvas->start_x) * frame->mm_per_pixel;
    double down = (canvas->y - canvas->start_y) * frame->mm_per_pixel;
    ang_vec3 by = ang_vec3_along(ang_vec3_scale(frame->axes.right, across), frame->axes.down, down);
    ang_measurement now = *before;
    if (measuring->grabbed == ANG_MARK_LABEL) {
        now.label_placed = true;
        now.label_mm[0] = measuring->label_mm[0] + across;
        now.label_mm[1] = measuring->label_mm[1] + down;
    } else if (measuring->grabbed == ANG_MARK_LINE) {
        ang_measurement_shift(&now, by);
    } else {
        ang_vec3 handle[ANG_MEASURE_HANDLES];
        ang_measurement_handles(before, handle);
        ang_measurement_drag(&now, measuring->grabbed, ang_vec3_add(handle[measuring->grabbed], by));
    }
    viewer->document.measures.item[chosen] = now;
}

/* Whether what is being made lies no longer in the plane that the pane shows. */
static bool left_behind(const ang_viewer *viewer, const ang_slice_frame *frame) {
    ang_vec3 from = ang_vec3_sub(viewer->measuring.pending.point[0], frame->corner);
    return fabs(ang_vec3_dot(from, frame->axes.inward)) > frame->mm_per_pixel / 100;
}

void ang_measuring_slice(ang_viewer *viewer, ang_pane pane, const ang_canvas *canvas, const ang_slice_frame *frame) {
    ang_measuring *measuring = &viewer->measuring;
    const ang_gesture *gesture = &viewer->gesture;
    bool making = measuring->placed > 0 && measuring->pane == (int)pane;
    if (viewer->tool != ANG_TOOL_MEASURE || canvas->double_clicked || (making && left_behind(viewer, frame))) {
        if (making || canvas->double_clicked) ang_measuring_cancel(viewer);
        return;
    }
    if (canvas->pressed && canvas->held == ANG_BUTTON_LEFT && !viewer->input.key[ANG_KEY_SPACE])
        press(viewer, pane, canvas, frame);
    making = measuring->placed > 0 && measuring->pane == (int)pane;
    bool ours = gesture->pane == (int)pane && !gesture->cancelled;
    if (ours && canvas->held == ANG_BUTTON_LEFT && (canvas->dx != 0 || canvas->dy != 0)) pull(viewer, canvas, frame);
    if (ours && canvas->released == ANG_BUTTON_LEFT && measuring->holding) {
        bool only_began = measuring->began && canvas->clicked;
        if (making && !only_began) place(viewer, pointed(canvas, frame));
        measuring->holding = false;
        measuring->grabbed = ANG_MARK_NOTHING;
    }
    for (int i = measuring->placed; measuring->placed > 0 && making && i < ANG_MEASURE_POINTS; i++)
        measuring->pending.point[i] = measuring->by_keys ? viewer->document.crosshair : pointed(canvas, frame);
}

void ang_measuring_volume(ang_viewer *viewer, const ang_canvas *canvas) {
    ang_measuring *measuring = &viewer->measuring;
    bool making = measuring->placed > 0 && measuring->pane == ANG_PANE_VOLUME;
    ang_vec3 at;
    if (viewer->tool != ANG_TOOL_MEASURE || canvas->double_clicked) {
        if (making || canvas->double_clicked) ang_measuring_cancel(viewer);
        return;
    }
    const ang_gesture *gesture = &viewer->gesture;
    bool ours = gesture->pane == ANG_PANE_VOLUME && !gesture->cancelled && !gesture->bends && !gesture->strengthens;
    bool click = ours && canvas->clicked && canvas->released == ANG_BUTTON_LEFT;
    double x = click ? canvas->start_x : canvas->x, y = click ? canvas->start_y : canvas->y;
    if (click && measuring->kind != ANG_MEASURE_LENGTH) {
        ang_viewer_say(viewer, false, "Only lengths are measured on the volume: from one surface to another");
        return;
    }
    if ((!click && !making) || !ang_volume_pick(viewer, x, y, &at)) return;
    if (!making) {
        begin(viewer, ANG_PANE_VOLUME, at, NULL);
    } else if (click) {
        place(viewer, at);
    } else {
        measuring->pending.point[1] = at;
    }
}
