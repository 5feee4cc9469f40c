// Emission and absorption, front to back, where shading costs far more than looking for a sample to be shaded. Software
// GL runs both sides of every branch but leaves a loop when all its pixels have: the inner loop spares it the shading
// of what is invisible.
uniform float termination; // accumulated opacity at which a ray stops

vec4 march(Ray ray, out float samples) {
    March m = march_along(ray);
    vec3 colour = vec3(0.0);
    float opacity = 0.0;
    int taken = 0;
    int i = m.begin;
    while (i < m.end && opacity < termination) {
        vec4 medium;
        vec3 place;
        float piece;
        bool shows;
        do {
            place = march_place(m, i, piece);
            int jump = skip_steps(place, m.rate);
            medium = transfer_at(stored_from(field_at(place)));
            shows = jump == 0 && medium.a > 0.0;
            taken += int(jump == 0);
            i += max(jump, 1);
        } while (!shows && i < m.end);
        float added = shows ? (1.0 - opacity) * opacity_of(medium.a * piece) : 0.0;
        colour += added * shade(medium.rgb, place, ray.direction_mm, shows);
        opacity += added;
    }
    samples = float(taken);
    return vec4(colour, opacity);
}
