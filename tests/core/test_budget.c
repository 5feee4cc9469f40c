/* Cost model and choice within a budget, without OpenGL. */
#include "tests/core/fixtures.h"

#include "core/plan/budget.h"
#include "core/plan/cost.h"

static ang_cost_work some_work(uint64_t *random) {
    double samples = 1e6 * random_unit(random);
    return (ang_cost_work){1e5 * random_unit(random), samples, random_unit(random) < 0.5 ? samples : 0,
                           1e3 * random_unit(random)};
}

/* Times made with known terms give these terms back. */
static void terms_are_found_again(void **state) {
    (void)state;
    static const double terms[][ANG_COST_TERMS] = {
        {2, 1e-4, 3e-5, 5e-5, 0.005}, {0, 1e-4, 3e-5, 5e-5, 0.005}, {1, 0, 2e-5, 0, 0}, {5, 0, 0, 0, 0.01}};
    uint64_t random = 3;
    for (size_t t = 0; t < sizeof terms / sizeof *terms; t++) {
        ang_cost_measured measured[30];
        ang_cost_model truth = {{0}, 0}, model;
        for (int k = 0; k < ANG_COST_TERMS; k++) truth.term[k] = terms[t][k];
        for (int i = 0; i < 30; i++) {
            measured[i].work = some_work(&random);
            measured[i].ms = ang_cost_predict(&truth, &measured[i].work);
        }
        assert_true(ang_cost_fit(measured, 30, &model));
        for (int k = 0; k < ANG_COST_TERMS; k++) assert_close(model.term[k], terms[t][k], 1e-6 * (terms[t][k] + 1e-6));
        assert_true(model.spread < 1e-6);
    }
}

/* Noisy times: no term becomes negative, and no other model of a grid around it has a smaller relative error. */
static void noise_makes_no_negative_terms(void **state) {
    (void)state;
    uint64_t random = 8;
    for (int n = 0; n < 50; n++) {
        ang_cost_measured measured[12];
        ang_cost_model truth = {{1, 2e-5, 3e-5, 0, 0}, 0}, model;
        for (int i = 0; i < 12; i++) {
            measured[i].work = some_work(&random);
            measured[i].ms = ang_cost_predict(&truth, &measured[i].work) * (0.7 + 0.6 * random_unit(&random));
        }
        assert_true(ang_cost_fit(measured, 12, &model));
        double sums[2 * ANG_COST_TERMS + 1];
        for (int trial = 0; trial <= 2 * ANG_COST_TERMS; trial++) {
            ang_cost_model other = model;
            if (trial > 0) {
                double *term = &other.term[(trial - 1) / 2];
                double by = fmax(*term, 1e-9) * 0.01;
                *term = trial % 2 ? *term + by : fmax(*term - by, 0);
            }
            sums[trial] = 0;
            for (int i = 0; i < 12; i++)
                sums[trial] += pow(ang_cost_predict(&other, &measured[i].work) / measured[i].ms - 1, 2);
            assert_true(sums[trial] >= sums[0] - 1e-12);
        }
        for (int k = 0; k < ANG_COST_TERMS; k++) assert_true(model.term[k] >= 0);
    }
    ang_cost_model model;
    ang_cost_measured nothing = {{1, 1, 1, 1}, 0};
    assert_false(ang_cost_fit(NULL, 0, &model));
    assert_false(ang_cost_fit(&nothing, 1, &model));
}

/* Pictures of a method whose shaded ones alone cost much, their times off by up to `noise` either way and one of them
 * by `burst`. */
static void measure_noisy(ang_cost_measured measured[9], const ang_cost_model *truth, double noise, double burst,
                          uint64_t *random) {
    static const ang_cost_work work[9] = {{4, 0, 0, 0},        {64, 3000, 0, 0},       {576, 28000, 0, 0},
                                          {64, 5000, 5000, 0}, {256, 22000, 22000, 0}, {144, 1400, 0, 0},
                                          {2300, 20000, 0, 0}, {144, 34, 0, 0},        {2300, 700, 0, 0}};
    size_t hit = (size_t)(9 * random_unit(random)) % 9;
    for (size_t i = 0; i < 9; i++) {
        double by = 1 + noise * (2 * random_unit(random) - 1);
        measured[i] = (ang_cost_measured){work[i], ang_cost_predict(truth, &work[i]) * by * (i == hit ? burst : 1)};
    }
}

