vec3 shade(vec3 colour, vec3 coordinate, vec3 direction_mm) {
    return colour;
}
