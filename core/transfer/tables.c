#include "core/transfer/tables.h"

#include "core/base/memory.h"

#include <math.h>
#include <stdlib.h>

enum { DEFAULT_LIMIT = 32768, STORED_VALUES = 65536 };

/* How far the interpolant may err over a ray: share of opacity (2e-5 is 0.005 levels), and the length in mm over which
 * an almost transparent value range is thought to be looked through. */
static const double ACCEPTED_OPACITY_ERROR = 2e-5;
static const double LONGEST_LOOK_THROUGH = 10;

/* The entries of one interval while it is made, in double. */
typedef struct entry {
    double colour[3];
    double extinction;
} entry;

typedef struct builder {
    const ang_transfer *transfer;
    double slope, intercept;
    double *knots; /* the points' positions in stored values, rising; `count` of them */
    size_t count;  /* of points */
    double first;  /* as in the tables */
    double width;  /* stored values in an interval */
    int intervals; /* as in the tables */
    bool *opaque;  /* per interval: part of a plateau */
    bool *peaked;  /* per interval: a point at opacity 1 lies inside */
    bool *crowded; /* per interval: several points share it, so that only the integral can be kept */
} builder;

static double hu_at(const builder *b, double stored) { return b->slope * stored + b->intercept; }

static bool same_point(const ang_transfer_point *a, const ang_transfer_point *b) {
    return a->opacity == b->opacity && a->colour[0] == b->colour[0] && a->colour[1] == b->colour[1] &&
           a->colour[2] == b->colour[2];
}

/* Whether the function jumps between point i and its successor. */
static bool is_step(const builder *b, size_t i) {
    return i + 1 < b->count && b->transfer->points[i].hu == b->transfer->points[i + 1].hu;
}

static bool is_opaque_value(const builder *b, size_t i) {
    return !b->transfer->by_extinction && b->transfer->points[i].opacity == 1;
}

/* Whether points i-1 and i are the ends of a plateau at opacity 1; i = 0 and i = count stand for the end values. */
static bool is_plateau(const builder *b, size_t i) {
    if (i == 0) return is_opaque_value(b, 0);
    if (i == b->count) return is_opaque_value(b, b->count - 1);
    return is_opaque_value(b, i - 1) && is_opaque_value(b, i) && b->knots[i] > b->knots[i - 1];
}

/* The limit of colour and extinction at `stored` from one side. */
static entry limit_at(const builder *b, double stored, bool from_right) {
    const ang_transfer *t = b->transfer;
    size_t low = 0, high = b->count;
    while (low < high) {
        size_t middle = low + (high - low) / 2;
        bool before = from_right ? b->knots[middle] <= stored : b->knots[middle] < stored;
        if (before)
            low = middle + 1;
        else
            high = middle;
    }
    const ang_transfer_point *l = &t->points[low > 0 ? low - 1 : 0];
    const ang_transfer_point *r = &t->points[low < b->count ? low : b->count - 1];
    double share = 0;
    if (low > 0 && low < b->count) share = (stored - b->knots[low - 1]) / (b->knots[low] - b->knots[low - 1]);
    share = fmin(fmax(share, 0), 1);
    entry e;
    for (int c = 0; c < 3; c++)
        e.colour[c] = l->colour[c] == r->colour[c] ? l->colour[c] : (1 - share) * l->colour[c] + share * r->colour[c];
    double value = l->opacity == r->opacity ? l->opacity : (1 - share) * l->opacity + share * r->opacity;
    e.extinction = t->by_extinction ? value : -log1p(-fmin(value, 1)) / t->unit_distance;
    return e;
}

/* Sets `first` and `end` to the stored values between which the function changes, one wider on a side where the value
 * at the very end belongs to the far side (a step or a plateau there). */
static void find_range(const builder *b, uint16_t minimum, uint16_t maximum, double *first, double *end,
                       bool *wider_left, bool *wider_right) {
    const ang_transfer_point *points = b->transfer->points;
    size_t i = 0, j = b->count - 1;
    while (i + 1 < b->count && same_point(&points[i], &points[i + 1])) i++;
    while (j > 0 && same_point(&points[j], &points[j - 1])) j--;
    *first = minimum;
    *end = minimum;
    *wider_left = *wider_right = false;
    if (i + 1 >= b->count || b->knots[i] > maximum || b->knots[j] < minimum) return;
    if (b->knots[i] >= minimum) {
        *first = floor(b->knots[i]);
        *wider_left = is_plateau(b, 0) || (is_step(b, i) && b->knots[i] > minimum);
    }
    *end = maximum;
    if (b->knots[j] <= maximum) {
        *end = ceil(b->knots[j]);
        *wider_right = is_plateau(b, b->count) || (j > 0 && is_step(b, j - 1));
    }
}

