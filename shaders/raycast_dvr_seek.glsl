// Emission and absorption of a stretch, front to back, where shading costs far more than looking for a sample to be
// shaded (as in march_dvr_seek.glsl).
vec4 pass_value(Path path, int first) {
    vec3 colour = vec3(0.0);
    float opacity = 0.0;
    vec3 along = along_mm(gl_FragCoord.xy);
    int i = first;
    int end = min(first + pass_steps, path.count);
    StepEnd at = step_end(node_place(path, first));
    while (i < end) {
        vec4 medium;
        vec3 place;
        float piece;
        do {
            piece = lattice_length(i, path.count, path.reach);
            place = path.start + lattice_place(i, piece) * path.direction;
            medium = step_medium(place, node_place(path, i + 1), piece, at);
            i++;
        } while (!(medium.a > 0.0) && i < end);
        bool shows = medium.a > 0.0;
        float added = shows ? (1.0 - opacity) * opacity_of(medium.a * piece) : 0.0;
        colour += added * shade(medium.rgb, place, along, shows);
        opacity += added;
    }
    return vec4(colour, opacity);
}
