// Along the ray, mm, of any length.
vec3 along_mm(vec2 pixel) {
    vec2 spread = ray_spread * pixel;
    return ray_from_eye_mm + spread.x * ray_step_x_mm + spread.y * ray_step_y_mm;
}
