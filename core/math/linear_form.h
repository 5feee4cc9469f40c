/* A linear function of places, and its range over a box. All functions are pure and thread safe. */
#ifndef ANG_MATH_LINEAR_FORM_H
#define ANG_MATH_LINEAR_FORM_H

#include "core/math/vec.h"

/* gradient . p + constant */
typedef struct ang_linear_form {
    ang_vec3 gradient;
    double constant;
} ang_linear_form;

static inline double ang_linear_form_at(const ang_linear_form *form, ang_vec3 p) {
    return ang_vec3_dot(form->gradient, p) + form->constant;
}

/* The least and the greatest value over the box from `lower` to `upper`. */
double ang_linear_form_least(const ang_linear_form *form, ang_vec3 lower, ang_vec3 upper);
double ang_linear_form_greatest(const ang_linear_form *form, ang_vec3 lower, ang_vec3 upper);

#endif
