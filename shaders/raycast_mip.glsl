// The greatest stored value of a stretch.
const int pass_group = 2; // as in raycast_dvr.glsl

vec4 pass_value(Path path, int first) {
    float value = 0.0;
    int i = first;
    int end = min(first + pass_steps, path.count);
    while (i < end) {
        for (int k = 0; k < pass_group; k++) {
            vec3 place = path.start + lookup_at(i, path) * path.direction;
            value = i < end ? max(value, field_at(place)) : value;
            i++;
        }
    }
    return vec4(value);
}
