#include "core/math/polynomial.h"

#include <math.h>
#include <stdbool.h>

ang_cubic ang_cubic_in_cell(const double corner[8], const double start[3], const double step[3]) {
    /* Interpolate in x to linear, in y to quadratic, in z to cubic polynomials of s. */
    double x[4][2], y[2][3];
    for (int i = 0; i < 4; i++) {
        double rise = corner[2 * i + 1] - corner[2 * i];
        x[i][0] = corner[2 * i] + rise * start[0];
        x[i][1] = rise * step[0];
    }
    for (int i = 0; i < 2; i++) {
        double rise0 = x[2 * i + 1][0] - x[2 * i][0], rise1 = x[2 * i + 1][1] - x[2 * i][1];
        y[i][0] = x[2 * i][0] + rise0 * start[1];
        y[i][1] = x[2 * i][1] + rise0 * step[1] + rise1 * start[1];
        y[i][2] = rise1 * step[1];
    }
    double rise[3] = {y[1][0] - y[0][0], y[1][1] - y[0][1], y[1][2] - y[0][2]};
    return (ang_cubic){{y[0][0] + rise[0] * start[2], y[0][1] + rise[0] * step[2] + rise[1] * start[2],
                        y[0][2] + rise[1] * step[2] + rise[2] * start[2], rise[2] * step[2]}};
}

int ang_cubic_monotone(const ang_cubic *f, double ends[4]) {
    int count = 0;
    ends[count++] = 0;
    /* Roots of c1 + 2 c2 s + 3 c3 s^2, by the form that does not cancel. */
    double a = 3 * f->c[3], b = f->c[2], c = f->c[1];
    double discriminant = b * b - a * c;
    if (discriminant > 0) {
        double q = -(b + copysign(sqrt(discriminant), b));
        double r0 = q / a, r1 = c / q;
        if (r0 > r1) {
            double swap = r0;
            r0 = r1;
            r1 = swap;
        }
        if (r0 > 0 && r0 < 1) ends[count++] = r0;
        if (r1 > 0 && r1 < 1 && r1 > ends[count - 1]) ends[count++] = r1;
    }
    ends[count++] = 1;
    return count;
}

double ang_cubic_solve(const ang_cubic *f, double target, double low, double high) {
    double at_low = ang_cubic_at(f, low) - target;
    bool rising = at_low < 0;
    double s = 0.5 * (low + high);
    for (int i = 0; i < 80; i++) {
        double value = ang_cubic_at(f, s) - target;
        if (value == 0) return s;
        if ((value < 0) == rising)
            low = s;
        else
            high = s;
        double slope = f->c[1] + s * (2 * f->c[2] + s * 3 * f->c[3]);
        double newton = s - value / slope;
        double next = newton > low && newton < high ? newton : 0.5 * (low + high);
        if (fabs(next - s) <= 1e-16 || next == low || next == high) return next;
        s = next;
    }
    return s;
}

int ang_cubic_crossings(const ang_cubic *f, double target, double places[3]) {
    double ends[4];
    int stretches = ang_cubic_monotone(f, ends) - 1, count = 0;
    for (int i = 0; i < stretches; i++) {
        double low = ang_cubic_at(f, ends[i]) - target, high = ang_cubic_at(f, ends[i + 1]) - target;
        if (low == high || (low < 0) == (high < 0)) continue;
        double s = ang_cubic_solve(f, target, ends[i], ends[i + 1]);
        if (s > 0 && s < 1 && (count == 0 || s > places[count - 1])) places[count++] = s;
    }
    return count;
}