/* Lays intervals of `width` over [first, end]; at least one. Returns false where there are more than `limit`. */
static bool lay_intervals(builder *b, double first, double end, bool wider_left, bool wider_right, double width,
                          int limit) {
    double margin = fmax(width, 1);
    if (wider_left) first -= margin;
    if (wider_right) end += margin;
    double intervals = fmax(1, ceil((end - first) / width));
    if (intervals > limit) return false;
    b->first = first;
    b->width = width;
    b->intervals = (int)intervals;
    return true;
}

static bool on_grid(const builder *b, double stored) {
    double place = (stored - b->first) / b->width;
    return fabs(place - round(place)) < 1e-6;
}

/* Whether finer intervals would show: points off the grid, or extinction bending within an interval. */
static bool is_fine_enough(const builder *b) {
    double end = b->first + b->intervals * b->width;
    for (size_t i = 0; i < b->count; i++) {
        if (b->knots[i] > b->first && b->knots[i] < end && !on_grid(b, b->knots[i])) return false;
        if (i + 1 == b->count || b->transfer->by_extinction || b->knots[i + 1] <= b->first || b->knots[i] >= end ||
            !(b->knots[i + 1] > b->knots[i]))
            continue;
        double a0 = b->transfer->points[i].opacity, a1 = b->transfer->points[i + 1].opacity;
        double rise = fabs(a1 - a0) * b->width / (b->knots[i + 1] - b->knots[i]);
        /* The second derivative of -ln(1-a) is greatest at the upper end; beyond 0.98 a millimetre is opaque anyway. */
        for (int k = 0; k < 2; k++) {
            double a = fmin(k ? fmax(a0, a1) : fmin(a0, a1) + rise / 2, 0.98);
            double unit = b->transfer->unit_distance;
            double deviation = rise * rise / (8 * (1 - a) * (1 - a) * unit), kappa = -log1p(-a) / unit;
            if (deviation * fmin(1 / (M_E * kappa), LONGEST_LOOK_THROUGH) > ACCEPTED_OPACITY_ERROR) return false;
        }
    }
    return true;
}

static void choose_intervals(builder *b, uint16_t minimum, uint16_t maximum, int limit) {
    double first, end;
    bool wider_left, wider_right;
    find_range(b, minimum, maximum, &first, &end, &wider_left, &wider_right);
    double width = 1;
    while (!lay_intervals(b, first, end, wider_left, wider_right, width, limit) && width < STORED_VALUES) width *= 2;
    if (b->intervals == 0) {
        /* A limit of one or two intervals leaves no room for the far sides. */
        lay_intervals(b, first, end, false, false, width, limit > 0 ? limit : 1);
    }
    while (!is_fine_enough(b) && b->width > 1.0 / ANG_TABLE_MOST_PER_VALUE &&
           lay_intervals(b, first, end, wider_left, wider_right, b->width / 2, limit)) {
    }
}

/* The index of the interval end to which a step or the end of a plateau moves: the nearer one, but never a stored value
 * from its right, because voxels of that value would then change sides. May lie outside 0..intervals. */
static double moved_end(const builder *b, double stored) {
    double place = fmin(fmax((stored - b->first) / b->width, -1), b->intervals + 1.0);
    double left = floor(place);
    double left_stored = b->first + left * b->width;
    if (place > left && b->width <= 1 && left_stored == floor(left_stored)) return left + 1;
    return round(place);
}

static void mark(bool *flags, int intervals, double from, double to) {
    int begin = (int)fmin(fmax(from, 0), intervals), end = (int)fmin(fmax(to, 0), intervals);
    for (int i = begin; i < end; i++) flags[i] = true;
}

static void mark_plateaus(builder *b) {
    for (size_t i = 0; i <= b->count; i++) {
        if (!is_plateau(b, i)) continue;
        double left = i > 0 ? b->knots[i - 1] : -INFINITY, right = i < b->count ? b->knots[i] : INFINITY;
        double from = moved_end(b, left), to = moved_end(b, right);
        if (from >= to) {
            from = floor((0.5 * (left + right) - b->first) / b->width);
            to = from + 1;
        }
        mark(b->opaque, b->intervals, from, to);
    }
}

/* Marks intervals with a point at opacity 1 inside, and those in which points at different places meet: two inside one
 * interval, or two steps that would move to the same interval end. */
