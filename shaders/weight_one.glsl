float weight_at(vec3 coordinate) {
    return 1.0;
}
