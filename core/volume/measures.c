#include "core/volume/measures.h"

#include "core/base/memory.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#define DEGREE  "\xc2\xb0"
#define SQUARED "\xc2\xb2"

static const char *const names[ANG_MEASURE_KINDS] = {"length", "angle", "ellipse", "rectangle"};

const char *ang_measure_kind_name(ang_measure_kind kind) { return kind < ANG_MEASURE_KINDS ? names[kind] : NULL; }

int ang_measure_kind_from_name(const char *name) {
    for (int i = 0; i < ANG_MEASURE_KINDS; i++)
        if (strcmp(name, names[i]) == 0) return i;
    return -1;
}

bool ang_measure_is_region(ang_measure_kind kind) {
    return kind == ANG_MEASURE_ELLIPSE || kind == ANG_MEASURE_RECTANGLE;
}

int ang_measure_points(ang_measure_kind kind) { return kind == ANG_MEASURE_ANGLE ? 3 : 2; }

int ang_measures_add(ang_measures *measures, const ang_measurement *measurement) {
    if (measures->count >= ANG_MEASURES) return -1;
    measures->item[measures->count] = *measurement;
    return measures->count++;
}

void ang_measures_delete(ang_measures *measures, int index) {
    if (index < 0 || index >= measures->count) return;
    measures->count--;
    memmove(&measures->item[index], &measures->item[index + 1],
            (size_t)(measures->count - index) * sizeof measures->item[0]);
    memset(&measures->item[measures->count], 0, sizeof measures->item[0]);
}

static bool same_place(ang_vec3 a, ang_vec3 b) { return ang_vec3_length(ang_vec3_sub(a, b)) <= 0; }

bool ang_measurement_same(const ang_measurement *a, const ang_measurement *b) {
    if (a->kind != b->kind || !same_place(a->right, b->right) || !same_place(a->down, b->down)) return false;
    for (int i = 0; i < ang_measure_points(a->kind); i++)
        if (!same_place(a->point[i], b->point[i])) return false;
    return true;
}

static bool same_label(const ang_measurement *a, const ang_measurement *b) {
    if (a->label_placed != b->label_placed) return false;
    double across = fabs(a->label_mm[0] - b->label_mm[0]), down = fabs(a->label_mm[1] - b->label_mm[1]);
    return !a->label_placed || across + down <= 0;
}

bool ang_measures_same(const ang_measures *a, const ang_measures *b) {
    if (a->count != b->count || a->hidden != b->hidden) return false;
    for (int i = 0; i < a->count; i++)
        if (!ang_measurement_same(&a->item[i], &b->item[i]) || !same_label(&a->item[i], &b->item[i])) return false;
    return true;
}

/* The next length that is shown, from index `at` on; NULL: none. */
static const ang_measurement *next_length(const ang_measures *measures, int *at) {
    while (!measures->hidden && *at < measures->count) {
        const ang_measurement *item = &measures->item[(*at)++];
        if (item->kind == ANG_MEASURE_LENGTH) return item;
    }
    return NULL;
}

bool ang_measures_same_lengths(const ang_measures *a, const ang_measures *b) {
    int i = 0, j = 0;
    for (;;) {
        const ang_measurement *p = next_length(a, &i), *q = next_length(b, &j);
        if (!p || !q) return p == q;
        if (!ang_measurement_same(p, q)) return false;
    }
}

/* A region's corner 0 to 3: bit 0 says whose side across it has, bit 1 whose side down. */
static ang_vec3 corner(const ang_measurement *region, int index) {
    ang_vec3 diagonal = ang_vec3_sub(region->point[1], region->point[0]), at = region->point[0];
    if (index & 1) at = ang_vec3_along(at, region->right, ang_vec3_dot(diagonal, region->right));
    if (index & 2) at = ang_vec3_along(at, region->down, ang_vec3_dot(diagonal, region->down));
    return at;
}

int ang_measurement_handles(const ang_measurement *measurement, ang_vec3 handle[ANG_MEASURE_HANDLES]) {
    bool region = ang_measure_is_region(measurement->kind);
    int count = region ? ANG_MEASURE_HANDLES : ang_measure_points(measurement->kind);
    for (int i = 0; i < count; i++) handle[i] = region ? corner(measurement, i) : measurement->point[i];
    return count;
}

static int ellipse(const ang_measurement *m, ang_vec3 at[ANG_MEASURE_OUTLINE]) {
    ang_vec3 middle = ang_measurement_middle(m), half = ang_vec3_scale(ang_vec3_sub(m->point[1], m->point[0]), 0.5);
    double a = ang_vec3_dot(half, m->right), b = ang_vec3_dot(half, m->down);
    for (int i = 0; i < ANG_MEASURE_OUTLINE; i++) {
        double turn = 2 * M_PI * i / (ANG_MEASURE_OUTLINE - 1);
        at[i] = ang_vec3_along(ang_vec3_along(middle, m->right, a * cos(turn)), m->down, b * sin(turn));
    }
    return ANG_MEASURE_OUTLINE;
}