static void mark_crowds(builder *b) {
    for (size_t i = 0; i < b->count; i++) {
        double place = (b->knots[i] - b->first) / b->width;
        if (is_opaque_value(b, i) && !on_grid(b, b->knots[i])) mark(b->peaked, b->intervals, floor(place), ceil(place));
        if (i + 1 == b->count) break;
        double left = (b->knots[i] - b->first) / b->width, right = (b->knots[i + 1] - b->first) / b->width;
        if (!(right > left) || right < 0 || left > b->intervals) continue;
        bool left_inside = !on_grid(b, b->knots[i]), right_inside = !on_grid(b, b->knots[i + 1]);
        bool shared = left_inside && right_inside && floor(left) == floor(right);
        bool collide = right - left < 1 && (left_inside || right_inside) &&
                       moved_end(b, b->knots[i]) == moved_end(b, b->knots[i + 1]);
        if (shared || collide) mark(b->crowded, b->intervals, floor(left), ceil(right));
    }
}

/* Moves steps inside the interval to its nearer end, by taking the limits at the steps instead of those at the ends. */
static void take_limits(const builder *b, double left, double right, size_t *cursor, entry ends[2]) {
    double at_left = left, at_right = right;
    while (*cursor < b->count && b->knots[*cursor] <= left) ++*cursor;
    size_t i = *cursor;
    for (; i < b->count && b->knots[i] < right; i++) {
        if (!is_step(b, i)) continue;
        if (b->first + moved_end(b, b->knots[i]) * b->width <= left)
            at_left = b->knots[i];
        else if (at_right == right)
            at_right = b->knots[i];
    }
    *cursor = i;
    ends[0] = limit_at(b, at_left, true);
    ends[1] = limit_at(b, at_right, false);
}

/* Makes the linear interpolant between the two entries have the mean extinction `mean`. */
static void match_integral(entry ends[2], const ang_transfer_integral *integral, double length, bool crowded) {
    double mean = integral->extinction / length;
    bool infinite_left = !isfinite(ends[0].extinction), infinite_right = !isfinite(ends[1].extinction);
    if (infinite_left && infinite_right)
        ends[0].extinction = ends[1].extinction = mean;
    else if (infinite_left && 2 * mean >= ends[1].extinction)
        ends[0].extinction = 2 * mean - ends[1].extinction;
    else if (infinite_right && 2 * mean >= ends[0].extinction)
        ends[1].extinction = 2 * mean - ends[0].extinction;
    else {
        double half = 0.5 * (ends[1].extinction - ends[0].extinction);
        half = isfinite(half) ? fmin(fmax(half, -mean), mean) : 0;
        ends[0].extinction = mean - half;
        ends[1].extinction = mean + half;
    }
    if (crowded && integral->extinction > 0)
        for (int e = 0; e < 2; e++)
            for (int c = 0; c < 3; c++) ends[e].colour[c] = fmin(integral->colour[c] / integral->extinction, 1);
}

static void fill_entries(const builder *b, ang_transfer_tables *tables) {
    size_t cursor = 0;
    for (int i = 0; i < b->intervals; i++) {
        double left = b->first + i * b->width, right = b->first + (i + 1) * b->width;
        entry ends[2];
        take_limits(b, left, right, &cursor, ends);
        if (b->opaque[i]) {
            ends[0].extinction = ends[1].extinction = ANG_TABLE_OPAQUE;
        } else if (b->crowded[i] || b->peaked[i] || !isfinite(ends[0].extinction) || !isfinite(ends[1].extinction)) {
            ang_transfer_integral piece = ang_transfer_integrate_between(b->transfer, hu_at(b, left), hu_at(b, right));
            match_integral(ends, &piece, b->slope * b->width, b->crowded[i]);
        }
        for (int e = 0; e < 2; e++) {
            float *out = &tables->entries[((size_t)i * 2 + e) * 4];
            for (int c = 0; c < 3; c++) out[c] = (float)ends[e].colour[c];
            out[3] = (float)fmin(ends[e].extinction, ANG_TABLE_OPAQUE);
        }
    }
}

