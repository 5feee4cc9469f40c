// The stored value, for blending by the greater.
vec4 slice_value(vec2 pixel, Slab slab) {
    return vec4(field_at(slab.place));
}

const float slice_nothing = 0.0;

vec4 slice_join(vec4 a, vec4 b) {
    return max(a, b);
}
