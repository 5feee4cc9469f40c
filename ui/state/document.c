#include "ui/state/document.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { most_states = 500 };
static const double same_gesture_seconds = 1;

void ang_document_take_preset(ang_document *document, const ang_preset *preset) {
    const ang_transfer *transfer = preset->transfer;
    memset(document->preset, 0, sizeof document->preset);
    snprintf(document->preset, sizeof document->preset, "%s", preset->name);
    document->edited = false;
    int count = transfer->count < ANG_DOCUMENT_POINTS ? (int)transfer->count : ANG_DOCUMENT_POINTS;
    memset(document->points, 0, sizeof document->points);
    for (int i = 0; i < count; i++) {
        size_t from = count > 1 ? (size_t)i * (transfer->count - 1) / (size_t)(count - 1) : 0;
        document->points[i] = transfer->points[from];
    }
    document->count = count;
    document->unit_distance = transfer->unit_distance;
    document->by_extinction = transfer->by_extinction;
    document->shift_hu = 0;
    document->stretch = 1;
    document->mode = preset->mode;
    document->shading = preset->shading;
    document->phong = preset->phong;
    if (isfinite(preset->iso_hu)) document->iso_hu = preset->iso_hu;
    if (preset->mode == ANG_MODE_MIP || preset->mode == ANG_MODE_MINIP || preset->mode == ANG_MODE_MEAN) {
        document->window_centre = preset->window_centre;
        document->window_width = preset->window_width;
    }
}

void ang_document_take_look(ang_document *document, const ang_document *from) {
    memcpy(document->preset, from->preset, sizeof document->preset);
    memcpy(document->points, from->points, sizeof document->points);
    document->count = from->count;
    document->unit_distance = from->unit_distance;
    document->by_extinction = from->by_extinction;
    document->edited = from->edited;
    document->shift_hu = from->shift_hu;
    document->stretch = from->stretch;
    document->mode = from->mode;
    document->shading = from->shading;
    document->phong = from->phong;
    document->iso_hu = from->iso_hu;
}

ang_transfer *ang_document_transfer(const ang_document *document, ang_error *err) {
    return ang_transfer_create(document->points, (size_t)document->count, document->unit_distance,
                               document->by_extinction, NULL, err);
}

/* The middle of what shows anything. */
static double middle(const ang_document *document) {
    int first = 0, last = document->count - 1;
    while (first < last && !(document->points[first + 1].opacity > 0)) first++;
    while (last > first && !(document->points[last - 1].opacity > 0)) last--;
    return (document->points[first].hu + document->points[last].hu) / 2;
}

void ang_document_bend(ang_document *document, const ang_document *from, double shift, double stretch) {
    double about = middle(from);
    for (int i = 0; i < from->count; i++)
        document->points[i].hu = about + (from->points[i].hu - about) * stretch + shift;
    document->iso_hu = about + (from->iso_hu - about) * stretch + shift;
    document->shift_hu = from->shift_hu + shift;
    document->stretch = from->stretch * stretch;
    document->edited = true;
}

void ang_document_strengthen(ang_document *document, const ang_document *from, double factor) {
    for (int i = 0; i < from->count; i++) {
        double value = from->points[i].opacity;
        document->points[i].opacity = from->by_extinction ? fmin(value * factor, ANG_TRANSFER_EXTINCTION_LIMIT)
                                      : value < 1         ? -expm1(factor * log1p(-value))
                                                          : 1;
    }
    document->edited = true;
}

int ang_document_add_point(ang_document *document, double hu) {
    if (document->count >= ANG_DOCUMENT_POINTS) return -1;
    int at = 0;
    while (at < document->count && document->points[at].hu <= hu) at++;
    const ang_transfer_point *left = &document->points[at > 0 ? at - 1 : 0];
    const ang_transfer_point *right = &document->points[at < document->count ? at : document->count - 1];
    double span = right->hu - left->hu, t = span > 0 ? (hu - left->hu) / span : 0;
    ang_transfer_point point = {.hu = hu, .opacity = left->opacity + t * (right->opacity - left->opacity)};
    for (int i = 0; i < 3; i++) point.colour[i] = left->colour[i] + t * (right->colour[i] - left->colour[i]);
    memmove(&document->points[at + 1], &document->points[at], (size_t)(document->count - at) * sizeof point);
    document->points[at] = point;
    document->count++;
    document->edited = true;
    return at;
}

