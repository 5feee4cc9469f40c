#include "core/plan/classification.h"

#include "core/base/memory.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char *const names[] = {"auto", "midpoint", "prefix"};

const char *ang_classify_name(ang_classify classify) { return names[classify]; }

int ang_classify_from_name(const char *name) {
    for (int i = ANG_CLASSIFY_AUTO; i <= ANG_CLASSIFY_PREFIX; i++)
        if (strcmp(names[i], name) == 0) return i;
    return -1;
}

/* What a rise must have to count: of steps and of colours a tenth, of a peak's opacity a level of 255. */
static const double LEAST_STEP = 0.1, LEAST_PEAK = 1.0 / 255;
/* Of a peak, beside the greater of what it leads from and to: what is less is a ripple on a slope. */
static const double LEAST_SHARE = 0.25;
/* Voxels looked at, each with its neighbour along the three axes. */
static const size_t MOST_VOXELS = 100000;

enum { CHANNELS = 4 }; /* opacity, r, g, b */

static double channel_at(const ang_transfer *t, size_t i, int channel) {
    const ang_transfer_point *p = &t->points[i];
    if (channel > 0) return p->colour[channel - 1];
    return t->by_extinction ? -expm1(-p->opacity * t->unit_distance) : p->opacity;
}

static double width_of(const ang_stiff_place *p) { return p->high - p->low; }

/* Keeps the narrowest, and of the same place in several channels one. */
static void add_place(ang_stiffness *s, ang_stiff_kind kind, double low, double high) {
    ang_stiff_place place = {kind, low, high, 0};
    int widest = 0;
    for (int i = 0; i < s->count; i++) {
        if (s->place[i].kind == kind && s->place[i].low == low && s->place[i].high == high) return;
        if (width_of(&s->place[i]) > width_of(&s->place[widest])) widest = i;
    }
    if (s->count < ANG_STIFF_PLACES)
        s->place[s->count++] = place;
    else if (width_of(&place) < width_of(&s->place[widest]))
        s->place[widest] = place;
}

static void add_steps(ang_stiffness *s, const ang_transfer *t, int channel) {
    for (size_t i = 0; i + 1 < t->count; i++) {
        double rise = fabs(channel_at(t, i + 1, channel) - channel_at(t, i, channel));
        double low = t->points[i].hu, high = t->points[i + 1].hu;
        /* Of a step either side may show. */
        bool shows = ang_transfer_visible(t, low, high) || t->points[i].opacity > 0;
        if (rise >= LEAST_STEP && (channel == 0 || shows)) add_place(s, ANG_STIFF_STEP, low, high);
    }
}

/* From point i on in direction `step`, as long as the values times `sign` do not rise: the last one. */
static size_t foot(const ang_transfer *t, int channel, size_t i, int step, double sign) {
    while ((step > 0 ? i + 1 < t->count : i > 0) &&
           sign * channel_at(t, step > 0 ? i + 1 : i - 1, channel) <= sign * channel_at(t, i, channel))
        i = step > 0 ? i + 1 : i - 1;
    return i;
}

/* HU at which the channel passes `level` between point i and the foot, from the foot on. */
static double passes(const ang_transfer *t, int channel, size_t at_foot, int step, double level, double sign) {
    size_t i = at_foot;
    for (;; i = step > 0 ? i + 1 : i - 1) {
        size_t next = step > 0 ? i + 1 : i - 1;
        double a = channel_at(t, i, channel), b = channel_at(t, next, channel);
        if (sign * b < sign * level) continue;
        double share = b == a ? 1 : (level - a) / (b - a);
        return t->points[i].hu + fmin(fmax(share, 0), 1) * (t->points[next].hu - t->points[i].hu);
    }
}

static void add_peaks(ang_stiffness *s, const ang_transfer *t, int channel, double sign) {
    for (size_t i = 1; i + 1 < t->count; i++) {
        double top = sign * channel_at(t, i, channel);
        /* The first point of a flat top. */
        if (!(sign * channel_at(t, i - 1, channel) < top)) continue;
        size_t left = foot(t, channel, i, -1, sign), right = foot(t, channel, i, 1, sign);
        double base = fmax(sign * channel_at(t, left, channel), sign * channel_at(t, right, channel));
        double height = top - base, least = channel == 0 ? LEAST_PEAK : LEAST_STEP;
        if (height < fmax(least, LEAST_SHARE * fmax(fabs(top), fabs(base)))) continue;
        double level = sign * (base + 0.1 * (top - base));
        double low = passes(t, channel, left, 1, level, sign), high = passes(t, channel, right, -1, level, sign);
        if (channel == 0 || ang_transfer_visible(t, low, high)) add_place(s, ANG_STIFF_PEAK, low, high);
    }
}

