// The first point at or above the iso value. A ray that starts inside meets a cut face, which shows its own value.
uniform float iso_stored; // stored value
uniform vec3 iso_colour;  // the transfer function's at the iso value

const int iso_refinements = 18; // halvings of one step

vec4 march(Ray ray, out float samples) {
    float reach = ray.leave - ray.enter;
    int count = lattice_count(reach);
    vec3 start = ray.origin + ray.enter * ray.direction;
    float before = 0.0;
    float at = 0.0;
    float value = stored_from(field_at(start));
    bool cut = value >= iso_stored;
    int evaluated = 1;
    // The sample after the last is the exit.
    for (int i = 0; i <= count && value < iso_stored; i++) {
        before = at;
        at = i < count ? lattice_place(i, lattice_length(i, count, reach)) : reach;
        value = stored_from(field_at(start + at * ray.direction));
        evaluated++;
    }
    samples = float(evaluated);
    if (value < iso_stored) return vec4(0.0);
    vec3 colour = iso_colour;
    if (cut) {
        colour = transfer_at(value).rgb;
    } else {
        for (int i = 0; i < iso_refinements; i++) {
            float middle = 0.5 * (before + at);
            if (stored_from(field_at(start + middle * ray.direction)) >= iso_stored)
                at = middle;
            else
                before = middle;
        }
        samples += float(iso_refinements);
    }
    return vec4(shade(colour, start + at * ray.direction, ray.direction_mm, true), 1.0);
}
