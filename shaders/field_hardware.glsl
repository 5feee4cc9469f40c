// The stored value, interpolated by the texture unit.
float field_at(vec3 place) {
    return 65535.0 * textureLod(field_values, place * field_scale + field_offset, 0.0).r;
}
