// Sums for the mean: about padding, the share of padding drops out (as in march_mean.glsl); mm of tissue.
uniform float mean_base;

vec4 slice_value(vec2 pixel, Slab slab) {
    float piece = slab.length;
    return piece * vec4(field_at(slab.place) - mean_base, weight_at(slab.place), 0.0, 0.0);
}

const float slice_nothing = 0.0;

vec4 slice_join(vec4 a, vec4 b) {
    return a + b;
}
