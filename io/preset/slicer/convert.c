/* Between volume properties and presets. */
#include "io/preset/slicer/forms.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* How far a chain of lines may be from a curve, in opacity or colour, and how often a piece is halved at most. */
static const double tolerance = 1e-3;
enum { MOST_HALVINGS = 16 };

/* Values along x: red, green, blue, opacity; `below`: those just below x. */
typedef void curve_function(const void *context, double x, bool below, double y[4]);

typedef struct knot {
    double x, y[4];
} knot;

/* A curve that is being followed by lines. */
typedef struct chain {
    curve_function *curve;
    const void *context;
    knot *knots;
    size_t count, added; /* `added`: beyond those of the file */
    ang_error *err;
} chain;

static bool append(chain *c, const knot *k) {
    if ((c->count & (c->count - 1)) == 0) {
        knot *grown = realloc(c->knots, (c->count ? 2 * c->count : 1) * sizeof *grown);
        if (!grown) return ang_fail(c->err, ANG_LIMIT, "no memory for a preset");
        c->knots = grown;
    }
    c->knots[c->count++] = *k;
    return true;
}

static double farthest(const knot *from, const knot *to, const knot *at) {
    double s = (at->x - from->x) / (to->x - from->x), most = 0;
    for (int i = 0; i < 4; i++) most = fmax(most, fabs(at->y[i] - ((1 - s) * from->y[i] + s * to->y[i])));
    return most;
}

/* Puts knots between these two where a line is too far off, looking at the quarters. */
static bool follow(chain *c, const knot *from, const knot *to, int halvings) {
    knot at[3];
    double off = 0;
    for (int i = 0; i < 3; i++) {
        at[i].x = from->x + (to->x - from->x) * (i + 1) / 4;
        c->curve(c->context, at[i].x, false, at[i].y);
        off = fmax(off, farthest(from, to, &at[i]));
    }
    if (off <= tolerance / 3 || halvings >= MOST_HALVINGS || !(at[1].x > from->x && at[1].x < to->x)) return true;
    c->added++;
    return follow(c, from, &at[1], halvings + 1) && append(c, &at[1]) && follow(c, &at[1], to, halvings + 1);
}

static bool same(const knot *a, const knot *b) { return memcmp(a->y, b->y, sizeof a->y) == 0; }

/* The knot, or two where the curve has a step, with what the piece before it needs. */
static bool go_to(chain *c, double x, bool curved) {
    knot below = {.x = x}, from_on = {.x = x};
    c->curve(c->context, x, true, below.y);
    c->curve(c->context, x, false, from_on.y);
    if (c->count > 0 && curved) {
        knot last = c->knots[c->count - 1];
        if (!follow(c, &last, &below, 0)) return false;
    }
    return (same(&below, &from_on) || append(c, &below)) && append(c, &from_on);
}

/* From properties to presets. */

static void property_curve(const void *context, double x, bool below, double y[4]) {
    const ang_property *p = context;
    double opacity[3];
    ang_property_value(&p->colour, x, below, y);
    ang_property_value(&p->opacity, x, below, opacity);
    y[3] = opacity[0];
}

static bool any_curved(const ang_property_function *f) {
    for (size_t i = 0; i + 1 < f->count; i++)
        if (fabs(f->points[i].midpoint - 0.5) > 1e-9 || f->points[i].sharpness >= 0.01) return true;
    return false;
}

static bool join(const ang_property *p, chain *c) {
    const ang_property_function *a = &p->opacity, *b = &p->colour;
    bool curved = any_curved(a) || any_curved(b);
    size_t i = 0, j = 0;
    while (i < a->count || j < b->count) {
        double x = i < a->count ? a->points[i].x : INFINITY;
        if (j < b->count && b->points[j].x < x) x = b->points[j].x;
        if (!go_to(c, x, curved)) return false;
        while (i < a->count && a->points[i].x <= x) i++;
        while (j < b->count && b->points[j].x <= x) j++;
    }
    return true;
}

static double limited(double value, double high, const char *what, const char *name, ang_notes *notes) {
    double kept = fmin(fmax(value, 0), high);
    if (kept < value || kept > value) ang_notes_add(notes, "%s: %s is %g and becomes %g", name, what, value, kept);
    return kept;
}

static void limit_knots(chain *c, const char *name, ang_notes *notes) {
    static const char *const what[4] = {"a red", "a green", "a blue", "an opacity"};
    for (size_t i = 0; i < c->count; i++)
        for (int k = 0; k < 4; k++) c->knots[i].y[k] = limited(c->knots[i].y[k], 1, what[k], name, notes);
}

