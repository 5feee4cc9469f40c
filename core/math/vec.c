#include "core/math/vec.h"

ang_mat4 ang_mat4_identity(void) { return (ang_mat4){{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}}}; }

ang_vec3 ang_mat4_direction(const ang_mat4 *a, ang_vec3 d) {
    return (ang_vec3){a->m[0][0] * d.x + a->m[0][1] * d.y + a->m[0][2] * d.z,
                      a->m[1][0] * d.x + a->m[1][1] * d.y + a->m[1][2] * d.z,
                      a->m[2][0] * d.x + a->m[2][1] * d.y + a->m[2][2] * d.z};
}

ang_vec3 ang_mat4_point(const ang_mat4 *a, ang_vec3 p) {
    ang_vec3 d = ang_mat4_direction(a, p);
    return (ang_vec3){d.x + a->m[0][3], d.y + a->m[1][3], d.z + a->m[2][3]};
}

ang_vec3 ang_mat4_transposed_direction(const ang_mat4 *a, ang_vec3 v) {
    return (ang_vec3){a->m[0][0] * v.x + a->m[1][0] * v.y + a->m[2][0] * v.z,
                      a->m[0][1] * v.x + a->m[1][1] * v.y + a->m[2][1] * v.z,
                      a->m[0][2] * v.x + a->m[1][2] * v.y + a->m[2][2] * v.z};
}

double ang_mat4_determinant(const ang_mat4 *a) {
    return ang_vec3_dot(ang_mat4_column(a, 0), ang_vec3_cross(ang_mat4_column(a, 1), ang_mat4_column(a, 2)));
}

bool ang_mat4_inverse(const ang_mat4 *a, ang_mat4 *inverse) {
    ang_vec3 x = ang_mat4_column(a, 0), y = ang_mat4_column(a, 1), z = ang_mat4_column(a, 2);
    double determinant = ang_mat4_determinant(a);
    double size = ang_vec3_length(x) * ang_vec3_length(y) * ang_vec3_length(z);
    if (!(fabs(determinant) > 1e-12 * size)) return false;
    ang_vec3 rows[3] = {ang_vec3_cross(y, z), ang_vec3_cross(z, x), ang_vec3_cross(x, y)};
    ang_vec3 origin = {a->m[0][3], a->m[1][3], a->m[2][3]};
    *inverse = ang_mat4_identity();
    for (int i = 0; i < 3; i++) {
        ang_vec3 row = ang_vec3_scale(rows[i], 1 / determinant);
        inverse->m[i][0] = row.x;
        inverse->m[i][1] = row.y;
        inverse->m[i][2] = row.z;
        inverse->m[i][3] = -ang_vec3_dot(row, origin);
    }
    return true;
}
