float field_at(vec3 coordinate) {
    return field_stored(trilinear(field_values, coordinate));
}
