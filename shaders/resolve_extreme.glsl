float resolve_value(vec4 accumulated) {
    return accumulated.r;
}
