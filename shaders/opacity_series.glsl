// 1 - exp(-z) for 0 <= z < 0.5 to float precision, without the cancellation of the formula (numerics.md).
float opacity_series(float z) {
    float series = 1.0 - z * (1.0 / 8.0);
    series = 1.0 - z * (1.0 / 7.0) * series;
    series = 1.0 - z * (1.0 / 6.0) * series;
    series = 1.0 - z * (1.0 / 5.0) * series;
    series = 1.0 - z * (1.0 / 4.0) * series;
    series = 1.0 - z * (1.0 / 3.0) * series;
    series = 1.0 - z * (1.0 / 2.0) * series;
    return z * series;
}