static void note_losses(const ang_property *p, size_t added, ang_notes *notes) {
    double least = INFINITY, most = -INFINITY;
    for (size_t i = 0; i < p->gradient.count; i++) {
        least = fmin(least, p->gradient.points[i].y[0]);
        most = fmax(most, p->gradient.points[i].y[0]);
    }
    if (p->gradient.count > 0 && least < 1 && !p->gradient_off)
        ang_notes_add(notes,
                      "%s: its gradient opacity, from %g to %g, is left out: where values change slowly the picture is "
                      "more opaque than in 3D Slicer",
                      p->name, least, most);
    if (p->nearest)
        ang_notes_add(notes, "%s: asks for values that are not interpolated; they are interpolated linearly", p->name);
    if (p->components > 1) ang_notes_add(notes, "%s: has %zu components; the first is taken", p->name, p->components);
    if (p->iso_count > 1) ang_notes_add(notes, "%s: has %zu iso values; the first is taken", p->name, p->iso_count);
    if (added > 0)
        ang_notes_add(notes,
                      "%s: is curved between its points (midpoint, sharpness): %zu more points follow it within "
                      "1/1000",
                      p->name, added);
    if (!p->unit_given)
        ang_notes_add(notes, "opacities are taken per 1 mm, VTK's default: the file tells no unit distance");
}

/* From where opacity begins to where it is greatest first, for modes of values. */
static void set_window(const chain *c, ang_preset *preset) {
    double low = NAN, high = NAN, most = 0;
    for (size_t i = 0; i < c->count; i++) {
        if (c->knots[i].y[3] > 0 && isnan(low)) low = c->knots[i > 0 ? i - 1 : 0].x;
        if (c->knots[i].y[3] > most) {
            most = c->knots[i].y[3];
            high = c->knots[i].x;
        }
    }
    preset->window_centre = high - low > 1e-6 ? low + (high - low) / 2 : 40;
    preset->window_width = high - low > 1e-6 ? high - low : 400;
}

static ang_transfer *transfer_of(const chain *c, const ang_property *p, ang_notes *notes, ang_error *err) {
    ang_transfer_point *points = malloc(c->count * sizeof *points);
    if (!points) {
        ang_fail(err, ANG_LIMIT, "no memory for a preset");
        return NULL;
    }
    for (size_t i = 0; i < c->count; i++) {
        const knot *k = &c->knots[i];
        points[i] = (ang_transfer_point){.hu = k->x, .colour = {k->y[0], k->y[1], k->y[2]}, .opacity = k->y[3]};
    }
    ang_error own = {0};
    ang_transfer *made = ang_transfer_create(points, c->count, p->unit_distance, false, notes, &own);
    free(points);
    if (!made) ang_fail(err, own.code, "%s: %s", p->name, own.message);
    return made;
}

static bool fill_preset(const ang_property *p, const chain *c, ang_preset *preset, ang_notes *notes, ang_error *err) {
    preset->name = strdup(p->name);
    preset->modality = strdup(strncmp(p->name, "MR", 2) == 0 ? "MR" : "CT");
    preset->description = strdup("From a volume property of 3D Slicer.");
    preset->version = 1;
    preset->mode = ANG_MODE_DVR;
    preset->shading = p->shade ? ANG_SHADING_PHONG : ANG_SHADING_NONE;
    preset->phong = ang_phong_default;
    preset->phong.ambient = limited(p->ambient, 1, "ambient", p->name, notes);
    preset->phong.diffuse = limited(p->diffuse, 1, "diffuse", p->name, notes);
    preset->phong.specular = limited(p->specular, 1, "specular", p->name, notes);
    preset->phong.power = limited(p->power, 1000, "specular power", p->name, notes);
    preset->iso_hu = p->iso;
    set_window(c, preset);
    if (!preset->name || !preset->modality || !preset->description)
        return ang_fail(err, ANG_LIMIT, "no memory for a preset");
    preset->transfer = transfer_of(c, p, notes, err);
    return preset->transfer != NULL;
}

ang_preset *ang_property_to_preset(const ang_property *p, ang_notes *notes, ang_error *err) {
    if (p->opacity.count == 0 || p->colour.count == 0) {
        ang_fail(err, ANG_USAGE, "%s: has no points of %s", p->name, p->opacity.count == 0 ? "opacity" : "colour");
        return NULL;
    }
    if (!(p->unit_distance >= 1e-6)) {
        ang_fail(err, ANG_USAGE, "%s: its unit distance is %g; it must be 1e-6 mm or more", p->name, p->unit_distance);
        return NULL;
    }
    chain c = {.curve = property_curve, .context = p, .err = err};
    ang_preset *preset = calloc(1, sizeof *preset);
    bool made = preset ? join(p, &c) : ang_fail(err, ANG_LIMIT, "no memory for a preset");
    if (made) {
        limit_knots(&c, p->name, notes);
        note_losses(p, c.added, notes);
        made = fill_preset(p, &c, preset, notes, err);
    }
    free(c.knots);
    if (made) return preset;
    ang_preset_free(preset);
    return NULL;
}

/* From presets to properties. */

/* A preset's opacities per `unit_distance`. */
typedef struct preset_curve {
    const ang_transfer *transfer;
    double unit_distance; /* mm */
    size_t piece;         /* that begins at this point */
} preset_curve;

