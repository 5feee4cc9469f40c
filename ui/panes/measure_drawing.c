#include "ui/panes/measure_drawing.h"

#include "core/scene/annotation.h"
#include "core/scene/objects.h"
#include "ui/panes/volume_ray.h"
#include "ui/viewer_private.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* As core/scene/objects.c draws marks in the volume. */
#define MARK       ANG_INK(255, 217, 51, 255)
#define MARK_NEAR  ANG_INK(255, 217, 51, 150)
#define MARK_LIGHT ANG_INK(255, 245, 200, 255)
#define SHADE      ANG_INK(0, 0, 0, 150)

static const double dash = 5, between = 4, label_gap = 7, arc_radius = 22; /* pixels at scale 1 */

typedef struct sheet {
    ang_viewer *viewer;
    ang_gui *gui;
    ang_rect rect;
    const ang_slice_frame *frame;
    double scale, thick; /* pixels */
    ang_ink ink;
    bool dashed;
    double phase; /* pixels of the dash pattern that are done */
} sheet;

/* From pane to window. */
static void line(const sheet *s, const double a[2], const double b[2], ang_ink ink, double thick) {
    ang_gui_line(s->gui, s->rect.x + a[0], s->rect.y + a[1], s->rect.x + b[0], s->rect.y + b[1], ink, thick);
}

static void dashes(sheet *s, const double a[2], const double b[2]) {
    double length = hypot(b[0] - a[0], b[1] - a[1]), period = (dash + between) * s->scale;
    /* Off the pane there may be very many. */
    if (!(length > 0) || length > 2e4) return;
    for (double at = -s->phase; at < length; at += period) {
        double from = fmax(at, 0) / length, to = fmin(at + dash * s->scale, length) / length;
        if (to <= from) continue;
        double p[2] = {a[0] + from * (b[0] - a[0]), a[1] + from * (b[1] - a[1])};
        double q[2] = {a[0] + to * (b[0] - a[0]), a[1] + to * (b[1] - a[1])};
        line(s, p, q, s->ink, s->thick);
    }
    s->phase = fmod(s->phase + length, period);
}

static void outline(sheet *s, double at[][2], int count) {
    for (int i = 0; i + 1 < count; i++) line(s, at[i], at[i + 1], SHADE, s->thick + 2 * s->scale);
    s->phase = 0;
    for (int i = 0; i + 1 < count; i++) {
        if (s->dashed)
            dashes(s, at[i], at[i + 1]);
        else
            line(s, at[i], at[i + 1], s->ink, s->thick);
    }
}

/* Between the arms of an angle. */
static void arc(sheet *s, double at[][2]) {
    enum { steps = 24 };
    double first = atan2(at[0][1] - at[1][1], at[0][0] - at[1][0]), turn;
    turn = remainder(atan2(at[2][1] - at[1][1], at[2][0] - at[1][0]) - first, 2 * M_PI);
    double shorter =
        fmin(hypot(at[0][0] - at[1][0], at[0][1] - at[1][1]), hypot(at[2][0] - at[1][0], at[2][1] - at[1][1]));
    double radius = fmin(arc_radius * s->scale, 0.5 * shorter), before[2];
    for (int i = 0; i <= steps; i++) {
        double angle = first + turn * i / steps;
        double now[2] = {at[1][0] + radius * cos(angle), at[1][1] + radius * sin(angle)};
        if (i > 0) line(s, before, now, s->ink, s->scale);
        memcpy(before, now, sizeof before);
    }
}

static void handles(const sheet *s, const ang_measurement *m, bool editable, bool chosen) {
    ang_vec3 handle[ANG_MEASURE_HANDLES];
    int count = ang_measurement_handles(m, handle);
    if (ang_measure_is_region(m->kind) && !editable) return;
    double radius = (editable ? chosen ? 4 : 3 : 2) * s->scale;
    for (int i = 0; i < count; i++) {
        double x, y;
        ang_slice_locate(s->frame, handle[i], &x, &y);
        ang_gui_disc(s->gui, s->rect.x + x, s->rect.y + y, radius + s->scale, SHADE);
        ang_gui_disc(s->gui, s->rect.x + x, s->rect.y + y, radius, s->ink);
    }
}

/* The place of a box nearest to a point. */
static void nearest_in(const ang_mark_box *box, const double point[2], double to[2]) {
    to[0] = fmin(fmax(point[0], box->left), box->right);
    to[1] = fmin(fmax(point[1], box->top), box->bottom);
}

