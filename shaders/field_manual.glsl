float field_at(vec3 place) {
    return field_stored(trilinear(field_values, place));
}
