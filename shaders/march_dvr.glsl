// Emission and absorption, front to back.
uniform float termination; // accumulated opacity at which a ray stops

vec4 march(Ray ray, out float samples) {
    March m = march_along(ray);
    vec3 colour = vec3(0.0);
    float opacity = 0.0;
    int taken = 0;
    int i = m.begin;
    StepEnd at;
    bool known = false; // `at` is where step i begins
    // Software GL runs all of a loop's body for all of its pixels: one flat loop costs it less than one for skipping
    // inside another for shading.
    while (i < m.end && opacity < termination) {
        float piece;
        vec3 place = march_place(m, i, piece);
        int jump = skip_steps(step_whole ? march_node(m, i) : place, m.rate);
        if (jump > 0) {
            i += jump;
            known = false;
            continue;
        }
        // A loop, which software GL leaves out where no pixel needs it.
        while (step_whole && !known) {
            at = step_end(march_node(m, i));
            known = true;
        }
        for (int k = 0; k < march_group; k++) {
            place = march_place(m, i, piece);
            bool counts = i < m.count && opacity < termination;
            vec4 medium = step_medium(place, march_node(m, i + 1), piece, at);
            float added = counts ? (1.0 - opacity) * opacity_of(medium.a * piece) : 0.0;
            colour += added * shade(medium.rgb, place, ray.direction_mm, added > 0.0);
            opacity += added;
            taken += int(counts && (count_all || medium.a > 0.0));
            i++;
        }
    }
    samples = float(taken);
    return vec4(colour, opacity);
}