void ang_document_delete_point(ang_document *document, int index) {
    if (document->count < 2 || index < 0 || index >= document->count) return;
    document->count--;
    memmove(&document->points[index], &document->points[index + 1],
            (size_t)(document->count - index) * sizeof document->points[0]);
    memset(&document->points[document->count], 0, sizeof document->points[0]);
    document->edited = true;
}

void ang_document_move_point(ang_document *document, int index, double hu, double opacity) {
    ang_transfer_point *point = &document->points[index];
    double low = index > 0 ? point[-1].hu : -ANG_TRANSFER_HU_LIMIT;
    double high = index + 1 < document->count ? point[1].hu : ANG_TRANSFER_HU_LIMIT;
    point->hu = fmin(fmax(hu, low), high);
    opacity = fmin(fmax(opacity, 0), 1);
    point->opacity = document->by_extinction
                         ? fmin(-log1p(-opacity) / document->unit_distance, ANG_TRANSFER_EXTINCTION_LIMIT)
                         : opacity;
    document->edited = true;
}

double ang_document_opacity(const ang_document *document, int index) {
    double value = document->points[index].opacity;
    return document->by_extinction ? -expm1(-value * document->unit_distance) : value;
}

static bool same_numbers(const double *a, const double *b, int count) {
    for (int i = 0; i < count; i++)
        if (a[i] < b[i] || a[i] > b[i]) return false;
    return true;
}

static bool same_transfer(const ang_document *a, const ang_document *b) {
    if (a->count != b->count || a->by_extinction != b->by_extinction) return false;
    for (int i = 0; i < a->count; i++) {
        const ang_transfer_point *p = &a->points[i], *q = &b->points[i];
        if (!same_numbers((double[]){p->hu, p->opacity}, (double[]){q->hu, q->opacity}, 2) ||
            !same_numbers(p->colour, q->colour, 3))
            return false;
    }
    return same_numbers(&a->unit_distance, &b->unit_distance, 1);
}

static bool same_zoom(const ang_view *a, const ang_view *b) {
    return same_numbers(&a->zoom, &b->zoom, 1) && same_numbers(a->pan_mm, b->pan_mm, 2);
}

static bool same_direction(const ang_view *a, const ang_view *b) {
    return a->projection == b->projection &&
           same_numbers((double[]){a->azimuth_deg, a->elevation_deg, a->roll_deg, a->fov_deg},
                        (double[]){b->azimuth_deg, b->elevation_deg, b->roll_deg, b->fov_deg}, 4);
}

static bool same_style(const ang_document *a, const ang_document *b) {
    const ang_phong *p = &a->phong, *q = &b->phong;
    return a->mode == b->mode && a->shading == b->shading &&
           same_numbers((double[]){p->ambient, p->diffuse, p->specular, p->power, p->g0},
                        (double[]){q->ambient, q->diffuse, q->specular, q->power, q->g0}, 5);
}

static bool same_window(const ang_document *a, const ang_document *b) {
    return same_numbers(&a->window_centre, &b->window_centre, 1) && same_numbers(&a->window_width, &b->window_width, 1);
}

static bool same_vector(ang_vec3 a, ang_vec3 b) {
    return same_numbers((double[]){a.x, a.y, a.z}, (double[]){b.x, b.y, b.z}, 3);
}

static bool same_box(const ang_document *a, const ang_document *b) {
    return same_vector(a->crop_lower, b->crop_lower) && same_vector(a->crop_upper, b->crop_upper);
}

static bool same_plane(const ang_document *a, const ang_document *b) {
    return same_vector(a->clip.normal, b->clip.normal) && same_numbers(&a->clip.offset_mm, &b->clip.offset_mm, 1);
}