/* Whatever the noise, a hundred times the unshaded work never is for nothing; and where the times are off by up to 30 %
 * pictures of a hundred times the rays are told to a factor of 2. */
static void no_fit_promises_larger_pictures_for_nothing(void **state) {
    (void)state;
    const ang_cost_model truth = {.term = {0.02, 9e-4, 1.3e-4, 5e-5, 0}};
    const ang_cost_work large[] = {{23e4, 2e6, 0, 0}, {23e4, 7e4, 0, 0}, {5e4, 3e6, 0, 0}, {5e4, 4e6, 4e6, 0}};
    uint64_t random = 12;
    for (int n = 0; n < 400; n++) {
        ang_cost_measured measured[9];
        ang_cost_model model;
        bool calm = n < 200;
        measure_noisy(measured, &truth, calm ? 0.3 : 0.9, calm ? 1 : 30, &random);
        assert_true(ang_cost_fit(measured, 9, &model));
        assert_true(ang_cost_grows(&model));
        for (size_t i = 0; i < 4; i++) {
            double predicted = ang_cost_predict(&model, &large[i]);
            assert_true(predicted > model.term[0]);
            if (calm) assert_true(ang_cost_miss(predicted, ang_cost_predict(&truth, &large[i])) < 2);
        }
        assert_true(ang_cost_fit_proportional(measured, 9, &model));
        assert_close(model.term[0], 0, 0);
        assert_close(model.term[4], 0, 0);
        assert_true(ang_cost_grows(&model));
    }
    /* Times without any sense: neither rays nor samples are in a model that has the least squares, shading is. */
    const ang_cost_measured senseless[] = {
        {{64, 3000, 0, 0}, 9}, {{576, 28000, 0, 0}, 9}, {{64, 5000, 5000, 0}, 11}, {{256, 22000, 22000, 0}, 19}};
    ang_cost_model model;
    assert_true(ang_cost_fit(senseless, 4, &model));
    assert_true(ang_cost_grows(&model));
}

static void what_a_model_misses_is_told(void **state) {
    (void)state;
    const ang_cost_model model = {.term = {0, 1, 0, 0, 0}};
    const ang_cost_measured measured[] = {{{10, 0, 0, 0}, 12}, {{10, 0, 0, 0}, 4}, {{10, 0, 0, 0}, 11}};
    assert_close(ang_cost_miss(2, 6), 3, 1e-12);
    assert_close(ang_cost_miss(6, 2), 3, 1e-12);
    assert_true(isinf(ang_cost_miss(0, 2)));
    assert_true(isinf(ang_cost_miss(NAN, 2)));
    assert_close(ang_cost_worst(&model, measured, 3), 2.5, 1e-12);
    assert_close(ang_cost_worst(&model, NULL, 0), 1, 0);
}

static void work_scales_with_pixels_and_steps(void **state) {
    (void)state;
    ang_cost_work work = {100, 5000, 400, 30};
    ang_cost_work rays = ang_cost_scale(&work, 16, 2, false), slices = ang_cost_scale(&work, 16, 2, true);
    assert_close(rays.rays, 1600, 0);
    assert_close(rays.samples, 160000, 0);
    assert_close(rays.shaded, 12800, 0);
    assert_close(rays.polygons, 30, 0);
    assert_close(slices.rays, 3200, 0);
    assert_close(slices.polygons, 60, 0);
}

enum { FAST, ROUGH, FINE, EXACT };
static const ang_candidate candidates[] = {[FAST] = {0, 4, 4, 5, 40},
                                           [ROUGH] = {0, 1, 1, 60, 6},
                                           [FINE] = {0, 0.25, 1, 200, 0.8},
                                           [EXACT] = {1, 0, 1, 90000, 0}};

