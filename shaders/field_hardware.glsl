// Interpolation by the texture unit.
float field_at(vec3 place) {
    return field_stored(textureLod(field_values, place * field_scale + field_offset, 0.0).r);
}