/* Values between the same two points, none of them next to one, are alike: one of them is looked up. */
static void fill_visible(const builder *b, ang_transfer_tables *tables) {
    const ang_transfer_point *points = b->transfer->points;
    size_t next = 0; /* the first point beyond the value */
    for (int v = 0; v < STORED_VALUES;) {
        double hu = hu_at(b, v);
        bool at = ang_transfer_visible(b->transfer, hu, hu),
             after = ang_transfer_visible(b->transfer, hu, hu_at(b, v + 1));
        while (next < b->count && points[next].hu <= hu) next++;
        bool apart = next == 0 || points[next - 1].hu <= hu_at(b, v - 1);
        do {
            tables->point_visible[v] = at;
            tables->visible[v + 1] = tables->visible[v] + after;
            v++;
        } while (apart && v < STORED_VALUES && (next == b->count || hu_at(b, v + 1) < points[next].hu));
    }
}

static bool build(builder *b, ang_transfer_tables *tables, uint16_t minimum, uint16_t maximum, int limit,
                  ang_error *err) {
    static const char what[] = "tables of the transfer function";
    b->knots = ang_alloc(b->count, sizeof *b->knots, what, err);
    if (!b->knots) return false;
    for (size_t i = 0; i < b->count; i++) {
        /* Rounding must not put a point that belongs on an interval end beside it. */
        double place = (b->transfer->points[i].hu - b->intercept) / b->slope * ANG_TABLE_MOST_PER_VALUE;
        if (fabs(place - round(place)) < 1e-6) place = round(place);
        b->knots[i] = place / ANG_TABLE_MOST_PER_VALUE;
    }
    choose_intervals(b, minimum, maximum, limit);
    tables->first = b->first;
    tables->per_value = 1 / b->width;
    tables->intervals = b->intervals;
    size_t intervals = (size_t)b->intervals;
    tables->entries = ang_alloc(intervals * 8, sizeof *tables->entries, what, err);
    tables->visible = ang_alloc(STORED_VALUES + 1, sizeof *tables->visible, what, err);
    tables->point_visible = ang_alloc(STORED_VALUES, sizeof *tables->point_visible, what, err);
    b->opaque = ang_alloc(intervals, sizeof *b->opaque, what, err);
    b->peaked = ang_alloc(intervals, sizeof *b->peaked, what, err);
    b->crowded = ang_alloc(intervals, sizeof *b->crowded, what, err);
    if (!tables->entries || !tables->visible || !tables->point_visible || !b->opaque || !b->peaked || !b->crowded)
        return false;
    mark_plateaus(b);
    mark_crowds(b);
    fill_entries(b, tables);
    fill_visible(b, tables);
    return true;
}

ang_transfer_tables *ang_tables_create(const ang_transfer *transfer, double slope, double intercept, uint16_t minimum,
                                       uint16_t maximum, int limit, ang_error *err) {
    if (!(slope > 0) || !isfinite(slope) || !isfinite(intercept)) {
        ang_fail(err, ANG_USAGE, "the rescale slope is %g and the intercept %g; the slope must be greater than 0",
                 slope, intercept);
        return NULL;
    }
    ang_transfer_tables *tables = ang_alloc(1, sizeof *tables, "tables of the transfer function", err);
    if (!tables) return NULL;
    builder b = {.transfer = transfer, .slope = slope, .intercept = intercept, .count = transfer->count};
    bool built =
        build(&b, tables, minimum, maximum > minimum ? maximum : minimum, limit > 0 ? limit : DEFAULT_LIMIT, err);
    free(b.knots);
    free(b.opaque);
    free(b.peaked);
    free(b.crowded);
    if (built) return tables;
    ang_tables_free(tables);
    return NULL;
}

void ang_tables_free(ang_transfer_tables *tables) {
    if (!tables) return;
    free(tables->entries);
    free(tables->visible);
    free(tables->point_visible);
    free(tables);
}

bool ang_tables_visible(const ang_transfer_tables *tables, uint16_t min, uint16_t max) {
    if (min >= max) return min == max && tables->point_visible[min];
    return tables->visible[max] > tables->visible[min];
}

void ang_tables_widen(const ang_transfer_tables *tables, uint16_t *min, uint16_t *max) {
    if (tables->per_value >= 1) return;
    double width = 1 / tables->per_value;
    double low = tables->first + width * floor((*min - tables->first) / width);
    double high = tables->first + width * ceil((*max - tables->first) / width);
    /* One interval more: a step inside an interval moves to its nearer end. */
    *min = (uint16_t)fmin(fmax(low - width, 0), 65535);
    *max = (uint16_t)fmin(fmax(high + width, 0), 65535);
}

bool ang_tables_shows(const ang_transfer_tables *tables, uint16_t min, uint16_t max) {
    ang_tables_widen(tables, &min, &max);
    return ang_tables_visible(tables, min, max);
}
