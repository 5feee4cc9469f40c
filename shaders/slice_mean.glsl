// Sums for the mean: about padding, the share of padding drops out (as in march_mean.glsl); mm of tissue.
// Both about a typical value, which keeps the sums small.
uniform float mean_base;
uniform float mean_typical; // stored value

vec4 slice_value(vec2 pixel, Slab slab) {
    float weight = weight_at(slab.place);
    float above = field_at(slab.place) - mean_base - weight * (mean_typical - mean_base);
    return slab.length * vec4(above, weight, 0.0, 0.0);
}

const float slice_nothing = 0.0;

vec4 slice_join(vec4 a, vec4 b) {
    return a + b;
}
