// ang_scene_grey over stored values.
uniform float window_lower; // stored value that is black
uniform float window_scale; // grey in one stored value

vec4 window_grey(float stored) {
    return vec4(vec3(clamp((stored - window_lower) * window_scale, 0.0, 1.0)), 1.0);
}
