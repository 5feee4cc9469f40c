// The stored value, interpolated here.
float field_at(vec3 place) {
    return 65535.0 * trilinear(field_values, place);
}
