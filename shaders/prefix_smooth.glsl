// Nothing is opaque at once.
vec4 medium_between(StepEnd a, StepEnd b, float piece) {
    return medium_of(mean_from(a, b));
}
