// Emission and absorption of one slab, premultiplied, for blending.
vec4 slice_value(vec2 pixel, Slab slab) {
    vec4 medium = transfer_at(stored_from(field_at(slab.place)));
    float opacity = opacity_of(medium.a * slab.length);
    return vec4(opacity * shade(medium.rgb, slab.place, slice_along_mm(pixel), opacity > 0.0), opacity);
}

const float slice_nothing = 0.0;

// `nearer` lies before `farther`.
vec4 slice_join(vec4 nearer, vec4 farther) {
    return nearer + (1.0 - nearer.a) * farther;
}
