#include "core/plan/budget.h"

#include <math.h>

static bool within(double value, double limit) { return isnan(limit) || value <= limit; }

/* NaN is worse than anything. */
static bool is_less(double a, double b) { return isnan(b) ? !isnan(a) : a < b; }

/* Whether `a` is to be taken before `b`: by the one, and where that is the same by the other. */
static bool is_better(const ang_candidate *a, const ang_candidate *b, bool by_time) {
    double first_a = by_time ? a->ms : a->error, first_b = by_time ? b->ms : b->error;
    if (is_less(first_a, first_b) || is_less(first_b, first_a)) return is_less(first_a, first_b);
    return by_time ? is_less(a->error, b->error) : is_less(a->ms, b->ms);
}

/* The best of the candidates that keep what must be kept; `count` where there is none. */
static size_t best_of(const ang_candidate *candidates, size_t count, const ang_budget *budget, bool error, bool time,
                      bool by_time) {
    size_t best = count;
    for (size_t i = 0; i < count; i++) {
        if ((error && !within(candidates[i].error, budget->max_error)) ||
            (time && !within(candidates[i].ms, budget->max_ms)))
            continue;
        if (best == count || is_better(&candidates[i], &candidates[best], by_time)) best = i;
    }
    return best;
}

ang_choice ang_budget_choose(const ang_candidate *candidates, size_t count, const ang_budget *budget) {
    bool limits_error = !isnan(budget->max_error), limits_time = !isnan(budget->max_ms);
    size_t best = best_of(candidates, count, budget, true, true, limits_error);
    if (best == count) best = best_of(candidates, count, budget, true, false, true);
    if (best == count) best = best_of(candidates, count, budget, false, true, false);
    if (best == count) best = best_of(candidates, count, budget, false, false, limits_time);
    return (ang_choice){best, within(candidates[best].error, budget->max_error),
                        within(candidates[best].ms, budget->max_ms)};
}

double ang_budget_error(double fixed, double varying, double order, double step, double measured_step) {
    return fixed + varying * pow(step / measured_step, order);
}

double ang_budget_step(double fixed, double varying, double order, double measured_step, double max_error) {
    if (!(fixed < max_error)) return 0;
    if (!(varying > 0)) return INFINITY;
    return measured_step * pow((max_error - fixed) / varying, 1 / order);
}
