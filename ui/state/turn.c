#include "ui/state/turn.h"

const ang_turn ang_turn_none = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};

static bool same(ang_vec3 a, ang_vec3 b) { return ang_vec3_length(ang_vec3_sub(a, b)) == 0; }

bool ang_turn_same(const ang_turn *a, const ang_turn *b) {
    return same(a->x, b->x) && same(a->y, b->y) && same(a->z, b->z);
}

ang_vec3 ang_turn_direction(const ang_turn *turn, ang_vec3 d) {
    return ang_vec3_along(ang_vec3_along(ang_vec3_scale(turn->x, d.x), turn->y, d.y), turn->z, d.z);
}

/* Rodrigues. */
static ang_vec3 rotated(ang_vec3 v, ang_vec3 axis, double radians) {
    double c = cos(radians), s = sin(radians);
    ang_vec3 out = ang_vec3_along(ang_vec3_scale(v, c), ang_vec3_cross(axis, v), s);
    return ang_vec3_along(out, axis, ang_vec3_dot(axis, v) * (1 - c));
}

/* Components within rounding of 0 and 1 become so, zero without a sign. */
static double exact(double value) {
    static const double rounding = 1e-12;
    double whole = round(value);
    return fabs(value - whole) < rounding ? whole + 0.0 : value;
}

static ang_vec3 exact_vector(ang_vec3 v) { return (ang_vec3){exact(v.x), exact(v.y), exact(v.z)}; }

bool ang_turn_mend(ang_turn *turn) {
    static const double tolerance = 1e-3;
    ang_vec3 cross = ang_vec3_cross(turn->x, turn->y);
    bool units = fabs(ang_vec3_length(turn->x) - 1) < tolerance && fabs(ang_vec3_length(turn->y) - 1) < tolerance;
    bool square = fabs(ang_vec3_dot(turn->x, turn->y)) < tolerance;
    if (!units || !square || !(ang_vec3_length(ang_vec3_sub(cross, turn->z)) < 4 * tolerance)) return false;
    ang_vec3 x = ang_vec3_unit(turn->x);
    ang_vec3 y = ang_vec3_unit(ang_vec3_along(turn->y, x, -ang_vec3_dot(turn->y, x)));
    turn->x = exact_vector(x);
    turn->y = exact_vector(y);
    turn->z = exact_vector(ang_vec3_cross(turn->x, turn->y));
    return true;
}

ang_turn ang_turn_about(const ang_turn *turn, ang_vec3 axis, double degrees) {
    double radians = degrees * M_PI / 180;
    ang_turn out = {rotated(turn->x, axis, radians), rotated(turn->y, axis, radians), rotated(turn->z, axis, radians)};
    ang_turn_mend(&out);
    return out;
}
