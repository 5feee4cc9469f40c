// Several planes a polygon, composited front to back.
layout(location = 0) out vec4 picture;

void main() {
    vec2 pixel = gl_FragCoord.xy;
    bool any = false;
    vec4 joined = vec4(slice_nothing);
    for (int i = 0; i < slice_group; i++) {
        int plane = slice_which * slice_group + i;
        Slab slab;
        bool owned = plane < slice_count && slab_at(pixel, plane, slab) && slice_owns(slab.place);
        if (owned) joined = slice_join(joined, slice_value(pixel, slab));
        any = any || owned;
    }
    if (!any) discard;
    picture = joined;
}