/* From a label that was put elsewhere to the nearest place of its mark. */
static void leader(const sheet *s, const ang_measurement *m, double at[][2], int count, const ang_mark_box *box) {
    double from[2] = {0, 0}, to[2], middle[2], nearest = INFINITY;
    bool region = ang_measure_is_region(m->kind);
    ang_slice_locate(s->frame, ang_measurement_middle(m), &middle[0], &middle[1]);
    for (int i = 0; i < (region ? count : 1); i++) {
        const double *point = region ? at[i] : middle;
        nearest_in(box, point, to);
        double away = hypot(point[0] - to[0], point[1] - to[1]);
        if (away >= nearest) continue;
        nearest = away;
        memcpy(from, point, sizeof from);
    }
    if (!(nearest > 2 * label_gap * s->scale) || isinf(nearest)) return;
    nearest_in(box, from, to);
    line(s, from, to, (s->ink & 0xFFFFFFu) | 140u << 24, s->scale);
}

static bool in_pane(const sheet *s, double at[][2], int count) {
    double least[2] = {INFINITY, INFINITY}, most[2] = {-INFINITY, -INFINITY};
    for (int i = 0; i < count; i++)
        for (int axis = 0; axis < 2; axis++) {
            least[axis] = fmin(least[axis], at[i][axis]);
            most[axis] = fmax(most[axis], at[i][axis]);
        }
    return most[0] >= 0 && most[1] >= 0 && least[0] <= s->rect.width && least[1] <= s->rect.height;
}

/* What labels keep clear of. */
typedef struct taken_boxes {
    ang_mark_box box[ANG_MEASURES * (ANG_MEASURE_HANDLES + 1)];
    int count;
} taken_boxes;

static void take_handles(taken_boxes *taken, const ang_measurement *m, const ang_slice_frame *frame, double radius) {
    ang_vec3 handle[ANG_MEASURE_HANDLES];
    int count = ang_measurement_handles(m, handle);
    for (int i = 0; i < count; i++) {
        double x, y;
        ang_slice_locate(frame, handle[i], &x, &y);
        taken->box[taken->count++] = (ang_mark_box){x - radius, y - radius, x + radius, y + radius};
    }
}

/* Text on a dark ground, to be read on bone as well. */
static void write_lines(const sheet *s, ang_mark_box box, char text[][64], int lines) {
    double tall = (box.bottom - box.top) / lines;
    ang_rect ground = {s->rect.x + box.left - 3 * s->scale, s->rect.y + box.top - s->scale,
                       box.right - box.left + 6 * s->scale, box.bottom - box.top + 2 * s->scale};
    ang_gui_fill(s->gui, ground, ANG_INK(0, 0, 0, 200));
    for (int i = 0; i < lines; i++)
        ang_gui_write(s->gui, s->rect.x + box.left, s->rect.y + box.top + i * tall, 0, true, false, s->ink, text[i]);
}

static void measure_lines(const sheet *s, char text[][64], int lines, double size[2]) {
    size[0] = 0;
    for (int i = 0; i < lines; i++) size[0] = fmax(size[0], ang_gui_text_width(s->gui, text[i], true));
    size[1] = lines * (ang_gui_text_height(s->gui, true) + ang_gui_px(s->gui, 2));
}

/* Moved so that all of it is in the pane, its beginning where it is too large. */
static ang_mark_box kept_in_pane(const sheet *s, ang_mark_box box) {
    double edge = 4 * s->scale;
    double x = fmax(fmin(0, s->rect.width - edge - box.right), edge - box.left);
    double y = fmax(fmin(0, s->rect.height - edge - box.bottom), edge - box.top);
    return (ang_mark_box){box.left + x, box.top + y, box.right + x, box.bottom + y};
}

static ang_mark_box label(const sheet *s, const ang_measurement *m, const ang_region_values *values, double at[][2],
                          int count, taken_boxes *taken) {
    char text[ANG_MEASURE_LINES][64];
    double size[2];
    int lines = ang_measurement_lines(m, values, s->viewer->study.hounsfield ? "HU" : "", text);
    measure_lines(s, text, lines, size);
    ang_mark_box box = ang_mark_label(m, s->frame, size[0], size[1], label_gap * s->scale, taken->box, taken->count);
    box = kept_in_pane(s, box);
    taken->box[taken->count++] = box;
    if (m->label_placed) leader(s, m, at, count, &box);
    write_lines(s, box, text, lines);
    return box;
}

static ang_mark_box mark(sheet *s, const ang_measurement *m, const ang_region_values *values, bool chosen,
                         taken_boxes *taken) {
    double at[ANG_MARK_POINTS][2];
    int count = ang_mark_outline(m, s->frame, at);
    if (!in_pane(s, at, count)) return (ang_mark_box){0};
    bool editable = s->viewer->tool == ANG_TOOL_MEASURE;
    s->ink = s->dashed ? MARK_NEAR : chosen && editable ? MARK_LIGHT : MARK;
    outline(s, at, count);
    if (m->kind == ANG_MEASURE_ANGLE) arc(s, at);
    handles(s, m, editable, chosen);
    return label(s, m, values, at, count, taken);
}

