// 1 - exp(-z) for z >= 0; opaque table entries have z beyond 1e20 and give exactly 1.
float opacity_of(float z) {
    return z < 0.5 ? opacity_series(z) : 1.0 - exp(-z);
}
