#include "app/budget.h"

#include "io/json.h"

#include <math.h>

/* A prediction that is off by this factor, either way, is none. */
static const double far_off = 10;

bool ang_app_budget_given(const ang_options *options) {
    return !isnan(options->max_error) || !isnan(options->max_time);
}

bool ang_app_budget_plan(ang_app_budget *budget, const ang_options *options, ang_gl *gl, const ang_volume *volume,
                         ang_picture *picture, const ang_method *asked, const ang_progress *progress, ang_error *err) {
    *budget = (ang_app_budget){.given = true,
                               .budget = {options->max_error, options->max_time},
                               .pictures = options->orbit != 0 ? options->frames : 1,
                               .measured_ms = NAN};
    if (!ang_costs_load(gl, &budget->costs, &budget->origin, progress, err) ||
        !ang_planner_plan(gl, volume, &picture->scene, &picture->render, asked, &budget->budget, &budget->costs,
                          &budget->planned, progress, err))
        return false;
    if (budget->planned.step_voxels > 0) picture->render.step_voxels = budget->planned.step_voxels;
    picture->render.termination = budget->planned.termination;
    return true;
}

void ang_app_budget_explain(const ang_app_budget *budget, ang_plan *plan) {
    const ang_planned *planned = &budget->planned;
    const ang_cost_model *model = ang_costs_of(&budget->costs, planned->method->name);
    ang_plan_use(plan,
                 "budget: %s, step %.3g voxels, %s, of %zu possibilities; predicted %.1f ms, %.3g levels; planned in "
                 "%.0f ms",
                 planned->method->name, planned->step_voxels,
                 planned->stride == 1   ? "every pixel"
                 : planned->stride == 2 ? "every second pixel along each axis"
                                        : "every fourth pixel along each axis",
                 planned->candidates, planned->ms, planned->error, planned->planning_ms);
    if (model)
        ang_plan_use(
            plan,
            "cost model of %s: %.3g ms and %.3g us a ray, %.3g us a sample, %.3g us more where shaded, %.3g us "
            "a polygon; within %.0f %% in the median; %s in %.1f s",
            planned->method->name, model->term[0], 1e3 * model->term[1], 1e3 * model->term[2], 1e3 * model->term[3],
            1e3 * model->term[4], 100 * model->spread,
            budget->origin.cached ? "kept from before, when it was measured" : "measured now", budget->costs.ms / 1e3);
}

void ang_app_budget_check(ang_app_budget *budget, double measured_ms, ang_notes *warnings) {
    const ang_planned *planned = &budget->planned;
    budget->measured_ms = measured_ms;
    budget->error_kept = planned->keeps_error;
    budget->time_kept = isnan(budget->budget.max_ms) || measured_ms <= budget->budget.max_ms;
    if (planned->missed[0]) ang_notes_add(warnings, "%s", planned->missed);
    if (budget->pictures > 1)
        ang_notes_add(warnings,
                      "--max-error and --max-time were planned for and checked with the first of the %d pictures: the "
                      "others may be farther off and take longer",
                      budget->pictures);
    if (!budget->time_kept)
        ang_notes_add(warnings, "--max-time %.6g was missed: a frame took %.0f ms, %.0f were predicted",
                      budget->budget.max_ms, measured_ms, planned->ms);
    budget->forgotten = ang_cost_miss(planned->ms, measured_ms) >= far_off && !isnan(measured_ms) &&
                        ang_costs_forget(&budget->origin, planned->method->name);
    if (budget->forgotten)
        ang_notes_add(warnings,
                      "the cost model of %s was off by a factor of %.0f here and is dropped: the next picture with "
                      "--max-error or --max-time measures it anew",
                      planned->method->name, ang_cost_miss(planned->ms, measured_ms));
}

static cJSON *model_json(const ang_cost_model *model) {
    cJSON *out = cJSON_CreateObject();
    static const char *const names[ANG_COST_TERMS] = {"ms", "ms_ray", "ms_sample", "ms_shaded_sample", "ms_polygon"};
    for (int i = 0; i < ANG_COST_TERMS; i++) ang_json_add_number(out, names[i], model->term[i]);
    ang_json_add_number(out, "spread", model->spread);
    return out;
}

cJSON *ang_app_budget_json(const ang_app_budget *budget) {
    const ang_planned *planned = &budget->planned;
    cJSON *out = cJSON_CreateObject();
    ang_json_add_number(out, "max_error", budget->budget.max_error);
    ang_json_add_number(out, "max_time_ms", budget->budget.max_ms);
    cJSON_AddStringToObject(out, "method", planned->method->name);
    ang_json_add_number(out, "step_voxels", planned->step_voxels > 0 ? planned->step_voxels : NAN);
    cJSON_AddNumberToObject(out, "stride", planned->stride);
    cJSON_AddNumberToObject(out, "candidates", (double)planned->candidates);
    cJSON_AddNumberToObject(out, "refinements", planned->refinements);
    ang_json_add_number(out, "planning_ms", planned->planning_ms);
    ang_json_add_number(out, "predicted_ms", planned->ms);
    ang_json_add_number(out, "measured_ms", budget->measured_ms);
    ang_json_add_number(out, "error", planned->error);
    ang_json_add_number(out, "interpolation", planned->between.max);
    cJSON_AddStringToObject(out, "checked", "the first picture");
    cJSON_AddBoolToObject(out, "error_kept", budget->error_kept);
    cJSON_AddBoolToObject(out, "time_kept", budget->time_kept);
    cJSON *costs = cJSON_AddObjectToObject(out, "cost_models");
    cJSON_AddStringToObject(costs, "gl_renderer", budget->origin.gl);
    cJSON_AddStringToObject(costs, "processor", budget->origin.processor);
    cJSON_AddBoolToObject(costs, "cached", budget->origin.cached);
    cJSON_AddBoolToObject(costs, "dropped", budget->forgotten);
    ang_json_add_number(costs, "measuring_ms", budget->costs.ms);
    for (size_t i = 0; i < budget->costs.count; i++)
        cJSON_AddItemToObject(costs, budget->costs.of[i].method, model_json(&budget->costs.of[i].model));
    return out;
}