/* Where a length goes through the slice. */
static void crossing(const sheet *s, const ang_measurement *m) {
    double at[2];
    ang_mark_crossing(m, s->frame, at);
    double x = s->rect.x + at[0], y = s->rect.y + at[1];
    ang_gui_ring(s->gui, x, y, 3 * s->scale, SHADE, 3 * s->scale);
    ang_gui_ring(s->gui, x, y, 3 * s->scale, MARK_NEAR, s->scale);
}

static sheet sheet_of(ang_viewer *viewer, ang_rect rect, const ang_slice_frame *frame) {
    double scale = viewer->input.scale;
    return (sheet){viewer, viewer->gui, rect, frame, scale, 1.5 * scale, MARK, false, 0};
}

void ang_measures_draw_slice(ang_viewer *viewer, ang_pane pane, ang_rect rect, const ang_canvas *canvas,
                             const ang_slice_frame *frame) {
    ang_measuring *measuring = &viewer->measuring;
    const ang_measures *measures = &viewer->document.measures;
    const ang_region_values *values = ang_measuring_values(viewer);
    sheet s = sheet_of(viewer, rect, frame);
    ang_presence presence[ANG_MEASURES];
    taken_boxes taken = {.count = 0};
    memset(measuring->label[pane], 0, sizeof measuring->label[pane]);
    for (int i = 0; i < measures->count; i++)
        if (ang_measuring_shows(viewer, pane, frame, i, &presence[i]) && presence[i] != ANG_PRESENCE_CROSSES)
            take_handles(&taken, &measures->item[i], frame, 4 * s.scale);
    ang_gui_clip(viewer->gui, rect);
    for (int i = 0; i < measures->count && !measures->hidden; i++) {
        bool chosen = i == ang_measuring_chosen(viewer);
        s.dashed = presence[i] == ANG_PRESENCE_NEAR;
        if (presence[i] == ANG_PRESENCE_CROSSES)
            crossing(&s, &measures->item[i]);
        else if (presence[i] != ANG_PRESENCE_NONE)
            measuring->label[pane][i] = mark(&s, &measures->item[i], &values[i], chosen, &taken);
    }
    s.dashed = false;
    if (measuring->placed > 0 && measuring->pane == (int)pane) {
        taken.count = 0;
        mark(&s, &measuring->pending, ang_measuring_pending_values(viewer), true, &taken);
    }
    ang_gui_unclip(viewer->gui);
    int index;
    bool free = viewer->tool == ANG_TOOL_MEASURE && canvas->hovered && canvas->held < 0 && measuring->placed == 0;
    bool holds = measuring->grabbed != ANG_MARK_NOTHING && viewer->gesture.pane == (int)pane;
    if (holds || (free && ang_measuring_under(viewer, pane, canvas, frame, &index) != ANG_MARK_NOTHING))
        ang_gui_cursor(viewer->gui, ANG_CURSOR_HAND);
}

/* One line with its middle at a place of the pane. */
static ang_mark_box write_at(const sheet *s, double x, double y, char text[][64]) {
    double size[2];
    measure_lines(s, text, 1, size);
    ang_mark_box box = {x - size[0] / 2, y - size[1] / 2, x + size[0] / 2, y + size[1] / 2};
    write_lines(s, box, text, 1);
    return box;
}

/* 0: hidden by what lies before it, 1: plain. */
static double plainness(double share) { return fmin(fmax((share - 0.1) / 0.3, 0), 1); }

/* Whether something of a length can be seen. */
static bool is_seen(const ang_sight *sight, const ang_measurement *length) {
    enum { places = 9 };
    ang_vec3 way = ang_vec3_sub(length->point[1], length->point[0]);
    bool seen = false;
    for (int i = 0; i < places && !seen; i++) {
        double x, y, along = (double)i / (places - 1);
        seen = plainness(ang_sight_share(sight, ang_vec3_along(length->point[0], way, along), &x, &y)) > 0;
    }
    return seen;
}

/* What lengths measure, of those that the picture shows and that are not hidden by what lies before them. */
static void write_lengths(const sheet *s, const ang_sight *sight, ang_scene scene, taken_boxes *taken) {
    const ang_volume_picture *volume = &s->viewer->volume;
    const ang_measures *measures = &volume->document.measures;
    ang_object_label kept[ANG_MEASURES];
    ang_objects seen = {.label = kept};
    size_t next = 0;
    for (int i = 0; i < measures->count && next < volume->objects.label_count; i++) {
        if (measures->item[i].kind != ANG_MEASURE_LENGTH) continue;
        if (is_seen(sight, &measures->item[i])) kept[seen.label_count++] = volume->objects.label[next];
        next++;
    }
    scene.objects = &seen;
    ang_annotation annotation = ang_annotation_of_objects(&scene);
    for (int i = 0; i < annotation.labels; i++) {
        char text[ANG_MEASURE_LINES][64];
        snprintf(text[0], sizeof text[0], "%s", annotation.label[i].text);
        taken->box[taken->count++] = write_at(s, annotation.label[i].x, annotation.label[i].y, text);
    }
}

