#include "core/math/linear_form.h"

double ang_linear_form_greatest(const ang_linear_form *form, ang_vec3 lower, ang_vec3 upper) {
    double sum = form->constant;
    for (int axis = 0; axis < 3; axis++) {
        double g = ang_vec3_at(form->gradient, axis);
        sum += fmax(g * ang_vec3_at(lower, axis), g * ang_vec3_at(upper, axis));
    }
    return sum;
}

double ang_linear_form_least(const ang_linear_form *form, ang_vec3 lower, ang_vec3 upper) {
    ang_linear_form negative = {ang_vec3_scale(form->gradient, -1), -form->constant};
    return -ang_linear_form_greatest(&negative, lower, upper);
}
