/* Cubics on [0, 1]: what trilinear interpolation is along a straight line through a cell. Pure, thread safe. */
#ifndef ANG_MATH_POLYNOMIAL_H
#define ANG_MATH_POLYNOMIAL_H

/* c[0] + c[1] s + c[2] s^2 + c[3] s^3 */
typedef struct ang_cubic {
    double c[4];
} ang_cubic;

static inline double ang_cubic_at(const ang_cubic *f, double s) {
    return f->c[0] + s * (f->c[1] + s * (f->c[2] + s * f->c[3]));
}

/* Trilinear interpolation of eight corner values (x fastest) along start + s * step, local coordinates in 0..1. */
ang_cubic ang_cubic_in_cell(const double corner[8], const double start[3], const double step[3]);

/* Integral over [0, 1]. */
static inline double ang_cubic_integral(const ang_cubic *f) {
    return f->c[0] + f->c[1] / 2 + f->c[2] / 3 + f->c[3] / 4;
}

/* The ends of the stretches of [0, 1] on which f is monotone, ascending, 0 and 1 included; returns how many (2..4). */
int ang_cubic_monotone(const ang_cubic *f, double ends[4]);

/* The place in [low, high], on which f is monotone and crosses `target`, where f = target, to rounding. */
double ang_cubic_solve(const ang_cubic *f, double target, double low, double high);

/* All places in (0, 1) where f crosses `target`, ascending; returns how many (0..3). A constant f crosses nowhere. */
int ang_cubic_crossings(const ang_cubic *f, double target, double places[3]);

#endif
