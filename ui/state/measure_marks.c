#include "ui/state/measure_marks.h"

#include "ui/state/pane_map.h"

/* Shares of a slice: what counts as in the plane, and how far beside it a mark still shows. */
static const double exact_share = 0.01, near_share = 0.5 + 1e-6;

static double distance_to(const ang_slice_frame *frame, ang_vec3 mm) {
    return ang_vec3_dot(ang_vec3_sub(mm, frame->corner), frame->axes.inward);
}

ang_presence ang_mark_presence(const ang_measurement *measurement, const ang_slice_frame *frame, double step_mm) {
    ang_vec3 handle[ANG_MEASURE_HANDLES];
    double least = INFINITY, most = -INFINITY;
    int count = ang_measurement_handles(measurement, handle);
    for (int i = 0; i < count; i++) {
        double away = distance_to(frame, handle[i]);
        least = fmin(least, away);
        most = fmax(most, away);
    }
    double farthest = fmax(most, -least);
    if (farthest <= exact_share * step_mm) return ANG_PRESENCE_WITHIN;
    if (farthest <= near_share * step_mm) return ANG_PRESENCE_NEAR;
    bool crosses = measurement->kind == ANG_MEASURE_LENGTH && least <= 0 && most >= 0;
    return crosses ? ANG_PRESENCE_CROSSES : ANG_PRESENCE_NONE;
}

void ang_mark_crossing(const ang_measurement *measurement, const ang_slice_frame *frame, double at[2]) {
    ang_vec3 from = measurement->point[0], to = measurement->point[1];
    double before = distance_to(frame, from), after = distance_to(frame, to);
    double share = before < after || before > after ? before / (before - after) : 0.5;
    ang_vec3 mm = ang_vec3_along(from, ang_vec3_sub(to, from), share);
    ang_slice_locate(frame, mm, &at[0], &at[1]);
}

static void locate(const ang_slice_frame *frame, ang_vec3 mm, double at[2]) {
    ang_slice_locate(frame, mm, &at[0], &at[1]);
}

int ang_mark_outline(const ang_measurement *measurement, const ang_slice_frame *frame, double at[ANG_MARK_POINTS][2]) {
    ang_vec3 places[ANG_MEASURE_OUTLINE];
    int count = ang_measurement_outline(measurement, places);
    for (int i = 0; i < count; i++) locate(frame, places[i], at[i]);
    return count;
}

int ang_mark_hit(const ang_measurement *measurement, const ang_slice_frame *frame, double x, double y, double reach) {
    ang_vec3 handle[ANG_MEASURE_HANDLES];
    double nearest = reach, at[ANG_MARK_POINTS][2];
    int found = ANG_MARK_NOTHING, count = ang_measurement_handles(measurement, handle);
    for (int i = 0; i < count; i++) {
        locate(frame, handle[i], at[0]);
        double away = hypot(at[0][0] - x, at[0][1] - y);
        if (away > nearest) continue;
        nearest = away;
        found = i;
    }
    if (found != ANG_MARK_NOTHING) return found;
    count = ang_mark_outline(measurement, frame, at);
    for (int i = 0; i + 1 < count; i++)
        if (ang_line_distance((double[]){at[i][0], at[i][1], at[i + 1][0], at[i + 1][1]}, x, y) <= reach)
            return ANG_MARK_LINE;
    return ANG_MARK_NOTHING;
}

enum { PLACES = 4 }; /* that a label tries */

/* The label whose nearest point to `point` is `gap` pixels away, as seen in the direction (dx, dy): all of it lies
 * beyond the line through the point at right angles to that. */
static ang_mark_box beside(const double point[2], double dx, double dy, const double size[2], double gap) {
    double length = hypot(dx, dy);
    if (!(length > 0)) dx = 0, dy = -1, length = 1;
    dx /= length;
    dy /= length;
    double away = gap + fabs(dx) * size[0] / 2 + fabs(dy) * size[1] / 2;
    double x = point[0] + dx * away, y = point[1] + dy * away;
    return (ang_mark_box){x - size[0] / 2, y - size[1] / 2, x + size[0] / 2, y + size[1] / 2};
}

static void unit_towards(const double from[2], const double to[2], double along[2]) {
    double length = hypot(to[0] - from[0], to[1] - from[1]);
    for (int i = 0; i < 2; i++) along[i] = length > 0 ? (to[i] - from[i]) / length : 0;
}

/* To the right of the line, of a level one above it; to its other side; beyond its ends. */
static void around_length(double at[][2], const double size[2], double gap, ang_mark_box place[PLACES]) {
    double along[2], middle[2] = {(at[0][0] + at[1][0]) / 2, (at[0][1] + at[1][1]) / 2};
    unit_towards(at[0], at[1], along);
    double side = along[1] > 0 || (along[1] >= 0 && along[0] > 0) ? 1 : -1;
    place[0] = beside(middle, side * along[1], -side * along[0], size, gap);
    place[1] = beside(middle, -side * along[1], side * along[0], size, gap);
    place[2] = beside(at[1], along[0], along[1], size, gap);
    place[3] = beside(at[0], -along[0], -along[1], size, gap);
}

