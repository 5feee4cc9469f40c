// The extreme value along the ray.
vec4 march(Ray ray, out float samples) {
    March m = march_along(ray);
    float found = extreme_nothing;
    int taken = 0;
    int i = m.begin;
    while (i < m.end) {
        float piece;
        vec3 place = march_place(m, i, piece);
        int jump = skip_steps(place, m.rate);
        if (jump > 0) {
            i += jump;
            continue;
        }
        for (int k = 0; k < march_group; k++) {
            place = march_place(m, i, piece);
            found = i < m.count ? extreme_of(found, field_at(place)) : found;
            taken += int(i < m.count);
            i++;
        }
    }
    samples = float(taken);
    return window_grey(found);
}
