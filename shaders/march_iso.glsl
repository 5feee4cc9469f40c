// The first point at or above the iso value. A ray that starts inside meets a cut face, which shows its own value.
uniform float iso_stored; // stored value
uniform vec3 iso_colour;  // the transfer function's at the iso value

const int iso_refinements = 18; // halvings of one step

// mm from the entry; the sample before the first is the entry, the one after the last the exit.
float iso_at(March m, int i) {
    return i < 0 ? 0.0 : i < m.count ? lattice_place(i, lattice_length(i, m.count, m.reach)) : m.reach;
}

vec4 march(Ray ray, out float samples) {
    March m = march_along(ray);
    float value = stored_from(field_at(m.start));
    bool cut = value >= iso_stored;
    int evaluated = 1;
    int i = m.begin;
    int last = m.end == m.count ? m.count : m.end - 1;
    while (i <= last && value < iso_stored) {
        vec3 place = m.start + iso_at(m, i) * m.direction;
        int jump = skip_steps(place, m.rate);
        if (jump > 0) {
            i += jump;
            continue;
        }
        value = stored_from(field_at(place));
        evaluated++;
        i++;
    }
    samples = float(evaluated);
    if (value < iso_stored) return vec4(0.0);
    float before = cut ? 0.0 : iso_at(m, i - 2);
    float at = cut ? 0.0 : iso_at(m, i - 1);
    vec3 colour = iso_colour;
    if (cut) {
        colour = transfer_at(value).rgb;
    } else {
        for (int k = 0; k < iso_refinements; k++) {
            float middle = 0.5 * (before + at);
            if (stored_from(field_at(m.start + middle * m.direction)) >= iso_stored)
                at = middle;
            else
                before = middle;
        }
        samples += float(iso_refinements);
    }
    return vec4(shade(colour, m.start + at * m.direction, ray.direction_mm, true), 1.0);
}
