// The mean by mm of what is not padding.
uniform float mean_padding; // stored value of padding
uniform float mean_empty;   // stored value (any) shown where there is only padding

vec4 march(Ray ray, out float samples) {
    float reach = ray.leave - ray.enter;
    int count = lattice_count(reach);
    vec3 start = (ray.origin + ray.enter * ray.direction) * field_scale + field_offset;
    vec3 along = ray.direction * field_scale;
    // About padding the share of padding drops out, and sums stay small.
    float sum = 0.0;
    float tissue = 0.0;
    for (int i = 0; i < count; i++) {
        float piece = lattice_length(i, count, reach);
        vec3 coordinate = start + lattice_place(i, piece) * along;
        sum += piece * (field_at(coordinate) - mean_padding);
        tissue += piece * weight_at(coordinate);
    }
    samples = float(count);
    return window_grey(tissue > 0.0 ? mean_padding + sum / tissue : mean_empty);
}
