// Emission and absorption, front to back, where every sample is taken and shading costs far more than that. Software GL
// runs both sides of every branch but leaves a loop when all its pixels have: the inner loop spares it the shading of
// what is invisible. It cannot jump: with a step that differs from pixel to pixel llvmpipe 22.3 hands on values of
// rounds that a pixel had left the loop before (test_envelope compares with march_dvr.glsl to the bit).
uniform float termination; // accumulated opacity at which a ray stops

vec4 march(Ray ray, out float samples) {
    March m = march_along(ray);
    vec3 colour = vec3(0.0);
    float opacity = 0.0;
    int i = m.begin;
    StepEnd at = step_end(march_node(m, i));
    while (i < m.end && opacity < termination) {
        vec4 medium;
        vec3 place;
        float piece;
        do {
            place = march_place(m, i, piece);
            i++;
            medium = step_medium(place, march_node(m, i), piece, at);
        } while (medium.a <= 0.0 && i < m.end);
        float added = (1.0 - opacity) * opacity_of(medium.a * piece);
        colour += added * shade(medium.rgb, place, ray.direction_mm, true);
        opacity += added;
    }
    samples = float(i - m.begin);
    return vec4(colour, opacity);
}
