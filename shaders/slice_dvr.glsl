// Emission and absorption of one slab, premultiplied, for blending.
vec4 slice_value(vec2 pixel, Slab slab) {
    // Half-way to the planes on both sides.
    vec3 half_way = slice_half_way(pixel);
    StepEnd at = step_end(slab.first ? slab.before : slab.place - half_way);
    vec4 medium = step_medium(slab.place, slab.last ? slab.beyond : slab.place + half_way, slab.length, at);
    float opacity = opacity_of(medium.a * slab.length);
    return vec4(opacity * shade(medium.rgb, slab.place, slice_along_mm(pixel), opacity > 0.0), opacity);
}

const float slice_nothing = 0.0;

// `nearer` lies before `farther`.
vec4 slice_join(vec4 nearer, vec4 farther) {
    return nearer + (1.0 - nearer.a) * farther;
}