static int by_hu(const void *left, const void *right) {
    const ang_stiff_place *a = left, *b = right;
    return a->low != b->low ? (a->low > b->low) - (a->low < b->low) : (a->high > b->high) - (a->high < b->high);
}

ang_stiffness ang_stiffness_of(const ang_transfer *transfer) {
    ang_stiffness s = {.count = 0};
    for (int channel = 0; channel < CHANNELS; channel++) {
        add_steps(&s, transfer, channel);
        add_peaks(&s, transfer, channel, 1);
        add_peaks(&s, transfer, channel, -1);
    }
    qsort(s.place, (size_t)s.count, sizeof *s.place, by_hu);
    return s;
}

/* Changes at the crossings of one place, in classes of a twelfth of an octave from 2^-20 to 2^44 HU per mm. */
enum { CLASSES = 64 * 12 };

static int class_of(double change) { return (int)fmin(fmax((log2(change) + 20) * 12, 0), CLASSES - 1); }

/* Adds a pair of neighbours to the places that it passes; most pairs lie beyond all of them. */
static void add_pair(const ang_stiffness *s, double lowest, double highest, unsigned (*classes)[CLASSES], double a,
                     double b, double mm) {
    double low = a < b ? a : b, high = a < b ? b : a;
    if (!(low < high) || high < lowest || low > highest) return;
    for (int i = 0; i < s->count; i++)
        if (high >= s->place[i].low && low <= s->place[i].high) classes[i][class_of((high - low) / mm)]++;
}

/* The voxels 0, stride, 2 stride, ...; their places are carried along, since to divide takes longer than the rest. */
bool ang_neighbours_take(ang_neighbours *neighbours, const ang_volume *volume, ang_error *err) {
    enum { AHEAD = 8 }; /* voxels, fetched while others are looked at */
    size_t count = ang_volume_count(volume), stride = count / MOST_VOXELS | 1;
    size_t dims[3] = {(size_t)volume->dims[0], (size_t)volume->dims[1], (size_t)volume->dims[2]}, at[3] = {0, 0, 0};
    const size_t step[3] = {1, dims[0], dims[0] * dims[1]};
    const size_t move[3] = {stride % dims[0], stride / dims[0] % dims[1], stride / dims[0] / dims[1]};
    *neighbours = (ang_neighbours){
        .stored = ang_alloc((count + stride - 1) / stride, sizeof *neighbours->stored, "neighbouring voxels", err)};
    if (!neighbours->stored) return false;
    for (size_t i = 0; i < count; i += stride) {
        if (i + AHEAD * stride + step[2] < count)
            for (int axis = 1; axis < 3; axis++)
                __builtin_prefetch(&volume->data[i + AHEAD * stride + (axis > 1 ? step[2] : 0)]);
        uint16_t *stored = neighbours->stored[neighbours->count++];
        stored[0] = volume->data[i];
        size_t carry = 0;
        for (int axis = 0; axis < 3; axis++) {
            stored[axis + 1] = volume->data[at[axis] + 1 < dims[axis] ? i + step[axis] : i];
            at[axis] += move[axis] + carry;
            carry = at[axis] >= dims[axis];
            at[axis] -= carry * dims[axis];
        }
    }
    return true;
}

void ang_neighbours_clear(ang_neighbours *neighbours) {
    free(neighbours->stored);
    *neighbours = (ang_neighbours){0};
}

static void add_voxels(const ang_stiffness *s, const ang_neighbours *neighbours, const ang_volume *volume,
                       const double mm[3], unsigned (*classes)[CLASSES]) {
    double lowest = INFINITY, highest = -INFINITY;
    for (int i = 0; i < s->count; i++) {
        lowest = fmin(lowest, s->place[i].low);
        highest = fmax(highest, s->place[i].high);
    }
    for (size_t i = 0; i < neighbours->count; i++) {
        const uint16_t *stored = neighbours->stored[i];
        double here = ang_volume_hu(volume, stored[0]);
        for (int axis = 0; axis < 3; axis++)
            add_pair(s, lowest, highest, classes, here, ang_volume_hu(volume, stored[axis + 1]), mm[axis]);
    }
}

