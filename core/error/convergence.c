#include "core/error/convergence.h"

#include <math.h>

/* Sums of a straight line through points added one by one. */
typedef struct line {
    double n, x, y, xx, xy, yy;
} line;

static void add(line *sum, double x, double y) {
    sum->n++;
    sum->x += x;
    sum->y += y;
    sum->xx += x * x;
    sum->xy += x * y;
    sum->yy += y * y;
}

static double slope(const line *sum) {
    return (sum->n * sum->xy - sum->x * sum->y) / (sum->n * sum->xx - sum->x * sum->x);
}

static bool usable(double step, double error, double floor) {
    return isfinite(step) && step > 0 && isfinite(error) && error > 0 && error > floor;
}

ang_order ang_order_fit(const double *step, const double *error, size_t count, double floor) {
    ang_order fit = {.order = (double)NAN, .factor = (double)NAN, .spread = (double)NAN};
    line sum = {0};
    double last_x = 0, last_y = 0;
    for (size_t i = 0; i < count; i++) {
        if (!usable(step[i], error[i], floor)) {
            if (fit.used > 0) break;
            continue;
        }
        double x = log(step[i]), y = log(error[i]);
        if (fit.used >= 2 && (y - last_y) / (x - last_x) < 0.4 * slope(&sum)) break;
        add(&sum, x, y);
        if (fit.used++ == 0) fit.coarsest = step[i];
        fit.finest = step[i];
        last_x = x;
        last_y = y;
    }
    if (fit.used < 2) return fit;
    fit.order = slope(&sum);
    double height = (sum.y - fit.order * sum.x) / sum.n;
    fit.factor = exp(height);
    if (fit.used > 2) {
        double width = sum.xx - sum.x * sum.x / sum.n;
        double left = sum.yy - height * sum.y - fit.order * sum.xy; /* sum of squared residuals */
        fit.spread = sqrt(fmax(left, 0) / (sum.n - 2) / width);
    }
    return fit;
}

/* Whether the slope of opacity or colour changes at a knot between `low` and `high` where something shows. */
static bool has_kinks(const ang_transfer *transfer, double low, double high) {
    for (size_t i = 0; i < transfer->count; i++) {
        double hu = transfer->points[i].hu, beside = 1e-6 * (fabs(hu) + 1);
        if (hu > low && hu < high && ang_transfer_visible(transfer, hu - beside, hu + beside)) return true;
    }
    return false;
}

ang_expected_order ang_order_expected(const ang_scene *scene, double low, double high, bool prefix) {
    switch (scene->mode) {
    case ANG_MODE_MIP:
    case ANG_MODE_MINIP:
        return (ang_expected_order){1, 1, "extremes of a trilinear field often lie on the faces of cells, at a kink"};
    case ANG_MODE_MEAN:
        return (ang_expected_order){2, 2, "the values themselves are summed up, and they are smooth within cells"};
    case ANG_MODE_ISO:
        return (ang_expected_order){
            0.5, 0.5,
            "what is missed is missed as a whole: the share of such pixels falls with the step, their RMS "
            "with its root"};
    case ANG_MODE_DVR:
        break;
    }
    bool jumps = ang_transfer_jumps(scene->transfer);
    if (prefix && (jumps || has_kinks(scene->transfer, low, high)))
        return (ang_expected_order){1, 2,
                                    "steps are classified by integrals over the transfer function: 2 where the field "
                                    "is smooth over a step, less "
                                    "where it bends within narrow parts of the transfer function"};
    if (jumps) return (ang_expected_order){1, 1, "the transfer function has steps or a plateau at opacity 1"};
    if (has_kinks(scene->transfer, low, high))
        return (ang_expected_order){1.8, 2, "the transfer function has kinks and no steps"};
    return (ang_expected_order){2, 2, "the transfer function is smooth over the values there are"};
}

void ang_pareto_front(const double *cost, const double *error, size_t count, double slack, bool *front) {
    for (size_t i = 0; i < count; i++) {
        front[i] = isfinite(cost[i]) && isfinite(error[i]);
        for (size_t j = 0; j < count && front[i]; j++) {
            bool no_worse = cost[j] <= cost[i] && error[j] <= (1 + slack) * error[i];
            if (no_worse && (cost[j] < cost[i] || error[j] < error[i])) front[i] = false;
        }
    }
}
