// The minimum along the ray.
vec4 march(Ray ray, out float samples) {
    float reach = ray.leave - ray.enter;
    int count = lattice_count(reach);
    vec3 start = ray.origin + ray.enter * ray.direction;
    float found = 65535.0;
    for (int i = 0; i < count; i++) {
        float piece = lattice_length(i, count, reach);
        found = min(found, field_at(start + lattice_place(i, piece) * ray.direction));
    }
    samples = float(count);
    return window_grey(found);
}