int ang_measurement_outline(const ang_measurement *measurement, ang_vec3 at[ANG_MEASURE_OUTLINE]) {
    static const int around[] = {0, 1, 3, 2, 0};
    ang_vec3 handle[ANG_MEASURE_HANDLES];
    if (measurement->kind == ANG_MEASURE_ELLIPSE) return ellipse(measurement, at);
    int count = ang_measurement_handles(measurement, handle);
    bool closed = measurement->kind == ANG_MEASURE_RECTANGLE;
    for (int i = 0; i < count + closed; i++) at[i] = handle[closed ? around[i] : i];
    return count + closed;
}

/* The point moved along a unit direction as far as `to` is. */
static ang_vec3 follow(ang_vec3 point, ang_vec3 direction, ang_vec3 to) {
    return ang_vec3_along(point, direction, ang_vec3_dot(ang_vec3_sub(to, point), direction));
}

void ang_measurement_drag(ang_measurement *m, int handle, ang_vec3 to) {
    if (!ang_measure_is_region(m->kind)) {
        m->point[handle] = to;
        return;
    }
    ang_vec3 *across = &m->point[handle & 1], *down = &m->point[handle >> 1];
    *across = follow(*across, m->right, to);
    *down = follow(*down, m->down, to);
}

void ang_measurement_shift(ang_measurement *measurement, ang_vec3 by) {
    for (int i = 0; i < ang_measure_points(measurement->kind); i++)
        measurement->point[i] = ang_vec3_add(measurement->point[i], by);
}

ang_vec3 ang_measurement_middle(const ang_measurement *measurement) {
    if (measurement->kind == ANG_MEASURE_ANGLE) return measurement->point[1];
    return ang_vec3_scale(ang_vec3_add(measurement->point[0], measurement->point[1]), 0.5);
}

/* Half the sides of a region's rectangle, mm. */
static void half_sides(const ang_measurement *region, double half[2]) {
    ang_vec3 diagonal = ang_vec3_sub(region->point[1], region->point[0]);
    half[0] = fabs(ang_vec3_dot(diagonal, region->right)) / 2;
    half[1] = fabs(ang_vec3_dot(diagonal, region->down)) / 2;
}

double ang_measurement_value(const ang_measurement *m) {
    double half[2];
    if (m->kind == ANG_MEASURE_LENGTH) return ang_vec3_length(ang_vec3_sub(m->point[1], m->point[0]));
    if (m->kind == ANG_MEASURE_ANGLE) {
        ang_vec3 a = ang_vec3_sub(m->point[0], m->point[1]), b = ang_vec3_sub(m->point[2], m->point[1]);
        return atan2(ang_vec3_length(ang_vec3_cross(a, b)), ang_vec3_dot(a, b)) * 180 / M_PI;
    }
    half_sides(m, half);
    return (m->kind == ANG_MEASURE_ELLIPSE ? M_PI : 4) * half[0] * half[1];
}

const char *ang_measurement_unit(ang_measure_kind kind) {
    return kind == ANG_MEASURE_LENGTH ? "mm" : kind == ANG_MEASURE_ANGLE ? "degrees" : "mm2";
}

/* Places along a direction: at first + i * step mm (dot product with the direction). */
typedef struct lattice {
    double first, step;
    long from, to; /* i */
} lattice;

/* As dense as voxels, through their centres, within `half` of `middle` and within the volume. */
static lattice lattice_along(const ang_volume *volume, const ang_mat4 *to_index, ang_vec3 direction, double middle,
                             double half) {
    ang_vec3 lower, upper, per_mm = ang_mat4_direction(to_index, direction);
    double voxels = fmax(fabs(per_mm.x), fmax(fabs(per_mm.y), fabs(per_mm.z))), least = INFINITY, most = -INFINITY;
    ang_volume_box(volume, &lower, &upper);
    for (int i = 0; i < 8; i++) {
        ang_vec3 index = {i & 1 ? upper.x : lower.x, i & 2 ? upper.y : lower.y, i & 4 ? upper.z : lower.z};
        double at = ang_vec3_dot(ang_mat4_point(&volume->affine, index), direction);
        least = fmin(least, at);
        most = fmax(most, at);
    }
    lattice l = {.first = ang_vec3_dot(ang_mat4_point(&volume->affine, (ang_vec3){0, 0, 0}), direction),
                 .step = 1 / voxels};
    const double slack = 1e-9; /* of a step: an edge through centres takes them in */
    l.from = (long)ceil((fmax(middle - half, least) - l.first) / l.step - slack);
    l.to = (long)floor((fmin(middle + half, most) - l.first) / l.step + slack);
    return l;
}

/* Sums about the first value, so that a large mean costs no digits. */
typedef struct sums {
    double origin, sum, squares, least, most;
    size_t count;
} sums;

