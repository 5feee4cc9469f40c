// The rays of a picture: ang_ray_frame in float (core/scene/scene.h). Index space is about the box's centre, t in mm
// along the ray and 0 on the plane of p.
uniform vec3 ray_origin;      // index
uniform vec3 ray_step_x;      // index
uniform vec3 ray_step_y;      // index
uniform vec3 ray_from_eye;    // index: origin - eye, subtracted in double; parallel: the axis per mm
uniform vec3 ray_from_eye_mm; // mm; parallel: the axis
uniform vec3 ray_step_x_mm;   // mm
uniform vec3 ray_step_y_mm;   // mm
uniform vec3 ray_axis_mm;     // unit
uniform float ray_spread;     // 1 perspective, 0 parallel
uniform float ray_near_depth; // mm along the axis
uniform vec3 box_lower;       // clip box, index
uniform vec3 box_upper;       // clip box, index

struct Ray {
    vec3 origin;       // index, at t = 0
    vec3 direction;    // index per mm
    vec3 direction_mm; // unit
    float enter;       // mm; nothing is met where enter >= leave
    float leave;       // mm
};

// The ray through picture coordinates (pixels, rows from the top).
Ray ray_through(vec2 pixel) {
    Ray ray;
    ray.origin = ray_origin + pixel.x * ray_step_x + pixel.y * ray_step_y;
    vec2 spread = ray_spread * pixel;
    vec3 along_mm = ray_from_eye_mm + spread.x * ray_step_x_mm + spread.y * ray_step_y_mm;
    vec3 along = ray_from_eye + spread.x * ray_step_x + spread.y * ray_step_y;
    float scale = 1.0 / sqrt(dot(along_mm, along_mm));
    ray.direction_mm = scale * along_mm;
    ray.direction = scale * along;

    ray.enter = ray_near_depth / dot(ray.direction_mm, ray_axis_mm);
    ray.leave = ray_limit(pixel);
    for (int axis = 0; axis < 3; axis++) {
        float low = box_lower[axis] - ray.origin[axis];
        float high = box_upper[axis] - ray.origin[axis];
        float d = ray.direction[axis];
        // A direction this small leads nowhere within the box, but its quotients would overflow.
        if (abs(d) < 1e-12) {
            if (low > 0.0 || high < 0.0) ray.leave = -1e30;
        } else {
            float t0 = low / d;
            float t1 = high / d;
            ray.enter = max(ray.enter, min(t0, t1));
            ray.leave = min(ray.leave, max(t0, t1));
        }
    }
    half_space_cut(ray.origin, ray.direction, ray.enter, ray.leave);
    return ray;
}
