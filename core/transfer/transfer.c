#include "core/transfer/transfer.h"

#include "core/base/memory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Gauss-Legendre nodes in (0, 1) and weights, each for plus and minus the node [Abramowitz & Stegun, table 25.4]. */
static const double gauss8[][2] = {
    {0.18343464249564981, 0.36268378337836199},
    {0.52553240991632899, 0.31370664587788727},
    {0.79666647741362673, 0.22238103445337448},
    {0.96028985649753629, 0.10122853629037626},
};
static const double gauss20[][2] = {
    {0.076526521133497338, 0.15275338713072584}, {0.22778585114164507, 0.14917298647260374},
    {0.37370608871541955, 0.14209610931838204},  {0.51086700195082713, 0.13168863844917664},
    {0.63605368072651502, 0.11819453196151841},  {0.7463319064601508, 0.10193011981724044},
    {0.83911697182221878, 0.083276741576704755}, {0.91223442825132595, 0.062672048334109068},
    {0.96397192727791381, 0.040601429800386939}, {0.99312859918509488, 0.017614007139152118},
};

/* The function at one HU of a region: near opacity 1 its complement carries the digits that the opacity has lost. */
typedef struct sample {
    double value;      /* opacity, or extinction where the points give it */
    double complement; /* 1 - opacity */
    double colour[3];
} sample;

/* Weighted so that it is exact where a == b, never 0 where one of them is not, and never outside [a, b]. */
static double mix(double a, double b, double from_a, double to_b) {
    if (a == b) return a;
    double value = (a * to_b + b * from_a) / (from_a + to_b);
    return fmin(fmax(value, fmin(a, b)), fmax(a, b));
}

