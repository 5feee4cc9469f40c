float weight_at(vec3 place) {
    return 1.0;
}
