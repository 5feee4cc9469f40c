// Emission and absorption of a stretch, front to back. Software GL runs a loop of known length at twice the speed: it
// goes on beyond the end of the ray, where nothing is added.
vec4 pass_value(Path path, int first) {
    vec3 colour = vec3(0.0);
    float opacity = 0.0;
    for (int k = 0; k < pass_steps; k++) {
        int i = first + k;
        float piece = lattice_length(i, path.count, path.reach);
        vec3 place = path.start + lattice_place(i, piece) * path.direction;
        vec4 medium = transfer_at(stored_from(field_at(place)));
        float added = i < path.count ? (1.0 - opacity) * opacity_of(medium.a * piece) : 0.0;
        colour += added * medium.rgb;
        opacity += added;
    }
    return vec4(colour, opacity);
}
