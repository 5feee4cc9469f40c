// Emission and absorption, front to back.
uniform float termination; // accumulated opacity at which a ray stops

vec4 march(Ray ray, out float samples) {
    float reach = ray.leave - ray.enter;
    int count = lattice_count(reach);
    vec3 start = ray.origin + ray.enter * ray.direction;
    vec3 colour = vec3(0.0);
    float opacity = 0.0;
    int i = 0;
    while (i < count && opacity < termination) {
        vec4 medium;
        vec3 place;
        float piece;
        // Software GL runs both sides of every branch but leaves a loop when all its pixels have: the inner loop spares
        // it the shading of what is invisible.
        do {
            piece = lattice_length(i, count, reach);
            place = start + lattice_place(i, piece) * ray.direction;
            i++;
            medium = transfer_at(stored_from(field_at(place)));
        } while (medium.a <= 0.0 && i < count);
        float added = (1.0 - opacity) * opacity_of(medium.a * piece);
        colour += added * shade(medium.rgb, place, ray.direction_mm, true);
        opacity += added;
    }
    samples = float(i);
    return vec4(colour, opacity);
}