bool ang_document_same_rendering(const ang_document *a, const ang_document *b) {
    bool coloured = a->mode == ANG_MODE_DVR || a->mode == ANG_MODE_ISO;
    return same_style(a, b) && same_direction(&a->view, &b->view) && same_zoom(&a->view, &b->view) &&
           a->crop == b->crop && (!a->crop || same_box(a, b)) && same_plane(a, b) &&
           ang_measures_same_lengths(&a->measures, &b->measures) &&
           (coloured ? same_transfer(a, b) : same_window(a, b)) &&
           (a->mode != ANG_MODE_ISO || same_numbers(&a->iso_hu, &b->iso_hu, 1));
}

static bool same_slices(const ang_document *a, const ang_document *b) {
    for (int i = 0; i < ANG_ORIENTATIONS; i++) {
        const ang_slice_view *p = &a->slice_view[i], *q = &b->slice_view[i];
        if (!same_numbers(&p->zoom, &q->zoom, 1) || !same_numbers(p->pan_mm, q->pan_mm, 2)) return false;
    }
    return true;
}

static ang_history_step compare(const ang_document *a, const ang_document *b) {
    bool rest = same_transfer(a, b) && same_style(a, b) && same_window(a, b) && same_direction(&a->view, &b->view) &&
                strcmp(a->preset, b->preset) == 0 && a->edited == b->edited && a->slab == b->slab &&
                a->method == b->method && a->crop == b->crop && same_box(a, b) && same_plane(a, b) &&
                ang_turn_same(&a->turn, &b->turn) && ang_measures_same(&a->measures, &b->measures) &&
                same_numbers((double[]){a->iso_hu, a->slab_mm, a->shift_hu, a->stretch},
                             (double[]){b->iso_hu, b->slab_mm, b->shift_hu, b->stretch}, 4);
    if (!rest) return ANG_STEP_CHANGE;
    if (!same_zoom(&a->view, &b->view) || !same_slices(a, b)) return ANG_STEP_ZOOM;
    return same_vector(a->crosshair, b->crosshair) ? ANG_STEP_NONE : ANG_STEP_CROSSHAIR;
}

void ang_history_note(ang_history *history, const ang_document *document, double seconds) {
    if (history->count > 0) {
        ang_history_step found = compare(&history->states[history->now], document);
        if (found == ANG_STEP_NONE) return;
        bool again = found == ANG_STEP_CROSSHAIR ? history->last == found || ang_history_can_redo(history)
                                                 : found == history->last && found == ANG_STEP_ZOOM &&
                                                       seconds - history->seconds <= same_gesture_seconds;
        history->seconds = seconds;
        history->last = found;
        if (again) {
            history->states[history->now] = *document;
            return;
        }
    }
    if (history->count > 0) history->count = history->now + 1; /* a new future */
    if (history->count == most_states) {
        memmove(history->states, history->states + 1, (size_t)(most_states - 1) * sizeof *history->states);
        history->count--;
    }
    if (history->count == history->capacity) {
        int capacity = history->capacity ? 2 * history->capacity : 16;
        ang_document *grown = realloc(history->states, (size_t)capacity * sizeof *grown);
        if (!grown) return; /* that step cannot be undone */
        history->states = grown;
        history->capacity = capacity;
    }
    history->states[history->count] = *document;
    history->now = history->count++;
}

bool ang_history_can_undo(const ang_history *history) { return history->now > 0; }
bool ang_history_can_redo(const ang_history *history) { return history->now + 1 < history->count; }

bool ang_history_undo(ang_history *history, ang_document *document) {
    if (!ang_history_can_undo(history)) return false;
    *document = history->states[--history->now];
    history->last = ANG_STEP_NONE;
    return true;
}

bool ang_history_redo(ang_history *history, ang_document *document) {
    if (!ang_history_can_redo(history)) return false;
    *document = history->states[++history->now];
    history->last = ANG_STEP_NONE;
    return true;
}

void ang_history_clear(ang_history *history) {
    free(history->states);
    *history = (ang_history){0};
}
