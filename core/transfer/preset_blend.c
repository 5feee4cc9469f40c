#include "core/transfer/preset_blend.h"

#include "core/base/memory.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static double between(double a, double b, double t) { return (1 - t) * a + t * b; }

static double ratio_between(double a, double b, double t) { return exp(between(log(a), log(b), t)); }

static ang_preset *copy_of(const ang_preset *preset, ang_error *err) {
    ang_preset *copy = ang_alloc(1, sizeof *copy, "preset", err);
    if (!copy) return NULL;
    *copy = *preset;
    copy->name = strdup(preset->name);
    copy->modality = strdup(preset->modality);
    copy->description = strdup(preset->description);
    const ang_transfer *t = preset->transfer;
    copy->transfer = ang_transfer_create(t->points, t->count, t->unit_distance, t->by_extinction, NULL, err);
    if (copy->transfer && copy->name && copy->modality && copy->description) return copy;
    if (copy->transfer) ang_fail(err, ANG_LIMIT, "no memory for a preset");
    ang_preset_free(copy);
    return NULL;
}

/* Colour and opacity just below `hu` or from it on; `i` is the first point beyond. */
static ang_transfer_point value_at(const ang_transfer *t, double hu, bool below, bool extinctions) {
    size_t i = 0;
    while (i < t->count && (t->points[i].hu < hu || (!below && t->points[i].hu <= hu))) i++;
    const ang_transfer_point *from = &t->points[i > 0 ? i - 1 : 0], *to = &t->points[i < t->count ? i : i - 1];
    double width = to->hu - from->hu, s = width > 0 ? (hu - from->hu) / width : 0;
    ang_transfer_point at = {.hu = hu, .opacity = between(from->opacity, to->opacity, s)};
    for (int c = 0; c < 3; c++) at.colour[c] = between(from->colour[c], to->colour[c], s);
    if (t->by_extinction && !extinctions) at.opacity = -expm1(-at.opacity * t->unit_distance);
    return at;
}

/* What both have at one place. */
typedef struct pair {
    ang_transfer_point a, b;
} pair;

static bool shows(const pair *p) { return p->a.opacity > 0 || p->b.opacity > 0; }

/* The second's part in what shows; where nothing does, a colour still is what a neighbour's goes over to. */
static double share_at(const pair *pairs, size_t count, size_t i, double t) {
    const pair *p = &pairs[i];
    if (!shows(p) && i + 1 < count && shows(p + 1))
        p++;
    else if (!shows(p) && i > 0 && shows(p - 1))
        p--;
    double from = (1 - t) * p->a.opacity, to = t * p->b.opacity;
    return from + to > 0 ? to / (from + to) : t;
}

/* At each place of both one, or two where one of both has a step; there is room for that. */
static size_t gather(const ang_transfer *a, const ang_transfer *b, bool extinctions, pair *pairs) {
    size_t i = 0, j = 0, count = 0;
    while (i < a->count || j < b->count) {
        double hu = i < a->count ? a->points[i].hu : INFINITY;
        if (j < b->count && b->points[j].hu < hu) hu = b->points[j].hu;
        for (int side = 1; side >= 0; side--)
            pairs[count++] = (pair){value_at(a, hu, side, extinctions), value_at(b, hu, side, extinctions)};
        const pair *below = &pairs[count - 2], *from_on = below + 1;
        if (memcmp(&below->a, &from_on->a, sizeof below->a) == 0 &&
            memcmp(&below->b, &from_on->b, sizeof below->b) == 0)
            count--;
        while (i < a->count && a->points[i].hu <= hu) i++;
        while (j < b->count && b->points[j].hu <= hu) j++;
    }
    return count;
}

static ang_transfer *mix_transfers(const ang_transfer *a, const ang_transfer *b, double t, ang_error *err) {
    bool extinctions = a->by_extinction && b->by_extinction;
    double unit = ratio_between(a->unit_distance, b->unit_distance, t);
    size_t room = 2 * (a->count + b->count);
    pair *pairs = ang_alloc(room, sizeof *pairs, "preset", err);
    ang_transfer_point *points = pairs ? ang_alloc(room, sizeof *points, "preset", err) : NULL;
    ang_transfer *mixed = NULL;
    if (points) {
        size_t count = gather(a, b, extinctions, pairs);
        for (size_t i = 0; i < count; i++) {
            const pair *p = &pairs[i];
            double share = share_at(pairs, count, i, t), opacity = between(p->a.opacity, p->b.opacity, t);
            points[i] = (ang_transfer_point){.hu = p->a.hu, .opacity = extinctions ? opacity : fmin(1, opacity)};
            for (int c = 0; c < 3; c++) points[i].colour[c] = fmin(1, between(p->a.colour[c], p->b.colour[c], share));
        }
        mixed = ang_transfer_create(points, count, unit, extinctions, NULL, err);
    }
    free(points);
    free(pairs);
    return mixed;
}

/* What a preset without shading looks like, said in Phong's numbers. */
static ang_phong phong_of(const ang_preset *preset) {
    ang_phong flat = preset->phong;
    flat.ambient = 1;
    flat.diffuse = flat.specular = 0;
    return preset->shading == ANG_SHADING_PHONG ? preset->phong : flat;
}

ang_preset *ang_preset_blend(const ang_preset *a, const ang_preset *b, double t, ang_error *err) {
    if (a->mode != b->mode) {
        ang_fail(err, ANG_USAGE, "preset %s is of mode %s and %s of mode %s: there is nothing between them", a->name,
                 ang_mode_name(a->mode), b->name, ang_mode_name(b->mode));
        return NULL;
    }
    ang_preset *mixed = copy_of(t < 0.5 ? a : b, err);
    if (!mixed || t <= 0 || t >= 1) return mixed;
    ang_phong p = phong_of(a), q = phong_of(b);
    mixed->shading = a->shading == ANG_SHADING_NONE ? b->shading : a->shading;
    mixed->phong = (ang_phong){.ambient = between(p.ambient, q.ambient, t),
                               .diffuse = between(p.diffuse, q.diffuse, t),
                               .specular = between(p.specular, q.specular, t),
                               .power = between(p.power, q.power, t),
                               .g0 = ratio_between(p.g0, q.g0, t)};
    mixed->iso_hu = between(a->iso_hu, b->iso_hu, t);
    mixed->window_centre = between(a->window_centre, b->window_centre, t);
    mixed->window_width = between(a->window_width, b->window_width, t);
    ang_transfer_free(mixed->transfer);
    mixed->transfer = mix_transfers(a->transfer, b->transfer, t, err);
    free(mixed->name);
    if (asprintf(&mixed->name, "%s to %s %.0f %%", a->name, b->name, 100 * t) < 0) mixed->name = NULL;
    if (mixed->transfer && !mixed->name) ang_fail(err, ANG_LIMIT, "no memory for a preset");
    if (mixed->transfer && mixed->name) return mixed;
    ang_preset_free(mixed);
    return NULL;
}
