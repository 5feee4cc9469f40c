// The greatest stored value of a stretch.
vec4 pass_value(Path path, int first) {
    float value = 0.0;
    for (int k = 0; k < pass_steps; k++) {
        int i = first + k;
        vec3 place = path.start + lookup_at(i, path) * path.direction;
        value = i < path.count ? max(value, field_at(place)) : value;
    }
    return vec4(value);
}