static ang_choice choose(double max_error, double max_ms) {
    ang_budget budget = {max_error, max_ms};
    return ang_budget_choose(candidates, 4, &budget);
}

static void budgets_choose_what_is_expected(void **state) {
    (void)state;
    assert_int_equal(choose(10, NAN).index, ROUGH);
    assert_int_equal(choose(100, NAN).index, FAST);
    assert_int_equal(choose(2, NAN).index, FINE);
    assert_int_equal(choose(0.1, NAN).index, EXACT);
    assert_int_equal(choose(NAN, 10).index, FAST);
    assert_int_equal(choose(NAN, 100).index, ROUGH);
    assert_int_equal(choose(NAN, 1e6).index, EXACT);
    assert_int_equal(choose(2, 1000).index, FINE);
    assert_int_equal(choose(NAN, NAN).index, EXACT);
    /* Not both: the error is kept, and that the time is not is said. */
    ang_choice late = choose(2, 100);
    assert_int_equal(late.index, FINE);
    assert_true(late.keeps_error);
    assert_false(late.keeps_time);
    ang_choice hopeless = choose(NAN, 1);
    assert_int_equal(hopeless.index, FAST);
    assert_false(hopeless.keeps_time);
    assert_true(hopeless.keeps_error);
    /* No error is known: the budget cannot be promised. */
    ang_candidate unknown[] = {{0, 0.5, 1, 10, NAN}, {1, 0.5, 1, 20, NAN}};
    ang_budget strict = {1, NAN}, both = {1, 15};
    assert_false(ang_budget_choose(unknown, 2, &strict).keeps_error);
    assert_int_equal(ang_budget_choose(unknown, 2, &both).index, 0);
}

/* More time never makes the picture worse, a looser error never makes it slower. */
static void choices_are_monotone(void **state) {
    (void)state;
    uint64_t random = 4;
    for (int n = 0; n < 2000; n++) {
        ang_candidate list[12];
        for (int i = 0; i < 12; i++)
            list[i] = (ang_candidate){0, 1, 1, pow(10, 4 * random_unit(&random)),
                                      random_unit(&random) < 0.1 ? NAN : pow(10, 3 * random_unit(&random) - 1)};
        double error = INFINITY, ms = INFINITY;
        for (double limit = 1; limit < 20000; limit *= 1.7) {
            ang_budget budget = {NAN, limit};
            ang_choice choice = ang_budget_choose(list, 12, &budget);
            if (!choice.keeps_time) continue;
            double now = isnan(list[choice.index].error) ? INFINITY : list[choice.index].error;
            assert_true(now <= error);
            assert_true(list[choice.index].ms <= limit);
            error = now;
        }
        for (double limit = 0.05; limit < 200; limit *= 1.7) {
            ang_budget budget = {limit, NAN};
            ang_choice choice = ang_budget_choose(list, 12, &budget);
            if (!choice.keeps_error) continue;
            assert_true(list[choice.index].ms <= ms);
            assert_true(list[choice.index].error <= limit);
            ms = list[choice.index].ms;
        }
    }
}

static void errors_and_steps_are_inverse(void **state) {
    (void)state;
    for (double order = 0.8; order < 2.5; order += 0.4)
        for (double limit = 0.3; limit < 40; limit *= 2) {
            double step = ang_budget_step(0.2, 3, order, 0.5, limit);
            assert_close(ang_budget_error(0.2, 3, order, step, 0.5), limit, 1e-9 * limit);
        }
    assert_close(ang_budget_step(0.2, 3, 2, 0.5, 0.2), 0, 0);
    assert_true(isinf(ang_budget_step(0.2, 0, 2, 0.5, 1)));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(terms_are_found_again),
        cmocka_unit_test(noise_makes_no_negative_terms),
        cmocka_unit_test(no_fit_promises_larger_pictures_for_nothing),
        cmocka_unit_test(what_a_model_misses_is_told),
        cmocka_unit_test(work_scales_with_pixels_and_steps),
        cmocka_unit_test(budgets_choose_what_is_expected),
        cmocka_unit_test(choices_are_monotone),
        cmocka_unit_test(errors_and_steps_are_inverse),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
