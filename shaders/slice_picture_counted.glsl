layout(location = 0) out vec4 picture;
layout(location = 1) out float counted; // one for each sample, added up by blending

void main() {
    vec2 pixel = gl_FragCoord.xy;
    Slab slab;
    if (!slab_at(pixel, slice_plane, slab) || !slice_owns(slab.place)) discard;
    picture = slice_value(pixel, slab);
    counted = 1.0;
}