/* Number of points at or below `hu`: the region that holds it. */
static size_t region_of(const ang_transfer *transfer, double hu) {
    size_t low = 0, high = transfer->count;
    while (low < high) {
        size_t middle = low + (high - low) / 2;
        if (transfer->points[middle].hu <= hu)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

static const ang_transfer_point *left_point(const ang_transfer *transfer, size_t region) {
    return &transfer->points[region > 0 ? region - 1 : 0];
}

static const ang_transfer_point *right_point(const ang_transfer *transfer, size_t region) {
    return &transfer->points[region < transfer->count ? region : transfer->count - 1];
}

/* The linear piece of `region` at `hu`, which may be either of its ends. */
static sample sample_region(const ang_transfer *transfer, size_t region, double hu) {
    const ang_transfer_point *a = left_point(transfer, region), *b = right_point(transfer, region);
    double from_a = 0, to_b = 1;
    if (a != b && b->hu > a->hu) {
        from_a = fmin(fmax(hu - a->hu, 0), b->hu - a->hu);
        to_b = fmin(fmax(b->hu - hu, 0), b->hu - a->hu);
    }
    sample s;
    s.value = mix(a->opacity, b->opacity, from_a, to_b);
    s.complement = mix(1 - a->opacity, 1 - b->opacity, from_a, to_b);
    for (int c = 0; c < 3; c++) s.colour[c] = mix(a->colour[c], b->colour[c], from_a, to_b);
    return s;
}

static double extinction_of(const ang_transfer *transfer, double value, double complement) {
    if (transfer->by_extinction) return value;
    double depth = value < 0.5 ? -log1p(-value) : -log(complement);
    return depth / transfer->unit_distance;
}

static bool region_has_length(const ang_transfer *transfer, size_t region) {
    return region == 0 || region == transfer->count ||
           right_point(transfer, region)->hu > left_point(transfer, region)->hu;
}

static bool region_is_opaque(const ang_transfer *transfer, size_t region) {
    return !transfer->by_extinction && region_has_length(transfer, region) &&
           left_point(transfer, region)->opacity == 1 && right_point(transfer, region)->opacity == 1;
}

static bool region_is_visible(const ang_transfer *transfer, size_t region) {
    return region_has_length(transfer, region) &&
           (left_point(transfer, region)->opacity > 0 || right_point(transfer, region)->opacity > 0);
}

/* The integrals over a piece of extinction weighted with (1-t) and with t, t from 0 to 1 along the piece. Opacity is
 * linear, so extinction is -ln u / unit with u linear, and int -ln u du = u (1 - ln u), int -u ln u du =
 * u^2 (1 - 2 ln u) / 4. These cancel where u changes little; there u = 0 is far away and quadrature converges to
 * rounding: with the singularity at z half lengths from the middle the error of n nodes is about
 * (z + sqrt(z^2 - 1))^(-2n) [Trefethen, Approximation Theory and Approximation Practice, theorem 19.3]. */
static void integrate_opacity(const ang_transfer *transfer, const sample *a, const sample *b, double length,
                              double weight[2]) {
    double ua = a->complement, ub = b->complement;
    double sum = ua + ub, difference = fabs(ua - ub);
    if (sum >= 1.45 * difference) {
        bool far = sum >= 6 * difference;
        const double(*nodes)[2] = far ? gauss8 : gauss20;
        int count = far ? 4 : 10;
        weight[0] = weight[1] = 0;
        for (int i = 0; i < 2 * count; i++) {
            double x = (i & 1 ? -1 : 1) * nodes[i / 2][0], t = 0.5 + 0.5 * x, s = 0.5 - 0.5 * x;
            double kappa = extinction_of(transfer, s * a->value + t * b->value, s * ua + t * ub);
            weight[0] += 0.5 * nodes[i / 2][1] * s * kappa * length;
            weight[1] += 0.5 * nodes[i / 2][1] * t * kappa * length;
        }
        return;
    }
    double large = fmax(ua, ub), small = fmin(ua, ub);
    double log_large = log(large), log_small = small > 0 ? log(small) : 0;
    double f = large * (1 - log_large) - small * (1 - log_small);
    double g = 0.25 * (large * large * (1 - 2 * log_large) - small * small * (1 - 2 * log_small));
    double scale = length / (difference * difference * transfer->unit_distance);
    double at_large = scale * (g - small * f), at_small = scale * (large * f - g);
    weight[0] = ua > ub ? at_large : at_small;
    weight[1] = ua > ub ? at_small : at_large;
}

/* Adds the integrals over [low, high], low <= high, both within the closure of `region`. */
static void add_piece(const ang_transfer *transfer, size_t region, double low, double high,
                      ang_transfer_integral *integral) {
    if (!(high > low) || !region_is_visible(transfer, region) || region_is_opaque(transfer, region)) return;
    sample a = sample_region(transfer, region, low), b = sample_region(transfer, region, high);
    double weight[2], length = high - low;
    if (transfer->by_extinction) {
        weight[0] = length * (a.value / 3 + b.value / 6);
        weight[1] = length * (a.value / 6 + b.value / 3);
    } else if (a.value == b.value && a.complement == b.complement) {
        weight[0] = weight[1] = 0.5 * length * extinction_of(transfer, a.value, a.complement);
    } else {
        integrate_opacity(transfer, &a, &b, length, weight);
    }
    integral->extinction += weight[0] + weight[1];
    for (int c = 0; c < 3; c++) integral->colour[c] += weight[0] * a.colour[c] + weight[1] * b.colour[c];
}

static void add_integral(ang_transfer_integral *sum, const ang_transfer_integral *term) {
    sum->extinction += term->extinction;
    for (int c = 0; c < 3; c++) sum->colour[c] += term->colour[c];
}

static bool check_point(const ang_transfer_point *p, size_t index, bool by_extinction, ang_error *err) {
    if (!isfinite(p->hu) || fabs(p->hu) > ANG_TRANSFER_HU_LIMIT)
        return ang_fail(err, ANG_USAGE, "point %zu of the transfer function is at %g HU; it must lie within %g HU of 0",
                        index, p->hu, ANG_TRANSFER_HU_LIMIT);
    for (int c = 0; c < 3; c++)
        if (!(p->colour[c] >= 0 && p->colour[c] <= 1))
            return ang_fail(err, ANG_USAGE, "point %zu of the transfer function has %s %g; it must lie in 0..1", index,
                            (const char *[]){"red", "green", "blue"}[c], p->colour[c]);
    if (by_extinction && !(p->opacity >= 0 && p->opacity <= ANG_TRANSFER_EXTINCTION_LIMIT))
        return ang_fail(err, ANG_USAGE,
                        "point %zu of the transfer function has extinction %g per mm; it must lie in "
                        "0..%g",
                        index, p->opacity, ANG_TRANSFER_EXTINCTION_LIMIT);
    if (!by_extinction && !(p->opacity >= 0 && p->opacity <= 1))
        return ang_fail(err, ANG_USAGE, "point %zu of the transfer function has opacity %g; it must lie in 0..1", index,
                        p->opacity);
    return true;
}

/* Stable, so that two points at one HU keep their order; presets have tens of points, so insertion is fast enough. */
static bool sort_points(ang_transfer_point *points, size_t count) {
    bool moved = false;
    for (size_t i = 1; i < count; i++) {
        ang_transfer_point p = points[i];
        size_t j = i;
        for (; j > 0 && points[j - 1].hu > p.hu; j--) points[j] = points[j - 1];
        points[j] = p;
        moved |= j != i;
    }
    return moved;
}

/* Keeps the first and the last of the points at one HU. */
static size_t merge_points(ang_transfer_point *points, size_t count, ang_notes *warnings) {
    size_t kept = 0;
    for (size_t i = 0; i < count;) {
        size_t end = i + 1;
        while (end < count && points[end].hu == points[i].hu) end++;
        if (end - i > 2 && warnings)
            ang_notes_add(warnings, "the transfer function has %zu points at %g HU; the first and the last are used",
                          end - i, points[i].hu);
        points[kept++] = points[i];
        if (end - i > 1) points[kept++] = points[end - 1];
        i = end;
    }
    return kept;
}

static void fill_regions(ang_transfer *transfer) {
    for (size_t i = 0; i <= transfer->count; i++) {
        transfer->visible_before[i + 1] = transfer->visible_before[i] + region_is_visible(transfer, i);
        transfer->opaque_before[i + 1] = transfer->opaque_before[i] + region_is_opaque(transfer, i);
    }
    for (size_t i = 1; i < transfer->count; i++) {
        add_piece(transfer, i, transfer->points[i - 1].hu, transfer->points[i].hu, &transfer->region[i]);
        transfer->prefix[i] = transfer->prefix[i - 1];
        add_integral(&transfer->prefix[i], &transfer->region[i]);
    }
}

ang_transfer *ang_transfer_create(const ang_transfer_point *points, size_t count, double unit_distance,
                                  bool by_extinction, ang_notes *warnings, ang_error *err) {
    if (count == 0 || !points) {
        ang_fail(err, ANG_USAGE, "the transfer function has no points; give at least one");
        return NULL;
    }
    if (!isfinite(unit_distance) || unit_distance < ANG_TRANSFER_LEAST_UNIT) {
        ang_fail(err, ANG_USAGE, "the unit distance of the transfer function is %g mm; it must be greater than 0",
                 unit_distance);
        return NULL;
    }
    for (size_t i = 0; i < count; i++)
        if (!check_point(&points[i], i, by_extinction, err)) return NULL;
    static const char what[] = "transfer function";
    ang_transfer *transfer = ang_alloc(1, sizeof *transfer, what, err);
    if (!transfer) return NULL;
    transfer->unit_distance = unit_distance;
    transfer->by_extinction = by_extinction;
    transfer->points = ang_alloc(count, sizeof *transfer->points, what, err);
    transfer->region = ang_alloc(count, sizeof *transfer->region, what, err);
    transfer->prefix = ang_alloc(count, sizeof *transfer->prefix, what, err);
    transfer->visible_before = ang_alloc(count + 2, sizeof *transfer->visible_before, what, err);
    transfer->opaque_before = ang_alloc(count + 2, sizeof *transfer->opaque_before, what, err);
    if (!transfer->points || !transfer->region || !transfer->prefix || !transfer->visible_before ||
        !transfer->opaque_before) {
        ang_transfer_free(transfer);
        return NULL;
    }
    memcpy(transfer->points, points, count * sizeof *points);
    if (sort_points(transfer->points, count) && warnings)
        ang_notes_add(warnings, "the points of the transfer function are not in order of HU; they were sorted");
    transfer->count = merge_points(transfer->points, count, warnings);
    fill_regions(transfer);
    return transfer;
}

void ang_transfer_free(ang_transfer *transfer) {
    if (!transfer) return;
    free(transfer->points);
    free(transfer->region);
    free(transfer->prefix);
    free(transfer->visible_before);
    free(transfer->opaque_before);
    free(transfer);
}

bool ang_transfer_same(const ang_transfer *a, const ang_transfer *b) {
    return a->count == b->count && memcmp(&a->unit_distance, &b->unit_distance, sizeof a->unit_distance) == 0 &&
           a->by_extinction == b->by_extinction && memcmp(a->points, b->points, a->count * sizeof *a->points) == 0;
}

ang_transfer *ang_transfer_shifted(const ang_transfer *transfer, double shift, ang_error *err) {
    ang_transfer_point *points = ang_alloc(transfer->count, sizeof *points, "transfer function", err);
    if (!points) return NULL;
    for (size_t i = 0; i < transfer->count; i++) {
        points[i] = transfer->points[i];
        points[i].hu += shift;
    }
    ang_transfer *shifted =
        ang_transfer_create(points, transfer->count, transfer->unit_distance, transfer->by_extinction, NULL, err);
    free(points);
    return shifted;
}

double ang_transfer_opacity(const ang_transfer *transfer, double hu) {
    double value = sample_region(transfer, region_of(transfer, hu), hu).value;
    return transfer->by_extinction ? -expm1(-value * transfer->unit_distance) : value;
}

double ang_transfer_extinction(const ang_transfer *transfer, double hu) {
    sample s = sample_region(transfer, region_of(transfer, hu), hu);
    return extinction_of(transfer, s.value, s.complement);
}

void ang_transfer_colour(const ang_transfer *transfer, double hu, double colour[3]) {
    sample s = sample_region(transfer, region_of(transfer, hu), hu);
    memcpy(colour, s.colour, sizeof s.colour);
}

ang_transfer_integral ang_transfer_integrate(const ang_transfer *transfer, double hu) {
    size_t region = region_of(transfer, hu);
    if (region == 0) return ang_transfer_integrate_between(transfer, transfer->points[0].hu, hu);
    ang_transfer_integral integral = transfer->prefix[region - 1];
    add_piece(transfer, region, transfer->points[region - 1].hu, hu, &integral);
    return integral;
}

ang_transfer_integral ang_transfer_integrate_between(const ang_transfer *transfer, double low, double high) {
    ang_transfer_integral integral = {0};
    if (high < low) {
        integral = ang_transfer_integrate_between(transfer, high, low);
        integral.extinction = -integral.extinction;
        for (int c = 0; c < 3; c++) integral.colour[c] = -integral.colour[c];
        return integral;
    }
    size_t first = region_of(transfer, low), last = region_of(transfer, high);
    if (first == last) {
        add_piece(transfer, first, low, high, &integral);
        return integral;
    }
    add_piece(transfer, first, low, transfer->points[first].hu, &integral);
    for (size_t i = first + 1; i < last; i++) add_integral(&integral, &transfer->region[i]);
    add_piece(transfer, last, transfer->points[last - 1].hu, high, &integral);
    return integral;
}

/* The regions that [low, high] meets in a positive length; false where there is none. */
static bool regions_met(const ang_transfer *transfer, double low, double high, size_t *first, size_t *last) {
    if (!(low < high)) return false;
    *first = region_of(transfer, low);
    *last = region_of(transfer, high);
    if (*last > 0 && transfer->points[*last - 1].hu == high) {
        while (*last > 0 && transfer->points[*last - 1].hu == high) --*last;
    }
    return true;
}

bool ang_transfer_opaque_between(const ang_transfer *transfer, double low, double high) {
    if (transfer->by_extinction || !(low <= high)) return false;
    size_t first, last;
    if (regions_met(transfer, low, high, &first, &last) &&
        transfer->opaque_before[last + 1] > transfer->opaque_before[first])
        return true;
    const double ends[2] = {low, high};
    for (int i = 0; i < 2; i++) {
        size_t region = region_of(transfer, ends[i]);
        if (region_is_opaque(transfer, region)) return true;
        /* The right end of a plateau belongs to it where the opacity does not step down there. */
        if (region > 0 && transfer->points[region - 1].hu == ends[i] && transfer->points[region - 1].opacity == 1) {
            size_t before = region - 1;
            if (before > 0 && transfer->points[before - 1].hu == ends[i]) before--;
            if (region_is_opaque(transfer, before)) return true;
        }
    }
    return false;
}

bool ang_transfer_visible(const ang_transfer *transfer, double low, double high) {
    if (!(low <= high)) return false;
    size_t first, last;
    if (regions_met(transfer, low, high, &first, &last) &&
        transfer->visible_before[last + 1] > transfer->visible_before[first])
        return true;
    return ang_transfer_extinction(transfer, low) > 0 || ang_transfer_extinction(transfer, high) > 0;
}

bool ang_transfer_jumps(const ang_transfer *transfer) {
    const ang_transfer_point *points = transfer->points;
    for (size_t i = 0; i < transfer->count; i++) {
        if (i > 0 && points[i].hu == points[i - 1].hu) return true;
        if (!transfer->by_extinction && points[i].opacity == 1) return true;
    }
    return false;
}
