// Emission and absorption of a stretch, front to back, in twos, which software GL runs faster, and not beyond the end of
// the ray: where the depth test does not end rays the longest of them would make all the others as long.
const int pass_group = 2;

vec4 pass_value(Path path, int first) {
    vec3 colour = vec3(0.0);
    float opacity = 0.0;
    int i = first;
    int end = min(first + pass_steps, path.count);
    StepEnd at = step_end(node_place(path, first));
    while (i < end) {
        for (int k = 0; k < pass_group; k++) {
            float piece = lattice_length(i, path.count, path.reach);
            vec3 place = path.start + lattice_place(i, piece) * path.direction;
            vec4 medium = step_medium(place, node_place(path, i + 1), piece, at);
            float added = i < end ? (1.0 - opacity) * opacity_of(medium.a * piece) : 0.0;
            colour += added * medium.rgb;
            opacity += added;
            i++;
        }
    }
    return vec4(colour, opacity);
}
