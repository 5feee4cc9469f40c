const float extreme_nothing = 65535.0;

float extreme_of(float a, float b) {
    return min(a, b);
}
