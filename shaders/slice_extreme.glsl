// A stored value, for blending by the greater or the lesser.
vec4 slice_value(vec2 pixel, Slab slab) {
    return vec4(field_at(slab.place));
}