static void take(sums *s, const ang_volume *volume, ang_vec3 index) {
    const double slack = 1e-6; /* voxels */
    ang_vec3 lower, upper;
    ang_volume_box(volume, &lower, &upper);
    for (int axis = 0; axis < 3; axis++)
        if (ang_vec3_at(index, axis) < ang_vec3_at(lower, axis) - slack ||
            ang_vec3_at(index, axis) > ang_vec3_at(upper, axis) + slack)
            return;
    double hu = ang_volume_hu(volume, ang_volume_sample(volume, index));
    if (s->count++ == 0) s->origin = s->least = s->most = hu;
    s->sum += hu - s->origin;
    s->squares += (hu - s->origin) * (hu - s->origin);
    s->least = fmin(s->least, hu);
    s->most = fmax(s->most, hu);
}

ang_region_values ang_region_measure(const ang_volume *volume, const ang_measurement *region) {
    ang_region_values none = {NAN, NAN, NAN, NAN, 0};
    ang_mat4 to_index;
    double half[2];
    if (!ang_mat4_inverse(&volume->affine, &to_index)) return none;
    half_sides(region, half);
    ang_vec3 middle = ang_measurement_middle(region);
    double x0 = ang_vec3_dot(middle, region->right), y0 = ang_vec3_dot(middle, region->down);
    lattice across = lattice_along(volume, &to_index, region->right, x0, half[0]);
    lattice down = lattice_along(volume, &to_index, region->down, y0, half[1]);
    sums s = {0};
    for (long j = down.from; j <= down.to; j++) {
        double y = down.first + (double)j * down.step - y0;
        for (long i = across.from; i <= across.to; i++) {
            double x = across.first + (double)i * across.step - x0;
            double u = half[0] > 0 ? x / half[0] : 0, v = half[1] > 0 ? y / half[1] : 0;
            if (region->kind == ANG_MEASURE_ELLIPSE && u * u + v * v > 1 + 1e-9) continue;
            ang_vec3 mm = ang_vec3_along(ang_vec3_along(middle, region->right, x), region->down, y);
            take(&s, volume, ang_mat4_point(&to_index, mm));
        }
    }
    if (s.count == 0) take(&s, volume, ang_mat4_point(&to_index, middle));
    if (s.count == 0) return none;
    double n = (double)s.count, mean = s.sum / n;
    double spread = n > 1 ? sqrt(fmax(s.squares - n * mean * mean, 0) / (n - 1)) : 0;
    return (ang_region_values){s.origin + mean, spread, s.least, s.most, s.count};
}

int ang_measurement_lines(const ang_measurement *m, const ang_region_values *values, const char *unit,
                          char line[ANG_MEASURE_LINES][64]) {
    double value = ang_measurement_value(m);
    const char *gap = unit[0] ? " " : "";
    if (!ang_measure_is_region(m->kind)) {
        snprintf(line[0], sizeof line[0], "%.1f%s", value, m->kind == ANG_MEASURE_LENGTH ? " mm" : DEGREE);
        return 1;
    }
    snprintf(line[2], sizeof line[2], "area %.1f mm" SQUARED, value);
    if (values->count == 0) {
        snprintf(line[0], sizeof line[0], "outside");
        memcpy(line[1], line[2], sizeof line[1]);
        return 2;
    }
    snprintf(line[0], sizeof line[0], "mean %.0f%s%s, SD %.0f%s%s", values->mean, gap, unit, values->sd, gap, unit);
    snprintf(line[1], sizeof line[1], "min %.0f%s%s, max %.0f%s%s", values->least, gap, unit, values->most, gap, unit);
    return 3;
}

static int print_row(char *text, size_t size, int number, const ang_measurement *m, const ang_region_values *v) {
    bool region = ang_measure_is_region(m->kind);
    int used = snprintf(text, size, "%d\t%s\t%.1f\t%s\t", number, names[m->kind], ang_measurement_value(m),
                        ang_measurement_unit(m->kind));
    if (region && v->count > 0)
        used +=
            snprintf(text + used, size - (size_t)used, "%.0f\t%.0f\t%.0f\t%.0f\t", v->mean, v->sd, v->least, v->most);
    else
        used += snprintf(text + used, size - (size_t)used, "\t\t\t\t");
    ang_vec3 at = ang_measurement_middle(m);
    return used + snprintf(text + used, size - (size_t)used, "%.1f\t%.1f\t%.1f\n", at.x, at.y, at.z);
}

char *ang_measures_print(const ang_measures *measures, const ang_region_values *values, const char *unit,
                         ang_error *err) {
    enum { row = 400 };
    size_t size = (size_t)row * ((size_t)measures->count + 1);
    char *text = ang_alloc(size, 1, "a table of measures", err);
    if (!text) return NULL;
    const char *open = unit[0] ? " (" : "", *close = unit[0] ? ")" : "";
    const char *heads[] = {"mean", "SD", "min", "max"};
    int used = snprintf(text, size, "number\tkind\tvalue\tunit\t");
    for (int i = 0; i < 4; i++)
        used += snprintf(text + used, size - (size_t)used, "%s%s%s%s\t", heads[i], open, unit, close);
    used += snprintf(text + used, size - (size_t)used, "L (mm)\tP (mm)\tH (mm)\n");
    for (int i = 0; i < measures->count; i++)
        used += print_row(text + used, size - (size_t)used, i + 1, &measures->item[i], &values[i]);
    return text;
}
