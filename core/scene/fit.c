#include "core/scene/fit.h"

#include <math.h>

static const double air_hu = -500;

void ang_volume_body_box(const ang_volume *volume, ang_vec3 *lower, ang_vec3 *upper) {
    const int *dims = volume->dims;
    double air = ang_volume_stored(volume, air_hu);
    int least[3] = {dims[0], dims[1], dims[2]}, most[3] = {-1, -1, -1};
    size_t index = 0;
    for (int z = 0; z < dims[2]; z++)
        for (int y = 0; y < dims[1]; y++)
            for (int x = 0; x < dims[0]; x++, index++) {
                if (!(volume->data[index] > air) || ang_volume_is_padding(volume, index)) continue;
                const int at[3] = {x, y, z};
                for (int axis = 0; axis < 3; axis++) {
                    if (at[axis] < least[axis]) least[axis] = at[axis];
                    if (at[axis] > most[axis]) most[axis] = at[axis];
                }
            }
    if (most[0] < 0) {
        ang_volume_box(volume, lower, upper);
        return;
    }
    *lower = (ang_vec3){least[0], least[1], least[2]};
    *upper = (ang_vec3){most[0], most[1], most[2]};
}

double ang_view_fitting_zoom(const ang_volume *volume, ang_vec3 lower, ang_vec3 upper, const ang_view *view, int width,
                             int height) {
    ang_view whole = *view;
    whole.zoom = 1;
    whole.pan_mm[0] = whole.pan_mm[1] = 0;
    ang_camera camera = ang_camera_for(volume, &whole);
    bool perspective = view->projection == ANG_PERSPECTIVE;
    double slope = perspective ? tan(view->fov_deg * (M_PI / 360)) : 1, aspect = (double)width / height, least = 0;
    ang_vec3 centre = ang_volume_centre(volume);
    for (int i = 0; i < 8; i++) {
        ang_vec3 corner = {i & 1 ? upper.x : lower.x, i & 2 ? upper.y : lower.y, i & 4 ? upper.z : lower.z};
        ang_vec3 from = ang_vec3_sub(ang_mat4_point(&volume->affine, corner), centre);
        double across = fabs(ang_vec3_dot(from, camera.right)) / aspect, up = fabs(ang_vec3_dot(from, camera.up));
        double behind = perspective ? ang_vec3_dot(from, camera.forward) : 0; /* of the centre */
        least = fmax(least, fmax(across, up) / slope - behind);
    }
    return least > 0 ? (perspective ? camera.focus_mm : camera.half_height) / least : 1;
}
