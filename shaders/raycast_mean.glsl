// Sums of a stretch for the mean (march_mean.glsl): x about padding, y mm of tissue. Blending adds up hundreds of them:
// the part that is a multiple of a large unit adds up without rounding, the rest is small (Dekker).
uniform float mean_base;
uniform vec2 mean_unit; // powers of two, of which a ray's sums are few enough for a float

vec4 pass_value(Path path, int first) {
    vec2 sum = vec2(0.0);
    precise vec2 lost = vec2(0.0);
    int end = min(first + pass_steps, path.count);
    for (int i = first; i < end; i++) {
        float piece = lattice_length(i, path.count, path.reach);
        vec3 place = path.start + lattice_place(i, piece) * path.direction;
        precise vec2 term = piece * vec2(field_at(place) - mean_base, weight_at(place)) - lost;
        precise vec2 next = sum + term;
        lost = (next - sum) - term;
        sum = next;
    }
    precise vec2 coarse = roundEven(sum / mean_unit) * mean_unit;
    precise vec2 fine = sum - coarse - lost;
    return vec4(coarse, fine);
}