static double opacity_per(const preset_curve *curve, double given) {
    const ang_transfer *t = curve->transfer;
    if (t->by_extinction) return -expm1(-given * curve->unit_distance);
    if (!(curve->unit_distance < t->unit_distance || curve->unit_distance > t->unit_distance)) return given;
    return given >= 1 ? 1 : -expm1(log1p(-given) * curve->unit_distance / t->unit_distance);
}

/* Within the piece; colours have no part in it. */
static void opacity_curve(const void *context, double x, bool below, double y[4]) {
    const preset_curve *curve = context;
    const ang_transfer_point *from = &curve->transfer->points[curve->piece], *to = from + 1;
    double s = (x - from->hu) / (to->hu - from->hu);
    (void)below;
    y[0] = y[1] = y[2] = 0;
    y[3] = opacity_per(curve, (1 - s) * from->opacity + s * to->opacity);
}

static bool add_points(const ang_transfer *t, chain *c, preset_curve *curve, bool curved, ang_property *p,
                       ang_error *err) {
    for (size_t i = 0; i < t->count; i++) {
        const ang_transfer_point *from = &t->points[i];
        /* The least that sets two points apart, as Slicer does it: it takes one point at a place. */
        bool step = i > 0 && from->hu <= from[-1].hu;
        double x = !step ? from->hu : fabs(from->hu) > 0 ? nextafter(from->hu, INFINITY) : DBL_MIN;
        ang_property_point opacity = {.x = x, .y = {opacity_per(curve, from->opacity)}, .midpoint = 0.5};
        ang_property_point colour = {.x = x, .midpoint = 0.5};
        memcpy(colour.y, from->colour, sizeof colour.y);
        if (!ang_property_function_add(&p->opacity, &opacity, err) ||
            !ang_property_function_add(&p->colour, &colour, err))
            return false;
        if (!curved || i + 1 == t->count || from[1].hu <= from->hu) continue;
        knot begin = {.x = from->hu, .y = {0, 0, 0, opacity.y[0]}}, end = {.x = from[1].hu};
        end.y[3] = opacity_per(curve, from[1].opacity);
        curve->piece = i;
        c->count = 0;
        if (!follow(c, &begin, &end, 0)) return false;
        for (size_t k = 0; k < c->count; k++) {
            ang_property_point between = {.x = c->knots[k].x, .y = {c->knots[k].y[3]}, .midpoint = 0.5};
            if (!ang_property_function_add(&p->opacity, &between, err)) return false;
        }
    }
    return true;
}

static void note_left_out(const ang_preset *preset, bool keeps_unit, size_t added, ang_notes *notes) {
    const char *name = preset->name;
    if (preset->mode != ANG_MODE_DVR)
        ang_notes_add(notes, "%s: mode %s is left out: choose it in 3D Slicer's display settings", name,
                      ang_mode_name(preset->mode));
    if (preset->shading == ANG_SHADING_PHONG)
        ang_notes_add(notes, "%s: g0 = %g HU/mm is left out: 3D Slicer shades flat regions too", name,
                      preset->phong.g0);
    if (isfinite(preset->iso_hu) && !keeps_unit)
        ang_notes_add(notes, "%s: the iso value %g HU is left out; .vp.json has room for it", name, preset->iso_hu);
    if (added > 0)
        ang_notes_add(notes, "%s: opacities become those of 1 mm; %zu more points follow the curve within 1/1000", name,
                      added);
    ang_notes_add(notes, "%s: modality, description and window are left out", name);
}

bool ang_property_from_preset(const ang_preset *preset, bool keeps_unit, ang_property *p, ang_notes *notes,
                              ang_error *err) {
    const ang_transfer *t = preset->transfer;
    preset_curve curve = {.transfer = t, .unit_distance = keeps_unit ? t->unit_distance : 1};
    bool curved = t->by_extinction || curve.unit_distance < t->unit_distance || curve.unit_distance > t->unit_distance;
    chain c = {.curve = opacity_curve, .context = &curve, .err = err};
    *p = ang_property_default;
    p->name = strdup(preset->name);
    p->shade = preset->shading == ANG_SHADING_PHONG;
    p->ambient = preset->phong.ambient;
    p->diffuse = preset->phong.diffuse;
    p->specular = preset->phong.specular;
    p->power = preset->phong.power;
    p->unit_distance = curve.unit_distance;
    p->unit_given = keeps_unit;
    p->iso = preset->iso_hu;
    p->iso_count = isfinite(preset->iso_hu) ? 1 : 0;
    bool made =
        p->name ? add_points(t, &c, &curve, curved, p, err) : ang_fail(err, ANG_LIMIT, "no memory for a preset");
    for (int i = 0; i < 2 && made; i++) {
        ang_property_point flat = {.x = 255 * i, .y = {1}, .midpoint = 0.5};
        made = ang_property_function_add(&p->gradient, &flat, err);
    }
    free(c.knots);
    if (made)
        note_left_out(preset, keeps_unit, c.added, notes);
    else
        ang_property_clear(p);
    return made;
}
