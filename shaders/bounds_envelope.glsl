// Rays are followed from the nearest to the farthest face of the envelope (hull_range.glsl), on the lattice of the whole
// ray.
uniform sampler2D envelope_range;

void bounds_of(Ray ray, float reach, int count, out int begin, out int end) {
    vec3 range = texelFetch(envelope_range, ivec2(gl_FragCoord.xy), 0).rgb;
    // Where a face that is left through comes first, the ray starts inside.
    float from = envelope_inside && range.b <= range.r ? 0.0 : range.r;
    float to = -range.g;
    // A twentieth of a step for the rounding of both. The last sample lies before its place on the lattice.
    float half_step = step_whole ? 0.5 : 0.0;
    begin = clamp(int(ceil(from / lattice_step - 0.55 - half_step)), 0, count);
    end = to < 0.0 ? 0 : to >= float(count - 1) * lattice_step ? count : min(int(floor(to / lattice_step - 0.45 + half_step)) + 1, count);
}
