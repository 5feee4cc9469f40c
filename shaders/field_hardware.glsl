// Interpolation by the texture unit.
float field_at(vec3 coordinate) {
    return field_stored(textureLod(field_values, coordinate, 0.0).r);
}
