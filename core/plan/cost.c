#include "core/plan/cost.h"

#include "core/base/median.h"

#include <math.h>
#include <stdlib.h>

enum { PICTURE, RAYS, SAMPLES, SHADED, POLYGONS };

static void terms_of(const ang_cost_work *work, double out[ANG_COST_TERMS]) {
    out[PICTURE] = 1;
    out[RAYS] = work->rays;
    out[SAMPLES] = work->samples;
    out[SHADED] = work->shaded;
    out[POLYGONS] = work->polygons;
}

double ang_cost_predict(const ang_cost_model *model, const ang_cost_work *work) {
    double terms[ANG_COST_TERMS], ms = 0;
    terms_of(work, terms);
    for (int i = 0; i < ANG_COST_TERMS; i++) ms += model->term[i] * terms[i];
    return ms;
}

/* Gauss with pivots on n equations, rows of `a` with the right side last; false where they are dependent. */
static bool solve(double a[ANG_COST_TERMS][ANG_COST_TERMS + 1], int n, double *x) {
    for (int column = 0; column < n; column++) {
        int pivot = column;
        for (int row = column + 1; row < n; row++)
            if (fabs(a[row][column]) > fabs(a[pivot][column])) pivot = row;
        if (!(fabs(a[pivot][column]) > 1e-12)) return false;
        for (int k = 0; k <= n; k++) {
            double swap = a[column][k];
            a[column][k] = a[pivot][k];
            a[pivot][k] = swap;
        }
        for (int row = column + 1; row < n; row++) {
            double factor = a[row][column] / a[column][column];
            for (int k = column; k <= n; k++) a[row][k] -= factor * a[column][k];
        }
    }
    for (int row = n - 1; row >= 0; row--) {
        x[row] = a[row][n];
        for (int k = row + 1; k < n; k++) x[row] -= a[row][k] * x[k];
        x[row] /= a[row][row];
    }
    return true;
}

/* The rows of the least-squares problem: terms scaled to at most 1, over the measured time, so that errors are
 * relative. */
typedef struct problem {
    const ang_cost_measured *measured;
    size_t count;
    double scale[ANG_COST_TERMS];
} problem;

static void row_of(const problem *p, size_t i, double row[ANG_COST_TERMS]) {
    terms_of(&p->measured[i].work, row);
    for (int k = 0; k < ANG_COST_TERMS; k++) row[k] *= p->scale[k] / p->measured[i].ms;
}

/* The best model with the terms in `set` alone; its sum of squares, or infinity where it has a negative term. */
static double fit_terms(const problem *p, unsigned set, double out[ANG_COST_TERMS]) {
    int index[ANG_COST_TERMS], n = 0;
    double a[ANG_COST_TERMS][ANG_COST_TERMS + 1] = {{0}}, x[ANG_COST_TERMS], row[ANG_COST_TERMS];
    for (int k = 0; k < ANG_COST_TERMS; k++)
        if (set >> k & 1u) index[n++] = k;
    for (size_t i = 0; i < p->count; i++) {
        row_of(p, i, row);
        for (int r = 0; r < n; r++) {
            for (int c = 0; c < n; c++) a[r][c] += row[index[r]] * row[index[c]];
            a[r][n] += row[index[r]];
        }
    }
    if (!solve(a, n, x)) return INFINITY;
    for (int k = 0; k < ANG_COST_TERMS; k++) out[k] = 0;
    for (int k = 0; k < n; k++) {
        /* A term of nothing is that of a smaller set. */
        if (!(x[k] > 0)) return INFINITY;
        out[index[k]] = x[k];
    }
    double sum = 0;
    for (size_t i = 0; i < p->count; i++) {
        row_of(p, i, row);
        double off = -1;
        for (int k = 0; k < ANG_COST_TERMS; k++) off += out[k] * row[k];
        sum += off * off;
    }
    return sum;
}

static double spread_of(const ang_cost_model *model, const ang_cost_measured *measured, size_t count) {
    double *off = malloc(count * sizeof *off);
    if (!off) return NAN;
    for (size_t i = 0; i < count; i++) off[i] = fabs(ang_cost_predict(model, &measured[i].work) / measured[i].ms - 1);
    double median = ang_median(off, count);
    free(off);
    return median;
}

double ang_cost_miss(double predicted, double measured) {
    if (!(predicted > 0) || !(measured > 0)) return INFINITY;
    return fmax(predicted / measured, measured / predicted);
}

double ang_cost_worst(const ang_cost_model *model, const ang_cost_measured *measured, size_t count) {
    double worst = 1;
    for (size_t i = 0; i < count; i++)
        worst = fmax(worst, ang_cost_miss(ang_cost_predict(model, &measured[i].work), measured[i].ms));
    return worst;
}

bool ang_cost_grows(const ang_cost_model *model) { return model->term[RAYS] > 0 || model->term[SAMPLES] > 0; }

/* `terms`: which the model may have. */
static bool fit(const ang_cost_measured *measured, size_t count, unsigned terms, ang_cost_model *model) {
    *model = (ang_cost_model){.spread = NAN};
    problem p = {measured, count, {0}};
    for (size_t i = 0; i < count; i++) {
        double of[ANG_COST_TERMS];
        if (!(measured[i].ms > 0)) return false;
        terms_of(&measured[i].work, of);
        for (int k = 0; k < ANG_COST_TERMS; k++) p.scale[k] = fmax(p.scale[k], of[k] / measured[i].ms);
    }
    for (int k = 0; k < ANG_COST_TERMS; k++) {
        if (!(p.scale[k] > 0)) terms &= ~(1u << k);
        p.scale[k] = p.scale[k] > 0 ? 1 / p.scale[k] : 0;
    }
    /* So few terms that every set of them can be tried: the least squares without negative terms are among them. Sets
     * without a cost of rays or samples are none: they would promise that a larger picture, or one without shading,
     * takes no longer. */
    const unsigned grow = (1u << RAYS | 1u << SAMPLES) & terms;
    double least = INFINITY, of[ANG_COST_TERMS];
    for (unsigned set = 1; set < 1u << ANG_COST_TERMS; set++) {
        bool possible = !(set & ~terms) && (set & grow || !grow);
        double sum = possible ? fit_terms(&p, set, of) : INFINITY;
        if (!(sum < least)) continue;
        least = sum;
        for (int k = 0; k < ANG_COST_TERMS; k++) model->term[k] = of[k] * p.scale[k];
    }
    if (!isfinite(least)) return false;
    model->spread = spread_of(model, measured, count);
    return true;
}

bool ang_cost_fit(const ang_cost_measured *measured, size_t count, ang_cost_model *model) {
    return fit(measured, count, (1u << ANG_COST_TERMS) - 1, model);
}

bool ang_cost_fit_proportional(const ang_cost_measured *measured, size_t count, ang_cost_model *model) {
    return fit(measured, count, 1u << RAYS | 1u << SAMPLES | 1u << SHADED, model);
}

ang_cost_work ang_cost_scale(const ang_cost_work *work, double pixels, double samples, bool slices) {
    ang_cost_work scaled = *work;
    scaled.rays *= pixels;
    scaled.samples *= pixels * samples;
    scaled.shaded *= pixels * samples;
    /* Planes have as many polygons however many pixels they cover; an envelope has its faces. */
    if (slices) {
        scaled.rays *= samples;
        scaled.polygons *= samples;
    }
    return scaled;
}
