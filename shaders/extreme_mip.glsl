const float extreme_nothing = 0.0;

float extreme_of(float a, float b) {
    return max(a, b);
}