static double median_of(const unsigned classes[CLASSES]) {
    unsigned long long total = 0, below = 0;
    for (int k = 0; k < CLASSES; k++) total += classes[k];
    if (total == 0) return 0;
    int k = 0;
    while (2 * (below + classes[k]) < total) below += classes[k++];
    return exp2((k + 0.5) / 12 - 20);
}

void ang_stiffness_measure_in(ang_stiffness *stiffness, const ang_neighbours *neighbours, const ang_volume *volume) {
    if (stiffness->count == 0) return;
    unsigned(*classes)[CLASSES] = calloc((size_t)stiffness->count, sizeof *classes);
    for (int i = 0; i < stiffness->count; i++) stiffness->place[i].change = 0;
    if (!classes) return; /* as if nothing passed: mid-point */
    double mm[3];
    for (int axis = 0; axis < 3; axis++)
        mm[axis] = sqrt(volume->affine.m[0][axis] * volume->affine.m[0][axis] +
                        volume->affine.m[1][axis] * volume->affine.m[1][axis] +
                        volume->affine.m[2][axis] * volume->affine.m[2][axis]);
    add_voxels(stiffness, neighbours, volume, mm, classes);
    for (int i = 0; i < stiffness->count; i++) stiffness->place[i].change = median_of(classes[i]);
    free(classes);
}

void ang_stiffness_measure(ang_stiffness *stiffness, const ang_volume *volume) {
    ang_neighbours neighbours = {0};
    if (stiffness->count > 0) ang_neighbours_take(&neighbours, volume, NULL);
    ang_stiffness_measure_in(stiffness, &neighbours, volume);
    ang_neighbours_clear(&neighbours);
}

/* How often a step's width goes into what the data change from sample to sample: above 1 they pass it unseen. */
static double severity(const ang_stiff_place *p, double step) {
    double change = p->change * step, width = width_of(p);
    if (p->kind == ANG_STIFF_STEP) change *= ANG_STIFF_STEP_SHARE;
    if (!(change > 0)) return 0;
    return width > 0 ? change / width : INFINITY;
}

ang_classification ang_classification_choose(ang_classify wanted, const ang_stiffness *stiffness, double step) {
    ang_classification c = {.prefix = wanted == ANG_CLASSIFY_PREFIX};
    const ang_stiff_place *worst = NULL, *peak = NULL;
    for (int i = 0; i < stiffness->count; i++) {
        const ang_stiff_place *p = &stiffness->place[i];
        if (severity(p, step) > 1 && (!worst || severity(p, step) > severity(worst, step))) worst = p;
        if (p->kind == ANG_STIFF_PEAK && severity(p, step) > 1 && (!peak || severity(p, step) > severity(peak, step)))
            peak = p;
    }
    if (wanted == ANG_CLASSIFY_AUTO) {
        c.prefix = worst != NULL;
        if (worst)
            snprintf(c.why, sizeof c.why,
                     "values change by %.3g HU in a step of %.3g mm where the transfer function %s",
                     worst->change * step, step,
                     worst->kind == ANG_STIFF_STEP ? "has a step" : "has a peak narrower than that");
        else
            snprintf(c.why, sizeof c.why, "%s",
                     stiffness->count ? "no step or peak of the transfer function is passed between two samples"
                                      : "the transfer function has neither steps nor peaks");
        return c;
    }
    snprintf(c.why, sizeof c.why, "--classification %s", c.prefix ? "prefix" : "midpoint");
    c.may_miss = !c.prefix && peak;
    if (c.may_miss)
        snprintf(c.warning, sizeof c.warning,
                 "the transfer function's peak from %.6g to %.6g HU may be missed: values change there by %.3g HU from "
                 "one sample to the next; --classification auto or prefix, or a smaller --step, shows it",
                 peak->low, peak->high, peak->change * step);
    return c;
}

void ang_classification_explain(const ang_classification *classification, bool plateaus, ang_plan *plan) {
    if (!classification->prefix) {
        ang_plan_use(plan, "mid-point classification");
        ang_plan_leave_out(plan, "prefix-integrated classification", "%s%s", classification->why,
                           classification->may_miss ? ", though a peak may be missed" : "");
        return;
    }
    ang_plan_use(plan, "prefix-integrated classification: %s", classification->why);
    if (!plateaus) ang_plan_leave_out(plan, "plateaus at opacity 1", "the transfer function has none");
}
