// The clip plane cuts a half-space away: ang_ray_frame's `beyond` in float.
uniform vec4 half_space_beyond; // mm beyond the plane, of a place: gradient and constant

bool half_space_has(vec3 place) {
    return dot(half_space_beyond.xyz, place) + half_space_beyond.w <= 0.0;
}

void half_space_cut(vec3 origin, vec3 direction, inout float enter, inout float leave) {
    float beyond = dot(half_space_beyond.xyz, origin) + half_space_beyond.w;
    float rate = dot(half_space_beyond.xyz, direction);
    // As for the faces of the box (ray.glsl).
    if (abs(rate) < 1e-12) {
        if (beyond > 0.0) leave = -1e30;
    } else if (rate < 0.0) {
        enter = max(enter, -beyond / rate);
    } else {
        leave = min(leave, -beyond / rate);
    }
}
