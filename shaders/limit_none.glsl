// Nothing opaque ends rays.
float ray_limit(vec2 pixel) {
    return 1e30;
}
