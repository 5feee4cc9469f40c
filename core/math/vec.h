/* Vectors and matrices of double for geometry on the CPU. All functions are pure and thread safe. */
#ifndef ANG_MATH_VEC_H
#define ANG_MATH_VEC_H

#include <math.h>
#include <stdbool.h>

typedef struct ang_vec3 {
    double x, y, z;
} ang_vec3;

/* An affine map: p -> m[0..2][0..2] p + m[0..2][3]; the last row is 0 0 0 1. Rows first. */
typedef struct ang_mat4 {
    double m[4][4];
} ang_mat4;

static inline ang_vec3 ang_vec3_add(ang_vec3 a, ang_vec3 b) { return (ang_vec3){a.x + b.x, a.y + b.y, a.z + b.z}; }
static inline ang_vec3 ang_vec3_sub(ang_vec3 a, ang_vec3 b) { return (ang_vec3){a.x - b.x, a.y - b.y, a.z - b.z}; }
static inline ang_vec3 ang_vec3_scale(ang_vec3 a, double s) { return (ang_vec3){a.x * s, a.y * s, a.z * s}; }
/* a + s b */
static inline ang_vec3 ang_vec3_along(ang_vec3 a, ang_vec3 b, double s) {
    return (ang_vec3){a.x + s * b.x, a.y + s * b.y, a.z + s * b.z};
}
static inline double ang_vec3_dot(ang_vec3 a, ang_vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
static inline ang_vec3 ang_vec3_cross(ang_vec3 a, ang_vec3 b) {
    return (ang_vec3){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
static inline double ang_vec3_length(ang_vec3 a) { return sqrt(ang_vec3_dot(a, a)); }
/* The unit vector along a; a zero vector stays zero. */
static inline ang_vec3 ang_vec3_unit(ang_vec3 a) {
    double length = ang_vec3_length(a);
    return length > 0 ? ang_vec3_scale(a, 1 / length) : a;
}
static inline double ang_vec3_at(ang_vec3 a, int axis) { return axis == 0 ? a.x : axis == 1 ? a.y : a.z; }

/* Column `axis` of the linear part: where one step along an index axis leads. */
static inline ang_vec3 ang_mat4_column(const ang_mat4 *a, int axis) {
    return (ang_vec3){a->m[0][axis], a->m[1][axis], a->m[2][axis]};
}

/* The identity. */
ang_mat4 ang_mat4_identity(void);
/* a point, translation included */
ang_vec3 ang_mat4_point(const ang_mat4 *a, ang_vec3 p);
/* a direction, without the translation */
ang_vec3 ang_mat4_direction(const ang_mat4 *a, ang_vec3 d);
/* The transposed linear part applied to v: with a = inverse(affine) it takes an index-space gradient to mm. */
ang_vec3 ang_mat4_transposed_direction(const ang_mat4 *a, ang_vec3 v);
/* The determinant of the linear part. */
double ang_mat4_determinant(const ang_mat4 *a);
/* The inverse of an affine map; false where the linear part is singular to working precision. */
bool ang_mat4_inverse(const ang_mat4 *a, ang_mat4 *inverse);

#endif
