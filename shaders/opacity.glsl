// 1 - exp(-z) for z >= 0 without cancellation (numerics.md); opaque table entries have z beyond 1e20 and give exactly 1.
float opacity_of(float z) {
    float series = 1.0 - z * (1.0 / 8.0);
    series = 1.0 - z * (1.0 / 7.0) * series;
    series = 1.0 - z * (1.0 / 6.0) * series;
    series = 1.0 - z * (1.0 / 5.0) * series;
    series = 1.0 - z * (1.0 / 4.0) * series;
    series = 1.0 - z * (1.0 / 3.0) * series;
    series = 1.0 - z * (1.0 / 2.0) * series;
    return z < 0.5 ? z * series : 1.0 - exp(-z);
}
