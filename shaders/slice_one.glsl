// One plane a polygon.
layout(location = 0) out vec4 picture;

void main() {
    vec2 pixel = gl_FragCoord.xy;
    Slab slab;
    if (!slab_at(pixel, slice_which, slab) || !slice_owns(slab.place)) discard;
    picture = slice_value(pixel, slab);
}