/* Behind the vertex; beyond the arms' ends, between them and each for itself. */
static void around_angle(double at[][2], const double size[2], double gap, ang_mark_box place[PLACES]) {
    double a[2], b[2];
    unit_towards(at[1], at[0], a);
    unit_towards(at[1], at[2], b);
    double longer =
        fmax(hypot(at[0][0] - at[1][0], at[0][1] - at[1][1]), hypot(at[2][0] - at[1][0], at[2][1] - at[1][1]));
    place[0] = beside(at[1], -a[0] - b[0], -a[1] - b[1], size, gap);
    place[1] = beside(at[1], a[0] + b[0], a[1] + b[1], size, gap + longer);
    place[2] = beside(at[0], a[0], a[1], size, gap);
    place[3] = beside(at[2], b[0], b[1], size, gap);
}

/* Below, above, to the right, to the left. */
static void around_region(double at[][2], int count, const double size[2], double gap, ang_mark_box place[PLACES]) {
    double least[2] = {INFINITY, INFINITY}, most[2] = {-INFINITY, -INFINITY};
    for (int i = 0; i < count; i++)
        for (int axis = 0; axis < 2; axis++) {
            least[axis] = fmin(least[axis], at[i][axis]);
            most[axis] = fmax(most[axis], at[i][axis]);
        }
    double x = (least[0] + most[0]) / 2, y = (least[1] + most[1]) / 2;
    place[0] = beside((double[]){x, most[1]}, 0, 1, size, gap);
    place[1] = beside((double[]){x, least[1]}, 0, -1, size, gap);
    place[2] = beside((double[]){most[0], y}, 1, 0, size, gap);
    place[3] = beside((double[]){least[0], y}, -1, 0, size, gap);
}

static bool has_room(const ang_slice_frame *frame, const ang_mark_box *box) {
    return box->left >= 0 && box->top >= 0 && box->right <= frame->width && box->bottom <= frame->height;
}

static bool is_clear(const ang_mark_box *box, const ang_mark_box *taken, int count) {
    for (int i = 0; i < count; i++)
        if (box->left < taken[i].right && taken[i].left < box->right && box->top < taken[i].bottom &&
            taken[i].top < box->bottom)
            return false;
    return true;
}

static bool covers_handle(const ang_measurement *m, const ang_slice_frame *frame, const ang_mark_box *box) {
    ang_vec3 handle[ANG_MEASURE_HANDLES];
    int count = ang_measurement_handles(m, handle);
    for (int i = 0; i < count; i++) {
        double at[2];
        locate(frame, handle[i], at);
        if (at[0] >= box->left && at[0] <= box->right && at[1] >= box->top && at[1] <= box->bottom) return true;
    }
    return false;
}

/* Moved so that it lies within the pane. */
static ang_mark_box kept_within(const ang_slice_frame *frame, ang_mark_box box) {
    double width = box.right - box.left, height = box.bottom - box.top;
    double left = fmax(fmin(box.left, frame->width - width), 0), top = fmax(fmin(box.top, frame->height - height), 0);
    return (ang_mark_box){left, top, left + width, top + height};
}

ang_mark_box ang_mark_label(const ang_measurement *m, const ang_slice_frame *frame, double width, double height,
                            double gap, const ang_mark_box *taken, int count) {
    ang_mark_box place[PLACES];
    double at[ANG_MARK_POINTS][2], size[2] = {width, height};
    if (m->label_placed) {
        locate(frame, ang_measurement_middle(m), at[0]);
        double x = at[0][0] + m->label_mm[0] / frame->mm_per_pixel - width / 2;
        double y = at[0][1] + m->label_mm[1] / frame->mm_per_pixel - height / 2;
        return kept_within(frame, (ang_mark_box){x, y, x + width, y + height});
    }
    int points = ang_mark_outline(m, frame, at);
    if (m->kind == ANG_MEASURE_LENGTH)
        around_length(at, size, gap, place);
    else if (m->kind == ANG_MEASURE_ANGLE)
        around_angle(at, size, gap, place);
    else
        around_region(at, points, size, gap, place);
    /* Best a place with room and clear; else moved into the pane; else with room. */
    for (int i = 0; i < PLACES; i++)
        if (has_room(frame, &place[i]) && is_clear(&place[i], taken, count)) return place[i];
    for (int i = 0; i < PLACES; i++) {
        ang_mark_box moved = kept_within(frame, place[i]);
        if (!covers_handle(m, frame, &moved) && is_clear(&moved, taken, count)) return moved;
    }
    for (int i = 0; i < PLACES; i++)
        if (has_room(frame, &place[i])) return place[i];
    return kept_within(frame, place[0]);
}