/* Further down, until it is clear of those that are taken. */
static ang_mark_box clear_of(const taken_boxes *taken, ang_mark_box box, double apart) {
    for (int tries = 0; tries <= taken->count; tries++)
        for (int i = 0; i < taken->count; i++) {
            const ang_mark_box *other = &taken->box[i];
            if (box.right <= other->left || box.left >= other->right || box.bottom <= other->top ||
                box.top >= other->bottom)
                continue;
            double down = other->bottom + apart - box.top;
            box.top += down;
            box.bottom += down;
        }
    return box;
}

/* An angle or a region as it lies in the patient, as far as it can be seen, and what it measures below it. */
static void draw_in_volume(const sheet *s, const ang_sight *sight, const ang_measurement *m,
                           const ang_region_values *values, taken_boxes *taken) {
    enum { pieces = 12 };
    ang_vec3 place[ANG_MEASURE_OUTLINE];
    int count = ang_measurement_outline(m, place), parts = count < ANG_MEASURE_OUTLINE ? pieces : 1;
    double last[2], before = 0, label[2] = {0, -INFINITY};
    for (int i = 0; i <= (count - 1) * parts; i++) {
        int from = i / parts < count - 1 ? i / parts : count - 2;
        ang_vec3 way = ang_vec3_sub(place[from + 1], place[from]);
        ang_vec3 mm = ang_vec3_along(place[from], way, (double)(i - from * parts) / parts);
        double at[2], plain = plainness(ang_sight_share(sight, mm, &at[0], &at[1])), both = fmin(plain, before);
        if (i > 0 && both > 0) {
            line(s, last, at, ANG_INK(0, 0, 0, 150 * both), s->thick + 2 * s->scale);
            line(s, last, at, ANG_INK_FADED(s->ink, 255 * both), s->thick);
        }
        if (plain > 0.5 && at[1] > label[1]) memcpy(label, at, sizeof label);
        before = plain;
        memcpy(last, at, sizeof last);
    }
    if (isinf(label[1])) return;
    char text[ANG_MEASURE_LINES][64];
    double size[2];
    int lines = ang_measurement_lines(m, values, s->viewer->study.hounsfield ? "HU" : "", text);
    measure_lines(s, text, lines, size);
    double top = label[1] + label_gap * s->scale;
    ang_mark_box box = {label[0] - size[0] / 2, top, label[0] + size[0] / 2, top + size[1]};
    box = kept_in_pane(s, clear_of(taken, box, 3 * s->scale));
    write_lines(s, box, text, lines);
    taken->box[taken->count++] = box;
}

static void draw_finished(ang_viewer *viewer, const sheet *s, const ang_scene *scene) {
    const ang_measures *measures = &viewer->document.measures;
    const ang_region_values *values = ang_measuring_values(viewer);
    ang_sight sight;
    if (measures->count == 0 || !ang_sight_make(viewer, scene->width, scene->height, &sight)) return;
    taken_boxes taken = {.count = 0};
    write_lengths(s, &sight, *scene, &taken);
    for (int i = 0; i < measures->count && !measures->hidden; i++)
        if (measures->item[i].kind != ANG_MEASURE_LENGTH)
            draw_in_volume(s, &sight, &measures->item[i], &values[i], &taken);
}

void ang_measures_draw_volume(ang_viewer *viewer, ang_rect rect, ang_scene scene) {
    const ang_measuring *measuring = &viewer->measuring;
    sheet s = sheet_of(viewer, rect, NULL);
    char text[ANG_MEASURE_LINES][64];
    ang_gui_clip(viewer->gui, rect);
    draw_finished(viewer, &s, &scene);
    double a[2], b[2], depth;
    bool making = measuring->placed > 0 && measuring->pane == ANG_PANE_VOLUME;
    if (making && ang_annotation_place(&scene, measuring->pending.point[0], &a[0], &a[1], &depth) &&
        ang_annotation_place(&scene, measuring->pending.point[1], &b[0], &b[1], &depth)) {
        s.ink = MARK_LIGHT;
        outline(&s, (double[][2]){{a[0], a[1]}, {b[0], b[1]}}, 2);
        ang_gui_disc(viewer->gui, rect.x + a[0], rect.y + a[1], 3 * s.scale, MARK_LIGHT);
        ang_measurement_lines(&measuring->pending, NULL, "", text);
        write_at(&s, b[0] + 32 * s.scale, b[1] + 16 * s.scale, text);
    }
    ang_gui_unclip(viewer->gui);
}
