// 1 - exp(-z) for 0 <= z < 0.5 without cancellation (numerics.md): all that this scene has.
float opacity_of(float z) {
    return opacity_series(z);
}
